// Choices that change nothing of a picture beside the others that were made.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/choices/explorer.h"

namespace app {

// Why nothing is lit; "" where cells are.
std::string_view whyUnlit(const Explorer& explorer);
// A sentence of each: "--light full does nothing: points are not lit". Of defaults nothing is said.
std::vector<std::string> idleChoices(const Explorer& explorer);

}  // namespace app
