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
#include <utility>
#include <vector>

#include "tests/support/meshes.h"
#include "tests/support/unstructured.h"
#include "timeseries/index/node_values.h"
#include "timeseries/index/sorted_step.h"

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

// In units of the range and the extents.
glm::dvec3 unitless(const PointGradients& of, const glm::dvec3& gradient, double scale = 1) {
    return gradient * of.extent() / (of.range() / scale);
}
void expectNear(const glm::dvec3& is, const glm::dvec3& expected, double tolerance) {
    EXPECT_LE(glm::length(is - expected), tolerance * glm::length(expected))
        << is.x << ' ' << is.y << ' ' << is.z << " of " << expected.x << ' ' << expected.y << ' '
        << expected.z;
}

TEST(PointGradients, OfALinearFieldAreItsOwn) {
    const glm::dvec3 g(0.3, -4, 2e3);
    for (const auto& grid : bentGrids())
        for (const double scale : {1.0, 1e-290, 1e290}) {
            const Field field =
                fieldOn(grid, [&](auto, const auto& p) { return scale * glm::dot(g, p); });
            const PointGradients gradients(field, grid->mesh(), 2);
            for (std::size_t i = 0; i < grid->count(); ++i)
                expectNear(gradients.at(i), unitless(gradients, g, scale), 1e-5);
        }
}

// Of cells that have the values, where all about them have cells beyond.
TEST(PointGradients, OfALinearFieldOfCellsAreItsOwnWithin) {
    const glm::dvec3 g(0.3, -4, 2);
    const glm::dvec3 step(10, 1, 3), from(1e3, -2, 5);
    const auto grid = tests::gridOf(tests::atCells(tests::bricks(
        {6, 7, 6}, tests::Cut::Polyhedra,
        [&](double i, double j, double k) { return from + step * glm::dvec3(i, j, k); })));
    const auto field = withNodeValues(std::make_shared<const Field>(
        fieldOn(grid, [&](auto, const auto& p) { return glm::dot(g, p); })));
    const PointGradients gradients(*field, grid->mesh(), 2);
    int within = 0;
    for (std::size_t corner = 0; corner < grid->mesh()->corners(); ++corner) {
        const glm::dvec3 at = (grid->mesh()->cornerPosition(corner) - from) / step;
        const glm::dvec3 other = glm::dvec3(5, 6, 5) - at;
        if (std::min({at.x, at.y, at.z, other.x, other.y, other.z}) < 1.4) continue;
        ++within;
        expectNear(gradients.at(corner), unitless(gradients, g), 1e-4);
    }
    EXPECT_EQ(within, 3 * 4 * 3 + 2 * 3 * 2);
}

// Whatever the quotients of its units would be.
TEST(PointGradients, AreNumbersOfWhateverLengths) {
    for (const double length : {1e-20, 1.0, 1e20})
        for (const double value : {1e300, 1e-300})
            for (const auto& grid : gridsOf({5, 4, 6}, [&](double i, double j, double k) {
                     return length * tests::bent(i, j, k);
                 })) {
                const glm::dvec3 g(0.3, -1, 0.2);
                const Field field = fieldOn(
                    grid, [&](auto, const auto& p) { return value * glm::dot(g, p / length); });
                const PointGradients gradients(field, grid->mesh(), 2);
                const glm::dvec3 expected =
                    g * (gradients.extent() / length) / (gradients.range() / value);
                for (std::size_t i = 0; i < grid->count(); ++i)
                    expectNear(gradients.at(i), expected, 1e-5);
            }
}

// One value that nobody masked spoils what is beside it alone.
TEST(PointGradients, BesideAValueOfAnotherKindAreWhatTheyWere) {
    const glm::dvec3 g(0.3, -4, 2e3);
    for (const auto& grid : bentGrids()) {
        const Field field = fieldOn(grid, [&](std::size_t i, const auto& p) {
            return i == 0 ? 1.70141e38 : 1e-6 * glm::dot(g, p);
        });
        const PointGradients gradients(field, grid->mesh(), 2);
        const std::size_t last = grid->count() - 1;
        expectNear(gradients.at(last) * 1e40, unitless(gradients, 1e34 * g), 1e-4);
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
            if (!isMissing(i)) expectNear(gradients.at(i), unitless(gradients, g), 1e-5);
            EXPECT_TRUE(isPlace(gradients.at(i)));
        }
    }
}

