// The room's own buttons on the panel, so that a controller with one button can ask for all that
// the hands can. Pure ImGui.
#pragma once

#include <optional>

#include "app/headset/room.h"
#include "app/panels/layout.h"
#include "app/panels/theme.h"

namespace app::headset {

// What they depend on.
struct RoomButtons {
    bool canUndo = false;
    bool clipsByHand = false;
};

// Two by two where a window has its picture, below what is said at its top and above the help.
panels::Rect roomButton(const panels::Layout& layout, RoomCommand command);
// Between ImGui's NewFrame and Render, after the interface. Returns what was pressed.
std::optional<RoomCommand> drawRoomButtons(const panels::Theme& theme, const panels::Layout& layout,
                                           const RoomButtons& buttons);

}  // namespace app::headset
