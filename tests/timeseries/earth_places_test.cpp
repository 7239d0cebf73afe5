// Longitudes and latitudes of columns that have other coordinates, and of grids about other poles.
#include "timeseries/grid/earth_places.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>
#include <stdexcept>

#include "tests/support/meshes.h"
#include "tests/support/rotated_pole.h"

namespace timeseries {
namespace {

using tests::direction;

TEST(RotatedPole, TurnsPlacesAsARigidSphereTurns) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> around(-360, 360), up(-90, 90);
    for (int n = 0; n < 10'000; ++n) {
        const RotatedPole pole{around(random), up(random), around(random)};
        const glm::dvec2 place(around(random), up(random));
        const glm::dvec2 found = pole.onEarth(place);
        ASSERT_LT(glm::distance(direction(found), tests::onEarth(pole, place)), 1e-12) << n;
        ASSERT_TRUE(found.x >= -180 && found.x < 180 && std::abs(found.y) <= 90) << n;
    }
}

TEST(RotatedPole, EachPoleIsWhereTheOtherGridHasIt) {
    const RotatedPole pole{-162, 39.25, 12};
    EXPECT_NEAR(pole.onEarth({12, 39.25}).y, 90, 1e-5) << "to the rounding of a cosine beside 1";
    for (const double longitude : {0.0, 77.0}) {
        const glm::dvec2 own = pole.onEarth({longitude, 90});
        EXPECT_NEAR(own.x, -162, 1e-9);
        EXPECT_NEAR(own.y, 39.25, 1e-12);
    }
    // The middle lies opposite to the pole's meridian.
    const glm::dvec2 middle = pole.onEarth({12, 0});
    EXPECT_NEAR(middle.x, 18, 1e-12);
    EXPECT_NEAR(middle.y, 90 - 39.25, 1e-12);
}

// CORDEX's EUR-11 tells these of its first column.
TEST(RotatedPole, AgreesWithWhatARegionalModelWrites) {
    const glm::dvec2 first = RotatedPole{-162, 39.25}.onEarth({-28.375, -23.375});
    EXPECT_NEAR(first.x, -10.06388, 1e-5);
    EXPECT_NEAR(first.y, 21.98783, 1e-5);
}

TEST(EarthPlaces, KnowTheirEnds) {
    const EarthPlaces places({{10, 50}, {12, 49}, {9, 55}, {11, 51}});
    EXPECT_EQ(places.lo(), glm::dvec2(9, 49));
    EXPECT_EQ(places.hi(), glm::dvec2(12, 55));
    EXPECT_EQ(places.count(), 4u);
    EXPECT_EQ(places[2], glm::dvec2(9, 55));
}

TEST(EarthPlaces, LeadNoFartherThanOnceRound) {
    const EarthPlaces places({{-10, 80}, {355, 81}, {179, 82}, {181, 83}});
    EXPECT_EQ(places[1], glm::dvec2(-5, 81));
    EXPECT_EQ(places[2], glm::dvec2(179, 82));
    EXPECT_EQ(places[3], glm::dvec2(-179, 83));
    EXPECT_EQ(places.lo(), glm::dvec2(-179, 80));
    EXPECT_EQ(places.hi(), glm::dvec2(179, 83));
    const EarthPlaces round({{0, 0}, {360, 0}});
    EXPECT_EQ(round[1].x, 360) << "a seam that is told twice stays";
}

TEST(EarthPlaces, WhatCanBeNoneIsNoPlace) {
    constexpr double kFill = 1e20, kNone = std::numeric_limits<double>::quiet_NaN();
    const std::vector<glm::dvec2> columns{{5, 91}, {kFill, kFill}, {kNone, 3}, {7, 90}, {8, kNone}};
    const EarthPlaces places(columns);
    for (const std::size_t n : {0, 1, 2, 4})
        EXPECT_TRUE(std::isnan(places[n].x) && std::isnan(places[n].y)) << n;
    EXPECT_EQ(places.lo(), glm::dvec2(7, 90));
    EXPECT_EQ(places.hi(), glm::dvec2(7, 90));
    EXPECT_EQ(places, EarthPlaces(columns)) << "also where there is no number";
    EXPECT_NE(places, EarthPlaces({{5, 9}, {kFill, 0}, {kNone, 3}, {7, 90}, {8, kNone}}));
    EXPECT_THROW(EarthPlaces({{5, 91}, {kFill, kFill}}), std::invalid_argument);
}

Grid flat(double z, std::shared_ptr<const EarthPlaces> earth) {
    return Grid({Axis{"x", "m", {0, 1}}, Axis{"y", "m", {0, 1}}, Axis{"z", "m", {z}}})
        .withEarth(std::move(earth));
}

TEST(EarthPlaces, AreOfTheSeriesInAllOfItsSteps) {
    const std::vector<glm::dvec2> columns{{10, 50}, {12, 49}, {9, 55}, {11, 51}};
    const auto earth = std::make_shared<const EarthPlaces>(columns),
               same = std::make_shared<const EarthPlaces>(columns),
               other = std::make_shared<const EarthPlaces>(std::vector(4, glm::dvec2(1, 2)));
    const auto series = std::make_shared<const Grid>(flat(0, earth));
    EXPECT_EQ(*series, flat(0, same));
    EXPECT_NE(*series, flat(0, other));
    EXPECT_NE(*series, flat(0, nullptr));
    for (const auto& step : {earth, same, other, std::shared_ptr<const EarthPlaces>()}) {
        EXPECT_EQ(gridOfStep(series, std::make_shared<const Grid>(flat(0, step))), series);
        EXPECT_EQ(gridOfStep(series, std::make_shared<const Grid>(flat(1, step))), nullptr);
    }
    // Of a mesh that moves, too.
    const auto at = [&](double x, const auto& places) {
        const auto grid = tests::curvilinear(
            {2, 2, 2}, [&](double i, double j, double k) { return glm::dvec3(x + i, j, k); });
        return std::make_shared<const Grid>(grid->withEarth(places));
    };
    const auto moved = gridOfStep(at(0, earth), at(1, nullptr));
    ASSERT_TRUE(moved);
    EXPECT_EQ(moved->earth(), earth);
    EXPECT_EQ(moved->position(0).x, 1);
}

}  // namespace
}  // namespace timeseries
