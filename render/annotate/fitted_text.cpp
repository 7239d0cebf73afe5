#include "render/annotate/fitted_text.h"

#include <algorithm>

namespace render {

std::string shortened(const Font& font, FontStyle style, std::string text, float width) {
    if (font.measure(text, style).x <= width) return text;
    const std::string ellipsis = "\u2026";
    while (!text.empty()) {
        // A character's last byte, and those that continue it.
        while ((static_cast<unsigned char>(text.back()) & 0xC0) == 0x80 && text.size() > 1)
            text.pop_back();
        text.pop_back();
        while (!text.empty() && text.back() == ' ') text.pop_back();
        if (!text.empty() && font.measure(text + ellipsis, style).x <= width)
            return text + ellipsis;
    }
    return {};
}

std::vector<std::string> wrapped(const Font& font, FontStyle style, const std::string& text,
                                 float width, std::size_t most) {
    std::string rest = text;
    std::replace(rest.begin(), rest.end(), '\n', ' ');
    std::vector<std::string> lines;
    while (!rest.empty() && lines.size() < most) {
        std::size_t end = rest.size();
        if (lines.size() + 1 < most)
            while (end != std::string::npos && end > 0 &&
                   font.measure(rest.substr(0, end), style).x > width)
                end = rest.rfind(' ', end - 1);
        // One word that does not fit, or the last line: cut.
        if (end == std::string::npos || end == 0) end = std::min(rest.find(' ', 1), rest.size());
        lines.push_back(shortened(font, style, rest.substr(0, end), width));
        rest.erase(0, std::min(rest.find_first_not_of(' ', end), rest.size()));
    }
    std::erase(lines, std::string());
    return lines;
}

}  // namespace render
