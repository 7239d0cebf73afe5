// Pictures of which one layer is drawn by cells and another by points.
#include "render/splat/mixed_splatter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "render/frame/plain_frame.h"
#include "render/model/rays_across.h"
#include "render/splat/depth_order.h"
#include "render/splat/mixed_list.h"
#include "render/splat/tile_splatter.h"
#include "tests/support/cell_rays.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace render {
namespace mixed {
namespace {

using tests::CellWorld;
using tests::drawn;

constexpr std::uint64_t kAllAtOnce = tests::kAllCells;
constexpr glm::ivec2 kSize(60, 45);

// The whole picture's plane, row 0 at the bottom.
std::vector<float> mixed(const Scene& scene, const View& view, int raysAcross = 1,
                         unsigned threads = 2, std::uint64_t slice = kAllAtOnce) {
    MixedSum sum(scene, view, {}, raysAcross, threads);
    std::uint64_t added = 0;
    while (!sum.done()) added += sum.add(slice);
    const std::uint64_t all = cellCount(scene, Channels::Over, 0) + splatCount(onlyPoints(scene));
    EXPECT_LE(added, 2 * all + 8) << "listing them counts, too";
    std::vector<float> whole(std::size_t(4 * view.size.x * view.size.y));
    const PixelBox& box = sum.box();
    for (int y = 0; y < box.size.y; ++y)
        std::copy_n(sum.plane().begin() + std::ptrdiff_t(4 * y * box.size.x), 4 * box.size.x,
                    whole.begin() + std::ptrdiff_t(4 * ((box.at.y + y) * view.size.x + box.at.x)));
    return whole;
}

// A layer whose points are drawn by themselves.
void drawByPoints(Scene& scene, std::size_t layer) {
    scene.layers[layer].byPoints = true;
    scene.layers[layer].cells.candidates.clear();
}

// What stands far enough before the other that not even its splats reach it lies over it: whatever
// each of them is alone.
void expectOneOverTheOther(CellWorld& world, const glm::dvec3& towards) {
    Scene& scene = world.scene;
    scene.order = Order::BackToFront;
    scene.light = Light::Full;
    drawByPoints(scene, 1);
    for (const double side : {1.0, -1.0}) {
        const View view = tests::lookFrom(side * towards, kSize, 0.3);
        const std::vector<float> cells = drawn(onlyCells(scene), view, Channels::Over);
        const Scene points = onlyPoints(scene);
        const std::vector<float> splats =
            sumTiles(points, order(points, pixelRays(view).eye), view, Channels::Over, 0, {});
        // The points' layer has the greater values, which lie on the side of `towards`.
        const std::vector<float>&front = side > 0 ? splats : cells,
              &back = side > 0 ? cells : splats;
        const std::vector<float> is = mixed(scene, view);
        int both = 0;
        for (std::size_t i = 0; i < is.size(); i += 4) {
            both += front[i + 3] > 0.05f && back[i + 3] > 0.05f;
            for (std::size_t c = 0; c < 4; ++c)
                ASSERT_NEAR(is[i + c], front[i + c] + (1 - front[i + 3]) * back[i + c], 2e-5)
                    << "pixel " << i / 4 << " from " << side;
        }
        EXPECT_GT(both, 50) << "or nothing is before anything";
    }
}

TEST(MixedSum, WhatStandsBeforeTheOtherHidesIt) {
    const auto grid = tests::cube(12);
    CellWorld world(tests::stepOf(grid, [&](std::size_t i) { return double(grid->indices(i).x); }),
                    {"1.5:3.2", "8:9"}, 0.6);
    world.scene.layers[0].style.color = ByValue{{}, 0, 6};
    expectOneOverTheOther(world, {3, 0.4, 0.5});
}

TEST(MixedSum, OfPointsThatLieOneByOneToo) {
    const auto grid = tests::curvilinear({12, 12, 12}, [](double i, double j, double k) {
        return glm::dvec3(i + 0.1 * std::sin(j), j, k + 0.05 * i);
    });
    CellWorld world(tests::stepOfPlaces(grid, [](const glm::dvec3& p) { return p.x; }),
                    {"1.5:3.2", "8:9"}, 0.6);
    expectOneOverTheOther(world, {3, 0.4, 0.5});
}

TEST(MixedSum, OfSplatsThatEndAtTheFacesToo) {
    const auto grid = std::make_shared<const timeseries::Grid>(
        std::array{tests::axis(12), tests::axis(12), tests::axis(3, 0, 8)});
    CellWorld world(tests::stepOf(grid, [&](std::size_t i) { return double(grid->indices(i).x); }),
                    {"1.5:3.2", "8:9"}, 0.6);
    ASSERT_TRUE(world.placed.longCells());
    expectOneOverTheOther(world, {3, 0.4, 0.5});
}

// A point between the cells of a layer that fills all: those before it hide it, those behind not.
TEST(MixedSum, APointIsAmongTheCellsAboutIt) {
    const auto grid = tests::cube(9);
    CellWorld world(
        tests::stepOf(grid, [&](std::size_t i) { return i == grid->count() / 2 ? 5.0 : 1.0; }),
        {"0:10", "4:6"}, 0.9);
    Scene& scene = world.scene;
    scene.order = Order::BackToFront;
    scene.layers[0].style = {Constant{glm::dvec3(0, 0, 1)}, 0.2};
    scene.layers[1].style.color = Constant{glm::dvec3(1, 0, 0)};
    drawByPoints(scene, 1);
    for (const glm::dvec3& from : {glm::dvec3(3, 0.1, 0.2), glm::dvec3(-2, -2, 1.5)}) {
        const View view = tests::lookFrom(from, {31, 31}, 0.02);
        const std::size_t middle = 4 * std::size_t(15 * 31 + 15);
        const std::vector<float> is = mixed(scene, view);
        const Scene points = onlyPoints(scene);
        const double splat = sumTiles(points, order(points, pixelRays(view).eye), view,
                                      Channels::Over, 0, {})[middle];
        const double whole = drawn(onlyCells(scene), view, Channels::Over)[middle + 3];
        ASSERT_GT(splat, 0.1);
        // Half of the cells' way lies before it, give or take the cells that meet at the point.
        const double half = std::sqrt(1 - whole), more = std::pow(1 - 0.2, 1.8);
        EXPECT_LT(is[middle] / splat, half / more);
        EXPECT_GT(is[middle] / splat, half * more);
    }
}

TEST(MixedSum, IsTheSameInSlicesAndOnAnyThreads) {
    CellWorld world(tests::noise(tests::cube(24)), {"0.2:0.4", "0.6:0.7"}, 0.7);
    world.scene.order = Order::BackToFront;
    world.scene.layers[1].style.color = ByValue{{}, 0.6, 0.7};
    drawByPoints(world.scene, 1);
    for (const int rays : {1, 2}) {
        const View view = tests::lookFrom({0.7, -3, 1.1}, kSize);
        const std::vector<float> is = mixed(world.scene, view, rays, 1);
        EXPECT_GT(*std::ranges::max_element(is), 0.3f);
        EXPECT_EQ(mixed(world.scene, view, rays, 3), is);
        EXPECT_EQ(mixed(world.scene, view, rays, 2, 700), is);
    }
}

// Listing, too, is done in slices: none takes the time of all.
TEST(MixedSum, IsListedInSlices) {
    CellWorld world(tests::noise(tests::cube(24)), {"0.2:0.4", "0.6:0.7"}, 0.7);
    world.scene.order = Order::BackToFront;
    drawByPoints(world.scene, 1);
    const View view = tests::lookFrom({0.7, -3, 1.1}, kSize);
    MixedList list(world.scene, view, columnsOf(world.scene));
    std::size_t slices = 0;
    for (; !list.done(); ++slices) list.goOn(100);
    std::uint64_t count = 0;
    for (const Layer& layer : world.scene.layers) count += drawnCount(world.scene, layer);
    ASSERT_EQ(list.all().size(), count);
    EXPECT_GT(slices, 2 * count / 100);
    EXPECT_LT(slices, 4 * count / 100);
    const MixedRank rank(world.scene, view);
    const auto columns = columnsOf(world.scene);
    const auto rankOf = [&](const CellOrPoint& of) {
        return world.scene.layers[of.layer].byPoints ? rank.ofPoint(columns.gridIndex[of.cell])
                                                     : rank.ofCell(of.cell);
    };
    for (std::size_t i = 1; i < count; ++i)
        ASSERT_LE(rankOf(list.all()[i - 1]), rankOf(list.all()[i])) << i;
}

TEST(MixedSum, WhereAllIsClippedAwayNothingIsDrawn) {
    CellWorld world(tests::noise(tests::cube(8)), {"0.2:0.4", "0.6:0.7"}, 0.7);
    world.scene.order = Order::BackToFront;
    drawByPoints(world.scene, 1);
    world.scene.layers[0].cells.candidates.clear();
    world.scene.clip.lo = world.scene.clip.hi = glm::dvec3(1e6);
    for (const float part : mixed(world.scene, tests::lookFrom({0.7, -3, 1.1}, kSize)))
        ASSERT_EQ(part, 0);
}

// By several rays a pixel both are a finer picture's means: spheres, splats that end at the
// domain's faces, those of a mesh, and squares, of as many pixels of either picture.
TEST(MixedSum, SeveralRaysAreTheMeanOfAFinerPicture) {
    const std::shared_ptr<const timeseries::Grid> even = tests::cube(10);
    const auto columns = std::make_shared<const timeseries::Grid>(
        std::array{tests::axis(12), tests::axis(12), tests::axis(3, 0, 5)});
    const auto leaning = tests::curvilinear({9, 8, 7}, [](double i, double j, double k) {
        return glm::dvec3(i + 0.2 * j - 4, j - 0.1 * k - 4, k + 0.01 * i * j - 3);
    });
    const View view = tests::lookFrom({0.7, -3, 1.1}, {40, 30});
    View fine = view;
    fine.size *= 2;
    for (const auto& grid : {even, columns, leaning})
        for (const Footprint& footprint : {Footprint{}, Footprint{Kernel::Point, 2}}) {
            SCOPED_TRACE(testing::Message() << grid->count() << ' ' << footprint.size);
            CellWorld world(tests::noise(grid), {"0.2:0.4", "0.6:0.7"}, 0.7);
            Scene& scene = world.scene;
            ASSERT_EQ(world.placed.longCells(), grid == columns);
            scene.order = Order::BackToFront;
            scene.footprint = footprint;
            drawByPoints(scene, 1);
            const std::vector<float> is = mixed(scene, view, 2);
            if (footprint.kernel == Kernel::Point) scene.footprint.size *= 2;
            const std::vector<float> finer = mixed(scene, fine);
            EXPECT_GT(*std::ranges::max_element(is), 0.1f);
            for (int y = 0; y < 30; ++y)
                for (int x = 0; x < 40; ++x)
                    for (int c = 0; c < 4; ++c) {
                        double mean = 0;
                        for (int s = 0; s < 4; ++s)
                            mean += double(finer[std::size_t(
                                        4 * ((2 * y + s / 2) * 80 + 2 * x + s % 2) + c)]) /
                                    4;
                        ASSERT_NEAR(is[std::size_t(4 * (y * 40 + x) + c)], mean, 1e-5)
                            << x << ' ' << y;
                    }
        }
}

// Unordered, each layer's plane is what it is alone, and the light is that of both.
TEST(MixedSum, WithoutOrderEachPlaneIsItsLayersOwn) {
    CellWorld world(tests::noise(tests::cube(10)), {"0.2:0.4", "0.6:0.7"}, 0.4);
    Scene& scene = world.scene;
    drawByPoints(scene, 1);
    const View view = tests::lookFrom({0.7, -3, 1.1}, kSize);
    const std::vector<float> depth = opticalDepthOf(scene, view);
    const std::vector<float> cells = opticalDepthOf(onlyCells(scene), view),
                             points = opticalDepthOf(onlyPoints(scene), view);
    double most = 0;
    for (std::size_t i = 0; i < depth.size(); ++i) {
        ASSERT_NEAR(depth[i], cells[i] + points[i], 1e-6 * (1 + cells[i] + points[i]));
        most = std::max(most, double(std::min(cells[i], points[i])));
    }
    EXPECT_GT(most, 0.01);
}

// Squares reach less far than the cells do: planes of different parts of the picture meet in it.
TEST(MixedSum, WithoutOrderTheLightIsThatOfBothDepths) {
    for (const std::size_t points : {0, 1})
        for (const Footprint& footprint : {Footprint{}, Footprint{Kernel::Point, 2}}) {
            CellWorld world(tests::noise(tests::cube(10)), {"0.2:0.4", "0.6:0.7"}, 0.4);
            Scene& scene = world.scene;
            scene.footprint = footprint;
            for (Layer& layer : scene.layers) layer.style.color = Constant{glm::dvec3(1)};
            drawByPoints(scene, points);
            const View view = tests::lookFrom({0.7, -3, 1.1}, kSize);
            const std::vector<float> depth = opticalDepthOf(scene, view);
            PlainFrame frame(scene.step, scene.placed, glm::dvec3(0));
            frame.draw(scene, view);
            const Image light = frame.light();
            for (int y = 0; y < kSize.y; ++y)
                for (int x = 0; x < kSize.x; ++x)
                    ASSERT_NEAR(light.at(x, kSize.y - 1 - y).r,
                                1 - std::exp(-double(depth[std::size_t(y * kSize.x + x)])), 1e-4)
                        << points << ' ' << x << ' ' << y;
        }
}

}  // namespace
}  // namespace mixed
}  // namespace render
