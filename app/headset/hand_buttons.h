// Buttons on the panel for what hands do, so that a controller with one button can ask for all that
// the hands can. Pure ImGui.
#pragma once

#include <optional>

#include "app/headset/hand_interaction.h"
#include "app/panels/layout.h"
#include "app/panels/theme.h"

namespace app::headset {

// What they depend on.
struct HandButtons {
    bool canUndo = false;
    bool clipsByHand = false;
};

// Two by two where a window has its picture, below what is said at its top and above the help.
panels::Rect handButton(const panels::Layout& layout, HandCommand command);
// Between ImGui's NewFrame and Render, after the interface. Returns what was pressed.
std::optional<HandCommand> drawHandButtons(const panels::Theme& theme, const panels::Layout& layout,
                                           const HandButtons& buttons);

}  // namespace app::headset
