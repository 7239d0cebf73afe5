// The call that makes the same picture: "copy as command line".
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/choices/explorer.h"

namespace app {

// `isochron render` and its arguments for a resolved explorer, without the program's name; paths as
// they are from `folder`. parse() of them gives an equal Explorer but for `play`, of which pictures
// depend on the tick of a sweep that stands alone. REQUIRES: a resolved explorer in which every
// layer has a range.
std::vector<std::string> renderArguments(const Explorer& explorer,
                                         const std::filesystem::path& output,
                                         const std::filesystem::path& folder);

// How a shell calls this program, as a word: ./run of a source tree where it was started by that,
// else `isochron` where PATH has it, else its path. `running` links to its file.
std::string callOfProgram(const std::filesystem::path& running = "/proc/self/exe");

// One line for a POSIX shell: quoted where needed.
std::string shellText(const std::vector<std::string>& arguments);

}  // namespace app
