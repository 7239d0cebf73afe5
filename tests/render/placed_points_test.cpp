#include "render/points/placed_points.h"
#include "render/annotate/stretch_text.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>

#include "tests/support/scenes.h"

namespace render {
namespace {

using tests::axis;
using timeseries::Axis;
using timeseries::Grid;

Axis in(const char* units, Axis a, bool down = false) {
    a.units = units;
    a.down = down;
    return a;
}

TEST(PlacedPoints, OneUnitKeepsItsProportionsAndTheHalfDiagonalIsOne) {
    const PlacedPoints placed(Grid({axis(11), axis(21), axis(6)}));
    EXPECT_NEAR(glm::length(placed.boxHalf()), 1, 1e-12);
    EXPECT_NEAR(placed.boxHalf().y / placed.boxHalf().x, 2, 1e-12);
    EXPECT_NEAR(placed.boxHalf().z / placed.boxHalf().x, 0.5, 1e-12);
    // Cubic cells: l is their side.
    EXPECT_NEAR(placed.unitLength(), placed.cell(0).x, 1e-12);
}

TEST(PlacedPoints, OtherUnitsAreFittedToHalfTheLongest) {
    const Grid ocean({in("degrees_east", axis(181, 0, 2)), in("degrees_north", axis(91, -90, 2)),
                      in("m", axis(11, 0, 100), true)});
    const PlacedPoints placed(ocean);
    EXPECT_NEAR(placed.boxHalf().y / placed.boxHalf().x, 0.5, 1e-12) << "degrees stay alike";
    EXPECT_NEAR(placed.boxHalf().z / placed.boxHalf().x, 0.5, 1e-12) << "metres are fitted";
    EXPECT_EQ(stretchText(ocean, placed),
              "5.56 m x drawn as 1° x");  // 1000 m over 180 degrees
}

// The same length whatever it is called and counted in.
TEST(PlacedPoints, UnitsThatCompareKeepTheirProportions) {
    for (const char* metre : {"m", "meter", "metre", "meters"}) {
        const Grid grid({in(metre, axis(21)), in("m", axis(11)), in("km", axis(11, 0, 0.002))});
        const PlacedPoints placed(grid);
        EXPECT_NEAR(placed.boxHalf().y / placed.boxHalf().x, 0.5, 1e-12) << metre;
        EXPECT_NEAR(placed.boxHalf().z / placed.boxHalf().x, 1, 1e-12) << metre;
        EXPECT_EQ(stretchText(grid, placed), "") << metre;
        EXPECT_EQ(stretchText(grid, PlacedPoints(grid, glm::dvec3(1, 1, 2000))), "x \u00d7 2");
    }
    // What measures nothing is as long as another that does not.
    const Grid bare({in("", axis(21)), in("", axis(11)), in("m", axis(11))});
    EXPECT_NEAR(PlacedPoints(bare).boxHalf().y / PlacedPoints(bare).boxHalf().x, 0.5, 1e-12);
    EXPECT_NEAR(PlacedPoints(bare).boxHalf().z / PlacedPoints(bare).boxHalf().x, 0.5, 1e-12);
}

TEST(PlacedPoints, DownwardAxesAreDrawnDownwards) {
    const Grid grid({axis(3), axis(3), in("m", axis(5), true)});
    const PlacedPoints placed(grid);
    EXPECT_GT(placed.position(0).z, placed.position(grid.count() - 1).z);
}

TEST(PlacedPoints, DescendingCoordinatesStandWhereTheyShould) {
    const PlacedPoints placed(Grid({axis(5, 10, -1), axis(5), axis(5)}));
    EXPECT_GT(placed.position(0).x, placed.position(4).x);
    EXPECT_GT(placed.cell(0).x, 0);
}

TEST(PlacedPoints, FlatAndSinglePointGridsHaveThickness) {
    const PlacedPoints flat(Grid({axis(5), axis(9), axis(1)}));
    EXPECT_NEAR(flat.cell(0).z, flat.cell(0).x, 1e-12);
    EXPECT_EQ(flat.boxHalf().z, 0);
    const PlacedPoints point(Grid({axis(1, 1e7), axis(1), axis(1)}));
    EXPECT_EQ(point.position(0), glm::dvec3(0));
    EXPECT_EQ(point.cell(0), glm::dvec3(1));
}

TEST(PlacedPoints, OffsetAndScaleOfTheCoordinatesDoNotChangeThePicture) {
    const PlacedPoints plain(Grid({axis(7), axis(5), axis(3)}));
    // 1e7 with steps of 1/1024: exact in double, far beyond float.
    const double h = 1.0 / 1024;
    const PlacedPoints moved(Grid({axis(7, 1e7, h), axis(5, -1e7, h), axis(3, 0, h)}));
    for (std::uint64_t i = 0; i < 105; ++i)
        EXPECT_LT(glm::length(plain.position(i) - moved.position(i)), 1e-12) << i;
}

TEST(PlacedPoints, VeryLargeAndVerySmallGridsFitTheWorldToo) {
    for (const double unit : {1e300, 1e-300}) {
        const PlacedPoints placed(Grid({axis(5, 0, unit), axis(5, 0, unit), axis(5, 0, unit)}));
        EXPECT_NEAR(glm::length(placed.boxHalf()), 1, 1e-12) << unit;
        EXPECT_NEAR(glm::length(placed.position(0)), 1, 1e-12) << unit;
    }
}

TEST(PlacedPoints, AxesBeyondAllProportionStayFinite) {
    Axis widest = axis(2, -1.7e308), thinnest = axis(6, 5e-324, 5e-324);
    widest.coordinates[1] = 1.7e308;
    for (const Grid& grid : {Grid({widest, axis(5), axis(4)}), Grid({thinnest, axis(5), axis(4)}),
                             Grid({widest, thinnest, in("K", axis(4))})}) {
        for (const auto stretch : {std::optional<glm::dvec3>(), std::optional(glm::dvec3(1)),
                                   std::optional(glm::dvec3(1e308, 1, 1e-300))}) {
            const PlacedPoints placed(grid, stretch);
            EXPECT_NEAR(glm::length(placed.boxHalf()), 1, 1e-9);
            EXPECT_GT(placed.unitLength(), 0);
            for (std::uint64_t i = 0; i < grid.count(); ++i) {
                EXPECT_LE(glm::length(placed.position(i)), 1 + 1e-9);
                const glm::vec3 cell(placed.cell(i));
                EXPECT_GT(cell.x * cell.y * cell.z, 0);
            }
        }
    }
}

TEST(PlacedPoints, CoordinatesAlongTheAxesComeBack) {
    const PlacedPoints placed(Grid({axis(5, 100), in("Pa", axis(9, 0, 1e4), true), axis(1, 7)}),
                              glm::dvec3(1, 1e-5, 2));
    for (const glm::dvec3 at : {glm::dvec3(100, 0, 7), glm::dvec3(103.25, 5e4, 7.5)}) {
        const glm::dvec3 back = placed.gridFromAxes(placed.axesFromGrid(at));
        for (int a = 0; a < 3; ++a) EXPECT_NEAR(back[a], at[a], 1e-9 * (1 + at[a]));
    }
}

TEST(PlacedPoints, AStretchIsTakenAsGiven) {
    const PlacedPoints placed(Grid({axis(11), axis(11), axis(11)}), glm::dvec3(1, 2, 3));
    EXPECT_NEAR(placed.boxHalf().y / placed.boxHalf().x, 2, 1e-12);
    EXPECT_NEAR(placed.boxHalf().z / placed.boxHalf().x, 3, 1e-12);
}

std::array<Axis, 3> unequal() { return {axis(5), axis(4, 7, -0.5), axis(3, 0, 2)}; }

TEST(PlacedPoints, ATurnedGridIsTheUprightOneTurned) {
    const glm::dmat3 turn = tests::rotation(0.7);
    const PlacedPoints upright{Grid(unequal())}, turned{Grid(unequal(), {turn, {1e6, 0, -3}})};
    for (std::uint64_t i = 0; i < 60; ++i)
        EXPECT_LT(glm::distance(turned.position(i), turn * upright.position(i)), 1e-12) << i;
    EXPECT_NEAR(turned.unitLength(), upright.unitLength(), 1e-12);
    EXPECT_TRUE(PlacedPoints(Grid({axis(5), axis(4), axis(3)}, {turn})).cubes());
    EXPECT_FALSE(turned.cubes());
}

TEST(PlacedPoints, AShearedGridKeepsTheFilesProportions) {
    const Grid grid(unequal(), {tests::leaning({1, 0, 0}, {1, 1, 0}, {0.5, -0.3, 1}), {1, 2, 3}});
    const PlacedPoints placed(grid, glm::dvec3(1));
    // One scale and one offset take the file's places to the world's.
    const glm::dvec3 first = grid.position(0), last = grid.position(59);
    const double scale =
        glm::distance(placed.position(0), placed.position(59)) / glm::distance(first, last);
    double farthest = 0, volume = 0;
    for (std::uint64_t i = 0; i < 60; ++i) {
        const glm::dvec3 expected = scale * (grid.position(i) - 0.5 * (first + last));
        EXPECT_LT(glm::distance(placed.position(i), expected), 1e-12) << i;
        farthest = std::max(farthest, glm::length(placed.position(i)));
        volume += std::pow(scale, 3) * std::abs(glm::determinant(grid.cell(i))) / 60;
    }
    EXPECT_NEAR(farthest, 1, 1e-12);
    EXPECT_NEAR(placed.unitLength(), std::cbrt(volume), 1e-12);
    EXPECT_FALSE(PlacedPoints(Grid({axis(5), axis(5), axis(5)}, grid.frame())).cubes());
    const glm::dvec3 corner = placed.boxHalfEdges() * glm::dvec3(-1, 1, -1);
    EXPECT_LT(glm::distance(corner, placed.position(0)), 1e-12) << "the second axis descends";
}

TEST(PlacedPoints, LengtheningHoldsForEveryDirection) {
    std::mt19937 random(3);
    std::normal_distribution<double> any;
    const auto vector = [&] { return glm::dvec3(any(random), any(random), any(random)); };
    for (int i = 0; i < 50; ++i) {
        const glm::dmat3 m = tests::leaning(vector(), vector(), vector());
        if (std::abs(glm::determinant(m)) < 1e-2) continue;
        const auto bounds = PlacedPoints(Grid({axis(2), axis(2), axis(2)}, {m})).lengthening();
        // By power iteration: the longest image, and the longest of the inverse.
        const auto longest = [&](const glm::dmat3& by) {
            glm::dvec3 v(0.3, 0.5, 0.8);
            for (int n = 0; n < 20000; ++n) v = glm::normalize(glm::transpose(by) * (by * v));
            return glm::length(by * v);
        };
        EXPECT_NEAR(bounds.most, longest(m), 1e-6) << i;
        EXPECT_NEAR(1 / bounds.least, longest(glm::inverse(m)), 1e-6 / bounds.least) << i;
    }
    const auto rigid = PlacedPoints(Grid(unequal(), {tests::rotation(2)})).lengthening();
    EXPECT_NEAR(rigid.least, 1, 1e-7);
    EXPECT_NEAR(rigid.most, 1, 1e-7);
}

TEST(IndexBox, HoldsThePointsInsideClosedRangesOnly) {
    const Grid grid({axis(10), axis(10, 9, -1), axis(10)});
    const glm::dvec3 lo(2, 2.5, -100), hi(4, 5, 100);
    const IndexBox box = indexBox(grid, lo, hi);
    for (std::uint64_t i = 0; i < grid.count(); ++i) {
        const glm::dvec3 p = grid.position(i);
        const bool inside =
            glm::all(glm::lessThanEqual(lo, p)) && glm::all(glm::lessThanEqual(p, hi));
        EXPECT_EQ(box.holds({i % 10, i / 10 % 10, i / 100}), inside) << i;
    }
}

TEST(IndexBox, OfAnObliqueGridCountsAlongItsAxes) {
    const std::array<Axis, 3> axes{axis(10), axis(10), axis(10)};
    const glm::dvec3 lo(2, 3, 4), hi(5, 6, 7);
    const IndexBox oblique = indexBox(Grid(axes, {tests::rotation(1), {50, 50, 50}}), lo, hi);
    const IndexBox upright = indexBox(Grid(axes), lo, hi);
    EXPECT_EQ(oblique.lo, upright.lo);
    EXPECT_EQ(oblique.hi, upright.hi);
}

TEST(IndexBox, OutsideTheGridHoldsNothing) {
    const IndexBox box = indexBox(Grid({axis(4), axis(4), axis(4)}), {5, 0, 0}, {9, 3, 3});
    for (unsigned i = 0; i < 4; ++i) EXPECT_FALSE(box.holds({i, i, i}));
}

TEST(PlacedPoints, AxesOfOneUnitAreNeverStretchedHoweverFlat) {
    const auto metres = [](std::size_t n, double step) {
        return Axis{.name = "x", .units = "m", .coordinates = tests::axis(n, 0, step).coordinates};
    };
    for (const double height : {4.0, 1e-3}) {
        const Grid flat({metres(513, 1), metres(33, 1), metres(5, height / 4)});
        const PlacedPoints placed(flat);
        const glm::dvec3 half = placed.boxHalf();
        EXPECT_NEAR(half.y / half.x, 32.0 / 512, 1e-12);
        EXPECT_NEAR(half.z / half.x, height / 512, 1e-12);
        EXPECT_EQ(stretchText(flat, placed), "");
    }
    // Another unit is fitted, whatever its numbers are.
    std::array axes{metres(513, 1), metres(33, 1), metres(5, 1)};
    axes[2].units = "hPa";
    const PlacedPoints fitted{Grid(axes)};
    EXPECT_NEAR(fitted.boxHalf().z / fitted.boxHalf().x, 0.5, 1e-12);
}

// To three digits, so that what they do not show is not told.
TEST(PlacedPoints, AStretchIsToldWhereItsDigitsShowIt) {
    const Grid grid({in("m", axis(5)), in("m", axis(5)), in("m", axis(5))});
    for (const auto& [times, told] : {std::pair{2.0, "x \u00d7 2"},
                                      {1.006, "x \u00d7 1.01"},
                                      {1.004, ""},
                                      {0.9996, ""},
                                      {0.9994, "x \u00d7 0.999"}})
        EXPECT_EQ(stretchText(grid, PlacedPoints(grid, glm::dvec3(1, 1, times))), told) << times;
}

TEST(PlacedPoints, TheDomainHoldsHalfACellBeyondTheOutermostPoints) {
    auto uneven = tests::axis(4);
    uneven.coordinates = {0, 1, 3, 7};
    uneven.down = true;
    const Grid grid({tests::axis(11), tests::axis(5, 3, -2), uneven});
    const PlacedPoints placed(grid, glm::dvec3(1));
    const PlacedPoints::Box box = placed.domain();
    const glm::dvec3 per = glm::abs(placed.scale()), half = placed.boxHalf();
    EXPECT_NEAR(box.hi.x, half.x + 0.5 * per.x, 1e-12);
    EXPECT_NEAR(box.lo.y, -half.y - 1.0 * per.y, 1e-12);
    // Downwards: the last cell, 4 deep, is the lowest.
    EXPECT_NEAR(box.lo.z, -half.z - 2.0 * per.z, 1e-12);
    EXPECT_NEAR(box.hi.z, half.z + 0.5 * per.z, 1e-12);
    EXPECT_TRUE(placed.longCells());  // 4 against 1
    EXPECT_FALSE(
        PlacedPoints(Grid({tests::axis(9), tests::axis(9), tests::axis(9, 0, 2.9)})).longCells());
}

}  // namespace
}  // namespace render
