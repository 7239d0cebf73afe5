// All keys and gestures over the picture.
#pragma once

#include "app/panels/desk.h"

namespace app::panels {

void drawHelp(const Desk& desk);

}  // namespace app::panels
