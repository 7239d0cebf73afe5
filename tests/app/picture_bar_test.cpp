// What a picture's colour bars span.
#include <gtest/gtest.h>

#include "app/picture/picture.h"
#include "app/picture/resolved.h"
#include "tests/support/picture_of_a_ramp.h"
#include "tests/support/scenes.h"
#include "tests/support/sorted.h"

namespace app {
namespace {

using timeseries::RangeSet;
using timeseries::SortedStep;
using namespace app::ramp;

// So that they stand still while time plays, and exports of single steps agree.
TEST_F(PictureOfARamp, TheColourBarsEndsDoNotDependOnTheStep) {
    using Ends = std::pair<double, double>;
    using Parts = std::vector<Ends>;
    const auto chosen = [&](const char* range, std::optional<MapChoice> map = {}) {
        Explorer e = withRanges({range});
        if (map) e.layers[0].color = *map;
        return resolved(e, steps_);
    };
    const auto barOf = [&](const Explorer& e, const SortedStep& step) {
        return makePicture(e, about_, 1, step, placed_).legend.layers.at(0).shown;
    };
    const MapChoice map{{}, -50, 100};
    const auto other = ramp(-7, RangeSet::everything());
    for (const auto& [e, ends] : {
             std::pair(chosen("100:200"), Ends(100, 200)),
             std::pair(chosen("min:max", map), Ends(-50, 100)),
             std::pair(chosen("20:max", map), Ends(20, 100)),
             std::pair(chosen("min:20", map), Ends(-50, 20)),
             std::pair(chosen("900:max", map), Ends(900, 900)),
             std::pair(chosen("900:max"), Ends(900, 999)),
         }) {
        EXPECT_EQ(barOf(e, *step_), Parts{ends});
        EXPECT_EQ(barOf(e, *other), Parts{ends});
    }
    const Explorer apart = chosen("min:20,100:200,900:max", map);
    const Parts all{{-50, 20}, {100, 200}, {900, 900}};
    EXPECT_EQ(barOf(apart, *step_), all) << "nothing is shown between the ranges";
    EXPECT_EQ(barOf(apart, *other), all);
}

// A map that nobody asked for begins below the data, which its bar does not show.
TEST_F(PictureOfARamp, ABarOfNoLowerEndBeginsWhereTheDataDo) {
    const Explorer e = resolved(withRanges({"min:20"}), steps_);
    const auto& map = std::get<MapChoice>(*e.layers[0].color);
    ASSERT_EQ((Extent{*map.lo, *map.hi}), darkEnds({0, 20}));
    const auto barOf = [&](double from) {
        const auto step = ramp(static_cast<float>(from), RangeSet::everything());
        const auto layer = makePicture(e, about_, 1, *step, placed_).legend.layers.at(0);
        EXPECT_EQ(layer.shown.size(), 1u);
        EXPECT_EQ(layer.shown.front().second, 20);
        return std::pair(layer.shown.front().first, layer.openBelow);
    };
    EXPECT_EQ(barOf(0), std::pair(0.0, false));
    EXPECT_EQ(barOf(7), std::pair(0.0, false)) << "where time began stands still";
    EXPECT_EQ(barOf(-2), std::pair(-2.0, false)) << "what is in the picture is on the bar";
    EXPECT_EQ(barOf(-100), std::pair(*map.lo, true));
}

// A first choice of such a step is a map without a width: no values are below or above its one.
TEST_F(PictureOfARamp, ABarOfAStepOfOneValueOrOfNoneSaysSo) {
    const auto stepOf = [](float value, bool isMissing) {
        return std::make_shared<const SortedStep>(
            tests::sorted({tests::cube(10), std::vector<float>(1000, value),
                           std::vector<bool>(isMissing ? 1000 : 0, true)}));
    };
    const auto none = stepOf(0, true), constant = stepOf(0.1f, false), below = stepOf(-5, false);
    about_.type = timeseries::ValueType::F32;
    const auto barOf = [&](const auto& chosenOf, const auto& shown) {
        const Explorer e = resolved({}, {{1, chosenOf}});
        return makePicture(e, about_, 1, *shown, placed_).legend.layers.at(0).ofOneColor;
    };
    EXPECT_EQ(barOf(none, none), "no values");
    EXPECT_EQ(barOf(constant, constant), "all 0.1") << "as a float32";
    EXPECT_EQ(barOf(constant, below), "all \u22125");
    EXPECT_EQ(barOf(constant, step_), "all values alike") << "each has the map's middle colour";
    EXPECT_EQ(barOf(step_, constant), "") << "a map that has a width has numbers";
}

}  // namespace
}  // namespace app
