// Where the real data sets lie that are too large for the repository: beside it, or where the
// environment says.
#pragma once

#include <cstdlib>
#include <filesystem>

#include "tests/support/built_paths.h"

namespace tests {

inline std::filesystem::path sharedData(const std::filesystem::path& name) {
    const char* shared = std::getenv("ISOCHRON_SHARED");
    const std::filesystem::path root = shared ? shared : sourceFolder().parent_path() / "shared";
    return root / "datasets" / name;
}

}  // namespace tests
