#include "app/panels/fitted_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cfloat>

#include "render/annotate/utf8.h"

namespace app::panels {

Characters::Characters(std::string_view what) {
    // Most texts are ASCII, and are drawn in every frame.
    if (std::ranges::any_of(what, [](char c) { return static_cast<unsigned char>(c) >= 0x80; }))
        what = mended = render::wellFormed(what);
    begin = what.empty() ? "" : what.data();
    end = begin + what.size();
}

glm::vec2 sizeOf(ImFont& font, std::string_view what) {
    const Characters c(what);
    const ImVec2 size = font.CalcTextSizeA(font.FontSize, FLT_MAX, 0, c.begin, c.end);
    return {size.x, size.y};
}
float widthOf(ImFont& font, std::string_view what) { return sizeOf(font, what).x; }

std::string shortened(std::string_view what, const std::function<bool(std::string_view)>& fits) {
    if (fits(what)) return std::string(what);
    const auto inside = [&](std::size_t bytes) {  // not within a UTF-8 character
        while (bytes > 0 && (static_cast<unsigned char>(what[bytes]) & 0xC0) == 0x80) --bytes;
        return bytes;
    };
    const auto cut = [&](std::size_t kept) {
        if (kept == 0) return std::string("…");
        return fmt::format("{}…{}", what.substr(0, inside(kept / 2)),
                           what.substr(inside(what.size() - kept / 2)));
    };
    std::size_t kept = 0, tooMany = what.size();
    while (tooMany - kept > 1) {
        const std::size_t middle = kept + (tooMany - kept) / 2;
        (fits(cut(middle)) ? kept : tooMany) = middle;
    }
    return cut(kept);
}

std::string fitting(ImFont& font, std::string_view what, float width) {
    return shortened(what, [&](std::string_view text) { return widthOf(font, text) <= width; });
}

std::string beginning(ImFont& font, std::string_view what, float width) {
    if (widthOf(font, what) <= width) return std::string(what);
    std::size_t bytes = what.size();
    std::string cut;
    do {  // whole UTF-8 characters
        do --bytes;
        while (bytes > 0 && (static_cast<unsigned char>(what[bytes]) & 0xC0) == 0x80);
        cut = fmt::format("{}…", what.substr(0, bytes));
    } while (bytes > 0 && widthOf(font, cut) > width);
    return cut;
}

std::string inLines(ImFont& font, std::string_view what, float width) {
    std::string out;
    std::size_t line = 0;  // where it begins in `out`
    const auto fits = [&](std::string_view more) {
        return widthOf(font, std::string(out, line).append(more)) <= width;
    };
    const auto breakLine = [&] {
        while (out.size() > line && out.back() == ' ') out.pop_back();
        out += '\n';
        line = out.size();
    };
    while (!what.empty()) {
        const std::size_t end = what.find_first_of(" /\n");
        const bool isLast = end == std::string_view::npos;
        std::string_view word = what.substr(0, isLast || what[end] != '/' ? end : end + 1);
        what.remove_prefix(word.size());
        if (!fits(word) && out.size() > line) breakLine();
        for (; !fits(word); breakLine()) {
            std::size_t bytes = 0;  // as many as fit, whole UTF-8 characters, one at least
            do {
                std::size_t next = bytes + 1;
                while (next < word.size() &&
                       (static_cast<unsigned char>(word[next]) & 0xC0) == 0x80)
                    ++next;
                if (bytes > 0 && !fits(word.substr(0, next))) break;
                bytes = next;
            } while (bytes < word.size());
            out += word.substr(0, bytes);
            word.remove_prefix(bytes);
            if (word.empty()) break;
        }
        out += word;
        for (; !what.empty() && (what[0] == ' ' || what[0] == '\n'); what.remove_prefix(1)) {
            out += what[0];
            if (what[0] == '\n') line = out.size();
        }
    }
    return out;
}

}  // namespace app::panels
