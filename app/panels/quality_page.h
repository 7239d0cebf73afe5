// How splats are drawn, and how long a frame may take.
#pragma once

#include "app/panels/form.h"

namespace app::panels {

void drawQualityPage(PanelContext& context, const Rect& at);

}  // namespace app::panels
