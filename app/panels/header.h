// What is open: file, variable, and the menu of what can be done with it.
#pragma once

#include <span>

#include "app/choices/preferences.h"
#include "app/panels/panel_context.h"

namespace app::panels {

// REQUIRES: something is shown.
void drawHeader(PanelContext& context, const Rect& at, std::span<const Named> recent);

}  // namespace app::panels
