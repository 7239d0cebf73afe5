// What a field whose cells have its values has at their corners.
#include "timeseries/index/node_values.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

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

// Within a grid of whatever shapes, whose cells are of unequal sizes; at its sides no value is
// beyond those of the cells there. What is missing or infinite does not count.
TEST(NodeValues, OfALinearFieldAreItsOwn) {
    const auto slope = [](const glm::dvec3& at) { return 3 * at.x - 2 * at.y + 0.1 * at.z; };
    for (const tests::Cut cut : tests::kCuts) {
        // Layers are 30 thick, then 3, and cells get wider.
        const UnstructuredGrid cells =
            tests::bricks({12, 11, 10}, cut, [](double i, double j, double k) {
                return glm::dvec3(i + 0.04 * i * i, j + 0.1 * std::sin(i),
                                  std::max(30 * k, 3 * k + 108));
            });
        const auto grid = atCells(cells);
        const Mesh& mesh = *grid->mesh();
        ASSERT_EQ(mesh.corners(), cells.types.size() + cells.points.size());
        std::vector<double> values(mesh.count());
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = slope(mesh.position(i));
        values[0] = std::numeric_limits<double>::quiet_NaN();
        values[1] = std::numeric_limits<double>::infinity();
        std::vector<double> lo(cells.points.size(), INFINITY), hi(cells.points.size(), -INFINITY);
        for (std::size_t cell = 2; cell < values.size(); ++cell)
            for (const std::uint32_t node : listOf(cells.corners, cells.ends, cell)) {
                lo[node] = std::min(lo[node], values[cell]);
                hi[node] = std::max(hi[node], values[cell]);
            }
        const auto with = withNodeValues(fieldOf(grid, values), 1);
        ASSERT_EQ(with->atNodes.size(), cells.points.size());
        for (std::size_t node = 0; node < cells.points.size(); ++node) {
            const glm::dvec3& at = cells.points[node];
            const double value = with->atNodes[node];
            EXPECT_LT(glm::distance(mesh.cornerPosition(mesh.count() + node), at), 1e-4);
            if (!(lo[node] <= hi[node])) {
                EXPECT_TRUE(std::isnan(value)) << "of none that counts";
                continue;
            }
            EXPECT_EQ(finiteValue(*with, mesh.count() + node), value);
            EXPECT_GE(value, lo[node] - 1e-9);
            EXPECT_LE(value, hi[node] + 1e-9);
            const std::size_t i = node % 12, j = node / 12 % 11, k = node / 132;
            const bool isWithin = i > 1 && j > 1 && k > 1 && i < 10 && j < 9 && k < 8;
            EXPECT_NEAR(value, slope(at), isWithin ? 2e-3 : INFINITY) << int(cut);
        }
        EXPECT_EQ(withNodeValues(with), with);
        const auto many = withNodeValues(fieldOf(grid, values), 3);
        for (std::size_t node = 0; node < cells.points.size(); ++node)
            EXPECT_TRUE(many->atNodes[node] == with->atNodes[node] ||
                        std::isnan(with->atNodes[node]));
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
