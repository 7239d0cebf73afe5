// Text as the fields of Dear ImGui hold it: of a character they know 16 bits, and take what is
// more, or no UTF-8, for U+FFFD. Such a character, and such a byte of a file's name, has stand-ins
// there, code points that Unicode leaves to programs (noncharacters: The Unicode Standard,
// section 23.7). Pure.
#pragma once

#include <string>
#include <string_view>

namespace app::panels {

// Any bytes; and back, exactly. Of stand-ins that an edit has cut apart nothing is left.
std::string fieldText(std::string_view text);
std::string meantText(std::string_view field);
// A character that was typed: itself, or its stand-ins.
std::u32string fieldCharacters(char32_t typed);

}  // namespace app::panels
