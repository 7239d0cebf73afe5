// Two eyes.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "app/choices/camera.h"

namespace app {
namespace {

using glm::dvec3;
using render::project;
using render::View;

const glm::dmat3 kBoxOfEyes(1 / std::sqrt(3.0));

TEST(Camera, EyeDistanceZeroGivesIdenticalEyes) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> turn(-360, 360), tilt(-90, 90), far(0.1, 20);
    for (int i = 0; i < 200; ++i) {
        ViewChoice view{turn(random), tilt(random), {}};
        if (i % 3 == 0) view = {90.0 * (i % 4), 0, far(random)};
        const auto both = eyes(view, {Stereo::MultiView, 0.0, far(random)}, kBoxOfEyes, {300, 200});
        const auto one = eyes(view, {}, kBoxOfEyes, {300, 200});
        ASSERT_EQ(both.size(), 2u);
        ASSERT_EQ(one.size(), 1u);
        for (const View& eye : both) {
            EXPECT_EQ(eye.clipFromView, one[0].clipFromView);
            EXPECT_EQ(eye.viewFromWorld, one[0].viewFromWorld);
            EXPECT_EQ(eye.size, one[0].size);
        }
    }
}

// A world point `depth` in front of the point midway between the eyes, off the axis.
dvec3 inFront(const std::vector<View>& both, double depth, double right, double up) {
    const auto a = render::pixelRays(both[0]), b = render::pixelRays(both[1]);
    const glm::dmat3 rotation = glm::transpose(glm::dmat3(both[0].viewFromWorld));
    return 0.5 * (a.eye + b.eye) + rotation * dvec3(right, up, -depth);
}

TEST(Camera, ParallaxIsZeroAtTheConvergenceDistanceAndCrossedBeforeIt) {
    std::mt19937 random(23);
    std::uniform_real_distribution<double> turn(-180, 180), tilt(-90, 90), distance(1, 10),
        apart(0.01, 0.5), converge(0.5, 12), aside(-0.3, 0.3), share(0.3, 0.95);
    for (int i = 0; i < 500; ++i) {
        const double meet = converge(random);
        const StereoChoice stereo{Stereo::LeftRight, apart(random), meet};
        const auto both =
            eyes({turn(random), tilt(random), distance(random)}, stereo, kBoxOfEyes, {640, 480});
        const auto parallax = [&](double depth) {
            const dvec3 world = inFront(both, depth, aside(random) * depth, aside(random) * depth);
            const glm::dvec2 left = project(both[0], world).window,
                             right = project(both[1], world).window;
            EXPECT_NEAR(left.y, right.y, 1e-8) << "never a vertical one";
            return right.x - left.x;
        };
        EXPECT_NEAR(parallax(meet), 0, 1e-8) << "case " << i;
        EXPECT_LT(parallax(meet * share(random)), 0) << "case " << i << ": in front is crossed";
        EXPECT_GT(parallax(meet / share(random)), 0) << "case " << i << ": behind is uncrossed";
    }
}

TEST(Camera, LeftIsToTheLeftAndTheEyesLookAlongParallelAxes) {
    const auto both = eyes({40, 25, 4.0}, {Stereo::SideBySide, 0.2, {}}, kBoxOfEyes, {640, 480});
    const auto left = render::pixelRays(both[0]), right = render::pixelRays(both[1]);
    const dvec3 apart = right.eye - left.eye;
    EXPECT_NEAR(std::sqrt(apart.x * apart.x + apart.y * apart.y + apart.z * apart.z), 0.2, 1e-12);
    const dvec3 inView = glm::dmat3(both[0].viewFromWorld) * apart;
    EXPECT_NEAR(inView.x, 0.2, 1e-12);
    EXPECT_EQ(glm::dmat3(both[0].viewFromWorld), glm::dmat3(both[1].viewFromWorld));
}

TEST(Camera, WithoutChoicesTheEyesMeetAtTheCentreAThirtiethOfTheDistanceApart) {
    const auto both = eyes({10, 20, 6.0}, {Stereo::SideBySide, {}, {}}, kBoxOfEyes, {640, 480});
    const glm::dvec2 left = project(both[0], dvec3(0)).window,
                     right = project(both[1], dvec3(0)).window;
    EXPECT_NEAR(left.x, right.x, 1e-9);
    EXPECT_NEAR(left.x, 320, 1e-9);
    const dvec3 inView = glm::dmat3(both[0].viewFromWorld) *
                         (render::pixelRays(both[1]).eye - render::pixelRays(both[0]).eye);
    EXPECT_NEAR(inView.x, 6.0 / 30, 1e-12);
}

TEST(Camera, OrthographicEyesSeeDepthAsPerspectiveOnes) {
    // Parallax for a small depth beyond the plane of none, in pixels: the projections agree to
    // first order.
    for (const double converge : {3.0, 5.0}) {
        ViewChoice view{30, 20, 5.0};
        const StereoChoice stereo{Stereo::LeftRight, 0.2, converge};
        const Stand stand = standOf(view, kBoxOfEyes, {640, 480});
        const auto parallax = [&](double depth) {
            const auto both = eyes(view, stereo, kBoxOfEyes, {640, 480});
            const dvec3 world = (stand.distance - depth) * stand.axes[2];
            return project(both[1], world).window.x - project(both[0], world).window.x;
        };
        for (const double behind : {-0.01, 0.0, 0.01}) {
            view.projection = Projection::Perspective;
            const double expected = parallax(converge + behind);
            view.projection = Projection::Orthographic;
            EXPECT_NEAR(parallax(converge + behind), expected, 0.01 * std::abs(expected) + 1e-6);
        }
    }
}

}  // namespace
}  // namespace app
