// A face of the clip box in the hand: where the hand's motion takes it, in the file's coordinates.
#include "app/headset/clip_hand.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "app/headset/standing.h"
#include "tests/support/scripted_exploration.h"

namespace app::headset {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

// 4 x 4 x 4 points at 0, 1, 2, 3 along axes that lean over each other, turned in the room; y is
// drawn downwards.
class ClipByHand : public testing::Test {
 protected:
    static tests::World leaning() {
        tests::World world;
        timeseries::CoordinateFrame frame;
        frame.directions = tests::leaning({1, 0.2, 0}, {-0.1, 1, 0.1}, {0.2, 0, 1});
        timeseries::Axis down = tests::axis(4);
        down.down = true;
        world.grid = std::make_shared<const timeseries::Grid>(
            std::array{tests::axis(4), down, tests::axis(4)}, frame);
        return world;
    }

    tests::ScriptedExploration world_{leaning()};
    Exploration& e_ = world_.exploration;
    render::PlacedPoints placed_{e_.shown()->sorted->grid()};
    Drawn drawn_{&placed_, e_.shown()->sorted, e_.shown()->step};
    xr::Placement placement_{
        {glm::normalize(glm::dquat(0.8, 0.1, -0.5, 0.3)), glm::dvec3(0.2, 1.3, -0.9)}, 0.5};
    ClipHand clip_;

