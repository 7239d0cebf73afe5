#include "app/picture/clip_counts.h"

#include <gtest/gtest.h>

#include <random>

#include "app/choices/choice_text.h"
#include "app/exploration/point_counts.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"
#include "tests/support/selection_oracle.h"

namespace app {
namespace {

using timeseries::RangeSet;

std::shared_ptr<const timeseries::Grid> gridOf(std::size_t x, std::size_t y, std::size_t z) {
    return std::make_shared<timeseries::Grid>(
        std::array{tests::axis(x), tests::axis(y), tests::axis(z)});
}

TEST(ClipCounts, AreThoseOfEveryPointLookedAt) {
    std::mt19937 random(21);
    for (int i = 0; i < 200; ++i) {
        const auto below = [&](std::size_t n) { return random() % n; };
        const std::size_t nx = 1 + below(13), ny = 1 + below(9), nz = 1 + below(9);
        const auto step = tests::stepOf(
            gridOf(nx, ny, nz), [&](std::size_t) { return static_cast<double>(below(50)); });
        Explorer e;
        const auto somewhere = [&](std::size_t n) {
            const double a = static_cast<double>(below(n + 2)) - 1,
                         b = static_cast<double>(below(n + 2)) - 1;
            return std::pair(std::min(a, b), std::max(a, b));
        };
        const auto [x0, x1] = somewhere(nx);
        const auto [y0, y1] = somewhere(ny);
        const auto [z0, z1] = somewhere(nz);
        e.clip = ClipBox{{x0, y0, z0}, {x1, y1, z1}};
        const char* const ranges[] = {"0:10", "5:30", "min:max", "3:4,20:25", "70:80"};
        for (std::size_t k = 0; k < 3; ++k)
            e.layers.push_back(
                {RangeSet::parse(ranges[below(5)]), glm::dvec3(1), 0.5, below(3) != 0});
        std::vector<std::uint64_t> layers(3);
        std::uint64_t selected = 0;
        for (std::uint64_t p = 0; p < step.size(); ++p) {
            const std::uint32_t at = step.gridIndex()[p];
            const auto x = static_cast<double>(at % nx), y = static_cast<double>(at / nx % ny),
                       z = static_cast<double>(at / nx / ny);
            if (x < x0 || x > x1 || y < y0 || y > y1 || z < z0 || z > z1) continue;
            bool visible = false;
            for (std::size_t k = 0; k < 3; ++k) {
                const auto value = static_cast<float>(timeseries::toDouble(step.value(p)));
                if (!oracle::holds(e.layers[k].ranges.ranges(), value)) continue;
                ++layers[k];
                visible = visible || e.layers[k].visible;
            }
            if (visible) ++selected;
        }
        const PointCounts counts = pointCounts(e, step);
        EXPECT_EQ(counts.layers, layers) << "case " << i;
        EXPECT_EQ(counts.selected, selected) << "case " << i;
        EXPECT_EQ(counts.total, nx * ny * nz) << "of the whole step";
        EXPECT_TRUE(counts.inClipBox);
    }
}

// Rows found by a product of doubles, on several threads.
TEST(ClipCounts, AreExactInALargeGrid) {
    const std::size_t nx = 331, ny = 67, nz = 101;
    const auto step =
        tests::stepOf(gridOf(nx, ny, nz), [](std::size_t i) { return static_cast<double>(i % 7); });
    const std::vector<std::vector<timeseries::Run>> sets{{{0, step.size()}}};
    const render::IndexBox box{{17, 3, 9}, {329, 65, 88}};
    EXPECT_EQ(countsInside(step, box, sets), std::vector<std::uint64_t>{313 * 63 * 80});
    const render::IndexBox lastColumn{{330, 0, 0}, {330, 999, 999}};
    EXPECT_EQ(countsInside(step, lastColumn, sets), std::vector<std::uint64_t>{67 * 101});
    const render::IndexBox nothing{{5, 5, 5}, {4, 9, 9}};
    EXPECT_EQ(countsInside(step, nothing, sets), std::vector<std::uint64_t>{0});
}

// Where points lie one by one, the box is one of the file's coordinates.
TEST(ClipCounts, AreExactInAMesh) {
    const auto grid = tests::curvilinear({31, 23, 17}, [](double i, double j, double k) {
        return glm::dvec3(i + 0.4 * std::sin(j), 1.5 * j - 0.2 * k, k + 0.1 * i);
    });
    const auto step = tests::stepOf(grid, [](std::size_t i) { return static_cast<double>(i % 7); });
    const glm::dvec3 lo(3.25, -1, 2.5), hi(20, 17.75, 9);
    std::uint64_t all = 0, threes = 0;
    for (std::uint64_t i = 0; i < grid->count(); ++i) {
        const glm::dvec3 at = grid->position(i);
        bool inside = true;
        for (int c = 0; c < 3; ++c) inside = inside && lo[c] <= at[c] && at[c] <= hi[c];
        all += inside ? 1 : 0;
        threes += inside && i % 7 == 3 ? 1 : 0;
    }
    ASSERT_GT(threes, 100u);
    const std::vector<std::vector<timeseries::Run>> sets{
        {{0, step.size()}}, step.select(timeseries::RangeSet::parse("3"))};
    EXPECT_EQ(countsInside(step, render::indexBox(*grid, lo, hi), sets),
              (std::vector<std::uint64_t>{all, threes}));
}

}  // namespace
}  // namespace app
