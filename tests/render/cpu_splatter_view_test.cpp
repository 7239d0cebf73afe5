// The truth from where it is seen: cameras, lenses, the near plane, what hides.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <numeric>
#include <random>

#include "render/model/footprint.h"
#include "render/reference/cpu_splatter.h"
#include "render/reference/exact_order.h"
#include "render/splat/depth_order.h"
#include "tests/support/scenes.h"
#include "tests/support/splat_world.h"

namespace render {
namespace {

using tests::axis;
using timeseries::Grid;
using timeseries::RangeSet;
using namespace render::splat_world;

// The upright scene and the oblique one, whose camera has turned with the grid.
void expectSamePicture(const Grid& upright, const Grid& turned, const glm::dmat3& turn) {
    const auto value = [](std::size_t i) { return static_cast<double>(i * 7919 % 101); };
    for (const Footprint footprint : {Footprint{Kernel::Quartic, 1}, Footprint{Kernel::Point, 2}}) {
        const World a(tests::stepOf(std::make_shared<Grid>(upright), value),
                      RangeSet::parse("20:60"), footprint);
        const World b(tests::stepOf(std::make_shared<Grid>(turned), value),
                      RangeSet::parse("20:60"), footprint);
        for (const glm::dvec3& from : {glm::dvec3(0.3, -3, 1.1), glm::dvec3(0.1, -0.2, 0.15)}) {
            const View view = tests::lookFrom(from, {90, 70});
            View turnedView = view;
            turnedView.viewFromWorld *= glm::dmat4(glm::transpose(turn));
            const auto expected = weights(a, view), drawn = weights(b, turnedView);
            EXPECT_GT(std::accumulate(expected.begin(), expected.end(), 0.0), 1);
            for (std::size_t i = 0; i < expected.size(); ++i)
                ASSERT_NEAR(drawn[i], expected[i], 1e-11 * (1 + expected[i])) << i;
        }
        // Ordered from the same place, the points come in the same order.
        Scene sortedA = a.scene, sortedB = b.scene;
        sortedA.order = sortedB.order = Order::BackToFront;
        const glm::dvec3 eye(0.31, -2.9, 0.97);
        EXPECT_EQ(std::get<Sorted>(orderExactly(sortedB, turn * eye)).point,
                  std::get<Sorted>(orderExactly(sortedA, eye)).point);
    }
}

TEST(Truth, ATurnedGridSeenByATurnedCameraIsTheSamePicture) {
    const std::array axes{axis(7), axis(6, 3, -0.8), axis(5, 0, 1.7)};
    const glm::dmat3 turn = tests::rotation(1.1);
    expectSamePicture(Grid(axes), Grid(axes, {turn, {5, 6, 7}}), turn);
    const std::array cubic{axis(7), axis(6), axis(5)};
    expectSamePicture(Grid(cubic), Grid(cubic, {turn}), turn);
}

TEST(Truth, AMirroredAxisIsADescendingOne) {
    const std::array ascending{axis(7, 2), axis(6), axis(5)};
    const std::array descending{axis(7, -2, -1), axis(6), axis(5)};
    const glm::dmat3 turn = tests::rotation(0.4);
    const glm::dmat3 mirror(glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1));
    expectSamePicture(Grid(descending), Grid(ascending, {turn * mirror}), turn);
}

TEST(Truth, AShellIsAsDeepAsTheChordsThroughIt) {
    // Radii 12 to 20 cells; a ray at r cells from the middle meets 2 (sqrt(400 - r^2) - sqrt(144 -
    // r^2)) of them. Which points are inside is decided point by point, so single rays are
    // uncertain by a cell or so; over the middle's pixels, seen along no axis of the grid, that
    // averages out.
    const std::size_t n = 48;
    const auto radius = [](std::size_t i) {
        const glm::dvec3 p(i % n, i / n % n, i / n / n);
        return glm::length(p - glm::dvec3((n - 1) / 2.0));
    };
    const World world(tests::stepOf(tests::cube(n), radius), RangeSet::parse("12:20"));
    const View view = tests::lookFrom(200.0 * glm::normalize(glm::dvec3(0.31, -0.83, 0.47)),
                                      {128, 128}, 1.0 / 200);
    const auto w = weights(world, view);
    const double cellsPerPixel = 1.0 / 64 / world.placed.cell(0).x;
    double drawn = 0, chords = 0;
    for (int y = 54; y < 74; ++y)
        for (int x = 54; x < 74; ++x) {
            const double r = glm::length(glm::dvec2(x - 63.5, y - 63.5)) * cellsPerPixel;
            if (r > 6) continue;
            chords += 2 * (std::sqrt(400 - r * r) - std::sqrt(144 - r * r));
            drawn += w[std::size_t(y) * 128 + x];
        }
    EXPECT_NEAR(drawn, chords, 0.02 * chords);
    // The whole: the volume of the selected cells, l = cell.
    const double l = world.placed.unitLength();
    const auto selected = static_cast<double>(world.step.count(RangeSet::parse("12:20")));
    EXPECT_NEAR(massDrawn(w, view, 200), selected * l * l, 2e-3 * selected * l * l);
}

TEST(Truth, OffAxisSplatsAreTheEllipsesThatALensWouldDraw) {
    // A sphere at 50 degrees off the axis covers more pixels than on it (by about 1 / cos^3): its
    // total, weighed by solid angle, stays. On the plane at unit depth a pixel's solid angle is
    // cos^3 / focal^2.
    const World world(onePoint());
    const double distance = 40, angle = 50 * std::numbers::pi / 180, t = std::tan(angle);
    for (const bool upward : {false, true}) {
        View view = tests::lookFrom({0, -distance, 0}, {501, 501}, 0.1);
        // Turn the head: the splat stands at `angle`, an asymmetric frustum looks there.
        view.viewFromWorld =
            glm::rotate(glm::dmat4(1.0), upward ? angle : -angle, glm::dvec3(upward, !upward, 0)) *
            view.viewFromWorld;
        view.clipFromView = upward ? clipFromView({-0.2, 0.2, t - 0.2, t + 0.2, 0.1, 100})
                                   : clipFromView({t - 0.2, t + 0.2, -0.2, 0.2, 0.1, 100});
        const auto w = weights(world, view);
        const PixelRays rays = pixelRays(view);
        double mass = 0;
        for (int y = 0; y < 501; ++y)
            for (int x = 0; x < 501; ++x) {
                const glm::dvec2 slope = (glm::dvec2(x + 0.5, y + 0.5) - rays.centre) / rays.focal;
                mass += w[std::size_t(y) * 501 + x] * std::pow(1 + glm::dot(slope, slope), -1.5);
            }
        mass *= distance * distance / (rays.focal.x * rays.focal.y);
        EXPECT_NEAR(mass, 1, 3e-3) << upward;
    }
}

TEST(Truth, EveryPixelThatASplatReachesIsDrawn) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const World world(tests::stepOf(
        std::make_shared<Grid>(
            std::array{axis(1), axis(1), axis(1)},
            timeseries::CoordinateFrame{tests::leaning({1, 0.4, 0}, {0, 1, 0.5}, {0.3, 0, 1})}),
        [](std::size_t) { return 1.0; }));
    for (int trial = 0; trial < 300; ++trial) {
        const glm::dvec3 way(uniform(random), uniform(random), uniform(random));
        const double distance = 6 + 30 * std::abs(uniform(random));
        View view = tests::lookFrom(distance * glm::normalize(way), {40, 40});
        const Frustum seenPart = std::array{Frustum{-0.5, 0.6, -0.2, 0.3, 0.01, 100},
                                            Frustum{-0.2, 0.3, -0.5, 0.6, 0.01, 100},
                                            Frustum{0.8, 2.6, -0.7, 0.9, 0.01, 100}}[trial % 3];
        view.clipFromView = clipFromView(seenPart);
        const double right = std::abs(uniform(random)), up = std::abs(uniform(random));
        view.viewFromWorld[3] +=
            distance * glm::dvec4(std::lerp(seenPart.left, seenPart.right, right),
                                  std::lerp(seenPart.down, seenPart.up, up), 0, 0);
        const PointsView seen(world.placed, view);
        const auto s = splatAt<double>(seen, 0, {});
        const auto w = weights(world, view);
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 40; ++x) {
                const glm::dvec2 at = glm::dvec2(x + 0.5, y + 0.5) - seen.rays.centre;
                const auto expected = weightOn<double>(s, Kernel::Quartic, at - s.centre,
                                                       at / seen.rays.focal, seen.rayLength);
                const double drawn = w[std::size_t(y) * 40 + x];
                ASSERT_EQ(drawn > 0, expected.value_or(0) > 0) << "trial " << trial;
                ASSERT_NEAR(drawn, expected.value_or(0), 1e-12) << "trial " << trial;
            }
    }
}

