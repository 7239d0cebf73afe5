#include "render/lattice.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

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

TEST(Lattice, OneUnitKeepsItsProportionsAndTheHalfDiagonalIsOne) {
    const Lattice lattice(Grid({axis(11), axis(21), axis(6)}));
    EXPECT_NEAR(glm::length(lattice.boxHalf()), 1, 1e-12);
    EXPECT_NEAR(lattice.boxHalf().y / lattice.boxHalf().x, 2, 1e-12);
    EXPECT_NEAR(lattice.boxHalf().z / lattice.boxHalf().x, 0.5, 1e-12);
    // Cubic cells: l is their side.
    EXPECT_NEAR(lattice.unitLength(), lattice.cell(0).x, 1e-12);
}

TEST(Lattice, OtherUnitsAreFittedToHalfTheLongest) {
    const Grid ocean({in("degrees_east", axis(181, 0, 2)), in("degrees_north", axis(91, -90, 2)),
                      in("m", axis(11, 0, 100), true)});
    const Lattice lattice(ocean);
    EXPECT_NEAR(lattice.boxHalf().y / lattice.boxHalf().x, 0.5, 1e-12) << "degrees stay alike";
    EXPECT_NEAR(lattice.boxHalf().z / lattice.boxHalf().x, 0.5, 1e-12) << "metres are fitted";
    EXPECT_EQ(stretchText(ocean, lattice),
              "5.56 m x drawn as 1° x");  // 1000 m over 180 degrees
}

TEST(Lattice, DownwardAxesAreDrawnDownwards) {
    const Grid grid({axis(3), axis(3), in("m", axis(5), true)});
    const Lattice lattice(grid);
    EXPECT_GT(lattice.position(0).z, lattice.position(grid.count() - 1).z);
}

TEST(Lattice, DescendingCoordinatesStandWhereTheyShould) {
    const Lattice lattice(Grid({axis(5, 10, -1), axis(5), axis(5)}));
    EXPECT_GT(lattice.position(0).x, lattice.position(4).x);
    EXPECT_GT(lattice.cell(0).x, 0);
}

TEST(Lattice, FlatAndSinglePointGridsHaveThickness) {
    const Lattice flat(Grid({axis(5), axis(9), axis(1)}));
    EXPECT_NEAR(flat.cell(0).z, flat.cell(0).x, 1e-12);
    EXPECT_EQ(flat.boxHalf().z, 0);
    const Lattice point(Grid({axis(1, 1e7), axis(1), axis(1)}));
    EXPECT_EQ(point.position(0), glm::dvec3(0));
    EXPECT_EQ(point.cell(0), glm::dvec3(1));
}

TEST(Lattice, OffsetAndScaleOfTheCoordinatesDoNotChangeThePicture) {
    const Lattice plain(Grid({axis(7), axis(5), axis(3)}));
    // 1e7 with steps of 1/1024: exact in double, far beyond float.
    const double h = 1.0 / 1024;
    const Lattice moved(Grid({axis(7, 1e7, h), axis(5, -1e7, h), axis(3, 0, h)}));
    for (std::uint64_t i = 0; i < 105; ++i)
        EXPECT_LT(glm::length(plain.position(i) - moved.position(i)), 1e-12) << i;
}

TEST(Lattice, VeryLargeAndVerySmallGridsFitTheWorldToo) {
    for (const double unit : {1e300, 1e-300}) {
        const Lattice lattice(Grid({axis(5, 0, unit), axis(5, 0, unit), axis(5, 0, unit)}));
        EXPECT_NEAR(glm::length(lattice.boxHalf()), 1, 1e-12) << unit;
        EXPECT_NEAR(glm::length(lattice.position(0)), 1, 1e-12) << unit;
    }
}

TEST(Lattice, AxesBeyondAllProportionStayFinite) {
    Axis widest = axis(2, -1.7e308), thinnest = axis(6, 5e-324, 5e-324);
    widest.coordinates[1] = 1.7e308;
    for (const Grid& grid : {Grid({widest, axis(5), axis(4)}), Grid({thinnest, axis(5), axis(4)}),
                             Grid({widest, thinnest, in("K", axis(4))})}) {
        for (const auto stretch : {std::optional<glm::dvec3>(), std::optional(glm::dvec3(1)),
                                   std::optional(glm::dvec3(1e308, 1, 1e-300))}) {
            const Lattice lattice(grid, stretch);
            EXPECT_NEAR(glm::length(lattice.boxHalf()), 1, 1e-9);
            EXPECT_GT(lattice.unitLength(), 0);
            for (std::uint64_t i = 0; i < grid.count(); ++i) {
                EXPECT_LE(glm::length(lattice.position(i)), 1 + 1e-9);
                const glm::vec3 cell(lattice.cell(i));
                EXPECT_GT(cell.x * cell.y * cell.z, 0);
            }
        }
    }
}

TEST(Lattice, AStretchIsTakenAsGiven) {
    const Lattice lattice(Grid({axis(11), axis(11), axis(11)}), glm::dvec3(1, 2, 3));
    EXPECT_NEAR(lattice.boxHalf().y / lattice.boxHalf().x, 2, 1e-12);
    EXPECT_NEAR(lattice.boxHalf().z / lattice.boxHalf().x, 3, 1e-12);
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

TEST(IndexBox, OutsideTheGridHoldsNothing) {
    const IndexBox box = indexBox(Grid({axis(4), axis(4), axis(4)}), {5, 0, 0}, {9, 3, 3});
    for (unsigned i = 0; i < 4; ++i) EXPECT_FALSE(box.holds({i, i, i}));
}

}  // namespace
}  // namespace render
