// The GL context that a headset session draws with: a window's, which then mirrors what the left
// eye sees, or one without a window where there is no display.
#pragma once

#include <optional>

#include "app/desktop/window.h"
#include "render/frame/present.h"
#include "render/gl/headless_context.h"
#include "xr/session.h"

namespace app::headset {

class Graphics {
 public:
    // Of a display that the runtime takes. Throws std::runtime_error when there is neither.
    explicit Graphics(const xr::Session::Offer& offer);

    // Throws std::runtime_error where the display's OpenGL is not the runtime's.
    xr::Binding binding() const;
    // Null without a display.
    desktop::Window* window() { return window_ ? &*window_ : nullptr; }
    // All of an eye's picture into the window, as large as it fits, without waiting for its screen;
    // nothing where there is none, or it is hidden.
    void mirror(const render::Present& present, render::Targets& light);

 private:
    bool takesEgl_;
    std::optional<desktop::Window> window_;
    std::optional<render::gl::HeadlessContext> headless_;
};

}  // namespace app::headset
