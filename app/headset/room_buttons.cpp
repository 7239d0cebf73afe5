#include "app/headset/room_buttons.h"

#include <array>

#include "app/panels/desk.h"
#include "app/panels/form.h"

namespace app::headset {
namespace {

struct Button {
    RoomCommand command;
    const char* label;
};
constexpr std::array kButtons = {
    Button{RoomCommand::Bring, "Bring it here"}, Button{RoomCommand::UndoMove, "Undo move"},
    Button{RoomCommand::ResetSize, "Reset size"}, Button{RoomCommand::ClipByHand, "Clip by hand"}};
constexpr float kTop = 104, kHeight = 36, kGap = 8;  // a ray is less steady than a mouse

}  // namespace

panels::Rect roomButton(const panels::Layout& layout, RoomCommand command) {
    const float s = layout.scale;
    const auto place = static_cast<std::size_t>(command);
    const float top =
        layout.picture.min.y + (kTop + (kHeight + kGap) * static_cast<float>(place / 2)) * s;
    const panels::Rect row{{layout.picture.min.x + panels::kMargin * s, top},
                           {layout.picture.max.x - panels::kMargin * s, top + kHeight * s}};
    return panels::part(row, place % 2, 2, s);
}

std::optional<RoomCommand> drawRoomButtons(const panels::Theme& theme, const panels::Layout& layout,
                                           const RoomButtons& buttons) {
    const panels::Rect all{roomButton(layout, kButtons.front().command).min,
                           roomButton(layout, kButtons.back().command).max};
    // A fixed region that comes later than the picture's would lie below it.
    panels::beginRegion("##room", all, panels::kClear, panels::Depth::Front);
    std::optional<RoomCommand> pressed;
    for (const Button& button : kButtons) {
        const panels::Rect at = roomButton(layout, button.command);
        const bool lit = button.command == RoomCommand::ClipByHand && buttons.clipsByHand;
        if (button.command == RoomCommand::UndoMove && !buttons.canUndo)
            panels::text(theme, at.centre(), button.label, panels::kFaint, 0.5f);
        else if (panels::textButton(theme, button.label, at, button.label, lit))
            pressed = button.command;
    }
    panels::endRegion();
    return pressed;
}

}  // namespace app::headset
