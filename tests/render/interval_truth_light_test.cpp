// The continuous truth of interval volumes: its light, and fields at the extremes.
#include "render/reference/interval_truth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/true_world.h"

namespace render {
namespace {

using namespace true_world;

TEST(IntervalTruth, AFieldOfNothingButMissingValuesIsEmpty) {
    const TrueWorld world(fieldOn(tests::cube(3), [](const glm::uvec3&) { return kNan; }),
                          {{{-kInfinity, kInfinity}}});
    const View view = tests::lookFrom(kFrom[0], kSize);
    EXPECT_THAT(world.weight(view), testing::Each(0));
    EXPECT_THAT(IntervalTruth(world.scene, world.field, 1, 2).light(view),
                testing::Each(glm::dvec4(0)));
}

// A slab's ends scale with the values, whatever their size.
template <typename T>
void expectScales(double unit, double lo, double hi) {
    const TrueWorld plain(
        fieldOn(tests::cube(5), [](const glm::uvec3& p) { return double(p.x) - 2; }), {{{lo, hi}}});
    const TrueWorld scaled(
        fieldOn<T>(tests::cube(5), [&](const glm::uvec3& p) { return unit * (double(p.x) - 2); }),
        {{{unit * lo, unit * hi}}});
    const View view = tests::lookFrom(kFrom[0], kSize);
    const std::vector<double> wanted = plain.weight(view), is = scaled.weight(view);
    EXPECT_GT(*std::ranges::max_element(wanted), 0.5);
    for (std::size_t i = 0; i < wanted.size(); ++i)
        ASSERT_NEAR(is[i], wanted[i], 1e-9) << unit << ", pixel " << i;
}

TEST(IntervalTruth, HugeAndTinyValuesAreValuesLikeOthers) {
    for (const double unit : {1e300, 8e307, 1e-300, 0x1p-1060})
        expectScales<double>(unit, -0.75, 1.5);
    for (const double unit : {0x1p100, 0x1p-149, 0x1p-140}) expectScales<float>(unit, -1, 1);
}

// Both ends of doubles in one cell: their difference is more than the greatest double.
TEST(IntervalTruth, CellsThatSpanAllDoublesHaveTheirMiddle) {
    constexpr double kMost = std::numeric_limits<double>::max();
    const TrueWorld world(
        fieldOn(tests::cube(2), [](const glm::uvec3& p) { return p.x == 0 ? -kMost : kMost; }),
        {{{0, kMost}}});
    const View view = tests::lookFrom(kFrom[0], kSize);
    const auto domain = world.placed.domain();
    expectOfRays(world, view, world.weight(view), [&](const Ray& ray) {
        return pathThrough(ray, {0, domain.lo.y, domain.lo.z}, domain.hi);
    });
}

// A pixel is the mean of its rays.
TEST(IntervalTruth, APixelIsTheMeanOfItsRays) {
    const TrueWorld world(fieldOn(tests::cube(4), [](const glm::uvec3&) { return 1.0; }),
                          {{{0, 2}}});
    const View view = tests::lookFrom(kFrom[0], {7, 5});
    const std::vector<double> is = world.weight(view, 0, 3);
    const auto domain = world.placed.domain();
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 7; ++x) {
            double sum = 0;
            for (const double j : {1.0 / 6, 0.5, 5.0 / 6})
                for (const double i : {1.0 / 6, 0.5, 5.0 / 6})
                    sum += pathThrough(rayOf(world, view, x + i, y + j), domain.lo, domain.hi);
            ASSERT_NEAR(is[std::size_t(y * 7 + x)], sum / 9, 1e-9);
        }
}

TEST(IntervalTruth, IsTheSameForAnyThreads) {
    const TrueWorld world(
        fieldOn(unevenGrid(), [](const glm::uvec3& p) { return std::sin(3.0 * p.x + 5.0 * p.y); }),
        {{{-0.5, 0.2}}});
    const View view = tests::lookFrom(kFrom[1], kSize);
    const auto with = [&](unsigned threads) {
        return IntervalTruth(world.scene, world.field, 2, threads);
    };
    EXPECT_EQ(with(1).weight(view, 0), with(3).weight(view, 0));
    EXPECT_EQ(with(1).light(view), with(3).light(view));
}

// One colour: what is taken of the light behind is 1 - e^-tau.
TEST(IntervalTruth, LightOfOneColourIsAbsorbedByItsOpticalDepth) {
    TrueWorld world(fieldOn(tests::cube(5), [](const glm::uvec3& p) { return double(p.x); }),
                    {{{0.5, 2.2}}});
    world.scene.layers[0].style = {Constant{glm::dvec3(0.2, 0.5, 0.9)}, 0.4};
    const View view = tests::lookFrom(kFrom[0], kSize);
    const std::vector<double> w = world.weight(view);
    const auto light = IntervalTruth(world.scene, world.field, 1, 2).light(view);
    for (std::size_t i = 0; i < w.size(); ++i) {
        const double alpha = 1 - std::pow(1 - 0.4, w[i]);
        ASSERT_NEAR(light[i].a, alpha, 1e-9);
        ASSERT_NEAR(light[i].r, 0.2 * alpha, 1e-9);
        ASSERT_NEAR(light[i].b, 0.9 * alpha, 1e-9);
    }
}

// From +x: the blue slab stands before the red one. Where both are, they share what is taken by
// their optical depths.
TEST(IntervalTruth, LightComesFromWhatIsInFront) {
    TrueWorld world(fieldOn(tests::cube(5), [](const glm::uvec3& p) { return double(p.x); }),
                    {{{0.5, 1.5}}, {{2.5, 3.5}}, {{2.5, 3.5}}});
    world.scene.layers[0].style = {Constant{glm::dvec3(1, 0, 0)}, 0.6};
    world.scene.layers[1].style = {Constant{glm::dvec3(0, 0, 1)}, 0.3};
    world.scene.layers[2].style = {Constant{glm::dvec3(0, 1, 0)}, 0.3};
    const View view = tests::lookFrom({3, 1e-3, 2e-3}, {3, 3}, 0.001);
    const glm::dvec4 light = IntervalTruth(world.scene, world.field, 1, 2).light(view)[4];
    const double front = 1 - 0.7 * 0.7;  // each slab is l thick
    EXPECT_NEAR(light.b, front / 2, 1e-5);
    EXPECT_NEAR(light.g, front / 2, 1e-5);
    EXPECT_NEAR(light.r, (1 - front) * 0.6, 1e-5);
    EXPECT_NEAR(light.a, 1 - (1 - front) * 0.4, 1e-5);
}

}  // namespace
}  // namespace render
