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

TEST(SelectedLayer, IsTheOneThatRedoAddsAgain) {
    tests::PanelsDesk desk;
    Explorer e = desk.exploration.explorer();
    e.layers = {tests::layer("4:20")};
    desk.exploration.edit(e);
    e.layers.push_back(tests::layer("30:50"));
    desk.exploration.edit(e);
    desk.interface.choices().layer = 1;
    desk.frames(2);
    desk.interface.obey(desk.exploration, Command::Undo);
    desk.frames(2);
    EXPECT_EQ(desk.interface.choices().layer, 0u);
    desk.interface.obey(desk.exploration, Command::Redo);
    desk.frames(2);
    EXPECT_EQ(desk.interface.choices().layer, 1u);
}

// Opens the first layer's colour; the controls are then the popup's.
void openColor(tests::PanelsDesk& desk, glm::vec2 window) {
    desk.frames(2);
    const Rect layers = sideLayout(layoutOf(window, 1), 1).layers;
    const LayerRowLayout row = layerRow(layers, layers.min.y + kLayersTitle, 1);
    desk.click(row.swatch.centre());
    desk.frames(3);
}

TEST(LayerColor, StaysInALowWindow) {
    for (const bool isMap : {false, true}) {
        for (const glm::vec2 window : {glm::vec2(640, 480), glm::vec2(690, 430)}) {
            tests::PanelsDesk desk(tests::World{}, window);
            Explorer e = desk.exploration.explorer();
            e.layers = {tests::layer("4:20")};
            e.layers[0].color = glm::dvec3(1, 0, 0);
            if (isMap) e.layers[0].color = MapChoice{};
            desk.exploration.edit(e);
            openColor(desk, window);
            ASSERT_GT(focus().controls().size(), 5u);
            for (const Focus::Control& control : focus().controls()) {
                EXPECT_GE(control.at.min.y, 0);
                EXPECT_LE(control.at.max.y, window.y) << isMap;
            }
        }
    }
}

TEST(LayerColor, ComesBackToTheLastMapAndItsEnds) {
    const glm::vec2 window(1280, 900);
    tests::PanelsDesk desk(tests::World{}, window);
    Explorer e = desk.exploration.explorer();
    const MapChoice map{*render::colorMapNamed(render::colorMapNames()[1]), 5, 9};
    e.layers = {tests::layer("4:20")};
    e.layers[0].color = map;
    desk.exploration.edit(e);
    openColor(desk, window);
    const Rect kind = focus().controls()[0].at;
    const auto color = [&] { return desk.exploration.explorer().layers[0].color; };
    desk.click({kind.min.x + 0.25f * kind.size().x, kind.centre().y});
    ASSERT_TRUE(color() && std::holds_alternative<glm::dvec3>(*color()));
    desk.click({kind.min.x + 0.75f * kind.size().x, kind.centre().y});
    ASSERT_TRUE(color() && std::holds_alternative<MapChoice>(*color()));
    EXPECT_EQ(std::get<MapChoice>(*color()), map);
}

}  // namespace
}  // namespace app::panels
