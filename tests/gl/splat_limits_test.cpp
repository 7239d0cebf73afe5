// Splats of all sizes, colours of all widths, and pictures as wide as there are: against the truth.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "render/gl/pass.h"
#include "tests/support/sorted.h"
#include "tests/support/splats_and_truth.h"

namespace render {
namespace {

using namespace splats_and_truth;

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

TEST_F(GlSplat, ColourByValueDoesNotSufferFromValuesFarOutsideTheMap) {
    // As files hold them whose fill value is not told, or that hold infinities.
    const auto noise = tests::noise(cube(24));
    std::vector<float> values(noise.size());
    for (std::size_t p = 0; p < values.size(); ++p)
        values[noise.gridIndex()[p]] = static_cast<float>(timeseries::toDouble(noise.value(p)));
    values[5] = -1e34f;
    values[77] = std::numeric_limits<float>::infinity();
    values[99] = -std::numeric_limits<float>::infinity();
    const auto step = tests::sorted({cube(24), values, {}});
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