    glm::dvec3 inStage(const glm::dvec3& grid) const {
        return glm::dvec3(stageFromAxes(placement_, placed_) *
                          glm::dvec4(placed_.axesFromGrid(grid), 1));
    }
    static xr::Pose at(const glm::dvec3& place) { return {{1, 0, 0, 0}, place}; }
    // Takes hold with the tip at a place of the grid; the face that is then held.
    Face take(std::size_t hand, const glm::dvec3& grid) {
        const auto hold = ClipHand::holdAt(at(inStage(grid)), drawn_, placement_, e_);
        EXPECT_TRUE(hold);
        clip_.take(hand, *hold, at(inStage(grid)), drawn_, placement_, e_);
        return hold->face;
    }
    void move(std::size_t hand, const xr::Pose& aim) {
        std::array<std::optional<xr::Pose>, 2> aims;
        aims[hand] = aim;
        clip_.move(e_, aims, drawn_, placement_);
    }
    const std::optional<ClipBox>& clip() const { return e_.explorer().clip; }
    // A millimetre in the room, in units of the grid.
    double millimetre() const { return 0.001 / (placed_.scale().x * placement_.metresPerUnit); }
};

TEST_F(ClipByHand, AFaceGoesWithTheHandAlongItsAxisAlone) {
    // A little inside the face at x = 3; then also along the others.
    EXPECT_EQ(take(1, {2.9, 1.5, 1.5}), (Face{0, 1}));
    for (const double by : {-0.5, -1.25, -0.2}) {
        move(1, at(inStage({2.9 + by, 1.5 - by, 1.2})));
        ASSERT_TRUE(clip());
        EXPECT_NEAR(clip()->hi.x, 3 + by, millimetre());
        EXPECT_EQ(clip()->lo, glm::dvec3(-kUnbounded));
        EXPECT_EQ(clip()->hi.y, kUnbounded);
        EXPECT_EQ(clip()->hi.z, kUnbounded);
    }
}

TEST_F(ClipByHand, AFaceHeldByTheRayGoesWithTheHandFromAfar) {
    const glm::dvec3 face = inStage({1.5, 0, 1.5}), eye = inStage({1.5, -6, 1.5});
    const auto looking = [&](const glm::dvec3& there) {
        return xr::Pose{glm::quatLookAt(glm::normalize(there - eye), glm::dvec3(0, 1, 0)), eye};
    };
    const auto hold = ClipHand::holdAt(looking(face), drawn_, placement_, e_);
    ASSERT_TRUE(hold);
    ASSERT_EQ(hold->face, (Face{1, 1})) << "the least coordinate stands highest";
    clip_.take(0, *hold, looking(face), drawn_, placement_, e_);
    // The hand goes a unit forward, and its ray with it.
    xr::Pose nearer = looking(face);
    nearer.position = inStage({1.5, -5, 1.5});
    move(0, nearer);
    ASSERT_TRUE(clip());
    EXPECT_NEAR(clip()->lo.y, 1, millimetre());
}

TEST_F(ClipByHand, AFaceStopsAtTheOtherAndIsUnboundedOutside) {
    EXPECT_EQ(take(0, {0.1, 1.5, 1.5}), (Face{0, -1}));
    move(0, at(inStage({2.1, 1.5, 1.5})));
    ASSERT_TRUE(clip());
    EXPECT_NEAR(clip()->lo.x, 2, millimetre());
    clip_.letGo(0, e_);
    EXPECT_EQ(take(1, {3.1, 1.5, 1.5}), (Face{0, 1}));
    move(1, at(inStage({-4, 1.5, 1.5})));
    EXPECT_EQ(clip()->hi.x, clip()->lo.x) << "never inside out";
    move(1, at(inStage({5, 1.5, 1.5})));
    EXPECT_EQ(clip()->hi.x, kUnbounded);
    clip_.letGo(1, e_);
    EXPECT_EQ(take(1, {2, 1.5, 1.5}), (Face{0, -1}));
    move(1, at(inStage({-4, 1.5, 1.5})));
    EXPECT_FALSE(clip()) << "nothing is cut off any more";
}

TEST_F(ClipByHand, AGrabIsOneStepOfUndo) {
    const auto grab = [&](double from, double to) {
        take(0, {from, 1.5, 1.5});
        for (int i = 1; i <= 5; ++i) move(0, at(inStage({from + (to - from) * i / 5, 1.5, 1.5})));
        clip_.letGo(0, e_);
    };
    grab(3, 2);
    const auto first = clip();
    grab(2, 1);
    ASSERT_FALSE(clip() == first);
    e_.undo();
    EXPECT_EQ(clip(), first);
    e_.undo();
    EXPECT_FALSE(clip());
}

TEST_F(ClipByHand, AHandThatRestsOrIsNotSeenEditsNothing) {
    take(0, {3, 1.5, 1.5});
    const bool couldUndo = e_.canUndo();
    move(0, at(inStage({3, 1.5, 1.5})));
    clip_.move(e_, {}, drawn_, placement_);
    EXPECT_FALSE(clip());
    EXPECT_EQ(e_.canUndo(), couldUndo);
}

TEST_F(ClipByHand, EdgesOfTheFaceInTheHandAreLit) {
    Explorer next = e_.explorer();
    next.clip = ClipBox{{1, -kUnbounded, -kUnbounded}, glm::dvec3(kUnbounded)};
    e_.edit(next);
    take(0, {1, 1.5, 1.5});
    const auto edges = clip_.edges({}, drawn_, e_);
    ASSERT_EQ(edges.size(), 12u);
    int lit = 0;
    for (const ClipHand::Edge& edge : edges) {
        double greatest = -kUnbounded;
        for (const glm::dvec3& world : {edge.from, edge.to}) {
            const glm::dvec3 grid =
                placed_.gridFromAxes(glm::inverse(placed_.worldFromAxes()) * world);
            EXPECT_GE(grid.x, 1 - 1e-9) << "of what is inside";
            greatest = std::max(greatest, grid.x);
        }
        EXPECT_EQ(edge.lit, greatest < 1 + 1e-9);
        lit += edge.lit ? 1 : 0;
    }
    EXPECT_EQ(lit, 4);
}

TEST_F(ClipByHand, WhereTheDrawnGridIsAnotherNothingIsTaken) {
    const auto other = std::make_shared<const timeseries::SortedStep>(tests::noise(tests::cube(5)));
    const render::PlacedPoints placed(other->grid());
    EXPECT_FALSE(ClipHand::holdAt(at(placement_.stageFromVolume.position), {&placed, other, 0},
                                  placement_, e_));
}

}  // namespace
}  // namespace app::headset
