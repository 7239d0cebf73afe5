#include "render/gl/headless_context.h"

#include <epoxy/gl.h>  // before EGL, as its header asks

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "render/gl/debug_output.h"

namespace render::gl {

struct HeadlessContext::Egl {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    ~Egl() {
        if (display == EGL_NO_DISPLAY) return;
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
        eglTerminate(display);
    }
};

namespace {

// EGL itself through the loader: epoxy's eglGetPlatformDisplay needs a display to exist already.
template <typename Function>
Function extension(const char* name) {
    return reinterpret_cast<Function>(eglGetProcAddress(name));
}

struct Device {
    EGLDeviceEXT id;
    bool software;
};

// "gpu", "cpu" or "any", GPUs first.
std::vector<Device> devicesOf(const std::string& kind) {
    const auto query = extension<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    const auto text = extension<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    if (query == nullptr || text == nullptr) return {};
    std::array<EGLDeviceEXT, 32> ids{};
    EGLint count = 0;
    if (!query(static_cast<EGLint>(ids.size()), ids.data(), &count)) return {};
    std::vector<Device> found;
    for (EGLint i = 0; i < count; ++i) {
        const char* extensions = text(ids[i], EGL_EXTENSIONS);
        const bool software =
            extensions != nullptr && std::strstr(extensions, "EGL_MESA_device_software") != nullptr;
        if (kind == (software ? "gpu" : "cpu")) continue;
        // GPUs first, in the system's order.
        found.insert(software ? found.end()
                              : std::find_if(found.begin(), found.end(),
                                             [](const Device& d) { return d.software; }),
                     Device{ids[i], software});
    }
    return found;
}

// Empty on success, else what was missing.
std::string makeCurrent(const Device& device, EGLDisplay& display, EGLContext& context) {
    const auto platformDisplay =
        extension<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    display = platformDisplay(EGL_PLATFORM_DEVICE_EXT, device.id, nullptr);
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr))
        return "no EGL display on it";
    if (!eglBindAPI(EGL_OPENGL_API)) return "no desktop OpenGL in its EGL";
    const std::array<EGLint, 9> attributes = {EGL_CONTEXT_MAJOR_VERSION,
                                              4,
                                              EGL_CONTEXT_MINOR_VERSION,
                                              5,
                                              EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                              EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                              EGL_CONTEXT_OPENGL_DEBUG,
                                              EGL_TRUE,
                                              EGL_NONE};
    context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    if (context == EGL_NO_CONTEXT) return "no OpenGL 4.5 core context on it";
    if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
        return "no context without a surface on it";
    return {};
}

}  // namespace

bool onlyProcessorsDraw(const std::string& device) {
    return device != "gpu" && std::ranges::all_of(devicesOf(device), &Device::software);
}

HeadlessContext::HeadlessContext(const std::string& wanted) {
    std::string tried;
    for (const Device& device : devicesOf(wanted)) {
        auto egl = std::make_unique<Egl>();
        const std::string why = makeCurrent(device, egl->display, egl->context);
        if (why.empty()) {
            egl_ = std::move(egl);
            break;
        }
        tried += fmt::format("; {}: {}", device.software ? "CPU renderer" : "GPU", why);
    }
    if (!egl_)
        throw std::runtime_error(
            fmt::format("no OpenGL 4.5 without a window: tried the {} of this machine{}. {}",
                        wanted == "gpu" ? "GPUs that EGL knows" : "EGL devices",
                        tried.empty() ? ", and found none" : tried,
                        wanted == "gpu" ? "--device any takes a CPU renderer where there is none"
                                        : "Mesa's llvmpipe (Debian: libegl1 libgl1-mesa-dri) is "
                                          "enough"));
    recordErrors();
    const auto text = [](GLenum name) { return reinterpret_cast<const char*>(glGetString(name)); };
    GLint major = 0, minor = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    renderer_ = fmt::format("{}, GL {}.{}", text(GL_RENDERER), major, minor);
}

HeadlessContext::~HeadlessContext() = default;

HeadlessContext::Names HeadlessContext::eglNames() const { return {egl_->display, egl_->context}; }

}  // namespace render::gl
