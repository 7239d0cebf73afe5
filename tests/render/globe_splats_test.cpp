// How even the splats of a globe's points are, anywhere between them and about the poles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "render/points/globe.h"
#include "tests/support/geographic.h"

namespace render {
namespace globe_splats {
namespace {

using tests::east;
using tests::gridOf;
using tests::levels;
using tests::north;
using timeseries::Axis;
using timeseries::Grid;

constexpr double kPi = std::numbers::pi;

// What the splats of a shell add up to at places by chance between these latitudes, ideally 1.
struct Density {
    double mean, rms, most;  // rms from 1
};
Density densityBetween(double from, double to, const Axis& latitudes) {
    const auto grid = gridOf(east(0, 355, 72), latitudes, levels(7));
    const Globe globe(*grid, 2.0);  // degrees a level
    const auto mesh = globe.meshOf(*grid);
    constexpr double kRadius =
        1.396;  // of a quartic kernel, in spacings (render/model/footprint.h)
    // The kernel whose shadow is (1 - b^2)^4: (1 - b^2)^3.5 over its integral.
    const double whole = 2 * kPi * std::tgamma(1.5) * std::tgamma(4.5) / std::tgamma(6.0);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> longitude(0, 360), level(2.5, 3.5);
    std::uniform_real_distribution<double> sine(std::sin(from * kPi / 180),
                                                std::sin(to * kPi / 180));
    constexpr int kPlaces = 200;
    double sum = 0, squares = 0, most = 0;
    for (int n = 0; n < kPlaces; ++n) {
        const double x = longitude(random), y = std::asin(sine(random)) * 180 / kPi;
        const glm::dvec3 at = globe.at({x, y, level(random)});
        double density = 0;
        for (std::uint64_t i = 0; i < grid->count(); ++i) {
            const glm::dvec3 away = at - mesh->position(i);
            if (glm::dot(away, away) > 0.1) continue;
            const auto cell = mesh->cell(i);
            const glm::dvec3 inCell = cell.solve(away);
            const double b2 = glm::dot(inCell, inCell) / (kRadius * kRadius);
            if (b2 < 1)
                density += mesh->volume(i) / std::abs(cell.determinant()) * std::pow(1 - b2, 3.5) /
                           (whole * std::pow(kRadius, 3));
        }
        sum += density;
        squares += (density - 1) * (density - 1);
        most = std::max(most, density);
    }
    return {sum / kPlaces, std::sqrt(squares / kPlaces), most};
}

// Anywhere between its points, but near the poles: what is left is the lattice's ripple, and what a
// splat loses by the curvature that it does not follow.
TEST(GlobeSplats, SplatsOfAShellAddUpToOne) {
    const Density density = densityBetween(-60, 60, north(-87.5, 87.5, 36));
    EXPECT_NEAR(density.mean, 0.998, 0.002);
    EXPECT_LT(density.rms, 0.0085);
}

// Within three steps of a pole. As needles, which all reach across it, they add up to 20 there.
TEST(GlobeSplats, AboutAPoleSplatsAddUpToNearlyOne) {
    for (const Axis& latitudes : {north(-87.5, 87.5, 36), north(-90, 90, 37)}) {
        const Density density = densityBetween(75, 90, latitudes);
        EXPECT_NEAR(density.mean, 1.02, 0.02);
        EXPECT_LT(density.rms, 0.1);
        EXPECT_LT(density.most, 1.7);
    }
}

// Of a sector, which no pole's other side is beside, cells are what they stand for.
TEST(GlobeSplats, CellsOfASectorBesideAPoleAreNoWider) {
    const auto whole = gridOf(east(0, 355, 72), north(62.5, 87.5, 6), levels(2));
    const auto sector = gridOf(east(0, 60, 13), north(62.5, 87.5, 6), levels(2));
    const auto widened = [](const Grid& grid) {
        const auto mesh = Globe(grid).meshOf(grid);
        std::uint64_t count = 0;
        for (std::uint64_t i = 0; i < mesh->count(); ++i) count += mesh->widened(i) > 0;
        return count;
    };
    EXPECT_EQ(widened(*whole), 72u * 2);
    EXPECT_EQ(widened(*sector), 0u);
}

}  // namespace
}  // namespace globe_splats
}  // namespace render
