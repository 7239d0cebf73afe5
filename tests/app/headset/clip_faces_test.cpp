// Which face of a box a hand is at, against walking along its ray and asking all around its tip.
#include "app/headset/clip_faces.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "app/headset/standing.h"
#include "tests/support/scenes.h"

namespace app::headset {
namespace {

bool isIn(const glm::dvec3& at, const AxisBox& box) {
    for (int a = 0; a < 3; ++a)
        if (at[a] < box.lo[a] || at[a] > box.hi[a]) return false;
    return true;
}

TEST(Crossing, IsWhereAWalkAlongTheLineIsInTheBox) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-1, 1);
    const auto point = [&] { return glm::dvec3(any(random), any(random), any(random)); };
    int met = 0;
    for (int i = 0; i < 300; ++i) {
        // Most of them towards the middle.
        const glm::dvec3 from = point(), along = 0.3 * point() - from;
        const glm::dvec3 a = 0.5 * point(), b = 0.5 * point();
        const AxisBox box{glm::min(a, b), glm::max(a, b)};
        const auto crossed = crossing(from, along, box);
        if (crossed) {
            ++met;
            EXPECT_LE(crossed->enters, crossed->leaves) << "else it is a miss";
            for (const auto& [t, face] : {std::pair(crossed->enters, crossed->in),
                                          std::pair(crossed->leaves, crossed->out)}) {
                const double at = (from + t * along)[face.axis];
                EXPECT_NEAR(at, (face.side < 0 ? box.lo : box.hi)[face.axis], 1e-12);
            }
        }
        for (double t = -20; t < 20; t += 0.037)
            EXPECT_EQ(isIn(from + t * along, box),
                      crossed && crossed->enters <= t && t <= crossed->leaves)
                << i << ' ' << t;
    }
    EXPECT_GT(met, 20);
}

TEST(Crossing, ALineBesideTheBoxAndAlongOneOfItsAxesMissesIt) {
    const AxisBox box{glm::dvec3(-1), glm::dvec3(1)};
    EXPECT_FALSE(crossing({0, 2, 0}, {1, 0, 0}, box));
    EXPECT_TRUE(crossing({0, 0.5, 0}, {1, 0, 0}, box));
}

TEST(ClippedBox, LiesInThePointsBoxWhicheverWayItsAxesRun) {
    auto down = tests::axis(5), descending = tests::axis(5);
    down.down = true;
    std::ranges::reverse(descending.coordinates);
    const render::PlacedPoints placed(
        timeseries::Grid(std::array{tests::axis(5), down, descending}));
    const glm::dvec3 half = placed.boxHalf();
    const AxisBox all = clippedBox(placed, {});
    EXPECT_EQ(all.lo, -half);
    EXPECT_EQ(all.hi, half);
    // Coordinates 0 to 4: 1 lies half of half the box below the middle, where it is not down.
    const AxisBox box = clippedBox(placed, ClipBox{{1, 1, -kInfinity}, {kInfinity, kInfinity, 1}});
    EXPECT_LT(glm::distance(box.lo, half * glm::dvec3(-0.5, -1, -1)), 1e-12);
    EXPECT_LT(glm::distance(box.hi, half * glm::dvec3(1, 0.5, -0.5)), 1e-12);
}

class HandAtABox : public testing::Test {
 protected:
    // Oblique, in metres: a box with sides of some 0.6.
    render::PlacedPoints placed_{
        timeseries::Grid(std::array{tests::axis(4), tests::axis(4), tests::axis(4)},
                         timeseries::CoordinateFrame{
                             .directions = tests::leaning({1, 0.2, 0}, {-0.1, 1, 0.1}, {0.2, 0, 1}),
                             .origin = {},
                             .names = {}})};
    xr::Placement placement_{
        {glm::normalize(glm::dquat(0.8, 0.1, -0.5, 0.3)), glm::dvec3(0.2, 1.3, -0.9)}, 0.5};
    glm::dmat4 stageFromAxes_ = stageFromAxes(placement_, placed_);
    glm::dvec3 half_ = placed_.boxHalf();
    AxisBox box_{-half_, 0.5 * half_};

