#include "timeseries/grid/grid.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <stdexcept>
#include <vector>

namespace timeseries {
namespace {

Axis axis(std::vector<double> coordinates) { return {"a", "m", std::move(coordinates)}; }

Axis counted(std::size_t n, double first = 0, double step = 1) {
    Axis axis{"x", "index", {}};
    for (std::size_t i = 0; i < n; ++i)
        axis.coordinates.push_back(first + step * static_cast<double>(i));
    return axis;
}

TEST(Axis, WidthIsHalfTheWayToEachNeighbour) {
    const Axis a = axis({0, 1, 3, 7});
    EXPECT_EQ(a.width(0), 1);  // the whole step to its only neighbour
    EXPECT_EQ(a.width(1), 0.5 + 1);
    EXPECT_EQ(a.width(2), 1 + 2.0);
    EXPECT_EQ(a.width(3), 4);
}

TEST(Axis, WidthOfADescendingAxisIsNegative) {
    const Axis a = axis({5, 3, 2});
    EXPECT_EQ(a.width(0), -2);
    EXPECT_EQ(a.width(1), -1.5);
    EXPECT_EQ(a.width(2), -1);
}

TEST(Axis, WidthOfASinglePointIsZero) { EXPECT_EQ(axis({4}).width(0), 0); }

TEST(Axis, EvenStepsAreUniform) {
    EXPECT_TRUE(counted(5).uniform());
    EXPECT_TRUE(counted(5, 10, -0.25).uniform());
    EXPECT_TRUE(axis({3}).uniform());
    EXPECT_TRUE(axis({3, 3.5}).uniform());
}

TEST(Axis, FloatRoundingOfCoordinatesIsStillUniform) {
    Axis a = axis({});
    for (int i = 0; i < 360; ++i)
        a.coordinates.push_back(static_cast<float>(-180 + (static_cast<double>(i) + 0.5) / 3));
    EXPECT_TRUE(a.uniform());
}

TEST(Axis, UnevenStepsAreNotUniform) {
    EXPECT_FALSE(axis({0, 1, 3}).uniform());
    EXPECT_FALSE(axis({0, 1, 2.01, 3}).uniform());
}

TEST(Grid, NumbersPointsXFastest) {
    const Grid grid({axis({10, 20, 30}), axis({1, 2}), axis({-1, -2, -4, -8})});
    EXPECT_EQ(grid.size(), (std::array<std::size_t, 3>{3, 2, 4}));
    EXPECT_EQ(grid.count(), 24U);
    std::uint64_t index = 0;
    for (double z : {-1, -2, -4, -8})
        for (double y : {1, 2})
            for (double x : {10, 20, 30}) EXPECT_EQ(grid.position(index++), glm::dvec3(x, y, z));
}

TEST(Grid, CellIsMadeOfTheWidths) {
    const std::array<Axis, 3> axes{axis({0, 1, 3}), axis({5, 3}), axis({0, 10, 40, 50})};
    const Grid grid(axes);
    for (std::uint64_t index = 0; index < grid.count(); ++index) {
        const glm::dmat3 cell = grid.cell(index);
        const std::uint64_t at[] = {index % 3, index / 3 % 2, index / 6};
        for (int column = 0; column < 3; ++column)
            for (int row = 0; row < 3; ++row)
                EXPECT_EQ(cell[column][row],
                          row == column ? axes[static_cast<std::size_t>(row)].width(at[row]) : 0.0)
                    << "point " << index << " column " << column << " row " << row;
    }
}

TEST(Grid, AnAxisOfOnePointTakesTheSmallestMeanStep) {
    // Mean steps: (6 - 0) / 2 = 3 along x, |1 - 5| / 2 = 2 along y.
    const Grid grid({axis({0, 1, 6}), axis({5, 4, 1}), axis({100})});
    for (std::uint64_t index = 0; index < grid.count(); ++index) {
        EXPECT_EQ(grid.cell(index)[2], glm::dvec3(0, 0, 2));
        EXPECT_EQ(grid.position(index).z, 100);
    }
}

TEST(Grid, CellsOfEverySmallShapeAreNotSingular) {
    for (std::size_t nx : {1, 2, 3})
        for (std::size_t ny : {1, 2, 3})
            for (std::size_t nz : {1, 2, 3}) {
                const Grid grid({counted(nx, 7, 0.5), counted(ny, 7, -2), counted(nz, 7, 3)});
                for (std::uint64_t index = 0; index < grid.count(); ++index)
                    EXPECT_GT(std::abs(glm::determinant(grid.cell(index))), 0.0)
                        << nx << " x " << ny << " x " << nz;
            }
}

TEST(Grid, ASinglePointHasAUnitCell) {
    const Grid grid({axis({3}), axis({-2}), axis({1e7})});
    EXPECT_EQ(grid.count(), 1U);
    EXPECT_EQ(grid.position(0), glm::dvec3(3, -2, 1e7));
    EXPECT_EQ(grid.cell(0), glm::dmat3(1.0));
}

TEST(Grid, FarOffCoordinatesKeepTheirSpacing) {
    const Grid grid({counted(5, 1e7, 1e-3), counted(2), counted(2)});
    for (std::uint64_t x = 1; x < 5; ++x)
        EXPECT_NEAR(grid.position(x).x - grid.position(x - 1).x, 1e-3, 1e-8);
}

TEST(Grid, IsUniformWhenAllAxesAre) {
    EXPECT_TRUE(Grid({counted(3), counted(4, 0, 2), counted(1)}).uniform());
    EXPECT_FALSE(Grid({counted(3), axis({0, 1, 4}), counted(3)}).uniform());
}

TEST(Grid, RefusesUnusableAxes) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    for (const std::vector<double>& bad : std::initializer_list<std::vector<double>>{{},
                                                                                     {nan},
                                                                                     {infinity},
                                                                                     {0, nan},
                                                                                     {0, 1, nan, 3},
                                                                                     {0, infinity},
                                                                                     {-infinity, 0},
                                                                                     {0, 0},
                                                                                     {0, 1, 1},
                                                                                     {0, 1, 0.5},
                                                                                     {2, 1, 1},
                                                                                     {2, 1, 3}})
        for (std::size_t which = 0; which < 3; ++which) {
            std::array<Axis, 3> axes{counted(2), counted(2), counted(2)};
            axes[which] = axis(bad);
            EXPECT_THROW(Grid{axes}, std::invalid_argument)
                << bad.size() << " coordinates on axis " << which;
        }
}

TEST(Grid, RefusesMorePointsThanFitSixtyThreeBits) {
    const std::size_t n = (std::size_t{1} << 21) + 1;  // n^3 > 2^63
    EXPECT_THROW(Grid({counted(n), counted(n), counted(n)}), std::invalid_argument);
}

TEST(Grid, CountsBeyondThirtyTwoBits) {
    EXPECT_EQ(Grid({counted(65536), counted(65536), counted(3)}).count(), std::uint64_t{3} << 32);
}

TEST(Grid, ComparesByAxes) {
    EXPECT_EQ(Grid({counted(3), counted(2), counted(1)}),
              Grid({counted(3), counted(2), counted(1)}));
    EXPECT_FALSE(Grid({counted(3), counted(2), counted(1)}) ==
                 Grid({counted(2), counted(3), counted(1)}));
}

TEST(Grid, TellsWhichPlacesLieWithinClosedEnds) {
    for (const std::vector<double>& along :
         {std::vector<double>{-2, -1, 0, 1, 5}, {5, 1, 0, -1, -2}}) {
        const Grid grid({axis({0, 1}), axis(along), axis({7})});
        EXPECT_EQ(grid.ends(1).least, -2);
        EXPECT_EQ(grid.ends(1).most, 5);
        for (double lo = -3; lo <= 6; lo += 0.5)
            for (double hi = -3; hi <= 6; hi += 0.5) {
                std::vector<std::size_t> within;
                for (std::size_t i = 0; i < along.size(); ++i)
                    if (lo <= along[i] && along[i] <= hi) within.push_back(i);
                const auto places = grid.placesWithin(1, lo, hi);
                ASSERT_EQ(places.has_value(), !within.empty()) << lo << " to " << hi;
                if (!places) continue;
                EXPECT_EQ(places->first, within.front()) << lo << " to " << hi;
                EXPECT_EQ(places->last, within.back()) << lo << " to " << hi;
            }
    }
}

TEST(Grid, TheNearestPlaneIsOneOfPoints) {
    const Grid grid({axis({10, 4, 1}), axis({2}), axis({0, 1})});
    EXPECT_EQ(grid.nearestPlane(0, 7.1), 10);
    EXPECT_EQ(grid.nearestPlane(0, 6.9), 4);
    EXPECT_EQ(grid.nearestPlane(0, -100), 1);
    EXPECT_EQ(grid.nearestPlane(1, 100), 2);
}

TEST(Grid, RelabelledItHasItsPointsUnderOtherNames) {
    Axis down = axis({1, 2});
    down.down = true;
    CoordinateFrame frame;
    frame.origin = {1, 2, 3};
    const Grid grid({axis({0, 1, 3}), axis({5, 4}), down}, frame);
    const Grid same = grid.relabelled({"lon", "", "depth"}, {true, false, true});
    EXPECT_EQ(same.frame(), grid.frame());
    for (std::size_t a = 0; a < 3; ++a) {
        EXPECT_EQ(same.axes()[a].coordinates, grid.axes()[a].coordinates);
        EXPECT_EQ(same.axes()[a].units, grid.axes()[a].units);
    }
    EXPECT_EQ(same.axes()[0].name, "lon");
    EXPECT_EQ(same.axes()[1].name, grid.axes()[1].name);
    EXPECT_EQ(same.axes()[2].name, "depth");
    EXPECT_TRUE(same.axes()[0].down);
    EXPECT_FALSE(same.axes()[1].down);
    EXPECT_FALSE(same.axes()[2].down);
    EXPECT_EQ(grid.relabelled({}, {}), grid);
}

TEST(Grid, ObliqueAxesPlaceEveryPointAndCell) {
    // Sheared and mirrored; the coordinates along the axes are uneven, descending, and not from 0.
    const glm::dvec3 i(0.6, 0, 0.8), j(0, -1, 0), k(-0.48, 0.6, 0.64), origin(100, -20, 3);
    const std::array<Axis, 3> axes{axis({0, 1, 3}), axis({5, 3}), axis({0, 10, 40, 50})};
    const Grid grid(axes, {{i, j, k}, origin});
    EXPECT_LT(glm::determinant(grid.frame().directions), 0);
    for (std::uint64_t index = 0; index < grid.count(); ++index) {
        const std::uint64_t x = index % 3, y = index / 3 % 2, z = index / 6;
        const glm::dvec3 expected = origin + axes[0].coordinates[x] * i +
                                    axes[1].coordinates[y] * j + axes[2].coordinates[z] * k;
        EXPECT_LT(glm::distance(grid.position(index), expected), 1e-12) << index;
        const glm::dmat3 cell = grid.cell(index);
        EXPECT_LT(glm::distance(cell[0], axes[0].width(x) * i), 1e-12) << index;
        EXPECT_LT(glm::distance(cell[1], axes[1].width(y) * j), 1e-12) << index;
        EXPECT_LT(glm::distance(cell[2], axes[2].width(z) * k), 1e-12) << index;
    }
    EXPECT_FALSE(grid == Grid(axes)) << "other places";
}

TEST(Grid, DirectionsThatPlaceNothingAreRefused) {
    const std::array<Axis, 3> axes{axis({0, 1}), axis({0, 1}), axis({0, 1})};
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), half(std::sqrt(0.5), std::sqrt(0.5), 0);
    for (const glm::dmat3& flawed :
         {glm::dmat3(x, y, half), glm::dmat3(x, x, z), glm::dmat3(x, y, glm::dvec3(0)),
          glm::dmat3(x, y, 2.0 * z), glm::dmat3(x, glm::dvec3(nan), z)})
        EXPECT_THROW(Grid(axes, {flawed}), std::invalid_argument);
    EXPECT_NO_THROW(Grid(axes, {glm::dmat3(x, half, z)}));
}

