#include "app/headset/snap_turn.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

namespace app::headset {
namespace {

// The steps of a hand that holds, its stick moved through these places.
int stepsThrough(SnapTurn& snap, const std::vector<double>& places) {
    int steps = 0;
    for (const double x : places) steps += snap.update(true, x);
    return steps;
}

TEST(SnapTurn, AFlickIsOneStepHoweverTheStickTrembles) {
    SnapTurn snap;
    EXPECT_EQ(stepsThrough(snap, {0, 0.3, 0.6, 0.69, 0.71, 1, 0.71, 0.69, 0.5, 0.71, 1, 0.45, 1}),
              1);
    EXPECT_EQ(stepsThrough(snap, {0.39, 0.6, 0.7}), 1) << "it had come back";
    EXPECT_EQ(stepsThrough(snap, {0.2, -0.69}), 0);
    EXPECT_EQ(stepsThrough(snap, {-0.7, -1}), -1);
}

TEST(SnapTurn, AStickThatWasOutBeforeTheHandTookHoldTurnsNothing) {
    SnapTurn snap;
    snap.update(false, 1);
    EXPECT_FALSE(snap.owns()) << "it moves values or time";
    EXPECT_EQ(snap.update(true, 1), 0);
    EXPECT_TRUE(snap.owns());
    EXPECT_EQ(stepsThrough(snap, {0.6, 1}), 0);
    EXPECT_EQ(stepsThrough(snap, {0, 1}), 1);
}

TEST(SnapTurn, AStickIsGivenBackWhenItHasComeBack) {
    SnapTurn snap;
    stepsThrough(snap, {0, 1});
    for (const double x : {1.0, 0.8, 0.41}) {
        EXPECT_EQ(snap.update(false, x), 0);
        EXPECT_TRUE(snap.owns()) << x;
    }
    snap.update(false, 0.39);
    EXPECT_FALSE(snap.owns());
    snap.update(false, 1);
    EXPECT_FALSE(snap.owns());
}

TEST(SnapTurn, TurnsAboutTheVerticalThroughTheMiddle) {
    const xr::Placement before{
        {glm::normalize(glm::dquat(0.3, -0.5, 0.7, 0.2)), glm::dvec3(1, 2, -3)}, 0.4};
    const xr::Placement after = turned(before, 2);
    EXPECT_EQ(after.stageFromVolume.position, before.stageFromVolume.position);
    EXPECT_EQ(after.metresPerUnit, before.metresPerUnit);
    // By 60 degrees: what is on the user's side (+z) goes right (+x), heights stay.
    const double sine = std::sqrt(3) / 2, cosine = 0.5;
    for (const glm::dvec3 p : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)}) {
        const glm::dvec3 was = before.stageFromVolume.orientation * p;
        const glm::dvec3 is = after.stageFromVolume.orientation * p;
        EXPECT_LT(glm::distance(
                      is, {cosine * was.x + sine * was.z, was.y, cosine * was.z - sine * was.x}),
                  1e-12);
    }
}

}  // namespace
}  // namespace app::headset
