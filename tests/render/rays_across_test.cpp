// Cells that are small in a picture, of which a pixel shows the mean of several rays.
#include "render/model/rays_across.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/reference/cells_on_rays.h"
#include "render/reference/sampled_error.h"
#include "render/splat/tile_layout.h"
#include "tests/support/cell_worlds.h"

namespace render {
namespace {

using tests::CellWorld;

CellWorld waves(int edge, const std::vector<std::string>& layers) {
    const auto grid = tests::cube(edge);
    return {tests::stepOf(grid,
                          [&](std::size_t i) {
                              const glm::dvec3 p(grid->indices(i));
                              return std::sin(0.45 * p.x) +
                                     std::cos(0.35 * p.y + 0.15 * p.x) * std::sin(0.4 * p.z);
                          }),
            layers};
}

View viewOf(int pixels) { return tests::lookFrom({1.2, -2.6, 0.9}, {pixels, pixels}); }

TEST(RaysAcross, AreThreeACellWhileEightAPixelSuffice) {
    const CellWorld world = waves(32, {"0.2:0.5"});
    bool isOne = false, isMost = false;
    for (int pixels = 2; pixels < 4000; pixels = pixels * 5 / 4 + 1) {
        const View view = viewOf(pixels);
        const double side = std::sqrt(cellPixels(world.scene, view));
        const int rays = raysAcross(world.scene, view);
        EXPECT_TRUE(rays == 8 || side * rays >= 3) << pixels;
        EXPECT_TRUE(rays == 1 || side * (rays - 1) < 3) << pixels;
        isOne = isOne || rays == 1;
        isMost = isMost || rays == 8;
    }
    EXPECT_TRUE(isOne && isMost);
}

TEST(RaysAcross, OfACoarsePixelAreThoseOfOneOfThePicture) {
    const CellWorld world = waves(32, {"0.2:0.5"});
    bool areSeveral = false;
    for (const int pixels : {17, 101, 333, 1000})
        for (const int across : {2, 3}) {
            const View view = viewOf(pixels), coarse = coarser(view, across);
            EXPECT_EQ(raysAcross(world.scene, coarse), raysAcross(world.scene, view)) << pixels;
            EXPECT_EQ(raysAcross(world.scene, coarser(coarse, 2)), raysAcross(world.scene, view));
            areSeveral = areSeveral || raysAcross(world.scene, view) > 1;
        }
    EXPECT_TRUE(areSeveral);
}

// Seen along an axis, a cube of the unit length in the box's middle is a square of so many pixels.
TEST(RaysAcross, ACellsPixelsAreThoseOfItsSquare) {
    const CellWorld world = waves(11, {"0.2:0.5"});
    const View view = tests::lookFrom({0, -5, 0}, {200, 200});
    const double half = world.placed.unitLength() / 2;
    const auto windowAt = [&](double x) {
        const glm::dvec4 clip = view.clipFromView * view.viewFromWorld * glm::dvec4(x, 0, 0, 1);
        return 100 * (clip.x / clip.w + 1);
    };
    const double side = windowAt(half) - windowAt(-half);
    EXPECT_NEAR(cellPixels(world.scene, view), side * side, 1e-6 * side * side);
}

// The finer picture's rays are pixels of their own.
TEST(RaysAcross, APixelIsTheMeanOfItsRays) {
    const CellWorld unordered = waves(24, {"0.2:0.5", "-0.6:-0.5"});
    CellWorld ordered = waves(24, {"0.2:0.5", "-0.6:-0.5"});
    ordered.scene.order = Order::BackToFront;
    const View view = viewOf(37);
    for (const int rays : {2, 3, 5, 7, 8})
        for (const Channels channels :
             {Channels::Weight, Channels::WeightedColor, Channels::Over, Channels::Count}) {
            const Scene& scene = channels == Channels::Over ? ordered.scene : unordered.scene;
            // What is opaque cuts the left half's rays.
            const View fine = finer(view, rays);
            const auto opaque = [&](const View& of) {
                std::vector<float> depth;
                for (int y = 0; y < of.size.y; ++y)
                    for (int x = 0; x < of.size.x; ++x)
                        depth.push_back(x / (of.size.x / view.size.x) < 18 ? 0.96f : 1.0f);
                return depth;
            };
            const std::vector<float> seen =
                tests::drawn(scene, view, channels, 0, 2, tests::kAllCells, opaque(view), rays);
            const std::vector<float> each =
                tests::drawn(scene, fine, channels, 0, 2, tests::kAllCells, opaque(fine));
            const std::size_t floats = floatsPerPixel(channels);
            std::vector<double> means(seen.size());
            double most = 0;
            for (std::size_t i = 0; i < each.size(); ++i) {
                const std::size_t x = i / floats % std::size_t(fine.size.x) / std::size_t(rays);
                const std::size_t y = i / floats / std::size_t(fine.size.x) / std::size_t(rays);
                double& mean = means[(y * std::size_t(view.size.x) + x) * floats + i % floats];
                mean += static_cast<double>(each[i]) / (rays * rays);
                most = std::max(most, mean);
            }
            ASSERT_GT(most, 0.05);
            for (std::size_t i = 0; i < seen.size(); ++i)
                ASSERT_NEAR(seen[i], means[i], 1e-5 * most)
                    << rays << " rays, channels " << static_cast<int>(channels) << ", " << i;
            // In slices, by other threads.
            EXPECT_EQ(tests::drawn(scene, view, channels, 0, 5, 100, opaque(view), rays), seen);
        }
}

TEST(RaysAcross, PixelsThatAreAskedHaveWhatIsSummedForAll) {
    const CellWorld world = waves(24, {"0.2:0.5"});
    const View view = viewOf(20);
    std::vector<glm::ivec2> pixels;
    for (int y = 0; y < view.size.y; ++y)
        for (int x = 0; x < view.size.x; ++x) pixels.emplace_back(x, y);
    const std::vector<double> depth = cellDepthAt(world.scene, view, pixels, 4, 2);
    const std::vector<float> sums =
        tests::drawn(world.scene, view, Channels::Weight, 0, 2, tests::kAllCells, {}, 4);
    const double perWeight = opticalDepthPerWeight(world.scene.layers[0].style.opacity);
    double most = 0;
    for (const double d : depth) most = std::max(most, d);
    ASSERT_GT(most, 0.1);
    for (std::size_t i = 0; i < depth.size(); ++i)
        ASSERT_NEAR(depth[i], perWeight * static_cast<double>(sums[i]), 1e-4 * most);
}

// Cells of half a pixel and less, of which kMostRaysAcross leave two rays on a side of a cell, then
// one; and a thin range: a fifth of the step between neighbours, root mean square, for which 0.12
// is asked.
TEST(RaysAcross, CellsBelowAPixelAreTrue) {
    struct Case {
        int edge, pixels;
        double side;          // of a cell in pixels, at most
        int raysOfTruth;      // four a cell at least
        double most, better;  // the error, and how many times less than that of one ray
    };
    for (const Case& each : {Case{40, 36, 0.5, 24, 0.05, 5}, Case{57, 29, 0.25, 24, 0.12, 3},
                             Case{81, 20, 0.125, 32, 0.12, 3}}) {
        SCOPED_TRACE(testing::Message() << "cells of " << each.side << " pixels");
        const CellWorld world = waves(each.edge, {"0.2:0.25"});
        const View view = viewOf(each.pixels);
        ASSERT_LT(std::sqrt(cellPixels(world.scene, view)), each.side);
        const auto pictureBy = [&](int rays) -> DepthAt {
            return [&, rays](std::span<const glm::ivec2> pixels) {
                return cellDepthAt(world.scene, view, pixels, rays);
            };
        };
        const DepthAt picture = pictureBy(raysAcross(world.scene, view));
        SampledTruth truth(world.scene, view, picture, {.raysAcross = each.raysOfTruth});
        for (const auto rays : {SampledTruth::Rays::Quarter, SampledTruth::Rays::Rest})
            truth.add(world.scene.cells->field(), rays);
        const auto errorOf = [&](const DepthAt& of) {
            return truth.apart(of(truth.pixels()), truth.depth());
        };
        const double error = errorOf(picture);
        EXPECT_LT(error, each.most);
        EXPECT_LT(each.better * error, errorOf(pictureBy(1)));
    }
}

}  // namespace
}  // namespace render
