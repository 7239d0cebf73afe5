// What a cursor shows while it plays, walked step by step.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "timeseries/series/time_cursor.h"

namespace timeseries::cursor_walks {

using namespace std::chrono_literals;

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

inline constexpr double kInf = std::numeric_limits<double>::infinity();

inline std::vector<std::size_t> cycleOf(const TimeCursor& cursor) {
    std::vector<std::size_t> steps;
    for (std::size_t p = 0; p < cursor.placesPerCycle(); ++p)
        steps.push_back(cursor.stepOfPlace(p));
    return steps;
}

// What playing shows, one entry a change, walked by waiting for each change.
inline std::vector<std::size_t> walk(TimeCursor cursor, std::size_t changes) {
    std::vector<std::size_t> steps{cursor.step()};
    for (std::size_t i = 0; i < changes && cursor.untilNextStep(); ++i) {
        cursor.advance(*cursor.untilNextStep());
        steps.push_back(cursor.step());
    }
    return steps;
}

// How long each place of the cycle is shown.
inline std::vector<std::int64_t> durations(TimeCursor cursor) {
    std::vector<std::int64_t> ns;
    for (std::size_t p = 0; p < cursor.placesPerCycle(); ++p) {
        ns.push_back(cursor.untilNextStep()->count());
        cursor.advance(*cursor.untilNextStep());
    }
    return ns;
}

// The order of a cycle from first principles: list the shown steps, turn, append the way back.
inline std::vector<std::size_t> expectedCycle(std::size_t steps, const CursorSettings& s) {
    std::vector<std::size_t> shown;
    for (std::size_t i = s.first; i <= std::min(s.last, steps - 1); i += s.stride)
        shown.push_back(i);
    if (s.direction == Direction::Backward) shown = {shown.rbegin(), shown.rend()};
    if (s.ending == Ending::PingPong)
        for (std::size_t k = shown.size(); k-- > 2;) shown.push_back(shown[k - 1]);
    return shown;
}

inline CursorSettings randomSettings(std::mt19937_64& random, std::size_t steps) {
    CursorSettings s;
    s.first = random() % steps;
    s.last = s.first + random() % (steps + 3);
    s.stride = 1 + random() % 4;
    s.ending = static_cast<Ending>(random() % 3);
    s.direction = static_cast<Direction>(random() % 2);
    s.pace = static_cast<Pace>(random() % 2);
    s.stepsPerSecond = static_cast<double>(random() % 100000) / 997;
    s.timeUnitsPerSecond = static_cast<double>(random() % 100000) / 997;
    return s;
}

inline std::vector<double> randomTimes(std::mt19937_64& random, std::size_t steps) {
    std::vector<double> times{-static_cast<double>(random() % 1000)};
    while (times.size() < steps)
        times.push_back(times.back() + 0.01 + static_cast<double>(random() % 1000) / 77);
    return times;
}

inline std::string describe(std::size_t steps, const CursorSettings& s) {
    return "steps " + std::to_string(steps) + " first " + std::to_string(s.first) + " last " +
           std::to_string(s.last) + " stride " + std::to_string(s.stride) + " ending " +
           std::to_string(static_cast<int>(s.ending)) + " direction " +
           std::to_string(static_cast<int>(s.direction)) + " pace " +
           std::to_string(static_cast<int>(s.pace)) + " steps/s " +
           std::to_string(s.stepsPerSecond) + " units/s " + std::to_string(s.timeUnitsPerSecond);
}

}  // namespace timeseries::cursor_walks
