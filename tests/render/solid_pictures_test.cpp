// Pictures of cells of unstructured grids whose points have the values, against closed forms and
// against what each ray passes.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "render/reference/cell_pick.h"
#include "render/reference/cells_on_rays.h"
#include "render/reference/interval_truth.h"
#include "render/reference/tets_on_pixels.h"
#include "tests/support/bent_grids.h"
#include "tests/support/cell_rays.h"

namespace render {
namespace solid_pictures {
namespace {

using tests::CellWorld;
using tests::drawn;
using tests::stepOfPlaces;
using tests::cells::inside;
using tests::cells::kFrom;
using tests::cells::kNan;
using tests::cells::Ray;
using tests::cells::rayOf;

// A linear field is so between the corners of any cell: a range of it is a slab of the box, as deep
// as a ray's way through that.
TEST(SolidPictures, ARangeOfALinearFieldIsASlab) {
    for (const auto& grid : tests::bentSolids())
        for (const auto& [lo, hi] :
             {std::pair(-1.0, 9.0), std::pair(1.1, 2.7), std::pair(1.9, 2.0)}) {
            const CellWorld world(stepOfPlaces(grid, [](const auto& p) { return p.x; }),
                                  {std::to_string(lo) + ":" + std::to_string(hi)});
            PlacedPoints::Box box = world.placed.pointsBox();
            box.lo.x = world.placed.axesFromGrid({std::max(lo, 0.0), 0, 0}).x;
            box.hi.x = world.placed.axesFromGrid({std::min(hi, 4.0), 0, 0}).x;
            for (const glm::dvec3& from : kFrom) {
                const View view = tests::lookFrom(from, {80, 60}, 0.1);
                const std::vector<float> w = drawn(world.scene, view);
                double off = 0, all = 0;
                for (int y = 0; y < 60; ++y)
                    for (int x = 0; x < 80; ++x) {
                        const Ray ray = rayOf(world, view, {x + 0.5, y + 0.5});
                        const auto [enters, leaves] = inside(ray, box);
                        const double way =
                            std::max(leaves - enters, 0.0) * ray.length / world.placed.unitLength();
                        const double d = double(w[std::size_t(y) * 80 + std::size_t(x)]) - way;
                        off += d * d;
                        all += way * way;
                    }
                // Ends of a range are ramps, a pixel wide.
                EXPECT_LE(std::sqrt(off / all), 2e-2) << lo << " to " << hi << " from " << from.x
                                                      << " of " << grid->mesh()->solids()->count();
            }
        }
}

// Also where tiles close, behind which nothing is looked at any more: when that is known depends on
// slices.
TEST(SolidPictures, PicturesAreTheSameForAnyThreadsAndSlices) {
    for (const auto& grid : tests::bentMeshes()) {
        CellWorld world(tests::noise(grid), {"0:1"}, 1 - 1e-9);
        world.scene.layers[0].style.color = ByValue{{}, 0, 1};
        world.scene.order = Order::BackToFront;
        for (const glm::dvec3& from : kFrom) {
            const View view = tests::lookFrom(from, {150, 20}, 0.03);
            const auto once = drawn(world.scene, view, Channels::Over, 0, 1);
            std::size_t opaque = 0;
            for (std::size_t i = 3; i < once.size(); i += 4) opaque += once[i] == 1;
            EXPECT_GT(opaque, 2000u) << "or no tile closes";
            EXPECT_EQ(once, drawn(world.scene, view, Channels::Over, 0, 5));
            EXPECT_EQ(once, drawn(world.scene, view, Channels::Over, 0, 3, 1));
            EXPECT_EQ(once, drawn(world.scene, view, Channels::Over, 0, 2, 7));
        }
    }
}

TEST(SolidPictures, AnEyeThatLooksPastThemSeesNothing) {
    for (const auto& grid : tests::bentMeshes()) {
        CellWorld world(tests::noise(grid), {"0:1"}, 0.5);
        for (const Order order : {Order::None, Order::BackToFront})
            for (const glm::dvec3& to : {glm::dvec3(0, -9, 0), glm::dvec3(9, -3, 0),
                                         glm::dvec3(0, -3, 9), glm::dvec3(0.7, -2.9, 40)}) {
                world.scene.order = order;
                View view = tests::lookFrom({0, -3, 0}, {40, 30}, 0.1);
                view.viewFromWorld = glm::lookAt(glm::dvec3(0, -3, 0), to, glm::dvec3(0.1, 0.2, 1));
                const auto channels = order == Order::None ? Channels::Weight : Channels::Over;
                for (const float v : drawn(world.scene, view, channels)) ASSERT_EQ(v, 0);
            }
    }
}

// Of any field the picture, its rays one by one and the truth by many rays a pixel are the same, to
// what a pixel's width is; missing points among them.
TEST(SolidPictures, AreTheIntervalVolumeOfTheFieldInThem) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> any(0, 1);
    const auto step = tests::stepOf(tests::bentGrid(tests::Cut::Wedges), [&](std::size_t i) {
        return i % 11 == 0 ? kNan : any(random);
    });
    const CellWorld world(step, {"0.3:0.6"});
    for (const glm::dvec3& from : kFrom) {
        const View view = tests::lookFrom(from, {24, 20}, 0.1);
        std::vector<glm::ivec2> pixels;
        for (int y = 0; y < 20; ++y)
            for (int x = 0; x < 24; ++x) pixels.emplace_back(x, y);
        const std::vector<float> w = drawn(world.scene, view);
        const std::vector<double> depth = cellDepthAt(world.scene, view, pixels);
        const std::vector<double> truth = meshWeight(world.scene, world.scene.cells->field(), view,
                                                     0, pixels, placesOfRays(4), 2);
        Scene whole = world.scene;  // without an index all cells are looked at
        whole.cells = nullptr;
        const std::vector<double> again =
            meshWeight(whole, world.scene.cells->field(), view, 0, pixels, placesOfRays(4), 2);
        const double perWeight = opticalDepthPerWeight(world.scene.layers[0].style.opacity);
        double off = 0, all = 0;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            EXPECT_NEAR(double(w[i]), depth[i] / perWeight, 2e-3);
            EXPECT_NEAR(again[i], truth[i], 1e-12 * (1 + truth[i]));
            off += (w[i] - truth[i]) * (w[i] - truth[i]);
            all += truth[i] * truth[i];
        }
        EXPECT_GT(all, 1);
        EXPECT_LE(std::sqrt(off / all), 0.03) << from.x;
    }
}

// In front of each other as they stand, whatever the shapes.
TEST(SolidPictures, HideWhatIsBehindThem) {
    for (const auto& grid : tests::bentSolids()) {
        // Of two opaque slabs the nearer one is seen, from either side.
        CellWorld world(stepOfPlaces(grid, [](const auto& p) { return p.x; }),
                        {"0.5:1.5", "2.5:3.5"}, 1.0);
        world.scene.order = Order::BackToFront;
        for (const double side : {-1.0, 1.0}) {
            const View view = tests::lookFrom({3 * side, 0, 0.05}, {9, 9}, 0.02);
            const std::vector<float> light = drawn(world.scene, view, Channels::Over);
            const glm::dvec3 nearer =
                std::get<Constant>(world.scene.layers[side < 0 ? 0 : 1].style.color).linearRgb;
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(double(light[4 * 40 + c]), nearer[c], 1e-3);
        }
    }
}

TEST(SolidPictures, APlaceBetweenPointsIsSeenUnderTheCursor) {
    for (const auto& grid : tests::bentSolids()) {
        const CellWorld world(stepOfPlaces(grid, [](const auto& p) { return p.x; }), {"1.3~0.001"},
                              1.0);
        const View view = tests::lookFrom({3, 0.1, 0.2}, {21, 21}, 0.05);
        const auto picked = pickCell(world.scene, view, {10.5, 10.5});
        ASSERT_TRUE(picked);
        EXPECT_NEAR(*picked->between, 1.3, 2e-3);
        const PixelRays rays = besideFaces(pixelRays(view));
        EXPECT_NEAR(rays.eye.x + picked->depth * rays.axis.x,
                    world.placed.axesFromGrid({1.3, 0, 0}).x, 1e-3);
        // The corner with the largest share is one of the cell's.
        EXPECT_EQ(timeseries::toDouble(picked->value),
                  double(float(world.step.grid().position(picked->gridIndex).x)));
        EXPECT_NEAR(timeseries::toDouble(picked->value), 1.3, 1.01);
    }
}

}  // namespace
}  // namespace solid_pictures
}  // namespace render
