// Maps of ranges that are edited, as of ranges that were there from the first.
#include "app/picture/fitted_map.h"

#include <gtest/gtest.h>

#include "app/choices/edits.h"
#include "tests/support/exploration_desk.h"

namespace app {
namespace {

using timeseries::RangeSet;
using Desk = tests::ExplorationDesk;

// Values from 0 upwards, most of them low, a step's greater by one than those of the step before.
tests::World tail() {
    tests::World world;
    world.value = [](std::size_t, std::size_t step, std::size_t point) {
        return static_cast<float>(point * point + step);
    };
    return world;
}
constexpr double kMost = 63 * 63;

const LayerChoice& first(const Desk& desk) { return desk.exploration.explorer().layers.at(0); }
Extent mapEnds(const Desk& desk) {
    const auto& map = std::get<MapChoice>(*first(desk).color);
    return {*map.lo, *map.hi};
}
void setRanges(Desk& desk, const RangeSet& ranges, std::string_view gesture = {}) {
    Explorer next = desk.exploration.explorer();
    next.layers.at(0).ranges = ranges;
    desk.exploration.edit(std::move(next), gesture);
}
void setRanges(Desk& desk, const char* ranges) { setRanges(desk, RangeSet::parse(ranges)); }
void setMap(Desk& desk, std::optional<double> lo, std::optional<double> hi) {
    Explorer next = desk.exploration.explorer();
    next.layers.at(0).color = MapChoice{*render::colorMapNamed("cividis"), lo, hi};
    desk.exploration.edit(std::move(next));
}

// Opened at step 5, where values end at kMost + 5.
struct FittedMap : testing::Test {
    FittedMap() { desk.open("a"); }
    Desk desk{{{"a", tail()}}};
};

TEST_F(FittedMap, OfTheFirstChoiceGoesOnToSpanTheRangeThatIsDragged) {
    const LayerChoice chosen = first(desk);
    const double low = timeseries::toDouble(chosen.ranges.ranges().front().lo.value);
    ASSERT_EQ(mapEnds(desk), darkEnds({low, kMost + 5}));
    for (const double to : {low - 100, low + 50, 5.0}) {
        setRanges(desk, withEnd(chosen.ranges, 0, End::Lo, to), "histogram");
        EXPECT_EQ(mapEnds(desk), darkEnds({to, kMost + 5}));
        EXPECT_EQ(std::get<MapChoice>(*first(desk).color).map,
                  std::get<MapChoice>(*chosen.color).map);
    }
    desk.exploration.endGesture();
    setRanges(desk, "10:20");
    EXPECT_EQ(mapEnds(desk), darkEnds({10, 20}));
    setRanges(desk, "min:20, 30:40");
    EXPECT_EQ(mapEnds(desk), darkEnds({5, 40})) << "the data begin at 5";
    desk.exploration.undo();
    desk.exploration.undo();
    EXPECT_EQ(mapEnds(desk), darkEnds({5, kMost + 5})) << "map and range are one edit";
    desk.exploration.undo();
    EXPECT_EQ(first(desk), chosen);
}

TEST_F(FittedMap, OfARangeThatADragMadeOneValueIsFittedAsBefore) {
    setRanges(desk, "10:20");
    setMap(desk, {}, {});
    ASSERT_EQ(mapEnds(desk), (Extent{10, 20}));
    for (const double to : {15.0, 20.0, 12.0})
        setRanges(desk, withEnd(RangeSet::parse("10:20"), 0, End::Lo, to), "histogram");
    EXPECT_EQ(mapEnds(desk), (Extent{12, 20}));
}

TEST_F(FittedMap, ByTheFitButtonKeepsItsExactEnds) {
    setRanges(desk, "10:max");
    setMap(desk, {}, {});
    ASSERT_EQ(mapEnds(desk), (Extent{10, kMost + 5}));
    setRanges(desk, "7:max");
    EXPECT_EQ(mapEnds(desk), (Extent{7, kMost + 5}));
    EXPECT_EQ(std::get<MapChoice>(*first(desk).color).map.name(), "cividis");
}

TEST_F(FittedMap, OfAnotherStepThatWasSeenIsOneStill) {
    desk.exploration.seek(8);
    desk.untilShown(8);
    setRanges(desk, "9:max");
    EXPECT_EQ(mapEnds(desk), darkEnds({9, kMost + 5})) << "fitted to step 5";
}

TEST_F(FittedMap, WhoseEndsTheUserSetStays) {
    setRanges(desk, "10:20");
    for (const auto& [lo, hi] : {std::pair(10, 21), {9, 20}, {20, 10}}) {
        setMap(desk, lo, hi);
        setRanges(desk, "5:20");
        EXPECT_EQ(mapEnds(desk), (Extent{static_cast<double>(lo), static_cast<double>(hi)}));
        desk.exploration.undo();
    }
    const std::variant<glm::dvec3, MapChoice> red = glm::dvec3(1, 0, 0);
    Explorer next = desk.exploration.explorer();
    next.layers.at(0).color = red;
    desk.exploration.edit(next);
    setRanges(desk, "5:20");
    EXPECT_EQ(first(desk).color, red);
}

// Land at 1e6: the range ends before it, the map where the water's values do.
TEST(AFittedMap, BesideAFillValueEndsWithTheOthers) {
    tests::World world;
    world.value = [](std::size_t, std::size_t, std::size_t point) {
        return point < 20 ? 1e6f : static_cast<float>((point - 20) * (point - 20));
    };
    constexpr double kHighest = 43 * 43;
    Desk desk{{{"a", world}}};
    desk.open("a");
    const RangeSet chosen = first(desk).ranges;
    const double low = timeseries::toDouble(chosen.ranges().front().lo.value),
                 high = timeseries::toDouble(chosen.ranges().front().hi.value);
    ASSERT_TRUE(high > kHighest && high < 1e6);
    ASSERT_EQ(mapEnds(desk), darkEnds({low, kHighest}));
    setRanges(desk, withEnd(chosen, 0, End::Lo, 100));
    EXPECT_EQ(mapEnds(desk), darkEnds({100, kHighest}));
}

}  // namespace
}  // namespace app
