// A room with an exploration in it, for its tests: hands, a head, and what they do frame by frame.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "app/headset/hand_interaction.h"
#include "tests/support/scripted_exploration.h"

namespace app::headset {

class HandsOfAnExploration : public testing::Test {
 protected:
    tests::ScriptedExploration world_;
    Exploration& e_ = world_.exploration;
    HandInteraction interaction_;
    // 4 x 4 x 4 points.
    render::PlacedPoints placed_{e_.shown()->sorted->grid()};
    HandInput input_{.hands = {},
                     .head = xr::Pose{{1, 0, 0, 0}, {0, 1.6, 0}},
                     .dt = std::chrono::milliseconds(10),
                     .drawn = Drawn{&placed_, e_.shown()->sorted, e_.shown()->step},
                     .asked = {}};
    xr::Hand& left_ = input_.hands[0];
    xr::Hand& right_ = input_.hands[1];
    std::optional<Reading> reading_;  // of the last frame

    HandsOfAnExploration() { frame(); }

    std::vector<Pulse> frame() {
        HandOutcome outcome = interaction_.update(e_, input_);
        reading_ = outcome.reading;
        return outcome.pulses;
    }
    // Where the room is to place the volume.
    xr::Placement first() const { return volumeBefore(*input_.head, placed_.boxHalfEdges()); }
    static xr::Pose looking(const glm::dvec3& from, const glm::dvec3& at) {
        return {glm::quatLookAt(glm::normalize(at - from), glm::dvec3(0, 1, 0)), from};
    }
    // A point of the panel, [0, 1] from its upper left corner.
    glm::dvec3 onPanel(const glm::dvec2& at) const {
        const Plate& panel = *interaction_.panel();
        const glm::dvec2 in = panel.half * glm::dvec2(2 * at.x - 1, 1 - 2 * at.y);
        return panel.stageFromPlate.orientation * glm::dvec3(in, 0) + panel.stageFromPlate.position;
    }
    void aim(xr::Hand& hand, const glm::dvec3& at) {
        hand.aim = looking({0.2, 1.3, -0.2}, at);
        hand.grip = hand.aim;
    }
    void ask(HandCommand command) {
        input_.asked = command;
        frame();
        input_.asked.reset();
    }
    // Takes hold, goes along, lets go.
    void carry(xr::Hand& hand, const glm::dvec3& by) {
        hand.grip = xr::Pose{};
        hand.grab = true;
        frame();
        hand.grip->position += by;
        frame();
        hand.grab = false;
        frame();
    }
    // Both hands, from 0.4 m apart.
    void stretch(double ratio) {
        for (xr::Hand* hand : {&left_, &right_}) hand->grab = true;
        for (const double apart : {0.4, 0.4 * ratio}) {
            left_.grip = xr::Pose{{1, 0, 0, 0}, {-0.5 * apart, 1.2, -0.5}};
            right_.grip = xr::Pose{{1, 0, 0, 0}, {0.5 * apart, 1.2, -0.5}};
            frame();
        }
        for (xr::Hand* hand : {&left_, &right_}) hand->grab = false;
        frame();
    }
    glm::dvec3 volume() const { return interaction_.placement().stageFromVolume.position; }
    bool playing() const { return e_.playback().playing; }
};

}  // namespace app::headset
