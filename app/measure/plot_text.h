// Texts of a plot: what is drawn of them, and how wide they are.
#pragma once

#include <string>
#include <string_view>

#include "app/measure/plot.h"

namespace app {

// As text of one line: well-formed UTF-8, a space for each control character.
std::string printable(std::string_view text);

}  // namespace app
