// The GL splatter, and the rows that stand in for it on the processor, against the truth: the same
// model in double.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numeric>

#include "render/gl/pass.h"
#include "render/reference/cpu_splatter.h"
#include "render/reference/exact_order.h"
#include "render/reference/image_compare.h"
#include "render/splat/depth_order.h"
#include "render/splat/row_splatter.h"
#include "render/splat/tile_splatter.h"
#include "tests/support/gl_planes.h"

namespace render {
namespace {

using tests::cube;
using tests::lookFrom;
using timeseries::RangeSet;

class GlSplat : public tests::GlTest {};

Scene noiseScene(const timeseries::SortedStep& step, const PlacedPoints& placed, const char* range,
                 RangeStyle style = {Constant{glm::dvec3(1)}, 0.5}) {
    return {.step = step,
            .placed = placed,
            .layers = {{step.select(RangeSet::parse(range)), style}},
            .footprint = {},
            .order = Order::None,
            .clip = {}};
}

std::vector<double> truth(const Scene& scene, const View& view, Channels channels,
                          std::span<const float> opaqueDepth = {}) {
    // Of the first layer, as GlTest::plane, where every layer has its own.
    const bool alone = channels == Channels::Over || channels == Channels::Count;
    Accumulator<double> sums(view.size, std::vector(alone ? 1 : scene.layers.size(), channels));
    splat(scene, orderExactly(scene, tests::kMidEye), view, opaqueDepth, sums);
    return sums.planes[0];
}

// Of a plane, nothing opaque before it.
std::vector<float> onProcessor(const Scene& scene, const View& view, Channels channels) {
    const DrawList list = order(scene, tests::kMidEye);
    if (TileSum::canSum(scene, channels)) return sumTiles(scene, list, view, channels, 0, {});
    return sumRows(scene, list, view, channels, 0, {});
}

// relative L2 of a plane drawn on GL, or summed on the processor where that is worse.
double error(tests::GlTest& gl, const Scene& scene, const View& view, Channels channels) {
    const auto expected = truth(scene, view, channels);
    const double drawn = compareScalars(gl.plane(scene, view, channels), expected).relativeL2;
    const double summed = compareScalars(onProcessor(scene, view, channels), expected).relativeL2;
    return summed > drawn || std::isnan(summed) ? summed : drawn;
}

constexpr double kTarget = 1e-5;

TEST_F(GlSplat, OpticalDepthIsTheTruthsToOnePartIn100000) {
    const auto step = tests::noise(cube(32));
    const PlacedPoints placed(step.grid());
    const Scene scene = noiseScene(step, placed, "0.3:0.6");
    // From outside with point sprites; from inside and from a corner with quads.
    for (const glm::dvec3 eye : {glm::dvec3(0, -3, 0), glm::dvec3(2, -2, 1),
                                 glm::dvec3(0.2, 0.1, 0.3), glm::dvec3(0.5, 0.5, 0.52)})
        EXPECT_LE(error(*this, scene, lookFrom(eye, {320, 320}), Channels::Weight), kTarget)
            << "eye " << eye.x << ' ' << eye.y << ' ' << eye.z;
}

TEST_F(GlSplat, UnequalAndUnevenCellsAreTheTruths) {
    timeseries::Axis uneven = tests::axis(12, 0, 1);
    for (double& x : uneven.coordinates) x = std::exp(0.4 * x);
    const auto grid = std::make_shared<timeseries::Grid>(
        std::array{tests::axis(30, 5, -0.2), tests::axis(20, 0, 0.7), uneven});
    const auto step = tests::noise(grid);
    const PlacedPoints placed(*grid);
    const Scene scene = noiseScene(step, placed, "0.2:0.4");
    for (const glm::dvec3 eye : {glm::dvec3(0, -3, 0.4), glm::dvec3(0.3, -0.2, 2.5)})
        EXPECT_LE(error(*this, scene, lookFrom(eye, {400, 300}), Channels::Weight), kTarget);
}

TEST_F(GlSplat, FlatCellsBesideTheEyeAreTheTruths) {
    // Far beside them the footprint's denominator is 0 to float rounding: of these eyes, to its
    // wrong side.
    const auto grid = std::make_shared<timeseries::Grid>(
        std::array{tests::axis(8), tests::axis(8), tests::axis(8, 0, 0.001)});
    const auto step = tests::noise(grid);
    const PlacedPoints placed(*grid, glm::dvec3(1));
    const Scene scene = noiseScene(step, placed, "0:1");
    for (const glm::dvec3 eye : {glm::dvec3(0.42, -0.3, 0.37), glm::dvec3(-0.43, -0.07, 0.2),
                                 glm::dvec3(-0.13, 0.23, 0.13)})
        EXPECT_LE(error(*this, scene, lookFrom(eye, {97, 61}, 1), Channels::Weight), kTarget)
            << eye.x;
}

TEST_F(GlSplat, TurnedAndShearedCellsAreTheTruths) {
    const std::array cubic{tests::axis(20), tests::axis(20), tests::axis(20)};
    const std::array unequal{tests::axis(24, 5, -0.2), tests::axis(16, 0, 0.7),
                             tests::axis(12, 0, 0.4)};
    const glm::dmat3 mirrored = tests::leaning({-1, 0.2, 0}, {0.4, 1, 0.3}, {-0.5, 0.3, 1});
    const glm::dmat3 flat = tests::leaning({1, 0, 0}, {1, 0.2, 0}, {0.3, 0.1, 1});
    for (const timeseries::Grid& grid :
         {timeseries::Grid(cubic, {tests::rotation(0.9)}), timeseries::Grid(cubic, {mirrored}),
          timeseries::Grid(unequal, {tests::rotation(2.2)}), timeseries::Grid(unequal, {flat})}) {
        const auto step = tests::noise(std::make_shared<timeseries::Grid>(grid));
        const PlacedPoints placed(grid);
        Scene scene = noiseScene(step, placed, "0.2:0.4", {ByValue{{}, 0.2, 0.4}, 0.3});
        const double volume = glm::determinant(placed.worldFromAxes());
        // Sprites, quads, and cells below a pixel.
        for (const glm::dvec3& eye :
             {glm::dvec3(0, -3, 0.4), glm::dvec3(0.3, -0.2, 0.1), glm::dvec3(200, -300, 150)}) {
            const View view = lookFrom(eye, {200, 160}, glm::length(eye) > 10 ? 0.02 : 0.4);
            EXPECT_LE(error(*this, scene, view, Channels::Weight), kTarget)
                << volume << ' ' << eye.x;
        }
        const View view = lookFrom(tests::kMidEye, {200, 200});
        scene.order = Order::BackToFront;
        Accumulator<double> inThatOrder(view.size, {Channels::Over});
        splat(scene, order(scene, tests::kMidEye), view, {}, inThatOrder);
        EXPECT_LE(
            compareScalars(plane(scene, view, Channels::Over), inThatOrder.planes[0]).relativeL2,
            kTarget)
            << volume;
        scene.order = Order::None;
        scene.footprint = {Kernel::Point, 3};
        const auto drawn = plane(scene, view, Channels::Weight);
        const auto expected = truth(scene, view, Channels::Weight);
        const double total = std::accumulate(expected.begin(), expected.end(), 0.0);
        EXPECT_NEAR(std::accumulate(drawn.begin(), drawn.end(), 0.0), total, 1e-5 * total)
            << volume;
    }
}

TEST_F(GlSplat, AsymmetricAndWideFrustaAreTheTruths) {
    const auto step = tests::noise(cube(24));
    const PlacedPoints placed(step.grid());
    const Scene scene = noiseScene(step, placed, "0.3:0.6");
    View view = lookFrom({0, -1.3, 0}, {500, 400});
    view.clipFromView = clipFromView({-1.4, 0.3, -0.2, 1.1, 0.05, 50});
    EXPECT_LE(error(*this, scene, view, Channels::Weight), kTarget);
}

TEST_F(GlSplat, ASplatSlidingOutOfThePictureNeverVanishesWhole) {
    // The centre leaves the clip volume while its footprint still shows.
    auto grid = std::make_shared<timeseries::Grid>(
        std::array{tests::axis(1), tests::axis(1), tests::axis(1)});
    const auto step = tests::stepOf(grid, [](std::size_t) { return 0.5; });
    const PlacedPoints placed(*grid);
    const Scene scene = noiseScene(step, placed, "0:1");
    for (double x = 1.0; x < 4.0; x += 0.25) {
        View view = lookFrom({0, -6, 0}, {128, 128});
        view.viewFromWorld[3].x = x;
        EXPECT_LE(error(*this, scene, view, Channels::Weight), kTarget) << "moved by " << x;
    }
}

TEST_F(GlSplat, PicturesAsWideAsTheDriverAllowsAreTheTruths) {
    // There is no room left for a viewport wider than the picture.
    std::array<GLint, 2> largest{};
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, largest.data());
    GLint texture = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
    const auto step = tests::noise(cube(7));  // odd: a plane of points is seen edge on
    const PlacedPoints placed(step.grid());
    Scene scene = noiseScene(step, placed, "0:1");
    scene.footprint.size = 0.02;  // small enough for point sprites
    const View view = lookFrom({0, -3, 0}, {std::min(largest[0], texture), 8}, 0.4 / 2048);
    const auto drawn = plane(scene, view, Channels::Weight);
    EXPECT_GT(*std::ranges::max_element(drawn), 0) << "or nothing was compared";
    EXPECT_LE(error(*this, scene, view, Channels::Weight), kTarget) << largest[0] << ' ' << texture;
}

TEST_F(GlSplat, SizesFarAboveAndBelowAPixelAreTheTruths) {
    const auto step = tests::noise(cube(10));
    const PlacedPoints placed(step.grid());
    Scene scene = noiseScene(step, placed, "0.3:0.6");
    for (const double size : {0.05, 0.5, 3.0, 20.0}) {
        scene.footprint.size = size;
        EXPECT_LE(error(*this, scene, lookFrom({0, -3, 0.3}, {256, 256}), Channels::Weight),
                  kTarget)
            << "size " << size;
    }
    scene.footprint.size = 1;
    EXPECT_LE(error(*this, scene, lookFrom({0, -900, 0}, {256, 256}, 0.3), Channels::Weight),
              kTarget)
        << "sub-pixel cells";
}

TEST_F(GlSplat, PointSplatsAreTheTruthsOnNearlyEveryPixel) {
    // A point within float rounding of a pixel's border may fall to either side: the totals agree,
    // and few pixels differ. The picture holds every point.
    const auto step = tests::noise(cube(24));
    const PlacedPoints placed(step.grid());
    Scene scene = noiseScene(step, placed, "0.3:0.6");
    scene.footprint.kernel = Kernel::Point;
    const View view = lookFrom({1, -4, 1}, {300, 300});
    for (const double size : {1.0, 2.0, 3.0, 300.0}) {
        scene.footprint.size = size;
        const auto expected = truth(scene, view, Channels::Weight);
        for (const auto& drawn :
             {plane(scene, view, Channels::Weight), onProcessor(scene, view, Channels::Weight)}) {
            double drawnSum = 0, expectedSum = 0;
            std::size_t differing = 0;
            for (std::size_t i = 0; i < drawn.size(); ++i) {
                const auto w = static_cast<double>(drawn[i]);
                drawnSum += w;
                expectedSum += expected[i];
                differing += std::abs(w - expected[i]) > 1e-4 * (w + expected[i]);
            }
            EXPECT_NEAR(drawnSum, expectedSum, 1e-5 * expectedSum) << "size " << size;
            EXPECT_LE(differing, drawn.size() / 100) << "size " << size;
        }
    }
}

TEST_F(GlSplat, ColourByValueIsTheTruths) {
    const auto step = tests::noise(cube(24));
    const PlacedPoints placed(step.grid());
    const View view = lookFrom({1, -3, 1}, {300, 300});
    // Map ends inside, outside and equal.
    for (const auto& [lo, hi] : {std::pair(0.3, 0.6), std::pair(-1.0, 4.0), std::pair(0.5, 0.5)}) {
        const Scene scene = noiseScene(step, placed, "0.3:0.6", {ByValue{{}, lo, hi}, 0.5});
        EXPECT_LE(error(*this, scene, view, Channels::WeightedColor), kTarget) << lo << ' ' << hi;
    }
}

TEST_F(GlSplat, ColourByValueDoesNotSufferFromValuesFarOutsideTheMap) {
    // As files hold them whose fill value is not told, or that hold infinities.
    const auto noise = tests::noise(cube(24));
    std::vector<float> values(noise.size());
    for (std::size_t p = 0; p < values.size(); ++p)
        values[noise.gridIndex()[p]] = static_cast<float>(timeseries::toDouble(noise.value(p)));
    values[5] = -1e34f;
    values[77] = std::numeric_limits<float>::infinity();
    values[99] = -std::numeric_limits<float>::infinity();
    const auto step = timeseries::SortedStep::build({cube(24), values, {}});
    const PlacedPoints placed(step.grid());
    const View view = lookFrom({1, -3, 1}, {300, 300});
    for (const auto& [lo, hi] : {std::pair(0.3, 0.6), std::pair(-1e34, 1.0)}) {
        const Scene scene = noiseScene(step, placed, "min:max", {ByValue{{}, lo, hi}, 0.5});
        EXPECT_LE(error(*this, scene, view, Channels::WeightedColor), kTarget) << lo << ' ' << hi;
    }
    // Two maps of very unlike width, each with its own layer.
    Scene scene = noiseScene(step, placed, "0.3:0.6", {ByValue{{}, 0.3, 0.6}, 0.5});
    scene.layers.push_back(
        {step.select(RangeSet::parse("min:0.2")), {ByValue{{}, -1e34, 0.2}, 0.5}});
    EXPECT_LE(error(*this, scene, view, Channels::WeightedColor), kTarget);
    scene.order = Order::BackToFront;
    EXPECT_LE(error(*this, scene, view, Channels::Over), 1e-4);
}

TEST_F(GlSplat, OrderedOverIsTheTruthsToTheOrdersResolution) {
    const auto step = tests::noise(cube(24));
    const PlacedPoints placed(step.grid());
    Scene scene = noiseScene(step, placed, "0.1:0.6", {ByValue{{}, 0.1, 0.6}, 0.3});
    scene.layers.push_back({step.select(RangeSet::parse("0.8:0.9")), {Constant{{1, 0, 0}}, 0.9}});
    scene.order = Order::BackToFront;
    for (const glm::dvec3 eye : {tests::kMidEye, glm::dvec3(0.03, -3, 0.02)}) {
        // The second eye stands beside the point that the order was made for.
        const View view = lookFrom(eye, {300, 300});
        EXPECT_LE(error(*this, scene, view, Channels::Over), 1e-4);
    }
}

TEST_F(GlSplat, OpacitiesOfATenMillionthAndOfOneAreTheTruths) {
    const auto step = tests::noise(cube(24));
    const PlacedPoints placed(step.grid());
    Scene scene = noiseScene(step, placed, "0:1");
    scene.order = Order::BackToFront;
    for (const double opacity : {1e-7, 1.0}) {
        scene.layers[0].style = {ByValue{{}, 0, 1}, opacity};
        EXPECT_LE(error(*this, scene, lookFrom({0, -3, 0}, {200, 160}), Channels::Over), 1e-4)
            << opacity;
    }
}

TEST_F(GlSplat, CountsEveryFootprintThatTouchesAPixel) {
    const auto step = tests::noise(cube(16));
    const PlacedPoints placed(step.grid());
    const Scene scene = noiseScene(step, placed, "0.3:0.6");
    const View view = lookFrom({1, -3, 1}, {200, 200});
    const auto drawn = plane(scene, view, Channels::Count);
    const auto expected = truth(scene, view, Channels::Count);
    // A pixel on a footprint's very border may fall to either side in float.
    std::size_t differing = 0;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        ASSERT_LE(std::abs(static_cast<double>(drawn[i]) - expected[i]), 1) << i;
        differing += static_cast<double>(drawn[i]) != expected[i];
    }
    EXPECT_LE(differing, drawn.size() / 1000);
}

