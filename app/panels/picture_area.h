// The picture under the hand: turn, move, zoom, probe; and what is said over it.
#pragma once

#include "app/panels/panel_context.h"

namespace app::panels {

class PictureArea {
 public:
    // Takes the mouse over the picture, where nothing drawn before has it. `outline`:
    // PlacedPoints::outline() of what is drawn there. REQUIRES: something is shown.
    void handle(PanelContext& context, const render::Outline& outline);
    // The pointer's place on the picture, in its pixels; none where it is elsewhere or drags.
    const std::optional<glm::vec2>& pointer() const { return pointer_; }

 private:
    enum class Grip { None, Turn, Move };
    Grip grip_ = Grip::None;
    std::optional<glm::vec2> pointer_;
};

// What is opening, what is shown instead of what is asked for, from `top` on; how far an export is.
void drawPictureOverlay(PanelContext& context, float top,
                        const std::optional<std::string>& exporting);

}  // namespace app::panels
