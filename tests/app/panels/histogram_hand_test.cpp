// Ends of ranges under the hand.
#include <gtest/gtest.h>

#include "tests/support/panels_desk.h"

namespace app::panels {
namespace {

using timeseries::RangeSet;

// A layer of values of a world, which go from 0 to 63 at every step.
class AnEnd : public testing::Test {
 protected:
    AnEnd() {
        desk.untilAllSeen();
        Explorer e = desk.exploration.explorer();
        e.layers = {tests::layer("4:20")};
        desk.exploration.edit(e);
        desk.frames(2);
    }
    HistogramLayout at() {
        return histogramLayout(sideLayout(desk.layout(), 1).histogramPanel, 1, true);
    }
    ValueAxis axis() {
        const auto [lo, hi] = withRoom(0, 63);
        return {lo, hi, at().histogram.min.y, at().histogram.max.y};
    }
    // By its line, to a height.
    void drag(double end, float toY) {
        const float x = at().histogram.centre().x;
        desk.moveTo({x, axis().y(end)});
        desk.hold(true);
        desk.moveTo({x, toY});
        desk.hold(false);
    }
    RangeSet ranges() const { return desk.exploration.explorer().layers.at(0).ranges; }

    tests::PanelsDesk desk;
};

TEST_F(AnEnd, StopsWhereTheAxisDoesAndHoldsTheDatasOwn) {
    drag(4, at().histogram.max.y + 300);
    const double lo = timeseries::toDouble(ranges().ranges()[0].lo.value);
    EXPECT_NEAR(lo, axis().lo, axis().perPixel());
    EXPECT_LE(lo, 0);
    EXPECT_EQ(desk.exploration.counts()->selected, 21u);
    drag(20, at().histogram.min.y - 200);
    const double hi = timeseries::toDouble(ranges().ranges()[0].hi.value);
    EXPECT_NEAR(hi, axis().hi, axis().perPixel());
    EXPECT_GE(hi, 63);
    EXPECT_EQ(desk.exploration.counts()->selected, 64u);
}

// At the digits that a pixel tells apart: tenths.
TEST_F(AnEnd, StopsShortOfAnotherRangeAtAValueThatIsShort) {
    ASSERT_GT(axis().perPixel(), 0.1);
    ASSERT_LT(axis().perPixel(), 1);
    const auto dragged = [&](double from, double to) {
        Explorer e = desk.exploration.explorer();
        e.layers = {tests::layer("4:20,30:50")};
        desk.exploration.edit(e);
        desk.frames(2);
        drag(from, axis().y(to));
        return ranges().text();
    };
    EXPECT_EQ(dragged(20, 40), "4:29.9,30:50");
    EXPECT_EQ(dragged(30, 10), "4:20,20.1:50");
    // Between its ends all of it.
    EXPECT_EQ(dragged(12, 40), "13.9:29.9,30:50");
    EXPECT_EQ(dragged(40, 10), "4:20,20.1:40.1");
}

TEST_F(AnEnd, IsWhereTheHandIsWithinTheAxis) {
    drag(20, axis().y(40));
    EXPECT_NEAR(timeseries::toDouble(ranges().ranges()[0].hi.value), 40, axis().perPixel());
    EXPECT_EQ(timeseries::toDouble(ranges().ranges()[0].lo.value), 4);
}

}  // namespace
}  // namespace app::panels
