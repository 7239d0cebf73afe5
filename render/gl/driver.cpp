#include "render/gl/driver.h"

#include <epoxy/gl.h>

#include <string_view>

namespace render::gl {

bool drawsOnProcessor() {
    const std::string_view name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    return name.starts_with("llvmpipe") || name.starts_with("softpipe");
}

void finishDrawing() { glFinish(); }

}  // namespace render::gl
