// What the demo's file holds, found without the program under test.
#pragma once

#include <cmath>
#include <variant>

#include "tests/support/selection_oracle.h"
#include "tests/ui/desk_test.h"

namespace ui {

// The demo's values at one step, as the reader gives them.
inline std::vector<float> valuesAt(std::size_t step) {
    const std::filesystem::path file = demo();
    const auto reader = timeseries::openReader(std::span(&file, 1));
    return std::get<std::vector<float>>(reader->read(0, step).values);
}

// What the first layer selects, by comparing every value.
inline std::uint64_t countIn(const app::Explorer& e) {
    std::uint64_t count = 0;
    for (const float value : valuesAt(e.steps->first))
        count += oracle::holds(e.layers.at(0).ranges.ranges(), value) ? 1 : 0;
    return count;
}

// The values between which the instrument stands, once all steps are seen.
inline app::panels::ValueAxis axisOf(const Places& at) {
    float lo = INFINITY, hi = -INFINITY;
    for (std::size_t step = 0; step < 31; ++step)
        for (const float value : valuesAt(step)) {
            lo = std::min(lo, value);
            hi = std::max(hi, value);
        }
    const auto [bottom, top] =
        app::panels::withRoom(static_cast<double>(lo), static_cast<double>(hi));
    return {bottom, top, at.instrument.histogram.min.y, at.instrument.histogram.max.y};
}

}  // namespace ui