TEST_F(GlSplat, ClippedPointsAreNotDrawn) {
    const auto step = tests::noise(cube(20));
    const PlacedPoints placed(step.grid());
    Scene scene = noiseScene(step, placed, "0:1");
    scene.clip = indexBox(step.grid(), {3, 5, 2}, {9, 19, 8.5});
    EXPECT_LE(error(*this, scene, lookFrom({1, -3, 1}, {256, 256}), Channels::Weight), kTarget);
}

TEST_F(GlSplat, TheOpaqueSceneHidesWhatLiesBehindIt) {
    const auto step = tests::noise(cube(20));
    const PlacedPoints placed(step.grid());
    const Scene scene = noiseScene(step, placed, "0:1");
    const View view = lookFrom({0, -3, 0}, {128, 128});
    // A wall through the points, at a depth that no point has exactly.
    const glm::dvec4 wall = view.clipFromView * glm::dvec4(0, 0, -3.01, 1);
    const auto depth = static_cast<float>(wall.z / wall.w);
    const auto drawn = plane(scene, view, Channels::Weight, depth);
    const auto expected =
        truth(scene, view, Channels::Weight, std::vector<float>(128 * 128, depth));
    EXPECT_LE(compareScalars(drawn, expected).relativeL2, kTarget);
    EXPECT_LT(compareScalars(drawn, truth(scene, view, Channels::Weight)).relativeL2, 1);
    EXPECT_GT(compareScalars(drawn, truth(scene, view, Channels::Weight)).relativeL2, 0.1);
}

