// What hands do in the room, with a real runtime: each through the devices that it drives.
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "app/headset/hand_buttons.h"
#include "tests/xr/monado/front_end.h"

namespace app::headset {
namespace {

class HandsInTheRoom : public FrontEndWithHands {
 protected:
    const HandInteraction& interaction() const { return headset_->interaction(); }
    // Where a point of the grid is in the room. The world's grid is a cube.
    glm::dvec3 inStage(const glm::dvec3& grid) const {
        const render::PlacedPoints placed(world_.exploration.shown()->sorted->grid());
        return glm::dvec3(stageFromAxes(interaction().placement(), placed) *
                          glm::dvec4(placed.axesFromGrid(grid), 1));
    }
    // The right hand, pointing that way.
    void move(const glm::dvec3& to, const glm::dvec3& at) {
        devices_.hand(1).place =
            tests::place(to, glm::quatLookAt(glm::normalize(at - to), glm::dvec3(0, 1, 0)));
        devices_.send();
    }
    void squeeze(float force) {
        devices_.hand(1).squeeze = devices_.hand(1).squeezeForce = force;
        devices_.send();
    }
    void trigger(bool pulled) {
        devices_.hand(1).trigger = pulled ? 1.0f : 0.0f;
        devices_.hand(1).triggerClick = pulled ? 1 : 0;
        devices_.send();
    }
    // A click on the panel, by the ray.
    void click(HandCommand command) {
        const glm::dvec2 size(kPanelPixels);
        const panels::Layout layout = panels::layoutOf(glm::vec2(size), kPanelScale);
        const glm::dvec2 at = glm::dvec2(handButton(layout, command).centre()) / size;
        const Plate& panel = *interaction().panel();
        const glm::dvec2 in = panel.half * glm::dvec2(2 * at.x - 1, 1 - 2 * at.y);
        move({0.1, 1.5, 0.1},
             panel.stageFromPlate.orientation * glm::dvec3(in, 0) + panel.stageFromPlate.position);
        framesUntil([&] {
            return interaction().pointer() && glm::distance(interaction().pointer()->at, at) < 0.01;
        });
        trigger(true);
        framesUntil([&] { return interaction().pointer() && interaction().pointer()->pressed; });
        trigger(false);
        framesUntil([&] { return interaction().pointer() && !interaction().pointer()->pressed; });
    }
};

TEST_F(HandsInTheRoom, AButtonOnThePanelTakesBackWhereTheVolumeWasCarried) {
    const xr::Placement before = interaction().placement();
    squeeze(1);
    framesUntil([&] { return interaction().holds(1); });
    devices_.hand(1).place = tests::place({0.5, 1.3, -0.6});
    devices_.send();
    framesUntil([&] { return glm::distance(volume(), before.stageFromVolume.position) > 0.2; });
    squeeze(0);
    framesUntil([&] { return !interaction().holds(1); });
    ASSERT_TRUE(interaction().canUndoMove());
    click(HandCommand::UndoMove);
    framesUntil([&] { return interaction().placement() == before; });
}

TEST_F(HandsInTheRoom, TheStickOfAHandThatHoldsTurnsTheVolume) {
    squeeze(1);
    framesUntil([&] { return interaction().holds(1); });
    const glm::dvec3 before =
        interaction().placement().stageFromVolume.orientation * glm::dvec3(1, 0, 0);
    devices_.hand(1).stick = {1, 0};
    devices_.send();
    framesUntil([&] {
        const glm::dvec3 now =
            interaction().placement().stageFromVolume.orientation * glm::dvec3(1, 0, 0);
        return std::abs(glm::dot(now, before) - std::cos(kSnapAngle)) < 1e-4;
    });
}

TEST_F(HandsInTheRoom, ATipInTheVolumeReadsThePointThere) {
    const std::size_t point = 2 + 4 * (1 + 4 * 3);
    const glm::dvec3 at = inStage({1.95, 1.05, 2.95});
    move(at, at + glm::dvec3(1, 0, 1));
    framesUntil([&] {
        return interaction().tip() && interaction().tip()->value == TipProbe::Value::Found;
    });
    EXPECT_EQ(interaction().tip()->reading.index, (std::array<std::size_t, 3>{2, 1, 3}));
    const double value = world_.world.value(0, world_.exploration.shown()->step, point);
    EXPECT_EQ(timeseries::toDouble(interaction().tip()->reading.value), value);
    trigger(true);
    framesUntil([&] { return headset_->panel().interface().reading().has_value(); });
    EXPECT_EQ(timeseries::toDouble(headset_->panel().interface().reading()->value), value);
    EXPECT_FALSE(world_.exploration.playback().playing);
}

TEST_F(HandsInTheRoom, AFaceOfTheClipBoxGoesWithTheHandThatHoldsIt) {
    Exploration& e = world_.exploration;
    const std::uint64_t selected = e.counts()->selected;
    click(HandCommand::ClipByHand);
    framesUntil([&] { return interaction().clipsByHand(); });
    // The right side, x = 3, taken by a tip that is a little inside.
    const glm::dvec3 from = inStage({2.95, 1.5, 1.5}), to = inStage({1.7, 1.5, 1.5});
    const glm::dvec3 away(1, 0, 0);
    move(from, from + away);
    framesUntil([&] { return interaction().tip() && interaction().tip()->reading.index[0] == 3; });
    squeeze(1);
    framesUntil([&] { return interaction().holdsFace(1); });
    move(to, to + away);
    // Within a millimetre: the sides are 0.6 m and three units.
    framesUntil(
        [&] { return e.explorer().clip && std::abs(e.explorer().clip->hi.x - 1.75) < 0.01; });
    squeeze(0);
    framesUntil([&] { return !interaction().holdsFace(1); });
    // Of the points whose x is 0 or 1.
    std::uint64_t inside = 0;
    const std::size_t edge = world_.world.edge;
    for (std::size_t i = 0; i < edge * edge * edge; ++i) {
        const float value = world_.world.value(0, e.shown()->step, i);
        if (i % edge <= 1 && oracle::holds(e.explorer().layers.at(0).ranges.ranges(), value))
            ++inside;
    }
    EXPECT_EQ(e.counts()->selected, inside);
    e.undo();
    EXPECT_FALSE(e.explorer().clip) << "one step";
    EXPECT_EQ(e.counts()->selected, selected);
}

}  // namespace
}  // namespace app::headset
