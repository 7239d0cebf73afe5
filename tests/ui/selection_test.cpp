#include "tests/ui/demo_values.h"
#include "tests/ui/desk_test.h"

namespace ui {
namespace {

class DeskSelects : public DeskTest {
 protected:
    // Drags the upper end of 600:1000 to about 1300.
    void dragEnd(Driver& desk) {
        const Places at = placesOf(desk.size());
        const float x = at.instrument.histogram.centre().x;
        waitUntilSeen(desk, 31);
        desk.settled();
        const app::panels::ValueAxis axis = axisOf(at);
        perPixel_ = axis.perPixel();
        desk.drag({x, axis.y(1000)}, {x, axis.y(1300)});
    }
    double perPixel_ = 0;
};

TEST_F(DeskSelects, ByTheDraggedEndOfARange) {
    Driver desk(screen(), folder(), {demo().string(), "--range", "600:1000"});
    desk.waitForTitle("pool_fire_T.nc · T");
    const Places at = placesOf(desk.size());
    const Shot before = desk.settled(at.clear);
    const std::uint64_t points = parse(desk.title()).points;
    dragEnd(desk);
    const Shot after = desk.settled(at.clear);
    const app::Explorer e = saved(desk, folder() / "dragged.json");
    const auto range = e.layers.at(0).ranges.ranges()[0];
    EXPECT_EQ(timeseries::toDouble(range.lo.value), 600);
    EXPECT_NEAR(timeseries::toDouble(range.hi.value), 1300, 3 * perPixel_);
    EXPECT_EQ(parse(desk.title()).points, countIn(e));
    EXPECT_GT(parse(desk.title()).points, points);
    EXPECT_GT(differing(before, after), 1000u);
}

TEST_F(DeskSelects, AndUndoRestoresPixelsAndCount) {
    Driver desk(screen(), folder(), {demo().string(), "--range", "600:1000"});
    desk.waitForTitle("pool_fire_T.nc · T");
    const Places at = placesOf(desk.size());
    const Shot before = desk.settled(at.clear);
    const std::string title = desk.title();
    dragEnd(desk);
    const Shot after = desk.settled(at.clear);
    const std::string dragged = desk.title();
    ASSERT_NE(dragged, title);
    desk.press("ctrl+z");
    EXPECT_EQ(differing(desk.settled(at.clear), before), 0u);
    EXPECT_EQ(desk.title(), title);
    desk.press("ctrl+y");
    EXPECT_EQ(differing(desk.settled(at.clear), after), 0u);
    EXPECT_EQ(desk.title(), dragged);
    desk.press("ctrl+z");
    desk.press("ctrl+shift+z");
    EXPECT_EQ(differing(desk.settled(at.clear), after), 0u);
}

TEST_F(DeskSelects, TwoRangesThatDoNotTouch) {
    Driver desk(screen(), folder(), {demo().string(), "--range", "600:800"});
    desk.waitForTitle("pool_fire_T.nc · T");
    const Places at = placesOf(desk.size());
    waitUntilSeen(desk, 31);
    desk.settled();
    const app::panels::ValueAxis axis = axisOf(at);
    const float x = at.instrument.histogram.centre().x;
    desk.drag({x, axis.y(1000)}, {x, axis.y(1300)});
    desk.settled();
    const app::Explorer e = saved(desk, folder() / "two.json");
    ASSERT_EQ(e.layers.size(), 1u);
    const auto ranges = e.layers[0].ranges.ranges();
    ASSERT_EQ(ranges.size(), 2u);
    EXPECT_EQ(timeseries::toDouble(ranges[0].lo.value), 600);
    EXPECT_EQ(timeseries::toDouble(ranges[0].hi.value), 800);
    EXPECT_NEAR(timeseries::toDouble(ranges[1].lo.value), 1000, 3 * axis.perPixel());
    EXPECT_NEAR(timeseries::toDouble(ranges[1].hi.value), 1300, 3 * axis.perPixel());
    EXPECT_EQ(parse(desk.title()).points, countIn(e));
}

// The new layer's row takes room in the column, but not from under the hand.
TEST_F(DeskSelects, AsANewLayerWhatWasDraggedAcrossWithShift) {
    Driver desk(screen(), folder(), {demo().string(), "--range", "1200:max"});
    desk.waitForTitle("pool_fire_T.nc · T");
    const Places at = placesOf(desk.size());
    waitUntilSeen(desk, 31);
    desk.settled();
    const app::panels::ValueAxis axis = axisOf(at);
    const float x = at.instrument.histogram.centre().x;
    desk.hold("shift");
    desk.drag({x, axis.y(600)}, {x, axis.y(900)});
    desk.release("shift");
    const app::Explorer e = saved(desk, folder() / "added.json");
    ASSERT_EQ(e.layers.size(), 2u);
    const auto range = e.layers[1].ranges.ranges()[0];
    EXPECT_NEAR(timeseries::toDouble(range.lo.value), 600, 3 * axis.perPixel());
    EXPECT_NEAR(timeseries::toDouble(range.hi.value), 900, 3 * axis.perPixel());
}

}  // namespace
}  // namespace ui
