#include "app/headset/hand_buttons.h"

#include <array>

#include "app/panels/form.h"
#include "app/panels/panel_context.h"

namespace app::headset {
namespace {

struct Button {
    HandCommand command;
    const char* label;
};
constexpr std::array kButtons = {
    Button{HandCommand::Bring, "Bring it here"}, Button{HandCommand::UndoMove, "Undo move"},
    Button{HandCommand::ResetSize, "Reset size"}, Button{HandCommand::ClipByHand, "Clip by hand"}};
constexpr float kTop = 104, kHeight = 36, kGap = 8;  // a ray is less steady than a mouse

}  // namespace

panels::Rect handButton(const panels::Layout& layout, HandCommand command) {
    const float s = layout.scale;
    const auto place = static_cast<std::size_t>(command);
    const float top =
        layout.picture.min.y + (kTop + (kHeight + kGap) * static_cast<float>(place / 2)) * s;
    const panels::Rect row{{layout.picture.min.x + panels::kMargin * s, top},
                           {layout.picture.max.x - panels::kMargin * s, top + kHeight * s}};
    return panels::part(row, place % 2, 2, s);
}

std::optional<HandCommand> drawHandButtons(const panels::Theme& theme, const panels::Layout& layout,
                                           const HandButtons& buttons) {
    const panels::Rect all{handButton(layout, kButtons.front().command).min,
                           handButton(layout, kButtons.back().command).max};
    // A fixed region that comes later than the picture's would lie below it.
    panels::beginRegion("##room", all, panels::kClear, panels::Depth::Front);
    std::optional<HandCommand> pressed;
    for (const Button& button : kButtons) {
        const panels::Rect at = handButton(layout, button.command);
        const bool lit = button.command == HandCommand::ClipByHand && buttons.clipsByHand;
        if (button.command == HandCommand::UndoMove && !buttons.canUndo)
            panels::text(theme, at.centre(), button.label, panels::kFaint, 0.5f);
        else if (panels::textButton(theme, button.label, at, button.label, lit))
            pressed = button.command;
    }
    panels::endRegion();
    return pressed;
}

}  // namespace app::headset
