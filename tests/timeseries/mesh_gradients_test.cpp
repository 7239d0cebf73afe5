// How a field changes about the points of meshes.
#include "timeseries/index/point_gradients.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "tests/support/meshes.h"
#include "tests/support/unstructured.h"

namespace timeseries {
namespace point_gradients {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Of a value at each place.
template <typename F>
Field fieldOn(const std::shared_ptr<const Grid>& grid, const F& f) {
    std::vector<double> values(grid->count());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = f(i, grid->mesh()->position(i));
    return {grid, std::move(values), {}};
}

template <typename Place>
std::vector<std::shared_ptr<const Grid>> gridsOf(std::array<std::uint32_t, 3> size,
                                                 const Place& place) {
    std::vector all{tests::curvilinear({size[0], size[1], size[2]}, place)};
    for (const tests::Cut cut : tests::kCuts)
        all.push_back(tests::gridOf(tests::atPoints(tests::bricks(size, cut, place))));
    return all;
}
// Bent, of unequal extents, far from the origin.
std::vector<std::shared_ptr<const Grid>> bentGrids() {
    return gridsOf({7, 6, 7}, [](double i, double j, double k) {
        const glm::dvec3 bent(i + 0.2 * std::sin(j + k), j + 0.2 * std::sin(k - i),
                              k + 0.2 * std::cos(i - j));
        return glm::dvec3(1e3, -2, 5e-3) + glm::dvec3(10, 1, 1e-3) * bent;
    });
}

// To what floats hold of places, along each axis in its own extent.
void expectNear(const glm::dvec3& is, const glm::dvec3& expected, const Mesh& mesh,
                double tolerance) {
    const glm::dvec3 extent = mesh.hi() - mesh.lo();
    const double size = glm::length(expected * extent);
    for (int a = 0; a < 3; ++a)
        EXPECT_LE(std::abs(is[a] - expected[a]) * extent[a], tolerance * size) << a;
}

TEST(PointGradients, OfALinearFieldAreItsOwnWhateverItsScale) {
    for (const auto& grid : bentGrids())
        for (const double scale : {1.0, 1e-290, 1e290}) {
            const glm::dvec3 g = scale * glm::dvec3(0.3, -4, 2e3);
            const Field field = fieldOn(grid, [&](auto, const auto& p) { return glm::dot(g, p); });
            const PointGradients gradients(field, grid->mesh(), 2);
            for (std::size_t i = 0; i < grid->count(); ++i)
                expectNear(gradients.at(i) / scale, g / scale, *grid->mesh(), 1e-5);
        }
}

// A value that is missing takes a point's neighbours from one side; those of others stay exact.
TEST(PointGradients, GoRoundWhatIsMissing) {
    const glm::dvec3 g(0.3, -4, 2e3);
    for (const auto& grid : bentGrids()) {
        const auto isMissing = [](std::size_t i) {
            const auto at = [](std::size_t x, std::size_t y, std::size_t z) {
                return x + 7 * (y + 6 * z);
            };
            return i == at(2, 2, 2) || i == at(3, 3, 3) || i == at(4, 2, 4);
        };
        const Field field = fieldOn(
            grid, [&](std::size_t i, const auto& p) { return isMissing(i) ? kNan : dot(g, p); });
        const PointGradients gradients(field, grid->mesh(), 2);
        for (std::size_t i = 0; i < grid->count(); ++i) {
            if (!isMissing(i)) expectNear(gradients.at(i), g, *grid->mesh(), 1e-5);
            EXPECT_TRUE(isPlace(gradients.at(i)));
        }
    }
}

// Where what is about a point is the same on both sides, a curved field's is exact, too.
TEST(PointGradients, OfACurvedFieldAreThoseOfItsPoints) {
    const auto place = [](double i, double j, double k) { return glm::dvec3(i, 2 * j, k); };
    const auto f = [](const glm::dvec3& p) { return p.x * p.x - p.x * p.y + 3 * p.z * p.z; };
    const auto slope = [](const glm::dvec3& p) { return glm::dvec3(2 * p.x - p.y, -p.x, 6 * p.z); };
    for (const auto& grid : gridsOf({5, 4, 6}, place)) {
        const Field field = fieldOn(grid, [&](auto, const auto& p) { return f(p); });
        const PointGradients gradients(field, grid->mesh(), 2);
        int inner = 0;
        for (std::size_t i = 0; i < grid->count(); ++i) {
            const glm::dvec3 p = grid->mesh()->position(i);
            if (p.x < 1 || p.x > 3 || p.y < 2 || p.y > 4 || p.z < 1 || p.z > 4) continue;
            ++inner;
            for (int a = 0; a < 3; ++a) EXPECT_NEAR(gradients.at(i)[a], slope(p)[a], 1e-4) << i;
        }
        EXPECT_EQ(inner, 3 * 2 * 4);
    }
}

// Rings of a field that looks alike from four sides, whose first and last points are neighbours, or
// one place.
TEST(PointGradients, GoOnWhereLinesComeRound) {
    for (const bool closed : {false, true}) {
        constexpr std::size_t kAround = 24;
        const auto angle = [](double i) { return 2 * std::numbers::pi * i / kAround; };
        const auto grid = tests::curvilinear(
            {kAround + (closed ? 1 : 0), 4, 3}, [&](double i, double j, double k) {
                return glm::dvec3((2 + j) * std::cos(angle(i)), (2 + j) * std::sin(angle(i)), k);
            });
        const Field field = fieldOn(grid, [](auto, const auto& p) {
            return std::cos(4 * std::atan2(p.y, p.x)) + std::sin(4 * std::atan2(p.y, p.x));
        });
        const PointGradients gradients(field, grid->mesh(), 2);
        const std::size_t row = grid->size()[0], quarter = kAround / 4;
        for (std::size_t first = 0; first < grid->count(); first += row) {
            const double length = glm::length(gradients.at(first + quarter));
            EXPECT_GT(length, 0.1);
            EXPECT_NEAR(glm::length(gradients.at(first)), length, 1e-5 * length);
            EXPECT_NEAR(glm::length(gradients.at(first + row - 1)),
                        glm::length(gradients.at(first + quarter - (closed ? 0 : 1))),
                        1e-5 * length);
        }
    }
}

// A sphere's longitudes and latitudes, whose first and last rows are one place each.
TEST(PointGradients, AtAPoleAreThoseOfItsMeridians) {
    const auto grid = tests::curvilinear({12, 7, 3}, [](double i, double j, double k) {
        const double lon = std::numbers::pi * i / 6, lat = std::numbers::pi * (j / 6 - 0.5);
        return (3 + k) * glm::dvec3(std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon),
                                    std::sin(lat));
    });
    const Field field = fieldOn(grid, [](auto, const auto& p) { return p.z; });
    const PointGradients gradients(field, grid->mesh(), 2);
    for (std::size_t i = 0; i < grid->count(); ++i)
        expectNear(gradients.at(i), {0, 0, 1}, *grid->mesh(), 1e-4);
}

TEST(PointGradients, OfWhatIsConstantOrNotThereAreNone) {
    for (const auto& grid : bentGrids())
        for (const double value : {7.0, kNan, std::numeric_limits<double>::infinity()}) {
            const PointGradients gradients(fieldOn(grid, [&](auto, const auto&) { return value; }),
                                           grid->mesh(), 2);
            for (std::size_t i = 0; i < grid->count(); ++i)
                EXPECT_EQ(gradients.at(i), glm::dvec3(0));
        }
}

TEST(PointGradients, AreTheSameOfAnyNumberOfThreads) {
    const auto place = [](double i, double j, double k) {
        return glm::dvec3(i + 0.1 * j, j + 0.01 * i * k, k);
    };
    for (const auto& grid : gridsOf({30, 24, 24}, place)) {
        const Field field = fieldOn(grid, [](std::size_t i, const auto&) {
            return static_cast<double>(i * 2654435761u % 1000);
        });
        const PointGradients one(field, grid->mesh(), 1);
        for (const unsigned threads : {2u, 3u, 4u}) {
            const PointGradients several(field, grid->mesh(), threads);
            for (std::size_t i = 0; i < grid->count(); ++i)
                ASSERT_EQ(one.at(i), several.at(i)) << i;
        }
    }
}

}  // namespace
}  // namespace point_gradients
}  // namespace timeseries
