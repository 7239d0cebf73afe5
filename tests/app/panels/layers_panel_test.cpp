// Which layer is selected: the one that drags in the histogram change.
#include <gtest/gtest.h>

#include "app/choices/edits.h"
#include "tests/support/panels_desk.h"

namespace app::panels {
namespace {

TEST(SelectedLayer, StaysTheSameWhereTheSweptOneComesAndGoesBeforeIt) {
    tests::PanelsDesk desk;
    Explorer e = desk.exploration.explorer();
    e.layers = {tests::layer("4:20"), tests::layer("30:50")};
    desk.exploration.edit(e);
    desk.interface.choices().layer = 1;
    const auto selected = [&] {
        desk.frames(2);
        return desk.exploration.explorer().layers.at(desk.interface.choices().layer).ranges;
    };
    const auto second = timeseries::RangeSet::parse("30:50");
    EXPECT_EQ(selected(), second);
    desk.sweep("1:63", 2);
    EXPECT_EQ(selected(), second);
    desk.exploration.undo();
    EXPECT_EQ(selected(), second);
    desk.exploration.redo();
    EXPECT_EQ(selected(), second);
    e = desk.exploration.explorer();
    removeLayer(e, 2);
    desk.exploration.edit(e);
    EXPECT_EQ(selected(), timeseries::RangeSet::parse("4:20"));
    // The swept one has no ranges that could be dragged.
    removeLayer(e, 1);
    desk.exploration.edit(e);
    desk.frames(2);
    EXPECT_EQ(desk.interface.choices().layer, 1u);
}

}  // namespace
}  // namespace app::panels