    glm::dvec3 inStage(const glm::dvec3& axes) const {
        return glm::dvec3(stageFromAxes_ * glm::dvec4(axes, 1));
    }
    static xr::Pose looking(const glm::dvec3& from, const glm::dvec3& at) {
        return {glm::quatLookAt(glm::normalize(at - from), glm::dvec3(0, 1, 0)), from};
    }
    glm::dvec3 middleOf(Face face) const {
        glm::dvec3 at = 0.5 * (box_.lo + box_.hi);
        at[face.axis] = (face.side < 0 ? box_.lo : box_.hi)[face.axis];
        return at;
    }
};

TEST_F(HandAtABox, ATipTakesTheFaceThatItIsNearWhereverItsRayGoes) {
    for (int axis = 0; axis < 3; ++axis)
        for (const int side : {-1, 1})
            for (const double beside : {-0.04, 0.04}) {  // inside and outside, in axis coordinates
                glm::dvec3 place = middleOf({axis, side});
                place[axis] += beside;
                const auto hold = holdOf(looking(inStage(place), inStage({0.3, 0.2, 0.1})),
                                         stageFromAxes_, box_, half_);
                ASSERT_TRUE(hold);
                EXPECT_EQ(hold->face, (Face{axis, side}));
                EXPECT_EQ(hold->at, inStage(place)) << "the tip itself";
            }
}

TEST_F(HandAtABox, ARayTakesTheFaceThatItMeetsFirst) {
    for (int axis = 0; axis < 3; ++axis)
        for (const int side : {-1, 1}) {
            const glm::dvec3 face = middleOf({axis, side});
            glm::dvec3 away = face;
            away[axis] += 3 * side;
            const auto hold =
                holdOf(looking(inStage(away), inStage(face)), stageFromAxes_, box_, half_);
            ASSERT_TRUE(hold);
            EXPECT_EQ(hold->face, (Face{axis, side}));
            EXPECT_LT(glm::distance(hold->at, inStage(face)), 1e-9);
            EXPECT_FALSE(holdOf(looking(inStage(away), inStage(away + (away - face))),
                                stageFromAxes_, box_, half_))
                << "it points away";
        }
}

TEST_F(HandAtABox, FromInsideTheRayTakesTheFaceWhereItLeaves) {
    placement_.metresPerUnit = 5;  // no face is within reach
    stageFromAxes_ = stageFromAxes(placement_, placed_);
    const glm::dvec3 inside = 0.5 * (box_.lo + box_.hi), face = middleOf({1, 1});
    const auto hold = holdOf(looking(inStage(inside), inStage(face)), stageFromAxes_, box_, half_);
    ASSERT_TRUE(hold);
    EXPECT_EQ(hold->face, (Face{1, 1}));
    EXPECT_LT(glm::distance(hold->at, inStage(face)), 1e-9);
}

TEST_F(HandAtABox, OfTwoFacesInOneTheTipTakesTheNearer) {
    box_.lo.z = box_.hi.z = 0;
    for (const int side : {-1, 1}) {
        const glm::dvec3 tip = inStage({0, 0, 0.05 * side});
        const auto hold =
            holdOf(looking(tip, tip + glm::dvec3(1, 0, 0)), stageFromAxes_, box_, half_);
        ASSERT_TRUE(hold);
        EXPECT_EQ(hold->face, (Face{2, side})) << "so that it can be pulled out again";
    }
}

TEST_F(HandAtABox, AcrossAFlatAxisNothingCanBeMoved) {
    half_.z = box_.lo.z = box_.hi.z = 0;
    const glm::dvec3 above = inStage({0, 0, 0.5});
    EXPECT_FALSE(holdOf(looking(above, inStage({0, 0, 0})), stageFromAxes_, box_, half_));
}

}  // namespace
}  // namespace app::headset
