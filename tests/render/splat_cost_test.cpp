#include "render/splat/splat_cost.h"

#include <gtest/gtest.h>

#include "render/reference/cpu_splatter.h"
#include "tests/support/cell_worlds.h"
#include "tests/support/rounds.h"
#include "tests/support/scenes.h"

namespace render {
namespace {

struct CostlyWorld {
    explicit CostlyWorld(double length, const char* range = "0:1")
        : step(tests::noise(std::make_shared<timeseries::Grid>(
              std::array{tests::axis(12), tests::axis(12), tests::axis(6, 0, length)}))),
          scene{.step = step,
                .placed = placed,
                .layers = {{step.select(timeseries::RangeSet::parse(range)), {}}},
                .footprint = {},
                .order = Order::None,
                .clip = {}} {}
    timeseries::SortedStep step;
    PlacedPoints placed{step.grid()};
    Scene scene;
};

// Pixels that splats touch, all together, counted.
double touched(const Scene& scene, const View& view) {
    Accumulator<double> counts(view.size, {Channels::Count});
    splat(scene, Runs{}, view, {}, counts);
    double sum = 0;
    for (const double c : counts.planes[0]) sum += c;
    return sum;
}

TEST(SplatCost, SmallSplatsCostLittleMoreThanOneEach) {
    const CostlyWorld world(1, "0.2:0.7");
    const View view = tests::lookFrom({0, -3, 0}, {40, 30});
    EXPECT_GT(splatCost(world.scene, 0, view), 1);
    EXPECT_LT(splatCost(world.scene, 0, view), 1.2);
    EXPECT_EQ(
        sceneCost(world.scene, view),
        splatCost(world.scene, 0, view) * static_cast<double>(pointCount(world.scene.layers[0])));
}

TEST(SplatCost, LargeOnesCostTheirPixels) {
    constexpr glm::ivec2 kSize = tests::kSanitized ? glm::ivec2(500, 375) : glm::ivec2(1000, 750);
    for (const double length : {1.0, 20.0})
        for (const glm::dvec3 eye :
             {glm::dvec3(0, -3, 0), glm::dvec3(0.2, -1.5, 2), glm::dvec3(0, -1.3, 0.2)}) {
            const CostlyWorld world(length);
            const View view = tests::lookFrom(eye, kSize);
            // A square holds 4 / pi times the pixels of its circle; some reach out of the picture.
            const double pixels = touched(world.scene, view);
            for (const SummedBy by : {SummedBy::Program, SummedBy::Gl}) {
                const double asMuch = pixels / pixelsOfASplat(by, Channels::Weight);
                const double cost = sceneCost(world.scene, view, by) -
                                    static_cast<double>(pointCount(world.scene.layers[0]));
                EXPECT_GE(cost, 0.7 * asMuch) << length;
                EXPECT_LE(cost, 2.2 * asMuch) << length;
            }
        }
}

// A plane of one colour has one float a pixel, one by value or in order four.
TEST(SplatCost, WhatAGpuBlendsCostsByItsFloats) {
    CostlyWorld world(4);
    const View view = tests::lookFrom({0, -3, 0}, {400, 300});
    const auto pixels = [&](SummedBy by) { return splatCost(world.scene, 0, view, by) - 1; };
    const double program = pixels(SummedBy::Program), oneFloat = pixels(SummedBy::Gl);
    EXPECT_NEAR(oneFloat / program, 200.0 / 30, 1e-9);
    world.scene.layers[0].style.color = ByValue{{}, 0, 1};
    EXPECT_NEAR(pixels(SummedBy::Gl) / program, 200.0 / 8, 1e-9);
    world.scene.order = Order::BackToFront;
    EXPECT_NEAR(pixels(SummedBy::Gl) / program, 200.0 / 8, 1e-9);
}

TEST(SplatCost, PlanesCostByThePixelsThatTheyCover) {
    const CostlyWorld world(1);
    const View far = tests::lookFrom({0, -4, 0}, {400, 300}),
               fine = tests::lookFrom({0, -4, 0}, {1600, 1200}),
               within = tests::lookFrom({0, -0.1, 0}, {400, 300});
    EXPECT_NEAR(planesCost(world.scene, fine) / planesCost(world.scene, far), 16, 4);
    EXPECT_GT(planesCost(world.scene, within), 5 * planesCost(world.scene, far));
    CostlyWorld two(1);
    two.scene.layers.push_back(two.scene.layers[0]);
    EXPECT_EQ(planesCost(two.scene, within), 2 * planesCost(world.scene, within));
}

TEST(SplatCost, NothingCostsNothing) {
    const CostlyWorld world(1, "2:3");
    EXPECT_EQ(sceneCost(world.scene, tests::lookFrom({0, -3, 0}, {40, 30})), 0);
}

// A cell, and what of it is seen.
double costOfCells(double (*field)(const glm::uvec3&), const char* range, const View& view,
                   Order order = Order::None) {
    tests::CellWorld world(
        tests::stepOf(tests::cube(12),
                      [&](std::size_t i) {
                          return field(timeseries::indicesOf(unsigned(i), glm::uvec3(12)));
                      }),
        {range});
    world.scene.order = order;
    return splatCost(world.scene, 0, view);
}
double ramp(const glm::uvec3& at) { return at.x; }

TEST(SplatCost, CellsCostByTheRaysThatCrossTheRangesEnds) {
    const View view = tests::lookFrom({0.3, -2.5, 0.4}, {600, 450});
    View nearer = tests::lookFrom({0.3, -2.5, 0.4}, {1200, 900});
    // Of a ramp between two points all cells between them are the same: crossed, or whole.
    const double crossed = costOfCells(ramp, "5.2:5.8", view),
                 whole = costOfCells(ramp, "5:6", view);
    EXPECT_GT(crossed, 1.3 * whole);
    // Four times as many pixels, and less of them beside the cell.
    const double ofNearer = costOfCells(ramp, "5.2:5.8", nearer);
    EXPECT_GT(ofNearer, 1.3 * crossed);
    EXPECT_LT(ofNearer, 4 * crossed);
}

TEST(SplatCost, CellsInOrderCostMore) {
    const View view = tests::lookFrom({0.3, -2.5, 0.4}, {600, 450});
    EXPECT_GT(costOfCells(ramp, "5.2:5.8", view, Order::BackToFront),
              1.5 * costOfCells(ramp, "5.2:5.8", view));
}

}  // namespace
}  // namespace render
