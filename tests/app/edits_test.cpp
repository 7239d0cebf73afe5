#include "app/choices/edits.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "app/choices/choice_text.h"
#include "app/choices/first_choice.h"
#include "app/choices/layer_colors.h"
#include "app/choices/sweep_edits.h"
#include "tests/support/scenes.h"
#include "tests/support/selection_oracle.h"
#include "tests/support/sorted.h"

namespace app {
namespace {

using timeseries::Range;
using timeseries::RangeSet;

class RangeEdits : public testing::Test {
 protected:
    // Multiples of 1/4: sums of them are exact, and they often meet.
    double number() { return 0.25 * static_cast<double>(static_cast<int>(random_() % 80) - 40); }
    RangeSet ranges() {
        for (;;) {
            std::vector<Range> some(1 + random_() % 4);
            for (Range& range : some) {
                range = {{number(), random_() % 3 == 0}, {number(), random_() % 3 == 0}};
                if (random_() % 5 == 0)  // typed as an integer that no double is
                    range.hi.value = (std::int64_t{1} << 53) + 1;
                if (timeseries::compare(range.lo.value, range.hi.value) > 0)
                    std::swap(range.lo, range.hi);
                if (random_() % 8 == 0) range.lo = {-kInfinity};
                if (random_() % 8 == 0) range.hi = {kInfinity};
            }
            if (RangeSet set(some); !set.empty()) return set;
        }
    }
    std::mt19937_64 random_{77};
};

bool sameBound(const timeseries::Bound& a, const timeseries::Bound& b) {
    return a.open == b.open && a.value == b.value;
}

// All ranges but one, as they were.
void expectOthersStay(const RangeSet& now, const RangeSet& before, std::size_t range) {
    ASSERT_EQ(now.ranges().size(), before.ranges().size());
    for (std::size_t i = 0; i < now.ranges().size(); ++i) {
        if (i == range) continue;
        EXPECT_TRUE(sameBound(now.ranges()[i].lo, before.ranges()[i].lo));
        EXPECT_TRUE(sameBound(now.ranges()[i].hi, before.ranges()[i].hi));
    }
}

TEST_F(RangeEdits, ADraggedEndHoldsWhatLiesBetweenItAndTheOther) {
    // Against plain comparisons: a value is in the range now if it lies between the hand and the
    // other end, and the hand has not passed a neighbour or that end.
    for (int i = 0; i < 3000; ++i) {
        const RangeSet before = ranges();
        const std::size_t n = before.ranges().size(), k = random_() % n;
        const End end = random_() % 2 == 0 ? End::Lo : End::Hi;
        const double to = number();
        const RangeSet now = withEnd(before, k, end, to);
        SCOPED_TRACE(before.text() + " became " + now.text() + ", range " + std::to_string(k) +
                     (end == End::Lo ? ", low to " : ", high to ") + std::to_string(to));
        expectOthersStay(now, before, k);
        if (HasFailure()) return;
        const Range &old = before.ranges()[k], &changed = now.ranges()[k];
        EXPECT_EQ(changed.lo.open, old.lo.open);
        EXPECT_EQ(changed.hi.open, old.hi.open);
        EXPECT_TRUE(end == End::Lo ? sameBound(changed.hi, old.hi) : sameBound(changed.lo, old.lo))
            << "the other end stays";
        // In eighths and halves between: none of them is a bound's neighbouring double.
        for (double v = -11; v <= 11; v += 0.125) {
            const bool isInOthers = [&] {
                for (std::size_t j = 0; j < n; ++j)
                    if (j != k && oracle::holds<double>(before.ranges()[j], v)) return true;
                return false;
            }();
            const double limitLo =
                k > 0 ? timeseries::toDouble(before.ranges()[k - 1].hi.value) : -kInfinity;
            const double limitHi =
                k + 1 < n ? timeseries::toDouble(before.ranges()[k + 1].lo.value) : kInfinity;
            Range wished = old;
            (end == End::Lo ? wished.lo : wished.hi).value = to;
            const bool isWished =
                oracle::holds<double>(wished, v) && v > limitLo && v < limitHi && !isInOthers;
            const bool isPinched = timeseries::compare(wished.lo.value, wished.hi.value) >= 0;
            if (isPinched || v == limitLo || v == limitHi) continue;
            EXPECT_EQ(oracle::holds<double>(changed, v), isWished) << v;
        }
    }
}

TEST_F(RangeEdits, AnEndStopsAtTheOtherAndJustShortOfANeighbour) {
    const RangeSet set = RangeSet::parse("0:1,2:3,[5,6)");
    EXPECT_EQ(withEnd(set, 1, End::Lo, 10).text(), "0:1,3:3,[5,6)");
    EXPECT_EQ(withEnd(set, 1, End::Hi, -10).text(), "0:1,2:2,[5,6)");
    const auto next = [](double from, double to) { return std::nextafter(from, to); };
    EXPECT_EQ(withEnd(set, 1, End::Lo, -10).ranges()[1].lo.value, timeseries::Number(next(1, 2)));
    EXPECT_EQ(withEnd(set, 1, End::Hi, 10).ranges()[1].hi.value, timeseries::Number(next(5, 4)));
    EXPECT_EQ(withEnd(set, 2, End::Lo, 9).ranges()[2].lo.value, timeseries::Number(next(6, 5)))
        << "[6, 6) would hold nothing";
    EXPECT_EQ(withEnd(RangeSet::parse("min:3"), 0, End::Lo, 1), RangeSet::parse("1:3"));
    EXPECT_EQ(withEnd(RangeSet::parse("1:3"), 0, End::Hi, kInfinity), RangeSet::parse("1:max"));
}

// Of 0.27 a pixel tenths are told: what stops short stops at one.
TEST_F(RangeEdits, AnEndStopsShortOfANeighbourAtTheHandsDigits) {
    const RangeSet set = RangeSet::parse("10:20,30:50,[60,70)");
    const auto dragged = [&](std::size_t range, End end, double to) {
        return withEnd(set, range, end, to, 0.27).text();
    };
    EXPECT_EQ(dragged(0, End::Hi, 40), "10:29.9,30:50,[60,70)");
    EXPECT_EQ(dragged(1, End::Lo, -3), "10:20,20.1:50,[60,70)");
    EXPECT_EQ(dragged(1, End::Hi, kInfinity), "10:20,30:59.9,[60,70)");
    EXPECT_EQ(dragged(2, End::Lo, 99), "10:20,30:50,[69.9,70)");
    EXPECT_EQ(withMoved(set, 0, 13, 0.27).text(), "19.9:29.9,30:50,[60,70)");
    EXPECT_EQ(withMoved(set, 1, -13, 0.27).text(), "10:20,20.1:40.1,[60,70)");
    // What is nearer already stays.
    const RangeSet near = RangeSet::parse("10:29.97,30:50");
    EXPECT_EQ(withEnd(near, 0, End::Hi, 40, 0.27), near);
    EXPECT_EQ(withEnd(near, 1, End::Lo, 0, 0.27), near);
    EXPECT_EQ(withMoved(near, 0, 5, 0.27), near);
    const RangeSet meeting = RangeSet::parse("[1,2),(2,3]");
    EXPECT_EQ(withEnd(meeting, 1, End::Lo, 0, 0.27), meeting);
    EXPECT_EQ(withEnd(meeting, 0, End::Hi, 9, 0.27), meeting);
    // Finer than doubles are, it stops at the nearest of them.
    EXPECT_EQ(withEnd(set, 0, End::Hi, 40, 1e-30), withEnd(set, 0, End::Hi, 40));
}

// Numbers of two decimals stay such, wherever the hand drags them.
TEST_F(RangeEdits, WhatIsDraggedHasNoMoreDigitsThanItsPartsAndTheHand) {
    const auto isShort = [](const timeseries::Bound& bound) {
        const double value = timeseries::toDouble(bound.value);
        return !(std::abs(value) < 1000) || value == toDecimals(value, 2);
    };
    for (int i = 0; i < 3000; ++i) {
        const RangeSet before = ranges();
        const std::size_t k = random_() % before.ranges().size();
        const double by = roundedTo(number() / 7, 0.1);
        const double to = roundedTo(number(), 0.1);
        for (const RangeSet& now :
             {withMoved(before, k, by, 0.1), withEnd(before, k, End::Lo, to, 0.1),
              withEnd(before, k, End::Hi, to, 0.1)}) {
            SCOPED_TRACE(before.text() + " became " + now.text());
            expectOthersStay(now, before, k);
            if (HasFailure()) return;
            EXPECT_TRUE(isShort(now.ranges()[k].lo) && isShort(now.ranges()[k].hi));
        }
    }
}

TEST_F(RangeEdits, TypedIntegersStayAsTyped) {
    const RangeSet set = RangeSet::parse("9007199254740993:9007199254740999");
    const auto changed = withEnd(set, 0, End::Lo, 0);
    EXPECT_EQ(changed.text(), "0:9007199254740999");
    // 2^53 + 7 is no double: the end stops at the nearest below.
    EXPECT_EQ(withEnd(set, 0, End::Lo, 1e300).ranges()[0].lo.value,
              timeseries::Number(9007199254740998.0));
}

TEST_F(RangeEdits, AMovedRangeKeepsItsWidthAndItsPlaceAmongOthers) {
    for (int i = 0; i < 3000; ++i) {
        const RangeSet before = ranges();
        const std::size_t n = before.ranges().size(), k = random_() % n;
        const double by = number();
        const RangeSet now = withMoved(before, k, by);
        SCOPED_TRACE(before.text() + " became " + now.text() + ", range " + std::to_string(k) +
                     " by " + std::to_string(by));
        expectOthersStay(now, before, k);
        if (HasFailure()) return;
        const Range &old = before.ranges()[k], &moved = now.ranges()[k];
        EXPECT_EQ(moved.lo.open, old.lo.open);
        EXPECT_EQ(moved.hi.open, old.hi.open);
        const double lo = timeseries::toDouble(old.lo.value),
                     hi = timeseries::toDouble(old.hi.value);
        const double nowLo = timeseries::toDouble(moved.lo.value);
        const double nowHi = timeseries::toDouble(moved.hi.value);
        if (std::isfinite(lo) && std::isfinite(hi)) {
            EXPECT_NEAR(nowHi - nowLo, hi - lo, 1e-12 * (1 + std::abs(hi)));
            // As far as asked, or up to the neighbour.
            const double below =
                k > 0 ? timeseries::toDouble(before.ranges()[k - 1].hi.value) : -1e300;
            const double above =
                k + 1 < n ? timeseries::toDouble(before.ranges()[k + 1].lo.value) : 1e300;
            const double expected = std::clamp(by, below - lo, above - hi);
            EXPECT_NEAR(nowLo - lo, expected, 1e-12 * (1 + std::abs(hi)));
        } else {
            EXPECT_EQ(std::isfinite(nowLo), std::isfinite(lo));
            EXPECT_EQ(std::isfinite(nowHi), std::isfinite(hi));
        }
    }
}

TEST_F(RangeEdits, TakingAwayAndAddingAreWhatSetsDo) {
    for (int i = 0; i < 500; ++i) {
        const RangeSet before = ranges();
        const std::size_t k = random_() % before.ranges().size();
        const Range taken = before.ranges()[k];
        const RangeSet rest = without(before, k);
        EXPECT_EQ(rest.ranges().size(), before.ranges().size() - 1);
        EXPECT_EQ(with(rest, taken), before);
        const Range added{{number()}, {number()}};
        for (double v = -11; v <= 11; v += 0.125)
            EXPECT_EQ(oracle::holds<double>(with(before, added).ranges(), v),
                      oracle::holds<double>(before.ranges(), v) || oracle::holds<double>(added, v));
    }
}

// A range's points, counted one by one.
std::uint64_t countOf(const std::vector<float>& values, double lo, double hi) {
    const RangeSet range = RangeSet({Range{{lo}, {hi}}});
    return static_cast<std::uint64_t>(std::ranges::count_if(
        values, [&](float value) { return oracle::holds(range.ranges(), value); }));
}

TEST(SteppedEnd, PassesDenormalValuesToo) {
    std::vector<double> values(27);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = 1e-310 * static_cast<double>(i + 1);
    const auto step = tests::sorted({tests::cube(3), values, {}});
    const double end = steppedEnd(step, values[4], End::Hi, 1, 1e-311);
    EXPECT_GE(end, values[5]);
    EXPECT_LT(end, values[6]);
}

TEST(SteppedEnd, SelectsOtherPointsWithEveryStep) {
    std::mt19937_64 random(3);
    // Crowded in places, wide apart in others, and ties.
    std::vector<float> values(1000);
    for (float& value : values)
        value = 300 + std::round(std::pow(static_cast<float>(random() % 1000) / 100, 3.0f)) / 7;
    const auto step = tests::sorted({tests::cube(10), values, {}});
    const double least = std::ranges::min(values), most = std::ranges::max(values);
    for (const double resolution : {1e-5, 0.3, 5.0}) {
        for (const int by : {1, -1, 10, -10}) {
            double lo = 320, hi = 380;
            for (int i = 0; i < 400; ++i) {
                const double above = steppedEnd(step, hi, End::Hi, by, resolution);
                const double below = steppedEnd(step, lo, End::Lo, -by, resolution);
                const std::string which =
                    fmt::format("{} to {}, {} times {}", lo, hi, by, resolution);
                const auto upTo = [&](double end) { return countOf(values, -kInfinity, end); };
                const auto from = [&](double end) { return countOf(values, end, kInfinity); };
                // An end stays where there is no value to pass: all are selected, or the last at
                // most.
                const std::uint64_t all = values.size();
                if (above == hi) {
                    EXPECT_TRUE(by > 0 ? upTo(hi) == all : upTo(hi) <= upTo(least)) << which;
                }
                if (below == lo) {
                    EXPECT_TRUE(by > 0 ? from(lo) == all : from(lo) <= from(most)) << which;
                }
                if (above == hi || below == lo) break;
                EXPECT_GE(std::abs(above - hi), 0.49 * resolution * std::abs(by)) << which;
                EXPECT_EQ(upTo(above) > upTo(hi), by > 0) << which;
                EXPECT_NE(upTo(above), upTo(hi)) << which;
                EXPECT_EQ(from(below) > from(lo), by > 0) << which;
                EXPECT_NE(from(below), from(lo)) << which;
                hi = above;
                lo = below;
            }
        }
    }
}

TEST(AddLayer, TakesTheNextFreeColourAndAnOpacityForItsPoints) {
    const auto step = tests::stepOf(tests::cube(10), [](std::size_t i) { return double(i); });
    Explorer e;
    e.layers = {{RangeSet::parse("0:1"), MapChoice{{}, 0.0, 1.0}, 0.5},
                {RangeSet::parse("0:1"), kLayerColors[1], 0.5}};
    const Explorer before = e;
    EXPECT_EQ(addLayer(e, RangeSet::parse("100:199"), step), 2u);
    ASSERT_EQ(e.layers.size(), 3u);
    EXPECT_TRUE(e.layers[0] == before.layers[0]) << "coloured by value stays so";
    EXPECT_EQ(std::get<glm::dvec3>(*e.layers[2].color), kLayerColors[0]);
    EXPECT_EQ(e.layers[2].opacity, opacityFor(100, step.grid()));
    EXPECT_EQ(e.layers[2].ranges, RangeSet::parse("100:199"));
    addLayer(e, RangeSet::parse("5"), step);
    EXPECT_EQ(std::get<glm::dvec3>(*e.layers[3].color), kLayerColors[2]);
    setSweep(e, {});
    e.layers.front().color = kLayerColors[3];
    addLayer(e, RangeSet::parse("5"), step);
    EXPECT_EQ(std::get<glm::dvec3>(*e.layers[5].color), kLayerColors[4]) << "the swept one has 3";
    e.layers.erase(e.layers.begin() + 2);
    addLayer(e, RangeSet::parse("5"), step);
    EXPECT_EQ(std::get<glm::dvec3>(*e.layers[5].color), kLayerColors[1]) << "free again";
}

TEST(ClipEnd, StopsAtTheOtherEndAndIsUnboundedWhereTheAxisEnds) {
    timeseries::Axis down = tests::axis(5, 10);  // 10 to 14
    std::ranges::reverse(down.coordinates);
    const timeseries::Grid grid(std::array{tests::axis(5), down, tests::axis(1)});
    const auto set = [&](const std::optional<ClipBox>& clip, std::size_t axis, End end, double at) {
        return withClipEnd(clip, grid, axis, end, at);
    };
    const auto box = set(std::nullopt, 0, End::Lo, 1.5);
    ASSERT_TRUE(box);
    EXPECT_EQ(clipText(*box), "1.5:max,min:max,min:max");
    EXPECT_EQ(clipText(*set(box, 0, End::Hi, 3)), "1.5:3,min:max,min:max");
    EXPECT_EQ(clipText(*set(box, 0, End::Hi, 1)), "1.5:1.5,min:max,min:max");
    EXPECT_EQ(clipText(*set(set(box, 0, End::Hi, 3), 0, End::Lo, 3.5)), "3:3,min:max,min:max");
    EXPECT_EQ(clipText(*set(std::nullopt, 0, End::Lo, 99)), "4:max,min:max,min:max");
    EXPECT_EQ(clipText(*set(std::nullopt, 0, End::Hi, -99)), "min:0,min:max,min:max");
    EXPECT_FALSE(set(box, 0, End::Lo, 0)) << "nothing is cut off";
    EXPECT_EQ(clipText(*set(box, 1, End::Lo, 11)), "1.5:max,11:max,min:max");
    EXPECT_EQ(set(box, 1, End::Lo, 10), box);
    EXPECT_EQ(set(box, 1, End::Hi, 14), box);
}

TEST(AddLayer, CountsWhatOfItWasKept) {
    const auto grid = tests::cube(10);
    std::vector<float> values(1000);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i);
    const auto step = tests::sorted({grid, std::move(values), {}}, RangeSet::parse("500:max"));
    Explorer e;
    addLayer(e, RangeSet::parse("400:599"), step);
    EXPECT_EQ(e.layers[0].opacity, opacityFor(100, step.grid()));
}

TEST(RemoveLayer, TheLastOneLeavesNoneUntilOneIsAdded) {
    const auto step = tests::stepOf(tests::cube(10), [](std::size_t i) { return double(i); });
    Explorer e;
    e.layers = {{RangeSet::parse("0:1"), kLayerColors[0], 0.5},
                {RangeSet::parse("5:6"), kLayerColors[1], 0.5}};
    removeLayer(e, 0);
    ASSERT_EQ(e.layers.size(), 1u);
    EXPECT_EQ(e.layers[0].ranges, RangeSet::parse("5:6"));
    EXPECT_FALSE(e.noLayers);
    removeLayer(e, 0);
    EXPECT_TRUE(e.layers.empty());
    EXPECT_TRUE(e.noLayers);
    addLayer(e, RangeSet::parse("7"), step);
    EXPECT_FALSE(e.noLayers);
}

TEST(NewRanges, HoldAPointThatIsInNoLayerYet) {
    const auto step = tests::stepOf(tests::cube(10), [](std::size_t i) { return double(i); });
    Explorer e;
    std::vector<RangeSet> all;
    for (std::size_t i = 0; i < render::kMaxLayers; ++i) {
        const RangeSet ranges = newRanges(e, step);
        std::uint64_t fresh = 0;
        for (std::uint64_t p = 0; p < step.size(); ++p) {
            const auto value = std::get<double>(step.value(p));
            const auto holds = [&](const RangeSet& set) {
                return oracle::holds(set.ranges(), value);
            };
            if (holds(ranges) && std::ranges::none_of(all, holds)) ++fresh;
        }
        EXPECT_GT(fresh, 0u) << i;
        EXPECT_EQ(fresh, step.count(ranges)) << i << ": of no other layer";
        all.push_back(ranges);
        addLayer(e, ranges, step);
    }
    EXPECT_EQ(all.front(), parseSelection("top 1 %", step));
}

TEST(NewRanges, AreOthersWhereEveryPointIsInALayer) {
    const auto step = tests::stepOf(tests::cube(10), [](std::size_t i) { return double(i); });
    Explorer e;
    e.layers = {{RangeSet::everything(), kLayerColors[0], 0.5},
                {parseSelection("top 1 %", step), kLayerColors[1], 0.5}};
    const RangeSet ranges = newRanges(e, step);
    EXPECT_NE(ranges, e.layers[0].ranges);
    EXPECT_NE(ranges, e.layers[1].ranges);
    EXPECT_GT(step.count(ranges), 0u);
}

}  // namespace
}  // namespace app
