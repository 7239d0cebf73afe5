// Where the error of the picture comes from, before it: opened by a press on the error among the
// figures (figures.h).
#pragma once

#include <string>
#include <vector>

#include "app/panels/panel_context.h"

namespace app::panels {

// A line each: the whole, its parts, light. Sizes are "…" while they are worked out.
struct ErrorLine {
    std::string name, size, what;
};
std::vector<ErrorLine> errorPartLines(const Performance& performance);

// Makes the error what can be pressed, and draws what that opens. Asks for the parts while it is
// open (Requests::errorParts).
void drawErrorParts(PanelContext& context);

}  // namespace app::panels
