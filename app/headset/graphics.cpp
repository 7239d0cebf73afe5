#include "app/headset/graphics.h"

#include <stdexcept>

#include "render/gl/current_glx.h"
#include "render/gl/debug_output.h"
#include "render/kept_picture.h"

namespace app::headset {
namespace {

constexpr glm::ivec2 kMirrorSize{900, 900};

}  // namespace

Graphics::Graphics() {
    try {
        window_.emplace(kMirrorSize, "isochron in the headset");
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
    const auto glx = render::gl::currentGlx();
    if (!glx) throw std::runtime_error("the window's OpenGL is not GLX's, which a headset needs");
    return xr::XlibBinding{glx->display, glx->visual, glx->config, glx->drawable, glx->context};
}

void Graphics::mirror(const render::Present& present, const render::Targets& light) {
    if (!window_) return;
    const glm::ivec2 size = window_->framebufferSize();
    if (size.x == 0 || size.y == 0) return;
    render::showGround(size, glm::vec3(0));
    present.draw(light, 0, (size - light.size()) / 2);
    window_->swap();
}

}  // namespace app::headset
