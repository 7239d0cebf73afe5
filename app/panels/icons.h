// Icons as strokes: crisp at every scale, no texture.
#pragma once

#include "app/panels/theme.h"

namespace app::panels {

enum class Icon {
    Play,
    Pause,
    StepBack,
    StepForward,
    Once,
    Loop,
    PingPong,
    Eye,
    EyeClosed,
    Remove,
    Add,
    Menu,
    Folder,
    File,
    Down
};

// Fills about 16 x 16 units of the design around `centre`.
void drawIcon(ImDrawList& list, Icon icon, glm::vec2 centre, float scale, ImU32 color);

}  // namespace app::panels
