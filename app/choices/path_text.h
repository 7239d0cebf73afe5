// Paths as texts in JSON, which holds UTF-8 alone, while names of old files may be anything.
#pragma once

#include <string>
#include <string_view>

namespace app {

bool isUtf8(std::string_view text);

// A path with what is no UTF-8 as %XX, and each % of its own, too; and back, which throws
// ChoiceError where two hexadecimal digits do not follow a %.
std::string escaped(std::string_view path);
std::string unescaped(std::string_view text);

}  // namespace app
