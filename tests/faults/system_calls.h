// The calls by which files are read and written are this program's own, where it links
// system_calls.cpp: they pass on what they are asked to the kernel, fail when a test says so, and
// are noted. One thread.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tests {

// Given a call's number among those of its kind, and what it asks for: nothing to let it be, or
// what it returns (a count, or -errno).
using Meddle = std::function<std::optional<long>(std::size_t call, std::size_t bytes)>;
struct Calls {
    Meddle pread, pwritev, fsync, rename, flock;
    std::size_t preads = 0, pwritevs = 0, fsyncs = 0, renames = 0, flocks = 0;
    // The process is killed in place of what would be the so-manieth of all that change anything.
    std::optional<std::size_t> killedAt;
    std::size_t changes = 0;
};
extern Calls calls;

// What was done to files below a folder, in order, while it is watched.
struct Done {
    enum What { Write, Sync, SyncFolder, Rename, Remove } what;
    std::string path, to;
    std::uint64_t at = 0;
    std::string bytes;
    std::chrono::steady_clock::time_point when{};  // the same clock for all processes
    unsigned process = 0;
};
extern std::optional<std::string> watched;
extern std::vector<Done> done;

}  // namespace tests
