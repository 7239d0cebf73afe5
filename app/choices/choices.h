// Every choice of a picture that is one value, declared once: how the command line, its copy and
// session files spell it. Files and layers are lists, spelled where they are read; so are, on the
// command line, names of axes.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "app/choices/explorer.h"

namespace app {

struct Choice {
    // "--splat-size"; "" where only sessions have it.
    const char* option;
    // In a session; of an object in it where there is a dot: "view.target". "" where a session has
    // its parts instead.
    const char* key;
    enum class Form { Text, Number, Whole, Numbers, Flag } form;  // there
    // None where nothing was chosen, and nothing is written.
    std::optional<std::string> (*text)(const Explorer&);
    // Throws std::invalid_argument, one sentence. A sweep's: REQUIRES its animation before it.
    void (*take)(Explorer&, std::string_view text);
    const char* group = "";  // of the command line's help
    const char* help = "";
    // What the option stands for where it takes no value.
    const char* flag = nullptr;
};

// In the order in which they are taken.
std::span<const Choice> choices();
// REQUIRES: there is one.
const Choice& choiceOf(std::string_view option);

// What keeps choices from standing together, which none of them can tell for itself.
struct Flaw {
    std::string key;  // of the one at fault, as above, or "layers"
    std::string why;
};
std::optional<Flaw> flawOf(const Explorer& explorer);

// How many pictures one cycle of the sweep has, whatever its ranges are. Throws
// std::invalid_argument for settings that are no sweep's.
std::int64_t ticksOf(timeseries::SweepSettings settings);

}  // namespace app
