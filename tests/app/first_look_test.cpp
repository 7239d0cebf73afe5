// How data on a globe are looked at first: the eye stands straight above the middle of their box,
// and north is up in the picture.
#include "app/choices/first_look.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/choices/camera.h"
#include "app/choices/session.h"
#include "render/points/globe.h"
#include "render/points/placed_points.h"
#include "tests/support/exploration_desk.h"
#include "tests/support/geographic.h"
#include "tests/support/parsed_options.h"

namespace app {
namespace {

using render::Map;
using timeseries::Grid;

std::shared_ptr<const Grid> region(double west, double eastmost, double south, double northmost) {
    return tests::gridOf(tests::east(west, eastmost, 5), tests::north(south, northmost, 4),
                         tests::levels(3));
}

// How far, in degrees, the eye is from the vertical of the middle, and the picture's upward
// direction from north there.
struct Off {
    double eye, north;
};
Off offOf(const ViewChoice& look, const Grid& grid) {
    const render::Globe globe(grid);
    const glm::dvec2 middle = 0.5 * (globe.lo() + globe.hi());
    const auto there = globe.directionsAt({middle, 0});
    const Stand stand =
        standOf(look, render::PlacedPoints::outlineOf(grid, std::nullopt, Map::Globe), {400, 300});
    const auto angle = [](const glm::dvec3& a, const glm::dvec3& b) {
        return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
    };
    return {angle(stand.axes[2], there.up), angle(stand.axes[1], there.north)};
}

TEST(FirstLook, FacesTheMiddleOfARegionWithNorthUp) {
    for (const double west : {-170.0, -24.5, 0.0, 100.0, 200.0})
        for (const double wide : {1.0, 57.0, 168.0, 200.0, 300.0})
            for (const double south : {-80.0, -20.0, 0.0, 44.0, 70.0})
                for (const double high : {0.5, 18.0, 100.0}) {
                    const double top = std::min(south + high, 88.0);
                    const auto grid = region(west, west + wide, south, top);
                    const Off off = offOf(firstLook(Map::Globe, *grid), *grid);
                    // In whole degrees, each half a degree off at most.
                    EXPECT_LT(off.eye, 0.75) << west << ' ' << wide << ' ' << south << ' ' << top;
                    EXPECT_LT(off.north, 1.0) << west << ' ' << wide << ' ' << south << ' ' << top;
                }
}

// Longitude a of the whole globe is faced from azimuth a + 90, latitude b from elevation b.
TEST(FirstLook, OfMoreThanHalfOfTheLongitudesIsAtTheirMiddle) {
    const ViewChoice look = firstLook(Map::Globe, *region(100, 300, 10, 50));
    EXPECT_EQ(look.azimuthDegrees, 200 + 90 - 360);
    EXPECT_EQ(look.elevationDegrees, 30);
}

TEST(FirstLook, OfAllRoundIsFromAboveThePoleOrAsOnAFlatMap) {
    EXPECT_EQ(firstLook(Map::Globe, *region(0, 358, 60, 88)).elevationDegrees, 74);
    EXPECT_EQ(firstLook(Map::Globe, *region(0, 358, -88, -60)).elevationDegrees, -74);
    EXPECT_EQ(firstLook(Map::Globe, *region(0, 358, -88, 88)), ViewChoice{});
    EXPECT_EQ(firstLook(Map::Flat, *region(0, 50, 0, 50)), ViewChoice{});
}

// Even where it is the angles of a flat map.
TEST(FirstLook, IsNotTakenWhereAViewWasAskedFor) {
    const auto grid = region(0, 50, 0, 50);
    Explorer open;
    open.map = Map::Globe;
    lookFirst(open, *grid);
    EXPECT_EQ(open.view, firstLook(Map::Globe, *grid));
    EXPECT_NE(open.view, ViewChoice{});
    Explorer asked = parsing::explorer({"--map", "globe", "--view", "30,20"});
    lookFirst(asked, *grid);
    ViewChoice inTheMiddle;
    inTheMiddle.shift = glm::dvec2(0);
    EXPECT_EQ(asked.view, inTheMiddle);
    Explorer saved;
    saved.map = Map::Globe;
    saved = fromJson(toJson(saved, "/"), "/");
    lookFirst(saved, *grid);
    EXPECT_EQ(saved.view, ViewChoice{});
    Explorer turned;
    turned.map = Map::Globe;
    turned.view.distance = 3;
    const ViewChoice before = turned.view;
    lookFirst(turned, *grid);
    EXPECT_EQ(turned.view, before);
}

TEST(FirstLook, FollowsTheMapUntilTheViewIsTurned) {
    const auto grid = region(0, 50, 0, 50);
    tests::ExplorationDesk desk({{"a", {.grid = grid}}});
    desk.open("a");
    const auto change = [&](const auto& set) {
        Explorer next = desk.exploration.explorer();
        set(next);
        desk.exploration.edit(next);
    };
    const auto view = [&] { return desk.exploration.explorer().view; };
    EXPECT_EQ(view(), ViewChoice{});
    change([](Explorer& e) { e.map = Map::Globe; });
    EXPECT_EQ(view(), firstLook(Map::Globe, *grid));
    change([](Explorer& e) { e.map = Map::Flat; });
    EXPECT_EQ(view(), ViewChoice{});
    change([](Explorer& e) { e.view.azimuthDegrees = 77; });
    change([](Explorer& e) { e.map = Map::Globe; });
    EXPECT_EQ(view().azimuthDegrees, 77);
}

TEST(FirstLook, IsThatOfAGlobeWhichIsOpened) {
    const auto grid = region(0, 50, 0, 50);
    tests::ExplorationDesk desk({{"a", {.grid = grid}}});
    Explorer e;
    e.files = {"a"};
    e.map = Map::Globe;
    desk.exploration.open(e);
    desk.untilOpened();
    EXPECT_EQ(desk.exploration.explorer().view, firstLook(Map::Globe, *grid));
}

}  // namespace
}  // namespace app
