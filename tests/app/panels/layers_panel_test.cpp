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

// Of whichever control opens a popup whose last one does: the swatch's.
TEST(LayerColor, FitsTheMapToTheRange) {
    bool hasFitted = false;
    for (std::size_t control = 0, count = 1; control < count && !hasFitted; ++control) {
        tests::PanelsDesk desk;
        Explorer e = desk.exploration.explorer();
        e.layers = {tests::layer("4:20")};
        e.layers[0].color = MapChoice{{}, 100, 200};
        desk.exploration.edit(e);
        desk.frames(2);
        count = focus().controls().size();
        desk.click(focus().controls()[control].at.centre());
        desk.frames(2);
        if (focus().controls().empty() || focus().controls().size() >= count) continue;
        desk.click(focus().controls().back().at.centre());
        desk.frames(2);
        if (desk.exploration.explorer().layers.empty()) continue;
        const auto& color = desk.exploration.explorer().layers[0].color;
        const auto* map = color ? std::get_if<MapChoice>(&*color) : nullptr;
        hasFitted = map != nullptr && map->lo == 4.0 && map->hi == 20.0;
    }
    EXPECT_TRUE(hasFitted);
}

}  // namespace
}  // namespace app::panels
