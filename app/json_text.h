// JSON as the program prints and keeps it. Names and units of old files may be Latin-1: what is no
// UTF-8 becomes U+FFFD instead of an exception. What a terminal would obey is escaped, so that it
// is printed as it is.
#pragma once

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "app/say.h"

namespace app {

// `indent`: -1 for one line.
template <typename Json>
std::string jsonText(const Json& json, int indent) {
    const std::string dumped = json.dump(indent, ' ', false, Json::error_handler_t::replace);
    std::string text;
    for (std::string_view rest = dumped; !rest.empty();) {
        const render::CodePoint first = render::firstPoint(rest);
        if (isObeyed(first.point))
            text += fmt::format("\\u{:04x}", static_cast<unsigned>(first.point));
        else
            text += rest.substr(0, first.length);
        rest.remove_prefix(first.length);
    }
    return text;
}

}  // namespace app
