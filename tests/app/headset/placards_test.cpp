// What stands in the room beside the volume: where, by the corners of each placard.
#include "app/headset/placards.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/scripted_exploration.h"

namespace app::headset {
namespace {

class PlacardsOfARoom : public testing::Test {
 protected:
    tests::ScriptedExploration world_;
    Exploration& e_ = world_.exploration;
    render::PlacedPoints placed_{e_.shown()->sorted->grid()};
    HandInput input_{.hands = {},
                     .head = xr::Pose{{1, 0, 0, 0}, {0, 1.6, 0}},
                     .dt = {},
                     .drawn = Drawn{&placed_, e_.shown()->sorted, e_.shown()->step},
                     .asked = {}};
    HandInteraction interaction_;

    std::vector<render::Placard> placards(const Boards& boards = {}) {
        interaction_.update(e_, input_);
        return placardsOf(interaction_, input_.hands, *input_.head, boards);
    }
    glm::dvec3 inStage(const glm::dvec3& world) const {
        return glm::dvec3(xr::stageFromWorld(interaction_.placement()) * glm::dvec4(world, 1));
    }
    static glm::dvec3 at(const render::Placard& placard, double x, double y) {
        return glm::dvec3(placard.worldFromPlacard * glm::dvec4(x, y, 0, 1));
    }
    static glm::vec3 color(const render::Placard& placard) {
        return std::get<glm::vec3>(placard.face);
    }
};

TEST_F(PlacardsOfARoom, EveryEdgeOfTheClipBoxIsALineFromEndToEnd) {
    Explorer next = e_.explorer();
    next.clip = ClipBox{{1, 0, 0}, {3, 2, 3}};
    e_.edit(next);
    EXPECT_TRUE(placards().empty());
    input_.asked = HandCommand::ClipByHand;
    // At the face x = 1, from the left.
    const glm::dvec3 face = placed_.axesFromGrid({1, 1, 1.5});
    input_.hands[0].aim = xr::Pose{{1, 0, 0, 0}, inStage(face - glm::dvec3(0.05, 0, 0))};
    const auto all = placards();
    ASSERT_EQ(interaction_.clipEdges().size(), 12u);
    std::vector<glm::vec3> lit, others;
    for (const ClipHand::Edge& edge : interaction_.clipEdges()) {
        const auto line = std::ranges::find_if(all, [&](const render::Placard& p) {
            return glm::distance(at(p, 0, -1), edge.from) < 1e-9 &&
                   glm::distance(at(p, 0, 1), edge.to) < 1e-9;
        });
        ASSERT_NE(line, all.end());
        const glm::dvec3 across = inStage(at(*line, 1, 0)) - inStage(at(*line, -1, 0));
        const glm::dvec3 towards = input_.head->position - inStage(at(*line, 0, 0));
        EXPECT_LT(glm::length(across), 0.005) << "thin";
        EXPECT_LT(std::abs(glm::dot(glm::normalize(across), glm::normalize(towards))), 1e-6)
            << "its flat side to the head";
        (edge.lit ? lit : others).push_back(color(*line));
    }
    EXPECT_EQ(lit, std::vector(4, lit.front()));
    EXPECT_EQ(others, std::vector(8, others.front()));
    EXPECT_NE(lit.front(), others.front()) << "what a grab would take is seen";
}

TEST_F(PlacardsOfARoom, ThePointAtATipAndTheOneKeptAreMarked) {
    placards();
    const glm::dvec3 point = placed_.position(1 + 4 * (2 + 4 * 3));
    const glm::dvec3 tip = inStage(0.97 * point);
    input_.hands[1].aim =
        xr::Pose{glm::quatLookAt(glm::normalize(glm::dvec3(1, 0, 1)), glm::dvec3(0, 1, 0)), tip};
    Boards boards;
    boards.kept = placed_.position(5);
    const auto all = placards(boards);
    const auto marks = [&](const glm::dvec3& place) {
        return std::ranges::count_if(all, [&](const render::Placard& p) {
            return glm::distance(at(p, 0, 0), place) < 1e-9;
        });
    };
    EXPECT_EQ(marks(point), 1);
    EXPECT_EQ(marks(placed_.position(5)), 1);
    EXPECT_EQ(marks(placed_.position(6)), 0);
}

TEST_F(PlacardsOfARoom, TheReadoutStandsAtTheHandWhoseTipIsInTheVolume) {
    placards();
    for (xr::Hand& hand : input_.hands) hand.grip = xr::Pose{{1, 0, 0, 0}, {0.4, 1, 0}};
    input_.hands[0].grip->position.x = -0.4;
    Boards boards;
    // Only passed on: there is no GL here to make one.
    boards.readout = reinterpret_cast<const render::Board*>(&boards);
    boards.readoutHalf = {0.1, 0.05};
    const auto readoutAt = [&] {
        const auto all = placards(boards);
        const auto board = std::ranges::find_if(all, [&](const render::Placard& p) {
            return std::holds_alternative<const render::Board*>(p.face);
        });
        return inStage(at(*board, 0, 0)).x;
    };
    EXPECT_NEAR(readoutAt(), 0.4, 1e-9);
    input_.hands[0].aim =
        xr::Pose{glm::quatLookAt(glm::normalize(glm::dvec3(1, 0, 1)), glm::dvec3(0, 1, 0)),
                 inStage({0.1, 0.1, 0.1})};
    EXPECT_NEAR(readoutAt(), -0.4, 1e-9);
}

}  // namespace
}  // namespace app::headset
