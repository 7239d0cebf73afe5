// What ui_bench's parts share: figures as they are told, and values to show.
#pragma once

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <random>
#include <vector>

#include "tests/ui/shot.h"

namespace ui {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

inline void tell(const char* what, std::vector<double> milliseconds) {
    std::ranges::sort(milliseconds);
    fmt::print("{:<48} {:>4} times  median {:7.1f} ms  longest {:7.1f} ms\n", what,
               milliseconds.size(), milliseconds[milliseconds.size() / 2], milliseconds.back());
}

// Splats are of a colour, axes and their numbers are not.
inline bool isColored(const Shot::Pixel& pixel) {
    constexpr int kGrey = 40;
    const auto [least, most] = std::ranges::minmax(pixel);
    return most - least > kGrey;
}

// In [0, 1).
inline std::vector<float> noise(std::size_t points) {
    std::mt19937 random(7);
    std::vector<float> values(points);
    for (float& value : values) value = static_cast<float>(random() >> 8) / (1 << 24);
    return values;
}

}  // namespace ui
