// The context that is current, by EGL's names, for another library that draws with it.
#pragma once

#include <optional>

namespace render::gl {

struct EglNames {
    void *display, *config, *context;  // EGLDisplay, EGLConfig (null if made without), EGLContext
};
// None where the current context is not EGL's.
std::optional<EglNames> currentEgl();

}  // namespace render::gl
