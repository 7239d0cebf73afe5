// Command lines as tests parse them.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/choices/choice_text.h"
#include "app/choices/options.h"
#include "app/choices/session.h"
#include "tests/support/files.h"
#include "timeseries/readers/reader.h"

namespace app::parsing {

inline Command parsed(const std::vector<std::string>& arguments) {
    std::vector<const char*> pointers;
    for (const std::string& argument : arguments) pointers.push_back(argument.c_str());
    return parse(pointers);
}

template <typename T>
T as(const std::vector<std::string>& arguments) {
    Command command = parsed(arguments);
    if (const auto* exit = std::get_if<Exit>(&command))
        throw std::runtime_error("exit " + std::to_string(exit->code) + ": " + exit->text);
    return std::get<T>(command);
}

// `isochron render a.nc -o o.exr` and these.
inline RenderOptions render(std::vector<std::string> more) {
    more.insert(more.begin(), {"render", "a.nc", "-o", "o.exr"});
    return as<RenderOptions>(more);
}

inline Explorer explorer(const std::vector<std::string>& more) { return render(more).explorer; }

// Refused with exit code 2 in one sentence, which is returned.
inline std::string refused(const std::vector<std::string>& arguments) {
    const Command command = parsed(arguments);
    std::string line;
    for (const std::string& argument : arguments) line += " '" + argument + "'";
    const auto* exit = std::get_if<Exit>(&command);
    if (exit == nullptr) {
        ADD_FAILURE() << "accepted:" << line;
        return {};
    }
    EXPECT_EQ(exit->code, 2) << line;
    EXPECT_FALSE(exit->text.empty()) << line;
    EXPECT_EQ(exit->text.find('\n'), std::string::npos) << line << ": " << exit->text;
    return exit->text;
}

inline std::string renderRefused(std::vector<std::string> more) {
    more.insert(more.begin(), {"render", "a.nc", "-o", "o.exr"});
    return refused(more);
}

inline glm::dvec3 rgb(const LayerChoice& layer) {
    return std::get<glm::dvec3>(layer.color.value());
}
inline std::string_view mapName(const LayerChoice& layer) {
    return std::get<MapChoice>(layer.color.value()).map.name();
}

}  // namespace app::parsing
