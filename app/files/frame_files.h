// Which pictures `isochron render` makes, and into which files: for those who draw them and those
// who tell of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/choices/explorer.h"

namespace app {

struct FrameAt {
    std::size_t step;
    std::int64_t tick;  // of the sweep; 0 without one
    std::filesystem::path file;
};

// A frame a step; with a sweep that does not stand a frame a tick of one cycle, over which the
// steps pass once. Told one by one: a cycle may have 2^30 ticks.
class FrameFiles {
 public:
    // `output`: OUT.png or OUT.exr; of several frames each has its step, or with a sweep its tick,
    // in its name, with as many digits as the last of the series' `stepCount` steps has, so that
    // those of several runs lie in order. REQUIRES: steps, ascending; a sweep whose ends are
    // finite.
    FrameFiles(std::filesystem::path output, const Explorer& explorer,
               std::vector<std::size_t> steps, std::size_t stepCount = 0);

    const std::filesystem::path& output() const { return output_; }
    std::size_t size() const { return count_; }
    FrameAt operator[](std::size_t i) const;
    FrameAt front() const { return (*this)[0]; }
    FrameAt back() const { return (*this)[count_ - 1]; }
    // "OUT.png", "OUT_left.png and OUT_right.png", "OUT_03.png to OUT_12.png".
    std::string names() const;

    // One sentence where a cycle of the sweep has fewer pictures than there are steps; else "".
    std::string leftOut() const;

    // How many files the pictures go into, two of a picture with an eye each, and how many of these
    // there are by now.
    std::size_t fileCount() const;
    std::size_t existing() const;
    // Whether one of them has this name in the folder of all.
    bool has(const std::filesystem::path& name) const;

 private:
    // Which picture the number in a file's name is about.
    std::optional<std::size_t> numbered(std::size_t number) const;
    std::filesystem::path output_;
    std::vector<std::size_t> steps_;
    bool swept_;
    std::int64_t standing_;  // the tick of a sweep that stands
    Stereo stereo_;
    std::size_t count_ = 0, digits_ = 0;
};

}  // namespace app
