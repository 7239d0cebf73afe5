// UTF-8 to code points (RFC 3629).
#pragma once

#include <string>
#include <string_view>

namespace render {

// Each byte that belongs to no well-formed sequence becomes U+FFFD.
std::u32string codePoints(std::string_view utf8);
// The text with each such byte replaced by U+FFFD: always well-formed.
std::string wellFormed(std::string_view text);

}  // namespace render
