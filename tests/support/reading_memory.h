// Reading one step of an uncompressed file holds at most twice its size: what it takes in the file,
// or the field's values where those are more (packed values are unpacked to a wider type).
#pragma once

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "timeseries/readers/reader.h"

namespace tests {

// A cube of 4-byte values takes 64 MiB, far more than the libraries and their buffers.
inline constexpr std::size_t kSide = 256;
inline constexpr std::uint64_t kPoints = kSide * kSide * kSide;

// `head`, then so many zero bytes, which take no room on the disk.
inline void writeHollow(const std::filesystem::path& path, const std::string& head,
                        std::uint64_t bytes) {
    std::ofstream(path, std::ios::binary) << head;
    std::filesystem::resize_file(path, head.size() + bytes);
}

// The most that a child of this process has resident while it works, in bytes, what it frees again
// included. REQUIRES: one thread.
inline std::uint64_t residentPeak(const std::function<void()>& work) {
    const pid_t child = fork();
    if (child == 0) {
        work();
        _exit(0);
    }
    int status = 1;
    rusage usage{};
    EXPECT_EQ(wait4(child, &status, 0, &usage), child);
    EXPECT_EQ(status, 0);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

// Of the last step of a variable of kPoints points: what it takes in the file and in the field.
struct StepBytes {
    std::uint64_t stored, values;
};
// Reads it: all, or the last eighth along z.
inline void expectTwiceAtMost(const std::filesystem::path& path, StepBytes bytes,
                              std::size_t variable = 0, bool eighth = false) {
    const std::uint64_t nothing = residentPeak([] {});
    const std::uint64_t part = eighth ? 8 : 1;
    const std::uint64_t reading = residentPeak([&] {
        const auto reader = timeseries::openReader(std::span(&path, 1));
        const std::size_t steps = reader->variables()[variable].time->points.size();
        const timeseries::Field field =
            eighth ? reader->slab(variable, steps - 1, {2, kSide - kSide / 8, kSide / 8})
                   : reader->read(variable, steps - 1);
        if (std::visit([](const auto& values) { return values.size(); }, field.values) !=
            kPoints / part)
            _exit(1);
    });
    const std::uint64_t held = reading - std::min(nothing, reading);
    // What the libraries hold whatever the size, and of each point whether it is missing.
    const std::uint64_t slack = (std::uint64_t{14} << 20) + kPoints / 8;
    EXPECT_LE(held, 2 * std::max(bytes.stored, bytes.values) / part + slack) << path;
    EXPECT_GE(held, bytes.values / part) << path << ": the measure does not see the values";
}

}  // namespace tests
