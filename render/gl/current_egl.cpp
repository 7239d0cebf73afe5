#include "render/gl/current_egl.h"

#define EGL_NO_X11
#include <EGL/egl.h>

namespace render::gl {

std::optional<EglNames> currentEgl() {
    EGLDisplay const display = eglGetCurrentDisplay();
    EGLContext const context = eglGetCurrentContext();
    if (display == EGL_NO_DISPLAY || context == EGL_NO_CONTEXT) return std::nullopt;
    EGLint id = 0, count = 0;
    EGLConfig config = nullptr;
    if (eglQueryContext(display, context, EGL_CONFIG_ID, &id) == EGL_TRUE && id != 0) {
        const EGLint wanted[] = {EGL_CONFIG_ID, id, EGL_NONE};
        if (eglChooseConfig(display, wanted, &config, 1, &count) != EGL_TRUE || count == 0)
            config = nullptr;
    }
    return EglNames{display, config, context};
}

}  // namespace render::gl