TEST_F(GlSplat, OffsetOfTheCoordinatesDoesNotChangeABit) {
    const auto near = tests::noise(cube(16));
    const double h = 1.0 / 1024;
    const auto far = tests::noise(std::make_shared<timeseries::Grid>(
        std::array{tests::axis(16, 1e7, h), tests::axis(16, -1e7, h), tests::axis(16, 3e6, h)}));
    const PlacedPoints nearPoints(near.grid()), farPoints(far.grid());
    const View view = lookFrom({1, -3, 1}, {200, 200});
    const auto a = plane(noiseScene(near, nearPoints, "0.3:0.6"), view, Channels::Weight);
    const auto b = plane(noiseScene(far, farPoints, "0.3:0.6"), view, Channels::Weight);
    EXPECT_LE(compareScalars(b, a).relativeL2, 1e-6);
}

TEST_F(GlSplat, ASubsetIsTheTruthsSubset) {
    // A third run shorter than the largest stride.
    const auto step = tests::noise(cube(16));
    const PlacedPoints placed(step.grid());
    Scene scene =
        noiseScene(step, placed, "0.1:0.2,0.3:0.45,0.5:0.501", {ByValue{{}, 0.1, 0.5}, 0.3});
    for (const std::uint32_t stride : {2u, 8u, kMaxStride}) {
        scene.stride = stride;
        for (const glm::dvec3 eye : {glm::dvec3(1, -3, 1), glm::dvec3(0.2, 0.1, 0.3)}) {
            const View view = lookFrom(eye, {160, 160});
            scene.order = Order::None;
            for (const Channels channels : {Channels::Weight, Channels::WeightedColor})
                EXPECT_LE(error(*this, scene, view, channels), kTarget) << stride << ' ' << eye.x;
            scene.order = Order::BackToFront;
            // Heavier splats: two that lie within one key of the order count for more.
            EXPECT_LE(error(*this, scene, view, Channels::Over), 1e-3) << stride << ' ' << eye.x;
        }
        // A splat's border is within float rounding of some pixels' centres.
        scene.order = Order::None;
        const View view = lookFrom({1, -3, 1}, {160, 160});
        EXPECT_LE(error(*this, scene, view, Channels::Count), 5e-3) << stride;
    }
}

