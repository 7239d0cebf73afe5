// The one door by which text leaves for the terminal. Names of files and texts of old files may be
// Latin-1: what is no UTF-8 becomes U+FFFD.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <stdexcept>
#include <string>
#include <utility>

#include "render/annotate/utf8.h"

namespace app {

// Throws std::runtime_error when standard output cannot be written; a failure of another file is
// nobody's to tell.
template <typename... Arguments>
void sayTo(std::FILE* file, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    const std::string text =
        render::wellFormed(fmt::format(format, std::forward<Arguments>(arguments)...));
    if (std::fwrite(text.data(), 1, text.size(), file) != text.size() && file == stdout)
        throw std::runtime_error("standard output cannot be written");
}

template <typename... Arguments>
void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    sayTo(stdout, format, std::forward<Arguments>(arguments)...);
}

}  // namespace app
