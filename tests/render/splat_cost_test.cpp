#include "render/model/splat_cost.h"

#include <gtest/gtest.h>

#include "render/reference/cpu_splatter.h"
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

TEST(SplatCost, SmallSplatsCostOneEach) {
    const CostlyWorld world(1, "0.2:0.7");
    EXPECT_EQ(splatCost(world.scene, 0, tests::lookFrom({0, -3, 0}, {40, 30})), 1);
    EXPECT_EQ(sceneCost(world.scene, tests::lookFrom({0, -3, 0}, {40, 30})),
              static_cast<double>(pointCount(world.scene.layers[0])));
}

TEST(SplatCost, LargeOnesCostTheirPixels) {
    constexpr glm::ivec2 kSize = tests::kSanitized ? glm::ivec2(500, 375) : glm::ivec2(1000, 750);
    for (const double length : {1.0, 20.0})
        for (const glm::dvec3 eye :
             {glm::dvec3(0, -3, 0), glm::dvec3(0.2, -1.5, 2), glm::dvec3(0, -1.3, 0.2)}) {
            const CostlyWorld world(length);
            const View view = tests::lookFrom(eye, kSize);
            // A square holds 4 / pi times the pixels of its circle; some reach out of the picture.
            const double pixels = touched(world.scene, view) / kOrdinaryPixels;
            EXPECT_GE(sceneCost(world.scene, view), 0.7 * pixels) << length;
            EXPECT_LE(sceneCost(world.scene, view), 2.2 * pixels) << length;
        }
}

TEST(SplatCost, NothingCostsNothing) {
    const CostlyWorld world(1, "2:3");
    EXPECT_EQ(sceneCost(world.scene, tests::lookFrom({0, -3, 0}, {40, 30})), 0);
}

}  // namespace
}  // namespace render
