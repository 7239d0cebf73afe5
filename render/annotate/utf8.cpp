#include "render/annotate/utf8.h"

#include <cstddef>

namespace render {

namespace {

struct Decoded {
    char32_t point;
    std::size_t length;
};

Decoded decodeFirst(std::string_view text) {
    constexpr Decoded kMalformed{U'\uFFFD', 1};
    const auto lead = static_cast<unsigned char>(text[0]);
    if (lead < 0x80) return {lead, 1};
    const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    if (lead < 0xC0 || lead > 0xF7 || text.size() < length) return kMalformed;
    auto point = static_cast<char32_t>(lead & (0x7F >> length));
    for (std::size_t i = 1; i < length; ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        if ((byte & 0xC0) != 0x80) return kMalformed;
        point = point << 6 | (byte & 0x3F);
    }
    // Only the shortest form is UTF-8; surrogates and what lies beyond Unicode are not.
    constexpr char32_t kShortest[] = {0, 0, 0x80, 0x800, 0x10000};
    const bool surrogate = point >= 0xD800 && point <= 0xDFFF;
    if (point < kShortest[length] || surrogate || point > 0x10FFFF) return kMalformed;
    return {point, length};
}

}  // namespace

std::u32string codePoints(std::string_view utf8) {
    std::u32string points;
    while (!utf8.empty()) {
        const auto [point, length] = decodeFirst(utf8);
        points += point;
        utf8.remove_prefix(length);
    }
    return points;
}

std::string wellFormed(std::string_view text) {
    constexpr std::string_view kReplacement = "\uFFFD";
    std::string out;
    while (!text.empty()) {
        const auto [point, length] = decodeFirst(text);
        const bool isMalformed = point == U'\uFFFD' && length == 1;
        out += isMalformed ? kReplacement : text.substr(0, length);
        text.remove_prefix(length);
    }
    return out;
}

}  // namespace render
