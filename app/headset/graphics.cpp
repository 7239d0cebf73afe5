#include "app/headset/graphics.h"

#include <stdexcept>

#include "render/frame/kept_picture.h"
#include "render/gl/current_egl.h"
#include "render/gl/current_glx.h"
#include "render/gl/debug_output.h"

namespace app::headset {
namespace {

constexpr glm::ivec2 kMirrorSize{900, 900};

}  // namespace

Graphics::Graphics(const xr::Session::Offer& offer) : takesEgl_(offer.takesEgl) {
    using desktop::Platform;
    try {
        window_.emplace(kMirrorSize, "isochron in the headset",
                        takesEgl_ ? Platform::Any : Platform::X11);
        window_->waitForScreen(false);
        render::gl::recordErrors();
    } catch (const std::runtime_error&) {
        headless_.emplace();
    }
}

xr::Binding Graphics::binding() const {
    if (headless_) {
        const auto [display, context] = headless_->eglNames();
        return xr::EglBinding{display, nullptr, context};
    }
    if (const auto glx = render::gl::currentGlx())
        return xr::XlibBinding{glx->display, glx->visual, glx->config, glx->drawable, glx->context};
    const auto egl = takesEgl_ ? render::gl::currentEgl() : std::nullopt;
    if (!egl)
        throw std::runtime_error(
            "the headset's runtime takes OpenGL from X11 only, and this display is another");
    return xr::EglBinding{egl->display, egl->config, egl->context};
}

void Graphics::mirror(const render::Present& present, render::Targets& light) {
    if (!window_) return;
    const glm::ivec2 size = window_->framebufferSize();
    if (size.x == 0 || size.y == 0) return;
    render::showGround(size, glm::vec3(0));
    const render::Fitted fitted = render::fittedInto(size, light.size());
    present.drawScaled(light, 0, fitted.at, fitted.size);
    window_->swap();
}

}  // namespace app::headset
