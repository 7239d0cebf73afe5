#include "tests/support/glx_context.h"

#include <epoxy/gl.h>
#include <epoxy/glx.h>

#include <stdexcept>

namespace tests {
namespace {

Display* displayOf(const xr::XlibBinding& binding) {
    return static_cast<Display*>(binding.display);
}

}  // namespace

GlxContext::GlxContext() {
    Display* display = XOpenDisplay(nullptr);
    if (display == nullptr) throw std::runtime_error("no X display answers");
    binding_.display = display;
    const int wanted[] = {GLX_RENDER_TYPE,
                          GLX_RGBA_BIT,
                          GLX_DRAWABLE_TYPE,
                          GLX_PBUFFER_BIT,
                          GLX_RED_SIZE,
                          8,
                          GLX_GREEN_SIZE,
                          8,
                          GLX_BLUE_SIZE,
                          8,
                          GLX_ALPHA_SIZE,
                          8,
                          GLX_X_VISUAL_TYPE,
                          GLX_TRUE_COLOR,
                          None};
    int count = 0;
    GLXFBConfig* configs = glXChooseFBConfig(display, DefaultScreen(display), wanted, &count);
    if (count == 0) throw std::runtime_error("the X display has no GLX configuration of 8 bits");
    const GLXFBConfig config = configs[0];
    XFree(configs);
    XVisualInfo* visual = glXGetVisualFromFBConfig(display, config);
    const int small[] = {GLX_PBUFFER_WIDTH, 16, GLX_PBUFFER_HEIGHT, 16, None};
    const int core45[] = {GLX_CONTEXT_MAJOR_VERSION_ARB,
                          4,
                          GLX_CONTEXT_MINOR_VERSION_ARB,
                          5,
                          GLX_CONTEXT_PROFILE_MASK_ARB,
                          GLX_CONTEXT_CORE_PROFILE_BIT_ARB,
                          None};
    const GLXPbuffer drawable = glXCreatePbuffer(display, config, small);
    const GLXContext context = glXCreateContextAttribsARB(display, config, nullptr, True, core45);
    binding_ = {display, static_cast<unsigned>(visual->visualid), config, drawable, context};
    XFree(visual);
    if (context == nullptr || !glXMakeCurrent(display, drawable, context))
        throw std::runtime_error("the X display has no OpenGL 4.5 core context");
}

GlxContext::~GlxContext() {
    Display* display = displayOf(binding_);
    glXMakeCurrent(display, None, nullptr);
    glXDestroyContext(display, static_cast<GLXContext>(binding_.context));
    glXDestroyPbuffer(display, binding_.drawable);
    XCloseDisplay(display);
}

}  // namespace tests
