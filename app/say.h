// The one door by which text leaves for the terminal. Names of files and texts of old files may be
// Latin-1, or hold what a terminal obeys: what is no UTF-8, or a control other than an end of a
// line and a tab, becomes U+FFFD.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "render/annotate/utf8.h"

namespace app {

// Text that is UTF-8, without controls.
inline std::string harmless(std::string_view text) {
    std::string out;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        const bool obeyed = (byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7F;
        if (obeyed)
            out += "\uFFFD";
        else
            out += c;
    }
    return out;
}

// Throws std::runtime_error when standard output cannot be written; a failure of another file is
// nobody's to tell.
template <typename... Arguments>
void sayTo(std::FILE* file, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    const std::string text =
        harmless(render::wellFormed(fmt::format(format, std::forward<Arguments>(arguments)...)));
    if (std::fwrite(text.data(), 1, text.size(), file) != text.size() && file == stdout)
        throw std::runtime_error("standard output cannot be written");
}

template <typename... Arguments>
void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    sayTo(stdout, format, std::forward<Arguments>(arguments)...);
}

}  // namespace app
