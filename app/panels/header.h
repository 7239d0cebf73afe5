// What is open: file, variable, and the menu of what can be done with it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/choices/preferences.h"
#include "app/panels/panel_context.h"

namespace app::panels {

// What is said beside each name of a menu: its folder where another has the same name.
std::vector<std::string> recentNotes(std::span<const Named> recent);

// REQUIRES: something is shown.
void drawHeader(PanelContext& context, const Rect& at, std::span<const Named> recent);

}  // namespace app::panels
