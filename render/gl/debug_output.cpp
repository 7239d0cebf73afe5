#include "render/gl/debug_output.h"

#include <epoxy/gl.h>

#include <stdexcept>
#include <utility>

namespace render::gl {
namespace {

// One GL context a thread: the message belongs to the thread that owns it.
thread_local std::optional<std::string> firstError;

void GLAPIENTRY record(GLenum, GLenum type, GLuint, GLenum, GLsizei length, const GLchar* message,
                       const void*) {
    if (type != GL_DEBUG_TYPE_ERROR && type != GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR) return;
    if (!firstError) firstError.emplace(message, static_cast<std::size_t>(length));
}

}  // namespace

void recordErrors() {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(record, nullptr);
}

void throwOnError() {
    if (const GLenum code = glGetError(); code != GL_NO_ERROR && !firstError)
        firstError = "error " + std::to_string(code);
    if (const auto error = takeRecordedError()) throw std::runtime_error("GL: " + *error);
}

void forgetErrors() {
    // A context that is lost answers errors for ever.
    for (int left = 16; glGetError() != GL_NO_ERROR && left > 0; --left) {
    }
    firstError.reset();
}

std::optional<std::string> takeRecordedError() { return std::exchange(firstError, std::nullopt); }

}  // namespace render::gl
