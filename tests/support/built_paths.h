// Where the tests were built from and what they run. One source file knows, so that a build in
// another folder compiles one file anew.
#pragma once

#include <filesystem>

namespace tests {

std::filesystem::path sourceFolder();
std::filesystem::path program();
std::filesystem::path brokenRuntime();  // a library of an OpenXR runtime: xr/broken_runtime.cpp

inline std::filesystem::path demo() { return sourceFolder() / "datasets/pool_fire_T.nc"; }

}  // namespace tests
