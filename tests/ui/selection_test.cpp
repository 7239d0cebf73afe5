#include "tests/ui/demo_values.h"
#include "tests/ui/desk_test.h"

namespace ui {
namespace {

class DeskSelects : public DeskWithFire {
 protected:
    // Along the middle of the histogram's bars.
    void drag(const app::panels::ValueAxis& axis, double from, double to) {
        const float x = at_.histogramPanel.histogram.centre().x;
        desk_->drag({x, axis.y(from)}, {x, axis.y(to)});
    }
    static double lo(const app::Explorer& e, std::size_t layer, std::size_t range) {
        return timeseries::toDouble(e.layers.at(layer).ranges.ranges()[range].lo.value);
    }
    static double hi(const app::Explorer& e, std::size_t layer, std::size_t range) {
        return timeseries::toDouble(e.layers.at(layer).ranges.ranges()[range].hi.value);
    }
};

TEST_F(DeskSelects, ByTheDraggedEndOfARange) {
    const Shot before = picture();
    const std::uint64_t count = points();
    const app::panels::ValueAxis axis = axisOf(*desk_);
    drag(axis, 1000, 1300);
    const Shot after = picture();
    const app::Explorer e = now();
    EXPECT_EQ(lo(e, 0, 0), 600);
    EXPECT_NEAR(hi(e, 0, 0), 1300, 3 * axis.perPixel());
    EXPECT_EQ(points(), countIn(e));
    EXPECT_GT(points(), count);
    EXPECT_GT(differing(before, after), 1000u);
}

TEST_F(DeskSelects, AndUndoRestoresPixelsAndCount) {
    const Shot before = picture();
    const std::string title = desk_->title();
    drag(axisOf(*desk_), 1000, 1300);
    const Shot after = picture();
    const std::string dragged = desk_->title();
    ASSERT_NE(dragged, title);
    desk_->press("ctrl+z");
    EXPECT_EQ(differing(picture(), before), 0u);
    EXPECT_EQ(desk_->title(), title);
    desk_->press("ctrl+y");
    EXPECT_EQ(differing(picture(), after), 0u);
    EXPECT_EQ(desk_->title(), dragged);
    desk_->press("ctrl+z");
    desk_->press("ctrl+shift+z");
    EXPECT_EQ(differing(picture(), after), 0u);
}

TEST_F(DeskSelects, TwoRangesThatDoNotTouch) {
    const app::panels::ValueAxis axis = axisOf(*desk_);
    drag(axis, 1150, 1300);
    desk_->settled();
    const app::Explorer e = now();
    ASSERT_EQ(e.layers.size(), 1u);
    ASSERT_EQ(e.layers[0].ranges.ranges().size(), 2u);
    EXPECT_EQ(lo(e, 0, 0), 600);
    EXPECT_EQ(hi(e, 0, 0), 1000);
    EXPECT_NEAR(lo(e, 0, 1), 1150, 3 * axis.perPixel());
    EXPECT_NEAR(hi(e, 0, 1), 1300, 3 * axis.perPixel());
    EXPECT_EQ(points(), countIn(e));
}

// The new layer's row takes room in the column, but not from under the hand.
TEST_F(DeskSelects, AsANewLayerWhatWasDraggedAcrossWithShift) {
    const app::panels::ValueAxis axis = axisOf(*desk_);
    desk_->hold("shift");
    drag(axis, 1150, 1300);
    desk_->release("shift");
    const app::Explorer e = now();
    ASSERT_EQ(e.layers.size(), 2u);
    EXPECT_NEAR(lo(e, 1, 0), 1150, 3 * axis.perPixel());
    EXPECT_NEAR(hi(e, 1, 0), 1300, 3 * axis.perPixel());
}

}  // namespace
}  // namespace ui
