// A GL 4.5 core context without a window or a display server: EGL on an enumerated device, no
// surface. A GPU where there is one, else Mesa's llvmpipe.
#pragma once

#include <memory>
#include <string>

namespace render::gl {

// Whether a context on such a device, if there is one, can only be a processor's. Loads no driver.
bool onlyProcessorsDraw(const std::string& device);

// Current on the thread that made it, until destroyed there.
class HeadlessContext {
 public:
    // `device`: "gpu", "cpu" or "any" (a GPU first). Throws std::runtime_error saying which devices
    // were tried and what was missing.
    explicit HeadlessContext(const std::string& device = "any");
    ~HeadlessContext();
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;

    // "llvmpipe (LLVM 15.0.6, 256 bits), GL 4.5".
    const std::string& renderer() const { return renderer_; }
    // EGLDisplay and EGLContext, for another library that draws with them; the context was made
    // without an EGLConfig.
    struct Names {
        void *display, *context;
    };
    Names eglNames() const;

 private:
    struct Egl;
    std::unique_ptr<Egl> egl_;
    std::string renderer_;
};

}  // namespace render::gl
