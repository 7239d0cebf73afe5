#include "tests/support/built_paths.h"

namespace tests {

std::filesystem::path sourceFolder() { return SOURCE_DIR; }
std::filesystem::path program() { return PROGRAM; }
std::filesystem::path brokenRuntime() { return BROKEN_RUNTIME; }

}  // namespace tests
