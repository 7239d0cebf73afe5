// The one door by which text leaves for the terminal. Names of files and texts of old files may be
// Latin-1, or hold what a terminal obeys: what is no UTF-8, a control other than an end of a line
// and a tab, or what turns the direction of the text, becomes U+FFFD.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "render/annotate/utf8.h"

namespace app {

// Of a code point whether a terminal may obey it instead of showing it: the controls of ASCII and
// of Latin-1, and those that make what follows run the other way, by which one name looks like
// another.
inline bool isObeyed(char32_t point) {
    return (point < 0x20 && point != U'\n' && point != U'\t') || (point >= 0x7F && point <= 0x9F) ||
           (point >= 0x202A && point <= 0x202E) || (point >= 0x2066 && point <= 0x2069);
}

// Well-formed UTF-8 in which nothing is obeyed.
inline std::string harmless(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        const render::CodePoint first = render::firstPoint(text);
        render::append(out, isObeyed(first.point) ? U'\uFFFD' : first.point);
        text.remove_prefix(first.length);
    }
    return out;
}

// Throws std::runtime_error when standard output cannot be written; a failure of another file is
// nobody's to tell.
template <typename... Arguments>
void sayTo(std::FILE* file, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    const std::string text = harmless(fmt::format(format, std::forward<Arguments>(arguments)...));
    if (std::fwrite(text.data(), 1, text.size(), file) != text.size() && file == stdout)
        throw std::runtime_error("standard output cannot be written");
}

template <typename... Arguments>
void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    sayTo(stdout, format, std::forward<Arguments>(arguments)...);
}

}  // namespace app
