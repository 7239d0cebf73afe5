#include "render/annotate/utf8.h"

namespace render {

CodePoint firstPoint(std::string_view text) {
    constexpr CodePoint kMalformed{U'\uFFFD', 1};
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

void append(std::string& utf8, char32_t point) {
    const auto byte = [&](char32_t bits) { utf8 += static_cast<char>(bits); };
    const auto rest = [&](int shift) { byte(0x80 | ((point >> shift) & 0x3F)); };
    if (point < 0x80) return byte(point);
    if (point < 0x800) {
        byte(0xC0 | point >> 6);
    } else if (point < 0x10000) {
        byte(0xE0 | point >> 12);
        rest(6);
    } else {
        byte(0xF0 | point >> 18);
        rest(12);
        rest(6);
    }
    rest(0);
}

std::u32string codePoints(std::string_view utf8) {
    std::u32string points;
    while (!utf8.empty()) {
        const CodePoint first = firstPoint(utf8);
        points += first.point;
        utf8.remove_prefix(first.length);
    }
    return points;
}

std::string wellFormed(std::string_view text) {
    constexpr std::string_view kReplacement = "\uFFFD";
    std::string out;
    while (!text.empty()) {
        const CodePoint first = firstPoint(text);
        out += first.isMalformed() ? kReplacement : text.substr(0, first.length);
        text.remove_prefix(first.length);
    }
    return out;
}

}  // namespace render
