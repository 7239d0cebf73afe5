// Sweeps through integers that doubles do not tell apart.
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "timeseries/series/value_sweep.h"

namespace timeseries {
namespace {

SweepSettings loopThrough(const char* ranges) {
    return {.animation = RangeSet::parse(ranges), .path = SweepPath::Loop};
}

// Where doubles are 128 apart, or more: of 2 delta + 1 whole numbers every window has all.
TEST(ValueSweep, WindowsOfIntegersBeyondDoublesAreExact) {
    const std::uint64_t greatest = std::numeric_limits<std::uint64_t>::max();
    struct Case {
        const char* ranges;
        std::uint64_t lo, hi;
    };
    for (const Case& c :
         {Case{"1152921504606846976:1152921504606854975", std::uint64_t{1} << 60,
               (std::uint64_t{1} << 60) + 7999},
          Case{"18446744073709543616:18446744073709551615", greatest - 7999, greatest}}) {
        SweepSettings s = loopThrough(c.ranges);
        s.delta = 10.5;
        s.timerSteps = 8000;
        const ValueSweep sweep(s);
        for (std::int64_t q = 0; q < 8000; ++q) {
            const std::uint64_t centre = c.lo + static_cast<std::uint64_t>(q);
            const auto intervals =
                RangeSet(std::vector{sweep.window(q)}).toIntervals<std::uint64_t>();
            ASSERT_EQ(intervals.size(), 1u);
            ASSERT_EQ(intervals[0].lo, centre - 10);
            ASSERT_EQ(intervals[0].hi, centre > greatest - 10 ? greatest : centre + 10);
        }
        EXPECT_EQ(toText(sweep.exactContour(7999)), std::to_string(c.hi));
    }
}

TEST(ValueSweep, OfIntegersBeyondDoublesGapsTakeNoTimeAndSignsAreKept) {
    SweepSettings s =
        loopThrough("-9223372036854775808:-9223372036854775800,9223372036854775800:max");
    EXPECT_THROW(ValueSweep{s}, std::invalid_argument);
    s = loopThrough(
        "-9223372036854775808:-9223372036854775800,"
        "9223372036854775799:9223372036854775807");
    s.timerSteps = 17;  // 16 steps of the way, of which each range has eight
    const ValueSweep sweep(s);
    for (std::int64_t q = 0; q < 17; ++q) {
        const auto centre = std::get<std::int64_t>(sweep.exactContour(q));
        EXPECT_EQ(centre, q <= 8 ? std::numeric_limits<std::int64_t>::min() + q
                                 : std::numeric_limits<std::int64_t>::max() - (16 - q))
            << q;
    }
    s = loopThrough("9007199254740993:9007199254740993,9007199254740995:9007199254740995");
    s.timerSteps = 2;
    EXPECT_EQ(toText(ValueSweep(s).exactContour(0)), "9007199254740993");
    EXPECT_EQ(toText(ValueSweep(s).exactContour(1)), "9007199254740995");
    s.delta = 1e300;
    EXPECT_EQ(RangeSet(std::vector{ValueSweep(s).window(0)}).toIntervals<std::int64_t>(),
              RangeSet::everything().toIntervals<std::int64_t>());
}

}  // namespace
}  // namespace timeseries
