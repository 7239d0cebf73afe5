// The order of cells by depth: along any ray from the eye, what comes later has a higher rank.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <random>

#include "render/reference/cell_walk.h"
#include "render/splat/cell_pieces.h"
#include "tests/support/cell_worlds.h"

namespace render {
namespace {

TEST(CellRank, RisesAlongEveryRayFromTheEye) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> side(-1, 1);
    for (const std::array<std::size_t, 3> size :
         {std::array<std::size_t, 3>{40, 33, 21}, {100, 3, 1}, {17, 16, 15}}) {
        const auto grid = std::make_shared<timeseries::Grid>(
            std::array{tests::axis(size[0]), tests::axis(size[1], 3, -0.7), tests::axis(size[2])});
        const tests::CellWorld world(tests::noise(grid), {"0:0.5"});
        const CellWalk walk(world.placed);
        std::size_t steps = 0;
        for (int i = 0; i < 60; ++i) {
            // Inside, beside and far away; looking at the middle.
            const double far = std::array{0.3, 0.9, 4.0}[static_cast<std::size_t>(i) % 3];
            const glm::dvec3 from = far * glm::dvec3(side(random), side(random), side(random));
            const View view = tests::lookFrom(from, {8, 8});
            const CellRank rank(world.scene, view);
            const glm::dvec3 eye = pixelRays(world.placed.inAxes(view)).eye;
            for (int k = 0; k < 20; ++k) {
                const glm::dvec3 at(world.placed.domain().lo), to(world.placed.domain().hi);
                glm::dvec3 through;
                for (int a = 0; a < 3; ++a)
                    through[a] = std::lerp(at[a], to[a], 0.5 + 0.5 * side(random));
                std::int64_t last = -1;
                walk(eye, through - eye, 0, [&](const glm::uvec3& cell, double, double) {
                    const std::int64_t next = rank(cell);
                    ASSERT_GT(next, last);
                    ASSERT_LT(next, static_cast<std::int64_t>(rank.count()));
                    ASSERT_EQ(rank(cell.x + walk.size().x * (cell.y + walk.size().y * cell.z)),
                              next);
                    last = next;
                    ++steps;
                });
            }
        }
        EXPECT_GT(steps, 5'000u);
    }
}

}  // namespace
}  // namespace render
