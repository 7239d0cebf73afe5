#include "render/gl/debug_output.h"

#include <epoxy/gl.h>

#include <optional>
#include <stdexcept>
#include <string>

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
    if (!firstError) return;
    const std::string message = *firstError;
    firstError.reset();
    throw std::runtime_error("GL: " + message);
}

}  // namespace render::gl
