#include "render/annotate/fitted_text.h"

#include <algorithm>
#include <string_view>

namespace render {

namespace {

// The most of `all` that fit, where fewer fit whenever more do; none where not even one does.
std::size_t mostThatFit(std::size_t all, const auto& fit) {
    std::size_t fitting = 0, tooMany = all + 1;
    while (tooMany - fitting > 1) {
        const std::size_t middle = fitting + (tooMany - fitting) / 2;
        (fit(middle) ? fitting : tooMany) = middle;
    }
    return fitting;
}

// Of the first bytes those that end no UTF-8 character in the middle.
std::size_t wholeCharacters(std::string_view text, std::size_t bytes) {
    while (bytes > 0 && bytes < text.size() &&
           (static_cast<unsigned char>(text[bytes]) & 0xC0) == 0x80)
        --bytes;
    return bytes;
}

}  // namespace

std::string shortened(const Font& font, FontStyle style, std::string text, float width) {
    if (font.measure(text, style).x <= width) return text;
    const auto cut = [&](std::size_t bytes) {
        bytes = wholeCharacters(text, bytes);
        while (bytes > 0 && text[bytes - 1] == ' ') --bytes;
        return bytes == 0 ? std::string() : text.substr(0, bytes) + "\u2026";
    };
    return cut(mostThatFit(text.size(), [&](std::size_t bytes) {
        return font.measure(cut(bytes), style).x <= width;
    }));
}

std::vector<std::string> wrapped(const Font& font, FontStyle style, const std::string& text,
                                 float width, std::size_t most) {
    std::string rest = text;
    std::replace(rest.begin(), rest.end(), '\n', ' ');
    std::vector<std::string> lines;
    while (!rest.empty() && lines.size() < most) {
        std::size_t end = rest.size();
        if (lines.size() + 1 < most) {
            end = mostThatFit(rest.size(), [&](std::size_t bytes) {
                return font.measure(rest.substr(0, wholeCharacters(rest, bytes)), style).x <= width;
            });
            if (end < rest.size()) end = rest.rfind(' ', end);
        }
        // One word that does not fit, or the last line: cut.
        if (end == std::string::npos || end == 0) end = std::min(rest.find(' ', 1), rest.size());
        lines.push_back(shortened(font, style, rest.substr(0, end), width));
        rest.erase(0, std::min(rest.find_first_not_of(' ', end), rest.size()));
    }
    std::erase(lines, std::string());
    return lines;
}

}  // namespace render
