// What a probe found, in words.
#pragma once

#include <string>

#include "app/panels/desk.h"

namespace app::panels {

// A number with a unit, where there is one to be shown.
std::string withUnit(const std::string& number, const std::string& unit);
// "612.34 K": as few digits as tell the value among those of its own type.
std::string valueText(const Reading& reading, const Shown& shown);
// "0.125 m   [37]": along an axis (0 x, 1 y, 2 z), with the index.
std::string positionText(const Reading& reading, const Shown& shown, std::size_t axis);

}  // namespace app::panels
