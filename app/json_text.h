// JSON as the program prints and keeps it. Names and units of old files may be Latin-1: what is no
// UTF-8 becomes U+FFFD instead of an exception.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace app {

// `indent`: -1 for one line.
template <typename Json>
std::string jsonText(const Json& json, int indent) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace app
