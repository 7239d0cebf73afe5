// What pixels have by their own rays, against the sums of whole pictures.
#include "render/reference/cells_on_rays.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/cell_worlds.h"

namespace render {
namespace {

using tests::CellWorld;

// With missing points and a clip box, from outside and from inside, of two layers, at whose ends
// many points are: cells that only touch a range have their share of a passage.
TEST(CellsOnRays, HaveWhatIsSummedForAllPixels) {
    const auto grid = tests::cube(15);
    const auto step = [&] {
        return tests::stepOf(grid, [&](std::size_t i) {
            if (i % 97 == 0) return std::nan("");
            const glm::dvec3 p(grid->indices(i));
            const double v =
                std::sin(0.45 * p.x) + std::cos(0.35 * p.y + 0.15 * p.x) * std::sin(0.4 * p.z);
            return std::round(16 * v) / 16;
        });
    };
    for (const bool inside : {false, true})
        for (const OpacityPer per : {OpacityPer::Length, OpacityPer::Crossing}) {
            CellWorld world(step(), {"0.25:0.5", "-0.8125:-0.75"}, 0.3);
            world.scene.opacityPer = per;
            world.scene.clip = indexBox(*grid, glm::dvec3(2), glm::dvec3(11.5));
            const View view = inside ? tests::lookFrom({0.05, -0.1, 0.02}, {40, 30})
                                     : tests::lookFrom({1.2, -2.5, 1}, {40, 30});
            std::vector<glm::ivec2> pixels;
            for (int y = 0; y < view.size.y; ++y)
                for (int x = 0; x < view.size.x; ++x) pixels.emplace_back(x, y);
            const std::vector<double> depth = cellDepthAt(world.scene, view, pixels, 1, 3);
            std::vector<double> sums(pixels.size());
            for (std::size_t k = 0; k < world.scene.layers.size(); ++k) {
                const std::vector<float> weight =
                    tests::drawn(world.scene, view, Channels::Weight, k);
                for (std::size_t i = 0; i < sums.size(); ++i)
                    sums[i] += opticalDepthPerWeight(world.scene.layers[k].style.opacity) *
                               static_cast<double>(weight[i]);
            }
            double most = 0;
            for (const double sum : sums) most = std::max(most, sum);
            ASSERT_GT(most, 0.1);
            for (std::size_t i = 0; i < sums.size(); ++i)
                ASSERT_NEAR(depth[i], sums[i], 1e-4 * most);
        }
}

// Rays that end where something is tell the same pixels from those that show nothing.
TEST(CellsOnRays, ThatEndWhereSomethingIsTellWherePixelsShowSomething) {
    const auto grid = tests::cube(15);
    const CellWorld world(tests::noise(grid), {"0.95:0.96", "0.02:0.03"}, 0.3);
    const View view = tests::lookFrom({1.2, -2.5, 1}, {80, 60});
    std::vector<glm::ivec2> pixels;
    for (int y = 0; y < view.size.y; ++y)
        for (int x = 0; x < view.size.x; ++x) pixels.emplace_back(x, y);
    for (const int raysAcross : {1, 2}) {
        const std::vector<double> depth = cellDepthAt(world.scene, view, pixels, raysAcross, 2);
        const std::vector<double> some =
            cellDepthAt(world.scene, view, pixels, raysAcross, 2, RaysEnd::WhereSomethingIs);
        std::size_t shown = 0, less = 0;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            ASSERT_EQ(some[i] > 0, depth[i] > 0) << i;
            shown += depth[i] > 0;
            less += some[i] < depth[i];
        }
        EXPECT_GT(shown, 100u);
        EXPECT_LT(shown, pixels.size() - 100);
        EXPECT_GT(less, 100u);
    }
}

}  // namespace
}  // namespace render