// Of every tetrahedron of a brick about its diagonal two corners are missing.
TEST(PointGradients, OfTetrahedraThatAreNowhereWholeTakeWhatThereIs) {
    const auto place = [](double i, double j, double k) { return glm::dvec3(i, j, k); };
    const auto grid =
        tests::gridOf(tests::atPoints(tests::bricks({5, 5, 5}, tests::Cut::Hexahedra, place)));
    const Field field = fieldOn(grid, [&](std::size_t, const glm::dvec3& p) {
        return static_cast<int>(p.x + p.y + p.z) % 2 == 1 ? kNan : p.x;
    });
    const PointGradients gradients(field, grid->mesh(), 2);
    int inner = 0;
    for (std::size_t i = 0; i < grid->count(); ++i) {
        const glm::dvec3 p = grid->mesh()->position(i), slope = gradients.at(i);
        if (p != glm::clamp(p, 1.0, 3.0)) continue;
        ++inner;
        EXPECT_GT(slope.x, 0.1);
        EXPECT_LE(std::abs(slope.y) + std::abs(slope.z), slope.x);
    }
    EXPECT_EQ(inner, 27);
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
            expectNear(gradients.at(i), unitless(gradients, slope(p)), 1e-5);
        }
        EXPECT_EQ(inner, 3 * 2 * 4);
    }
}

constexpr std::size_t kAround = 24;
double angle(double i) { return 2 * std::numbers::pi * i / kAround; }

// Rings of a field that looks alike from four sides: the first and last points of a line are
// neighbours, or one place, or the last two are the first two again.
TEST(PointGradients, GoOnWhereLinesComeRound) {
    for (const std::size_t again : {0u, 1u, 2u}) {
        const auto grid =
            tests::curvilinear({kAround + again, 4, 3}, [&](double i, double j, double k) {
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
            for (const std::size_t i : {std::size_t{0}, row - 2, row - 1})
                EXPECT_NEAR(glm::length(gradients.at(first + i)),
                            glm::length(gradients.at(first + quarter + i % quarter)), 2e-5 * length)
                    << again << ' ' << i;
        }
    }
}

// Longitudes that come round on a flat map, of neighbours and of cells.
TEST(PointGradients, GoOnWhereCoordinatesBeginAnew) {
    constexpr std::uint32_t kLongitudes = 12;
    const glm::dvec3 period(360, 0, 0);
    const auto place = [](double i, double j, double k) { return glm::dvec3(30 * i, 10 * j, k); };
    auto places = tests::placesOf({kLongitudes, 5, 3}, place);
    places.period = period;
    UnstructuredGrid cells = tests::bricks({kLongitudes + 1, 5, 3}, tests::Cut::Voxels, place);
    for (std::uint32_t& corner : cells.corners)
        if (corner % (kLongitudes + 1) == kLongitudes) corner -= kLongitudes;
    Mesh mesh = tests::atPoints(cells);
    mesh.setSolids(mesh.solids(), period);
    for (const auto& grid : {tests::gridOf(std::move(places)), tests::gridOf(std::move(mesh))}) {
        const auto row = grid->mesh()->hasNeighbours() ? kLongitudes : kLongitudes + 1;
        const Field field = fieldOn(
            grid, [](auto, const auto& p) { return std::sin(2 * p.x * std::numbers::pi / 180); });
        const PointGradients gradients(field, grid->mesh(), 2);
        // Half a turn on it is the same.
        for (std::size_t first = 0; first < grid->count(); first += row) {
            EXPECT_GT(gradients.at(first).x, 1);
            expectNear(gradients.at(first), gradients.at(first + 6), 1e-5);
        }
    }
}

// On a flat map nothing is between columns on two sides of a pole.
TEST(PointGradients, OfAFlatMapKnowNothingOfCellsAboutAPole) {
    const auto sloping = [](const glm::dvec3& period) {
        UnstructuredGrid cells = tests::bricks(
            {3, 2, 2}, tests::Cut::Wedges,
            [](double i, double j, double k) { return glm::dvec3(120 * i, 80 + 9 * j, k); });
        tests::addCell(cells, 13, {3, 4, 5, 9, 10, 11});  // its second row, about the pole
        Mesh mesh = tests::atPoints(cells);
        mesh.setSolids(mesh.solids(), period);
        const auto grid = tests::gridOf(std::move(mesh));
        const Field field = fieldOn(grid, [](auto, const auto& p) { return p.y + p.z; });
        const PointGradients gradients(field, grid->mesh(), 2);
        return std::pair(gradients.at(4), unitless(gradients, {0, 1, 1}));
    };
    const auto [is, expected] = sloping({1e4, 0, 0});  // whose wedges are no wider than a quarter
    expectNear(is, expected, 1e-5);
    // Those of the rows are too wide then, and so is that one.
    EXPECT_EQ(sloping({360, 0, 0}).first, glm::dvec3(0));
}

// A sphere's longitudes and latitudes, whose first and last rows are one place each, also where
// these were written in single precision and their values differ a little.
TEST(PointGradients, AtAPoleAreThoseOfAllMeridians) {
    for (const bool isSingle : {false, true}) {
        const auto grid = tests::curvilinear({12, 7, 3}, [&](double i, double j, double k) {
            const double lon = std::numbers::pi * i / 6, lat = std::numbers::pi * (j / 6 - 0.5);
            const glm::dvec3 at =
                (3 + k) * glm::dvec3(std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon),
                                     std::sin(lat));
            if (!isSingle) return at;
            const auto near = static_cast<float>(lat), of = static_cast<float>(3 + k);
            return glm::dvec3(of * std::cos(near) * glm::vec2(std::cos(lon), std::sin(lon)),
                              of * std::sin(near));
        });
        for (const glm::dvec3& g :
             {glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::dvec3(0.5, -1, 0.3)}) {
            const Field field = fieldOn(grid, [&](std::size_t i, const auto& p) {
                const std::size_t row = i / 12 % 7;
                const double off = isSingle && (row == 0 || row == 6) ? 1e-4 * double(i % 5) : 0;
                return glm::dot(g, p) + off;
            });
            const PointGradients gradients(field, grid->mesh(), 2);
            for (std::size_t i = 0; i < grid->count(); ++i)
                expectNear(gradients.at(i), unitless(gradients, g), isSingle ? 1e-3 : 1e-5);
        }
    }
}

