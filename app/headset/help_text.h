// What the panel says of the controllers that are there, and of no others.
#pragma once

#include <string>

#include "xr/session.h"

namespace app::headset {

// Lines parted by '\n'.
std::string helpText(const std::string& runtime, const xr::Controls& controls);

}  // namespace app::headset
