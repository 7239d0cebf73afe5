// How much memory this process may have.
#pragma once

#include <cstdint>
#include <filesystem>

namespace timeseries {

// Bytes: what is installed or, where that is less, what the process's control groups are held to,
// as jobs of a cluster and containers are. The folders are Linux's: where it says of which groups
// the process is (cgroups(7), both versions), and where these are.
std::uint64_t machineMemory(const std::filesystem::path& ofProcess = "/proc/self/cgroup",
                            const std::filesystem::path& groups = "/sys/fs/cgroup");

}  // namespace timeseries
