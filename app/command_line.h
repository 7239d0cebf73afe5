// The call that makes the same picture: "copy as command line".
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/explorer.h"

namespace app {

// Arguments of `isochron render` for a resolved explorer, without the program's name; paths as
// they are relative to `folder`. parse() of them gives an equal Explorer, but for what pictures do
// not depend on: hidden layers are left out, `play` is not told.
std::vector<std::string> renderArguments(const Explorer& explorer, const std::filesystem::path& output,
                                         const std::filesystem::path& folder);

// One line for a POSIX shell: quoted where needed.
std::string shellText(const std::vector<std::string>& arguments);

}  // namespace app