TEST(AlignedWith, TellsWhichCoordinateEachAxisRunsAlong) {
    const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    using Along = std::array<int, 3>;
    EXPECT_EQ(alignedWith(glm::dmat3(1.0)), (Along{0, 1, 2}));
    EXPECT_EQ(alignedWith({y, -z, x}), (Along{1, 2, 0}));
    EXPECT_EQ(alignedWith({glm::dvec3(1, 1e-7, 0), y, z}), (Along{0, 1, 2})) << "rounding";
    EXPECT_FALSE(alignedWith({x, x, z}));
    EXPECT_FALSE(alignedWith({x, y, glm::dvec3(0)}));
    const double angle = 1e-4;
    EXPECT_FALSE(alignedWith({glm::dvec3(std::cos(angle), std::sin(angle), 0),
                              glm::dvec3(-std::sin(angle), std::cos(angle), 0), z}));
}

// At the ends of rows and slices, where quotients are whole or nearly so, up to the largest index.
TEST(IndicesAlong, AreThoseOfADivision) {
    for (const auto& n : {std::array{7u, 5u, 3u},
                          {1u, 1u, 9u},
                          {1u, 4294967295u, 1u},
                          {3u, 1u, 1431655765u},
                          {65536u, 65536u, 1u},
                          {4294967295u, 1u, 1u},
                          {1625u, 1625u, 1626u}}) {
        const glm::uvec3 size(n[0], n[1], n[2]);
        const IndicesAlong along(size);
        const std::uint64_t count =
            std::min<std::uint64_t>(std::uint64_t{n[0]} * n[1] * n[2], 4294967296);
        std::vector<std::uint64_t> near{0, count - 1};
        for (const std::uint64_t step : {std::uint64_t{n[0]}, std::uint64_t{n[0]} * n[1]})
            for (const std::uint64_t times : {std::uint64_t{1}, count / step / 2, count / step})
                for (const int beside : {-1, 0, 1})
                    near.push_back(step * times + std::uint64_t(beside));
        for (const std::uint64_t i : near) {
            if (i >= count) continue;
            const auto index = static_cast<std::uint32_t>(i);
            EXPECT_EQ(along(index), glm::uvec3(indicesOf(i, glm::u64vec3(size)))) << i;
        }
    }
}

}  // namespace
}  // namespace timeseries
