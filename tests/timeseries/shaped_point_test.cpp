#include "timeseries/grid/shaped_point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "timeseries/grid/axis_rings.h"

namespace timeseries {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Magnitudes ascend with their codes, and each is the nearest to itself and to what is just nearer
// to it than to the next.
void expectNearest(const SmallFloat& form) {
    double before = form.magnitude(0);
    EXPECT_EQ(before, 0);
    for (std::uint32_t code = 1; code <= form.last(); code += 1 + code / 5000) {
        before = form.magnitude(code - 1);
        const double here = form.magnitude(code), middle = (before + here) / 2;
        ASSERT_GT(here, before) << code;
        ASSERT_EQ(form.code(here), code);
        ASSERT_EQ(form.code(middle * (1 - 1e-12)), code - 1);
        ASSERT_EQ(form.code(middle * (1 + 1e-12)), code);
    }
    const double most = form.magnitude(form.last());
    for (const double beyond : {2 * most, 1e300, kInfinity})
        EXPECT_EQ(form.code(beyond), form.last());
    EXPECT_EQ(form.code(5e-324), 0u);
}

TEST(SmallFloats, AreTheNearestThereAre) {
    expectNearest(ShapedPoint::kPlace);
    expectNearest(ShapedPoint::kSide);
    expectNearest(ShapedPoint::kRightSide);
    expectNearest(ShapedPoint::kFirstSlope);
    expectNearest(ShapedPoint::kSlope);
}

// Those of a power of two and more to half a unit of their mantissa's last place.
TEST(SmallFloats, AreAsNearAsTheirMantissaSays) {
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> exponent(-13, 1);
    for (int i = 0; i < 10000; ++i) {
        const double x = std::exp2(exponent(random));
        const double kept = ShapedPoint::kPlace.magnitude(ShapedPoint::kPlace.code(x));
        EXPECT_LE(std::abs(kept - x), std::ldexp(x, -23));
    }
}

TEST(ShapedPoints, LieWhereTheyDo) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> some(-2, 2);
    for (int i = 0; i < 10000; ++i) {
        const double scale = std::ldexp(1, -static_cast<int>(random() % 40));
        const glm::dvec3 at(some(random), scale * some(random), -scale);
        const glm::vec3 kept = ShapedPoint(at).at();
        for (int c = 0; c < 3; ++c)
            EXPECT_LE(std::abs(kept[c] - at[c]),
                      std::max(std::ldexp(std::abs(at[c]), -23), 0x1p-36));
    }
}

TEST(ShapedPoints, WhatIsNoNumberIsNoPlace) {
    for (const double none : {std::nan(""), kInfinity, -kInfinity}) {
        const ShapedPoint point(glm::dvec3(1, none, -2));
        EXPECT_EQ(point.at().x, 1);
        EXPECT_TRUE(std::isnan(point.at().y));
        EXPECT_EQ(point.at().z, -2);
        EXPECT_FALSE(point.hasCell());
        EXPECT_EQ(point.cell().determinant(), 0);
    }
    for (const double far : {4.0, 1e30}) {  // more than any: a place for all that
        EXPECT_NEAR(ShapedPoint(glm::dvec3(far)).at().x, 4, 1e-6);
        EXPECT_NEAR(ShapedPoint(glm::dvec3(-far)).at().x, -4, 1e-6);
    }
}

struct SomeCells {
    std::mt19937_64 random{6};
    double size(double least, double most) {
        std::uniform_real_distribution<double> exponent(std::log(least), std::log(most));
        return std::exp(exponent(random));
    }
    LowerTriangle<double> next(double steepest) {
        std::uniform_real_distribution<double> slope(-steepest, steepest);
        const glm::dvec3 d(size(1e-9, 10), size(1e-9, 10), size(1e-9, 10));
        return {d, {d.y * slope(random), d.z * slope(random), d.z * slope(random)}};
    }
};

TEST(ShapedPoints, CellsKeepTheirVolumesAndNearlyTheirShapes) {
    SomeCells cells;
    for (int i = 0; i < 10000; ++i) {
        const auto cell = cells.next(i % 2 ? 1e4 : 2);
        const ShapedPoint point(glm::dvec3(0), cell, false, 0, ShapedPoint::Right::Volume);
        const auto kept = point.cell().as<double>();
        EXPECT_NEAR(kept.determinant() / cell.determinant(), 1, 0x1p-21);
        for (const int c : {0, 2}) EXPECT_NEAR(kept.diagonal[c] / cell.diagonal[c], 1, 0x1p-9);
        EXPECT_NEAR(kept.diagonal.y / cell.diagonal.y, 1, 0x1p-7);
        const glm::dvec3 thick(cell.diagonal.y, cell.diagonal.z, cell.diagonal.z);
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(kept.below[k], cell.below[k],
                        0x1p-9 * std::abs(cell.below[k]) + 0x1p-12 * thick[k])
                << k;
    }
}

// Of columns of levels, whose heights are told elsewhere.
TEST(ShapedPoints, CellsOfColumnsKeepTheirAreas) {
    SomeCells cells;
    for (int i = 0; i < 10000; ++i) {
        const auto cell = cells.next(2);
        const auto kept =
            ShapedPoint(glm::dvec3(0), cell, false, 0, ShapedPoint::Right::Area).cell();
        EXPECT_NEAR(
            double(kept.diagonal.x) * double(kept.diagonal.y) / (cell.diagonal.x * cell.diagonal.y),
            1, 0x1p-21);
        EXPECT_NEAR(kept.diagonal.z / cell.diagonal.z, 1, 0x1p-9);
    }
}

TEST(ShapedPoints, KeepWhetherAndHowMuch) {
    const LowerTriangle<double> cell{{0.5, 0.25, 0.125}, {-0.25, 0.75, -0.125}};
    for (const bool turned : {false, true})
        for (unsigned widened = 0; widened <= kMostWidened; ++widened) {
            const glm::dvec3 at(-1.5, 0.75, -0.125);
            const ShapedPoint point(at, cell, turned, widened, ShapedPoint::Right::Volume);
            EXPECT_EQ(point.turned(), turned);
            EXPECT_EQ(point.widened(), widened);
            // Powers of two and their sums are kept as they are.
            EXPECT_EQ(glm::dvec3(point.at()), at);
            EXPECT_EQ(glm::dvec3(point.cell().diagonal), cell.diagonal);
            EXPECT_EQ(glm::dvec3(point.cell().below), cell.below);
        }
}

TEST(ShapedPoints, NoCellIsLostHoweverThinOrSteep) {
    for (const double side : {1e-300, 1e-40, 1.0, 1e30}) {
        const LowerTriangle<double> cell{{side, 1, side}, {1e30, -1e30, 1e-300}};
        const ShapedPoint point(glm::dvec3(0), cell, false, 0, ShapedPoint::Right::Volume);
        EXPECT_TRUE(point.hasCell());
        const auto kept = point.cell().as<double>();
        EXPECT_GT(kept.determinant(), 0);
        for (int k = 0; k < 3; ++k) {
            EXPECT_TRUE(std::isfinite(kept.diagonal[k]));
            EXPECT_TRUE(std::isfinite(kept.below[k]));
        }
    }
}

}  // namespace
}  // namespace timeseries
