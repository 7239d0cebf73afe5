// Fields on axes of a rotated pole, whose longitudes and latitudes are told beside: flat by their
// axes, on a globe where they stand on the Earth.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "render/annotate/axes.h"
#include "render/annotate/map_lines.h"
#include "render/points/placed_points.h"
#include "tests/support/geographic.h"
#include "tests/support/meshes.h"
#include "tests/support/rotated_pole.h"

namespace render {
namespace {

using tests::measuredAxis;
using timeseries::Axis;
using timeseries::EarthPlaces;
using timeseries::Grid;
using timeseries::RotatedPole;

constexpr RotatedPole kEurope{-162, 39.25};
constexpr int kAcross = 47, kUpwards = 45;

Grid rotatedGrid(int levels) {
    return Grid({measuredAxis("rlon", "degrees", -28, 18, kAcross),
                 measuredAxis("rlat", "degrees", -23, 21, kUpwards), tests::levels(levels)});
}
std::shared_ptr<const EarthPlaces> placesAbout(const Grid& grid, const RotatedPole& pole) {
    std::vector<glm::dvec2> columns;
    for (const double y : grid.axes()[1].coordinates)
        for (const double x : grid.axes()[0].coordinates) columns.push_back(pole.onEarth({x, y}));
    return std::make_shared<const EarthPlaces>(columns);
}
std::shared_ptr<const Grid> onTheEarth(int levels, const RotatedPole& pole = kEurope) {
    const Grid grid = rotatedGrid(levels);
    return std::make_shared<const Grid>(grid.withEarth(placesAbout(grid, pole)));
}

TEST(GlobeOfARotatedPole, IsShownByWhatIsTold) {
    EXPECT_FALSE(Globe::shows(rotatedGrid(3)));
    EXPECT_TRUE(Globe::shows(*onTheEarth(3)));
    EXPECT_FALSE(isGeographic(*onTheEarth(3))) << "its axes are another pole's";
    const PlacedPoints placed(*onTheEarth(3), {}, Map::Globe);
    EXPECT_TRUE(placed.globe());
}

TEST(GlobeOfARotatedPole, PointsStandWhereThePoleIsTurnedTo) {
    for (const int levels : {1, 3}) {
        const auto grid = onTheEarth(levels);
        const Globe globe(*grid, 2.0);
        const auto mesh = globe.meshOf(*grid);
        ASSERT_EQ(mesh->size(), grid->size());
        for (std::uint64_t n = 0; n < grid->count(); ++n) {
            const glm::dvec3 own = grid->position(n);
            const glm::dvec3 up = tests::onEarth(kEurope, glm::dvec2(own));
            const glm::dvec2 place(std::atan2(up.y, up.x), std::asin(up.z));
            ASSERT_LT(glm::distance(mesh->position(n), globe.at({glm::degrees(place), own.z})),
                      1e-6)
                << n;
        }
        EXPECT_EQ(mesh->folded() + mesh->flat() + mesh->absent(), 0u);
        if (levels == 1) continue;
        double sum = 0;
        for (std::uint64_t n = 0; n < grid->count(); ++n) sum += mesh->volume(n);
        // Between parallels and meridians of its own pole.
        const double share =
            kAcross / 360.0 * (std::sin(glm::radians(21.5)) - std::sin(glm::radians(-23.5))) / 2;
        const auto cubed = [&](double level) { return std::pow(globe.radius(level), 3); };
        const double expected = share * 4.0 / 3 * std::acos(-1) * (cubed(2.5) - cubed(-0.5));
        EXPECT_NEAR(sum / expected, 1, 0.01);
    }
}

// Whether columns of two dimensions are all that a file has, or stand beside axes.
TEST(GlobeOfARotatedPole, IsThatOfItsColumns) {
    const auto grid = onTheEarth(3);
    timeseries::MeshPlaces places{.size = grid->size(), .at = {}, .levels = {0, 1, 2}};
    for (std::uint64_t n = 0; n < grid->earth()->count(); ++n)
        places.at.emplace_back((*grid->earth())[n], 0);
    const Grid columns(
        {Axis{"lon", "degrees_east", {}}, Axis{"lat", "degrees_north", {}}, Axis{"level", "1", {}}},
        std::make_shared<const timeseries::Mesh>(places));
    const PlacedPoints one(*grid, {}, Map::Globe), other(columns, {}, Map::Globe);
    ASSERT_TRUE(one.globe() && other.globe());
    for (std::uint64_t n = 0; n < grid->count(); ++n) {
        ASSERT_LT(glm::distance(one.position(n), other.position(n)), 1e-6);
        ASSERT_NEAR(one.meshVolume(n) / other.meshVolume(n), 1, 1e-3);
    }
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(one.boxHalf()[axis], other.boxHalf()[axis], 1e-6);
}

TEST(GlobeOfARotatedPole, LiesFlatAsItsAxesSay) {
    const Grid without = rotatedGrid(3);
    const auto with = onTheEarth(3);
    const PlacedPoints one(without), other(*with);
    EXPECT_EQ(one.positions(), other.positions());
    EXPECT_EQ(one.widths(), other.widths());
    EXPECT_EQ(one.boxHalf(), other.boxHalf());
    EXPECT_FALSE(other.isMesh() || other.globe());
    EXPECT_FALSE(mapPlaneOf(*with)) << "no coasts along its axes";
}

TEST(GlobeOfARotatedPole, AClipBoxIsOfItsAxes) {
    const auto grid = onTheEarth(3);
    const PlacedPoints placed(*grid, {}, Map::Globe);
    const glm::dvec3 lo(-10, -5, 1), hi(3, 9, 2);
    const IndexBox box = indexBox(*grid, lo, hi);
    int inside = 0;
    for (std::uint64_t n = 0; n < grid->count(); ++n) {
        const glm::dvec3 at = grid->position(n);
        const bool expected =
            glm::all(glm::lessThanEqual(lo, at)) && glm::all(glm::lessThanEqual(at, hi));
        ASSERT_EQ(placed.inside(n, box), expected);
        inside += expected;
    }
    EXPECT_EQ(inside, 14 * 15 * 2);
}

// Columns without a place are nowhere.
TEST(GlobeOfARotatedPole, WhatHasNoPlaceIsNotDrawn) {
    const Grid grid = rotatedGrid(2);
    std::vector<glm::dvec2> columns;
    const auto all = placesAbout(grid, kEurope);
    for (std::uint64_t n = 0; n < all->count(); ++n)
        columns.push_back(n % kAcross < 10 ? glm::dvec2(1e20) : (*all)[n]);
    const Grid some = grid.withEarth(std::make_shared<const EarthPlaces>(columns));
    const PlacedPoints placed(some, {}, Map::Globe);
    ASSERT_TRUE(placed.globe());
    EXPECT_EQ(placed.mesh()->absent(), 2u * 10 * kUpwards);
    EXPECT_EQ(placed.meshVolume(5), 0);
    EXPECT_GT(placed.meshVolume(15), 0);
}

TEST(GlobeOfARotatedPole, AMeshIsOfTheGridThatItWasMadeFor) {
    const auto grid = onTheEarth(2);
    const Grid other = grid->withEarth(placesAbout(*grid, {10, 20, 30}));
    const auto mesh = Globe(*grid).meshOf(*grid);
    EXPECT_EQ(Globe(*grid).meshIfMade(*grid), mesh);
    EXPECT_EQ(Globe(*grid).meshIfMade(other), nullptr);
}

// Of a file whose heights a formula gives: the mesh has places along the axes.
TEST(GlobeOfARotatedPole, HeightsOfEachPointStandAboveItsColumn) {
    const Grid upright = rotatedGrid(1);
    timeseries::MeshPlaces places{.size = {kAcross, kUpwards, 2}, .at = {}};
    for (int k = 0; k < 2; ++k)
        for (std::uint64_t n = 0; n < upright.count(); ++n) {
            const glm::dvec3 at = upright.position(n);
            places.at.emplace_back(at.x, at.y, 1000 * k + 10 * at.x);
        }
    const Grid raised =
        Grid({Axis{"rlon", "degrees", {}}, Axis{"rlat", "degrees", {}}, Axis{"height", "m", {}}},
             std::make_shared<const timeseries::Mesh>(places))
            .withEarth(placesAbout(upright, kEurope));
    ASSERT_TRUE(Globe::shows(raised));
    const Globe globe(raised, 100.0);
    const auto mesh = globe.meshOf(raised);
    for (const std::uint64_t n : {0u, 1000u, 2115u, 4000u}) {
        const glm::dvec2 place = (*raised.earth())[n % upright.count()];
        EXPECT_LT(glm::distance(mesh->position(n), globe.at({place, places.at[n].z})), 1e-6);
    }
}

}  // namespace
}  // namespace render
