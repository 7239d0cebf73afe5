#include "timeseries/machine_memory.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace timeseries {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();

// A group is held to what each group about it is, too. "max", or no file: to nothing.
std::uint64_t limitOf(const fs::path& root, fs::path group, const char* file) {
    std::uint64_t least = kUnlimited;
    for (group = group.relative_path();; group = group.parent_path()) {
        std::ifstream in(root / group / file);
        if (std::uint64_t bytes; in >> bytes) least = std::min(least, bytes);
        if (group.empty()) return least;
    }
}

}  // namespace

std::uint64_t machineMemory(const fs::path& ofProcess, const fs::path& groups) {
    std::uint64_t least = static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
                          static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
    std::ifstream in(ofProcess);
    // Number, controllers with commas between them (none: the second version), path.
    std::string number, controllers, path;
    while (std::getline(in, number, ':') && std::getline(in, controllers, ':') &&
           std::getline(in, path)) {
        if (controllers.empty())
            least = std::min(least, limitOf(groups, path, "memory.max"));
        else if (("," + controllers + ",").find(",memory,") != std::string::npos)
            least = std::min(least, limitOf(groups / "memory", path, "memory.limit_in_bytes"));
    }
    return least;
}

}  // namespace timeseries
