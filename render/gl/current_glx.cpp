#include "render/gl/current_glx.h"

#include <X11/Xlib.h>
#include <epoxy/glx.h>

namespace render::gl {

std::optional<GlxNames> currentGlx() {
    const GLXContext context = glXGetCurrentContext();
    Display* display = context == nullptr ? nullptr : glXGetCurrentDisplay();
    if (display == nullptr) return std::nullopt;
    int id = 0, screen = 0, count = 0;
    glXQueryContext(display, context, GLX_FBCONFIG_ID, &id);
    glXQueryContext(display, context, GLX_SCREEN, &screen);
    const int wanted[] = {GLX_FBCONFIG_ID, id, None};
    GLXFBConfig* configs = glXChooseFBConfig(display, screen, wanted, &count);
    if (configs == nullptr || count == 0) return std::nullopt;
    GlxNames names{display, 0, configs[0], glXGetCurrentDrawable(), context};
    int visual = 0;
    if (glXGetFBConfigAttrib(display, configs[0], GLX_VISUAL_ID, &visual) == 0)
        names.visual = static_cast<unsigned>(visual);
    XFree(configs);
    return names;
}

}  // namespace render::gl