// A view in other units than the world's sees the same.
TEST(Truth, TheUnitOfAViewChangesNothing) {
    const std::array cells{axis(7), axis(6, 3, -0.8), axis(5, 0, 1.7)};
    const std::array slim{axis(7), axis(6), axis(3, 0, 6)};
    for (const auto& axes : {cells, slim})
        for (const Footprint footprint :
             {Footprint{}, Footprint{Kernel::Point, 2}, Footprint{Kernel::Quartic, 1.5}}) {
            const World world(tests::stepOf(std::make_shared<Grid>(
                                                axes, timeseries::CoordinateFrame{tests::leaning(
                                                          {1, 0.4, 0}, {0, 1, 0.5}, {0.3, 0, 1})}),
                                            [](std::size_t i) { return double(i); }),
                              RangeSet::everything(), footprint);
            View view = tests::lookFrom({1, -2, 0.7}, {64, 48});
            view.clipFromView = clipFromView({-0.4, 0.5, -0.3, 0.4, 1.1, 50});
            const auto w = weights(world, view);
            view.viewFromWorld = glm::scale(glm::dmat4(1.0), glm::dvec3(3)) * view.viewFromWorld;
            view.clipFromView = clipFromView({-0.4, 0.5, -0.3, 0.4, 3.3, 150});
            const auto scaled = weights(world, view);
            const double most = *std::ranges::max_element(w);
            ASSERT_GT(most, 0);
            for (std::size_t i = 0; i < w.size(); ++i) ASSERT_NEAR(scaled[i], w[i], 1e-9 * most);
        }
}

