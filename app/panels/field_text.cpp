#include "app/panels/field_text.h"

#include <cstddef>

#include "render/annotate/utf8.h"

namespace app::panels {
namespace {

// One of these before digits of so many bits each.
constexpr char32_t kCharacter = 0xFFFE, kByte = 0xFFFF, kDigit = 0xFDD0, kDigits = 32;
constexpr int kBits = 5, kDigitsOfCharacter = 4, kDigitsOfByte = 2;
constexpr char32_t kBeyond = 0x10000;  // the first of 2^20 characters

bool isDigit(char32_t c) { return c >= kDigit && c < kDigit + kDigits; }
bool isStandIn(char32_t c) { return c == kCharacter || c == kByte || isDigit(c); }

std::u32string standIns(char32_t kind, char32_t value, int digits) {
    std::u32string all(1, kind);
    for (int i = digits - 1; i >= 0; --i) all += kDigit + ((value >> (i * kBits)) & (kDigits - 1));
    return all;
}

}  // namespace

std::u32string fieldCharacters(char32_t typed) {
    if (typed < kBeyond) return std::u32string(1, typed);
    return standIns(kCharacter, typed - kBeyond, kDigitsOfCharacter);
}

std::string fieldText(std::string_view text) {
    std::string field;
    while (!text.empty()) {
        const render::CodePoint first = render::firstPoint(text);
        const bool isByte = first.isMalformed() || isStandIn(first.point);
        const std::u32string held =
            isByte ? standIns(kByte, static_cast<unsigned char>(text[0]), kDigitsOfByte)
                   : fieldCharacters(first.point);
        for (const char32_t c : held) render::append(field, c);
        text.remove_prefix(isByte ? 1 : first.length);
    }
    return field;
}

std::string meantText(std::string_view field) {
    std::string text;
    while (!field.empty()) {
        const auto [point, length] = render::firstPoint(field);
        if (!isStandIn(point)) text += field.substr(0, length);
        field.remove_prefix(length);
        if (point != kCharacter && point != kByte) continue;
        const int digits = point == kByte ? kDigitsOfByte : kDigitsOfCharacter;
        char32_t value = 0;
        int read = 0;
        for (; read < digits && !field.empty(); ++read) {
            const render::CodePoint digit = render::firstPoint(field);
            if (!isDigit(digit.point)) break;
            value = value << kBits | (digit.point - kDigit);
            field.remove_prefix(digit.length);
        }
        if (read < digits) continue;
        if (point == kCharacter)
            render::append(text, value + kBeyond);
        else
            text += static_cast<char>(value);
    }
    return text;
}

}  // namespace app::panels