// Lines that come back along themselves, as behind a wing, are no rings.
TEST(PointGradients, OfLinesThatAreFoldedEndWhereTheseDo) {
    const auto grid = tests::curvilinear({21, 5, 4}, [](double i, double j, double k) {
        const double away = i - 10, up = j + 0.02 * (100 - away * away) * (away < 0 ? -1 : 1);
        return glm::dvec3(std::abs(away), away < 0 ? -j + 0.01 * up : j + 0.01 * up, k);
    });
    const glm::dvec3 g(1, 0.5, -0.25);
    const Field field = fieldOn(grid, [&](auto, const auto& p) { return glm::dot(g, p); });
    const PointGradients gradients(field, grid->mesh(), 2);
    for (std::size_t i = 0; i < grid->count(); ++i)
        if (i % 21 == 0 || i % 21 == 20) expectNear(gradients.at(i), unitless(gradients, g), 1e-4);
}

TEST(PointGradients, OfWhatIsConstantOrNotThereAreNone) {
    for (const auto& grid : bentGrids())
        for (const double value : {7.0, kNan, std::numeric_limits<double>::infinity()}) {
            const PointGradients gradients(fieldOn(grid, [&](auto, const auto&) { return value; }),
                                           grid->mesh(), 2);
            EXPECT_EQ(gradients.range(), 0);
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

// A step keeps those on one mesh.
TEST(PointGradients, OfAStepAreMadeOnceForEachMesh) {
    const auto place = [](double i, double j, double k) { return glm::dvec3(i, j, k); };
    const auto grid = tests::curvilinear({5, 4, 6}, place);
    const auto other = tests::curvilinear(
        {5, 4, 6}, [&](double i, double j, double k) { return 2.0 * place(i, j, k); });
    const auto step =
        SortedStep::build(fieldOn(grid, [](auto, const glm::dvec3& p) { return p.x; }));
    EXPECT_EQ(step.gradientsIfMade(grid->mesh()), nullptr);
    const std::uint64_t before = step.bytes();
    const auto made = step.gradients(grid->mesh());
    EXPECT_EQ(step.gradients(grid->mesh()), made);
    EXPECT_EQ(step.gradientsIfMade(grid->mesh()), made);
    EXPECT_EQ(step.bytes(), before + made->bytes());
    EXPECT_EQ(step.gradientsIfMade(other->mesh()), nullptr);
    EXPECT_EQ(step.gradients(other->mesh())->extent(), 2.0 * made->extent());
    EXPECT_EQ(step.gradientsIfMade(grid->mesh()), nullptr);
}

}  // namespace
}  // namespace point_gradients
}  // namespace timeseries