TEST(Truth, PointsBehindOrNearerThanTheNearPlaneAreNotDrawn) {
    const World world(onePoint());
    View view = tests::lookFrom({0, -1, 0}, {33, 33});
    view.clipFromView = clipFromView({-0.4, 0.4, -0.4, 0.4, 1.5, 100});
    EXPECT_FALSE(splatAt<double>(PointsView(world.placed, view), 0, {}).visible);
    for (const double w : weights(world, view)) EXPECT_EQ(w, 0);
    view = tests::lookFrom({0, 5, 0}, {33, 33});
    view.viewFromWorld =
        glm::rotate(glm::dmat4(1.0), std::numbers::pi, glm::dvec3(0, 1, 0)) * view.viewFromWorld;
    for (const double w : weights(world, view)) EXPECT_EQ(w, 0);
}

TEST(Truth, WeightChangesContinuouslyWhenTheEyeMovesThroughTheNearPlane) {
    // A point splat at 1 puts 15^2 on its pixel, of 15 to a unit of slope.
    for (const auto& [kernel, step] : {std::pair{Kernel::Quartic, 0.02}, {Kernel::Point, 4.5}}) {
        const World world(onePoint(), RangeSet::everything(), {kernel, 1});
        double before = 0, most = 0;
        for (int i = 0; i <= 200; ++i) {
            View view = tests::lookFrom({0, -2.1 + i * 0.006, 0}, {9, 9}, 0.3);
            view.clipFromView = clipFromView({-0.3, 0.3, -0.3, 0.3, 1, 100});
            const double w = weights(world, view)[4 * 9 + 4];
            if (i > 0) {
                EXPECT_LT(std::abs(w - before), step) << i;
            }
            const double depth = 2.1 - i * 0.006, t = std::clamp(depth - 1, 0.0, 1.0);
            if (kernel == Kernel::Point) {
                EXPECT_NEAR(w, 225 / (depth * depth) * (3 * t * t - 2 * t * t * t), 1e-9) << i;
            }
            before = w;
            most = std::max(most, w);
        }
        EXPECT_EQ(before, 0);
        EXPECT_GT(most, 10 * step);
    }
}

TEST(Truth, WhatLiesBehindTheOpaqueSceneIsHidden) {
    const World world(onePoint());
    const View view = tests::lookFrom({0, -5, 0}, {33, 33});
    const auto depthAt = [&](double z) {
        const glm::dvec4 p = view.clipFromView * glm::dvec4(0, 0, -z, 1);
        return std::vector<float>(33 * 33, static_cast<float>(p.z / p.w));
    };
    Accumulator<double> behind(view.size, {Channels::Weight}),
        before(view.size, {Channels::Weight});
    splat(world.scene, Runs{}, view, depthAt(4.9), behind);
    splat(world.scene, Runs{}, view, depthAt(5.1), before);
    EXPECT_EQ(std::accumulate(behind.planes[0].begin(), behind.planes[0].end(), 0.0), 0);
    EXPECT_EQ(before.planes[0], weights(world, view));
}

}  // namespace
}  // namespace render