TEST_F(GlSplat, ValuesOnAServingScaleDrawTheSameColours) {
    const auto step = tests::noise(cube(24));
    const PlacedPoints placed(step.grid());
    const View view = lookFrom({1, -3, 1}, {200, 200});
    // As wide and as far as serves() allows: 1024 half widths of the map together.
    const Scene scene = noiseScene(step, placed, "0.4:0.41", {ByValue{{}, 0.4, 0.41}, 0.5});
    const ValueScale wanted = *neededScale(scene);
    const ValueScale far{0.4 + 2 * 600 * wanted.halfWidth, 420 * wanted.halfWidth};
    ASSERT_TRUE(far.serves(wanted));
    ASSERT_FALSE((ValueScale{far.lo, 430 * wanted.halfWidth}.serves(wanted)));
    const auto drawn = [&](const ValueScale& scale) {
        GlTargets targets(view.size);
        gl::begin(
            {.framebuffer = targets.lightFramebuffer(), .size = view.size, .clearDepth = 1.0f});
        GlStep onGpu(step, placed);
        onGpu.upload(scene, scale);
        GlSplatter splatter;
        const auto list = splatter.upload(scene, Runs{}, onGpu);
        splatter.draw(*list, view, Channels::WeightedColor, 0,
                      targets.clearedPlane(0, Channels::WeightedColor));
        std::vector<float> pixels(std::size_t(200) * 200 * 4);
        glGetTextureSubImage(targets.plane(0).id(), 0, 0, 0, 0, 200, 200, 1, GL_RGBA, GL_FLOAT,
                             static_cast<GLsizei>(pixels.size() * sizeof(float)), pixels.data());
        return pixels;
    };
    EXPECT_LE(compareScalars(drawn(far), drawn(wanted)).relativeL2, 1e-3);
}

TEST_F(GlSplat, AnEmptySelectionDrawsNothing) {
    const auto step = tests::noise(cube(8));
    const PlacedPoints placed(step.grid());
    Scene scene = noiseScene(step, placed, "5:6");
    for (const Order order : {Order::None, Order::BackToFront}) {
        scene.order = order;
        const Channels channels = order == Order::None ? Channels::Weight : Channels::Over;
        for (const float w : plane(scene, lookFrom({0, -3, 0}, {32, 32}), channels))
            EXPECT_EQ(w, 0);
    }
}

}  // namespace
}  // namespace render
