// What a field whose cells have its values has at their corners.
#include "timeseries/index/node_values.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <random>

#include "tests/support/unstructured.h"
#include "timeseries/index/cell_corners.h"

namespace timeseries {
namespace node_values {
namespace {

template <typename T>
std::shared_ptr<const Field> fieldOf(const std::shared_ptr<const Grid>& grid,
                                     std::vector<T> values) {
    return std::make_shared<const Field>(Field{grid, std::move(values), {}});
}

std::shared_ptr<const Grid> atCells(const UnstructuredGrid& grid) {
    return tests::gridOf(tests::atCells(grid));
}

// Of every cell that names a node one over the distance, of all shapes, on any number of threads.
TEST(NodeValues, AreMeansByOneOverTheDistance) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> any(-1, 1);
    for (const tests::Cut cut : tests::kCuts) {
        const UnstructuredGrid cells =
            tests::bricks({20, 20, 15}, cut, [](double i, double j, double k) {
                return glm::dvec3(i + 0.2 * std::sin(j), j + 0.1 * k, 30 * k + i);
            });
        const auto grid = atCells(cells);
        const Mesh& mesh = *grid->mesh();
        ASSERT_EQ(mesh.corners(), cells.types.size() + cells.points.size());
        std::vector<double> values(cells.types.size());
        for (double& v : values) v = any(random);
        values[70] = std::numeric_limits<double>::quiet_NaN();
        values[80] = std::numeric_limits<double>::infinity();
        std::vector<long double> sums(cells.points.size()), weights(cells.points.size());
        for (std::size_t cell = 0; cell < values.size(); ++cell) {
            if (!std::isfinite(values[cell])) continue;
            for (const std::uint32_t node : listOf(cells.corners, cells.ends, cell)) {
                const double away = glm::distance(mesh.position(cell), cells.points[node]);
                sums[node] += values[cell] / away;
                weights[node] += 1 / away;
            }
        }
        const auto with = withNodeValues(fieldOf(grid, values), 1);
        ASSERT_EQ(with->atNodes.size(), cells.points.size());
        for (std::size_t node = 0; node < sums.size(); ++node) {
            ASSERT_GT(weights[node], 0);
            // A mesh's places are floats.
            EXPECT_NEAR(with->atNodes[node], double(sums[node] / weights[node]), 1e-5);
            EXPECT_EQ(finiteValue(*with, mesh.count() + node), with->atNodes[node]);
            EXPECT_LT(glm::distance(mesh.cornerPosition(mesh.count() + node), cells.points[node]),
                      1e-4);
        }
        EXPECT_EQ(withNodeValues(fieldOf(grid, values), 3)->atNodes, with->atNodes);
        EXPECT_EQ(withNodeValues(with), with);
    }
}

// Or a range of that value alone would have holes.
TEST(NodeValues, WhereCellsAreAlikeAreTheirs) {
    const auto grid = atCells(tests::bentBricks(tests::Cut::Tetrahedra));
    for (const double value : {0.1, -1e300, 5e-324}) {
        const auto with = withNodeValues(fieldOf(grid, std::vector(grid->count(), value)));
        for (const double at : with->atNodes) EXPECT_EQ(at, value);
    }
}

TEST(NodeValues, OfTheLargestDoublesAreNumbers) {
    const auto grid = atCells(tests::bentBricks(tests::Cut::Hexahedra));
    std::vector<double> values(grid->count());
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = (i % 2 ? -1 : 1) * std::numeric_limits<double>::max();
    const auto with = withNodeValues(fieldOf(grid, values));
    for (const double at : with->atNodes) EXPECT_TRUE(std::isfinite(at));
}

TEST(NodeValues, OfWholeNumbersAreBetweenThem) {
    const auto grid =
        atCells(tests::bricks({3, 2, 2}, tests::Cut::Voxels,
                              [](double i, double j, double k) { return glm::dvec3(i, j, k); }));
    const auto with = withNodeValues(fieldOf<std::uint8_t>(grid, {3, 4}));
    for (std::size_t node = 0; node < 12; ++node)
        EXPECT_NEAR(with->atNodes[node], node % 3 == 0 ? 3 : node % 3 == 1 ? 3.5 : 4, 1e-6);
    // Beside what is missing the others count, and where all are nothing.
    auto missing = *fieldOf<std::uint8_t>(grid, {3, 4});
    missing.missing = {true, false};
    const auto some = withNodeValues(std::make_shared<const Field>(missing));
    for (std::size_t node = 0; node < 12; ++node)
        if (node % 3 == 0)
            EXPECT_TRUE(std::isnan(some->atNodes[node]));
        else
            EXPECT_EQ(some->atNodes[node], 4);
}

TEST(NodeValues, AreOfCellsAlone) {
    const auto atPoints = tests::gridOf(tests::atPoints(tests::bentBricks(tests::Cut::Wedges)));
    const auto field = fieldOf(atPoints, std::vector<float>(atPoints->count()));
    EXPECT_EQ(withNodeValues(field), field);
}

// A point that no cell names may be anywhere, and a middle is never one of the nodes.
TEST(NodeValues, OfNoCellAreNone) {
    UnstructuredGrid cells =
        tests::bricks({2, 2, 2}, tests::Cut::Hexahedra,
                      [](double i, double j, double k) { return glm::dvec3(i, j, k); });
    cells.points.emplace_back(1e308, NAN, 0);
    const auto with = withNodeValues(fieldOf<float>(atCells(cells), {2}));
    ASSERT_EQ(with->atNodes.size(), 9u);
    EXPECT_TRUE(std::isnan(with->atNodes[8]));
    EXPECT_EQ(with->atNodes[0], 2);
}

}  // namespace
}  // namespace node_values
}  // namespace timeseries
