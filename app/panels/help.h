// All keys and gestures over the picture.
#pragma once

#include "app/panels/panel_context.h"

namespace app::panels {

void drawHelp(const PanelContext& context);

}  // namespace app::panels
