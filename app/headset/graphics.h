// The GL context that a headset session draws with: a window's, which then mirrors what the left
// eye sees, or one without a window where there is no display.
#pragma once

#include <optional>

#include "app/desktop/window.h"
#include "render/gl/headless_context.h"
#include "render/present.h"
#include "xr/session.h"

namespace app::headset {

class Graphics {
 public:
    // Throws std::runtime_error when there is neither.
    Graphics();

    xr::Binding binding() const;
    // Null without a display.
    desktop::Window* window() { return window_ ? &*window_ : nullptr; }
    // The middle of an eye's picture into the window, without waiting for its screen; nothing
    // where there is none, or it is hidden.
    void mirror(const render::Present& present, const render::Targets& light);

 private:
    std::optional<desktop::Window> window_;
    std::optional<render::gl::HeadlessContext> headless_;
};

}  // namespace app::headset
