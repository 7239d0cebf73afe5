#include "xr/pose.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

namespace xr {
namespace {

constexpr double kTiny = 1e-12;

Pose randomPose(std::mt19937& random) {
    std::uniform_real_distribution<double> coordinate(-2, 2);
    const auto next = [&] { return coordinate(random); };
    glm::dquat turn(next(), next(), next(), next());
    return {glm::normalize(turn), {next(), next(), next()}};
}

double largestDifference(const glm::dmat4& a, const glm::dmat4& b) {
    double most = 0;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) most = std::max(most, std::abs(a[c][r] - b[c][r]));
    return most;
}

TEST(Pose, ProductsAndInversesAreThoseOfTheMatrices) {
    std::mt19937 random(1);
    for (int i = 0; i < 200; ++i) {
        const Pose a = randomPose(random), b = randomPose(random);
        EXPECT_LT(largestDifference(matrix(a * b), matrix(a) * matrix(b)), kTiny) << i;
        EXPECT_LT(largestDifference(matrix(inverse(a)), glm::inverse(matrix(a))), kTiny) << i;
    }
}

TEST(Pose, AQuarterTurnAboutYTakesForwardToTheLeft) {
    const double half = std::sqrt(0.5);
    const Pose pose{{half, 0, half, 0}, {1, 2, 3}};
    const glm::dvec4 ahead = matrix(pose) * glm::dvec4(0, 0, -1, 1);
    EXPECT_NEAR(ahead.x, 0, kTiny);
    EXPECT_NEAR(ahead.y, 2, kTiny);
    EXPECT_NEAR(ahead.z, 3, kTiny);
}

TEST(Placement, AUnitIsSoManyMetres) {
    std::mt19937 random(2);
    const Placement placement{randomPose(random), 0.25};
    const glm::dmat4 stage = stageFromWorld(placement);
    EXPECT_NEAR(glm::length(glm::dvec3(stage * glm::dvec4(0, 1, 0, 0))), 0.25, kTiny);
    EXPECT_LT(glm::distance(glm::dvec3(stage[3]), placement.stageFromVolume.position), kTiny);
}

// glm knows symmetric frusta only: an independent oracle for those.
TEST(ViewOf, ASymmetricFovIsGlmsPerspective) {
    for (const double up : {0.3, 0.78, 1.2}) {
        for (const double aspect : {0.5, 1.0, 1.7}) {
            const double right = std::atan(std::tan(up) * aspect);
            const render::View view =
                viewOf({}, {-right, right, up, -up}, {}, 0.05, 40, {100, 100});
            EXPECT_LT(largestDifference(view.clipFromView,
                                        glm::perspectiveRH_ZO(2 * up, aspect, 0.05, 40.0)),
                      1e-9);
        }
    }
}

// A point on the edge of the field of view, by angles alone, is drawn at the edge of the image.
TEST(ViewOf, TheAnglesOfAnAsymmetricFovMeetTheCornersOfTheImage) {
    std::mt19937 random(3);
    const Fov fov{-0.93, 0.70, 0.61, -0.87};
    const glm::ivec2 size(896, 1007);
    for (int i = 0; i < 50; ++i) {
        const Pose stageFromEye = randomPose(random);
        const Placement placement{randomPose(random), 0.1 + 0.1 * i};
        const render::View view = viewOf(stageFromEye, fov, placement, 0.02, 100, size);
        const glm::dmat4 worldFromStage = glm::inverse(stageFromWorld(placement));
        const double depth = 0.5 + 0.1 * i;
        for (const double across : {fov.left, fov.right}) {
            for (const double along : {fov.up, fov.down}) {
                const glm::dvec3 inEye(std::tan(across) * depth, std::tan(along) * depth, -depth);
                const glm::dvec3 world(worldFromStage * matrix(stageFromEye) *
                                       glm::dvec4(inEye, 1));
                const render::Projected at = render::project(view, world);
                EXPECT_NEAR(at.window.x, across > 0 ? size.x : 0, 1e-7);
                EXPECT_NEAR(at.window.y, along > 0 ? size.y : 0, 1e-7);
                EXPECT_NEAR(at.depth, depth, 1e-9);
                const render::PixelRays rays = render::pixelRays(view);
                const glm::dvec3 onRay = rays.eye + rays.along(at.window - rays.centre) * depth;
                EXPECT_LT(glm::distance(onRay, world), 1e-9);
            }
        }
    }
}

TEST(ViewOf, NearAndFarAreMetresWhateverTheScale) {
    const Placement placement{Pose{}, 0.2};
    const render::View view = viewOf({}, {-0.7, 0.7, 0.7, -0.7}, placement, 0.1, 50, {64, 64});
    for (const auto& [metres, clip] : {std::pair{0.1, 0.0}, {50.0, 1.0}}) {
        const glm::dvec4 at =
            view.clipFromView * view.viewFromWorld * glm::dvec4(0, 0, -metres / 0.2, 1);
        EXPECT_NEAR(at.z / at.w, clip, 1e-9);
    }
}

}  // namespace
}  // namespace xr
