#include "app/panels/field_text.h"

#include <cstddef>

namespace app::panels {
namespace {

// One of these before digits of so many bits each.
constexpr char32_t kCharacter = 0xFFFE, kByte = 0xFFFF, kDigit = 0xFDD0, kDigits = 32;
constexpr int kBits = 5, kDigitsOfCharacter = 4, kDigitsOfByte = 2;
constexpr char32_t kBeyond = 0x10000;  // the first of 2^20 characters

bool isDigit(char32_t c) { return c >= kDigit && c < kDigit + kDigits; }
bool isStandIn(char32_t c) { return c == kCharacter || c == kByte || isDigit(c); }

void append(std::string& out, char32_t c) {
    const auto byte = [&](char32_t bits) { out += static_cast<char>(bits); };
    const auto rest = [&](int shift) { byte(0x80 | ((c >> shift) & 0x3F)); };
    if (c < 0x80) return byte(c);
    if (c < 0x800) {
        byte(0xC0 | c >> 6);
        return rest(0);
    }
    if (c < kBeyond) {
        byte(0xE0 | c >> 12);
    } else {
        byte(0xF0 | c >> 18);
        rest(12);
    }
    rest(6);
    rest(0);
}

// The first character of what is not empty, and its bytes; 0 bytes where these are no UTF-8
// (RFC 3629).
struct First {
    char32_t character = 0;
    std::size_t bytes = 0;
};
First firstOf(std::string_view text) {
    const auto lead = static_cast<unsigned char>(text[0]);
    if (lead < 0x80) return {lead, 1};
    const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    if (lead < 0xC2 || lead > 0xF4 || text.size() < bytes) return {};
    char32_t c = lead & (0x7F >> bytes);
    for (const char each : text.substr(1, bytes - 1)) {
        const auto more = static_cast<unsigned char>(each);
        if ((more & 0xC0) != 0x80) return {};
        c = c << 6 | (more & 0x3F);
    }
    constexpr char32_t kLeast[] = {0x80, 0x800, kBeyond};
    const bool isSurrogate = c >= 0xD800 && c < 0xE000;
    if (c < kLeast[bytes - 2] || c > 0x10FFFF || isSurrogate) return {};
    return {c, bytes};
}

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
        const First first = firstOf(text);
        const bool isByte = first.bytes == 0 || isStandIn(first.character);
        const std::u32string held =
            isByte ? standIns(kByte, static_cast<unsigned char>(text[0]), kDigitsOfByte)
                   : fieldCharacters(first.character);
        for (const char32_t c : held) append(field, c);
        text.remove_prefix(isByte ? 1 : first.bytes);
    }
    return field;
}

std::string meantText(std::string_view field) {
    std::string text;
    const auto next = [&] {
        const First first = field.empty() ? First{} : firstOf(field);
        return first.bytes > 0 ? first : First{0, 1};
    };
    while (!field.empty()) {
        const First first = next();
        if (!isStandIn(first.character)) text += field.substr(0, first.bytes);
        field.remove_prefix(first.bytes);
        if (first.character != kCharacter && first.character != kByte) continue;
        const int digits = first.character == kByte ? kDigitsOfByte : kDigitsOfCharacter;
        char32_t value = 0;
        int read = 0;
        for (; read < digits && !field.empty() && isDigit(next().character); ++read) {
            value = value << kBits | (next().character - kDigit);
            field.remove_prefix(next().bytes);
        }
        if (read < digits) continue;
        if (first.character == kCharacter)
            append(text, value + kBeyond);
        else
            text += static_cast<char>(value);
    }
    return text;
}

}  // namespace app::panels
