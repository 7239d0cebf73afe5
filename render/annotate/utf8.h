// UTF-8 and code points (RFC 3629).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace render {

struct CodePoint {
    char32_t point;
    std::size_t length;  // of its bytes
    bool isMalformed() const { return point == U'\uFFFD' && length == 1; }
};
// REQUIRES: text that is not empty. A byte that belongs to no well-formed sequence is malformed.
CodePoint firstPoint(std::string_view text);
// REQUIRES: a code point of Unicode.
void append(std::string& utf8, char32_t point);

// Each byte that belongs to no well-formed sequence becomes U+FFFD.
std::u32string codePoints(std::string_view utf8);
// The text with each such byte replaced by U+FFFD: always well-formed.
std::string wellFormed(std::string_view text);

}  // namespace render
