// What the demo's file holds, found without the program under test.
#pragma once

#include <cmath>
#include <variant>

#include "tests/support/selection_oracle.h"
#include "tests/ui/desk_test.h"

namespace ui {

constexpr std::size_t kDemoSteps = 31;

inline timeseries::Reader& demoReader() {
    static const std::filesystem::path file = demo();
    static const auto reader = timeseries::openReader(std::span(&file, 1));
    return *reader;
}

// The demo's values at one step, as the reader gives them.
inline std::vector<float> valuesAt(std::size_t step) {
    return std::get<std::vector<float>>(demoReader().read(0, step).values);
}

// The time of each step, in seconds.
inline std::vector<double> demoTimes() {
    const auto axis = demoReader().variables()[0].time;
    std::vector<double> times;
    for (const timeseries::TimePoint& point : axis->points) times.push_back(point.value);
    return times;
}

// What the first layer selects, by comparing every value.
inline std::uint64_t countIn(const app::Explorer& e) {
    std::uint64_t count = 0;
    for (const float value : valuesAt(e.steps->first))
        count += oracle::holds(e.layers.at(0).ranges.ranges(), value) ? 1 : 0;
    return count;
}

// The least and the greatest value of all steps.
inline std::pair<double, double> demoExtent() {
    static const auto extent = [] {
        float lo = INFINITY, hi = -INFINITY;
        for (std::size_t step = 0; step < kDemoSteps; ++step)
            for (const float value : valuesAt(step)) {
                lo = std::min(lo, value);
                hi = std::max(hi, value);
            }
        return std::pair<double, double>(lo, hi);
    }();
    return extent;
}

// The values between which the histogram stands, once all steps are seen; waits for that.
inline app::panels::ValueAxis axisOf(Driver& desk) {
    waitUntilSeen(desk, kDemoSteps);
    desk.settled();
    const auto [lo, hi] = demoExtent();
    const auto [bottom, top] = app::panels::withRoom(lo, hi);
    const app::panels::Rect bars = placesOf(desk.size()).histogramPanel.histogram;
    return {bottom, top, bars.min.y, bars.max.y};
}

}  // namespace ui
