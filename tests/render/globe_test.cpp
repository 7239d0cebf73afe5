// Fields of longitudes and latitudes on a globe: where their points lie, what their cells hold, and
// what the Earth hides. Against closed forms and rotations.
#include "render/points/globe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <numbers>

#include "render/annotate/globe_meshes.h"
#include "render/annotate/stretch_text.h"
#include "render/model/pick.h"
#include "render/reference/cell_pick.h"
#include "render/splat/mesh_cells.h"
#include "tests/support/cell_worlds.h"
#include "tests/support/flat_text.h"
#include "tests/support/geographic.h"
#include "tests/support/measured_axis.h"
#include "tests/support/meshes.h"

namespace render {
namespace on_globe {
namespace {

using tests::CellWorld;
using tests::east;
using tests::gridOf;
using tests::levels;
using tests::measuredAxis;
using tests::north;
using timeseries::Axis;
using timeseries::Grid;

constexpr double kPi = std::numbers::pi;

// Turned from longitude 0 on the equator, at a radius.
glm::dvec3 turned(double longitude, double latitude, double radius) {
    const auto about = [](double degrees, const glm::dvec3& axis) {
        return glm::rotate(glm::dmat4(1), degrees * kPi / 180, axis);
    };
    return glm::dvec3(about(longitude, {0, 0, 1}) * about(latitude, {0, -1, 0}) *
                      glm::dvec4(radius, 0, 0, 1));
}

double distanceOfBits(const Grid& grid, const Globe& globe) {
    const auto mesh = globe.meshOf(grid);
    return glm::length(mesh->hi() - mesh->lo()) / (1 << 23);
}

TEST(Globe, PlacesAreTurnedFromTheEquatorByLongitudeAndLatitude) {
    constexpr double kEarth = 6371e3;
    const auto depths = measuredAxis("depth", "m", 0, 5000, 5, true);
    const auto heights = measuredAxis("height", "km", 1, 20, 5);
    for (const auto& [z, perMetre, sense] : {std::tuple(depths, 1.0, -1), {heights, 1000.0, 1}})
        for (const double times : {10.0, 100.0}) {
            const auto grid = gridOf(east(-180, 170, 36), north(-85, 85, 18), z);
            const Globe globe(*grid, times);
            ASSERT_TRUE(globe.exaggeration());
            EXPECT_NEAR(*globe.exaggeration(), times, 1e-9);
            const auto mesh = globe.meshOf(*grid);
            const double error = distanceOfBits(*grid, globe);
            for (std::uint64_t i = 0; i < grid->count(); ++i) {
                const glm::dvec3 place = grid->position(i);
                const double radius = 1 + sense * times * place.z * perMetre / kEarth;
                const glm::dvec3 expected = turned(place.x, place.y, radius);
                ASSERT_LT(glm::distance(globe.at(place), expected), 1e-12) << i;
                ASSERT_LT(glm::distance(mesh->position(i), expected), error) << i;
            }
        }
}

// Of a field of a part of the Earth distances are the same, and its middle has north and up.
TEST(Globe, APartOfTheEarthIsTurnedToWhoLooksAtIt) {
    const auto grid = gridOf(east(-24, 32, 15), north(44, 76, 9), levels(2));
    const Globe globe(*grid, 1.0);
    for (std::uint64_t i = 1; i < grid->count(); ++i) {
        const auto at = [&](std::uint64_t n) { return grid->position(n); };
        const auto place = [&](std::uint64_t n) {
            return turned(at(n).x, at(n).y, 1 + at(n).z * kPi / 180);
        };
        ASSERT_NEAR(glm::distance(globe.at(at(i)), globe.at(at(i - 1))),
                    glm::distance(place(i), place(i - 1)), 1e-12);
    }
    // Tilted by 16 degrees, half of 44 to 76.
    const auto [x, y, z] = globe.directionsAt({4, 60, 0});
    EXPECT_LT(glm::distance(x, {1, 0, 0}), 1e-12);
    EXPECT_NEAR(z.z, std::cos(16 * kPi / 180), 1e-12);
    EXPECT_NEAR(z.y, -std::sin(16 * kPi / 180), 1e-12);
    EXPECT_LT(glm::distance(glm::cross(x, y), z), 1e-12);
}

TEST(Globe, ThePictureSaysByHowMuchHeightsAreExaggerated) {
    const auto textOf = [](const Axis& z, std::optional<glm::dvec3> scale = {}) {
        const auto grid = gridOf(east(0, 359, 360), north(-89, 89, 179), z);
        return stretchText(*grid, PlacedPoints(*grid, scale, Map::Globe));
    };
    // A tenth of 6371 km.
    EXPECT_EQ(textOf(measuredAxis("depth", "m", 0, 5000, 5, true)), "depth × 127");
    EXPECT_EQ(textOf(measuredAxis("depth", "m", 0, 5000, 5, true), glm::dvec3(1, 1, 20)),
              "depth × 20");
    // 0.1 radii are 5.73 degrees, of 900 hPa.
    EXPECT_EQ(textOf(measuredAxis("lev", "hPa", 100, 1000, 5, true)), "157 hPa lev drawn as 1°");
    EXPECT_EQ(textOf(measuredAxis("lev", "hPa", 100, 1000, 5, true), glm::dvec3(1, 1, 0.01)),
              "100 hPa lev drawn as 1°");
    EXPECT_EQ(textOf(measuredAxis("z", "m", 2, 2, 1)), "");
}

// Air lies outside, the sea inside, whichever way their axes count.
TEST(Globe, DepthsGoInwardsAndHeightsOutwards) {
    const auto expect = [](const Axis& z, bool below) {
        const auto grid = gridOf(east(0, 350, 36), north(-80, 80, 17), z);
        const Globe globe(*grid);
        EXPECT_EQ(globe.liesBelow(), below) << z.name;
        const double a = globe.radius(z.coordinates.front()),
                     b = globe.radius(z.coordinates.back());
        EXPECT_NEAR(below ? std::max(a, b) : std::min(a, b), 1, 0.01) << z.name;
        EXPECT_NEAR(below ? std::min(a, b) : std::max(a, b), below ? 0.9 : 1.1, 1e-12) << z.name;
        EXPECT_LT(globe.ballRadius(), std::min(a, b));
        EXPECT_GT(globe.ballRadius(), 0.85);
    };
    expect(measuredAxis("depth", "m", 5, 4000, 9, true), true);
    expect(measuredAxis("z", "m", -4000, -5, 9), true);
    expect(measuredAxis("pressure", "dbar", 0, 2000, 9, true), true);
    expect(measuredAxis("height", "m", 10, 20000, 9), false);
    expect(measuredAxis("lev", "hPa", 1000, 10, 9, true), false);
    expect(measuredAxis("lev", "hybrid_sigma_pressure", 5, 992, 9, true), false);
    expect(measuredAxis("level", "index", 0, 8, 9), false);
    // Levels of the air that count downwards.
    expect(measuredAxis("lev", "level", 1, 9, 9, true), false);
    expect(measuredAxis("sigma", "1", 0.1, 0.9, 9, true), false);
    // However large a stretch is asked for, nothing passes the Earth's centre.
    const auto grid =
        gridOf(east(0, 350, 36), north(-80, 80, 17), measuredAxis("depth", "m", 0, 5000, 5, true));
    EXPECT_GT(Globe(*grid, 1e9).radius(5000), 0);
    EXPECT_GT(Globe(*grid, 1e9).ballRadius(), 0);
    const auto both =
        gridOf(east(0, 350, 36), north(-80, 80, 17), measuredAxis("z", "m", -4000, 9000, 5));
    EXPECT_NEAR(Globe(*both, 1e9).radius(-4000), 0.1, 1e-12);
    EXPECT_GT(Globe(*both, 1e9).ballRadius(), 0);
    EXPECT_NEAR(Globe(*both, 1e4).radius(0), 1, 1e-12);
}

// What a globe cannot show lies flat, and how far a globe reaches is known without its points.
TEST(Globe, OfOnePlaceOrOfHeightsThatAreNotToldApartThereIsNone) {
    const auto tiny = std::numeric_limits<double>::denorm_min();
    for (const auto& grid :
         {gridOf(east(5, 5, 1), north(10, 10, 1), measuredAxis("z", "m", 0, 2, 3)),
          gridOf(east(0, 9, 10), north(0, 9, 10), measuredAxis("z", "m", 0, tiny, 2))}) {
        EXPECT_FALSE(Globe::shows(*grid));
        const PlacedPoints placed(*grid, {}, Map::Globe);
        EXPECT_EQ(placed.globe(), nullptr);
        EXPECT_EQ(placed.isMesh(), false);
    }
    for (const auto& grid : {gridOf(east(0, 350, 36), north(-80, 80, 17), levels(3)),
                             gridOf(east(-24, 32, 15), north(44, 76, 9), levels(2))})
        for (const Map map : {Map::Flat, Map::Globe}) {
            EXPECT_TRUE(Globe::shows(*grid));
            const PlacedPoints placed(*grid, {}, map);
            EXPECT_EQ(placed.globe() != nullptr, map == Map::Globe);
            const Outline is = PlacedPoints::outlineOf(*grid, {}, map), expected = placed.outline();
            EXPECT_EQ(is.isBall, expected.isBall);
            EXPECT_EQ(is.boxHalfEdges, expected.boxHalfEdges);
        }
}

TEST(Globe, APlaceIsFoundFromWhereItLies) {
    for (const auto& [x, y, z] : {std::tuple(east(0, 350, 36), north(-80, 80, 17), levels(3)),
                                  {east(160, 230, 8), north(30, 60, 4), levels(3)}}) {
        const Globe globe(*gridOf(x, y, z), 3.0);
        for (const double longitude : {x.coordinates[0], x.coordinates[3] + 1, x.coordinates[7]})
            for (const double latitude : {-89.0, 0.0, 50.0})
                for (const double third : {-1.0, 0.0, 1.5}) {
                    const glm::dvec3 place(longitude, latitude, third);
                    EXPECT_LT(glm::distance(globe.placeOf(globe.at(place)), place), 1e-9);
                }
    }
    const Globe flat(*gridOf(east(0, 9, 10), north(0, 9, 10), levels(1)));
    EXPECT_EQ(flat.placeOf(1.25 * flat.at({3, 4, 0})).z, 0);
}

// Whole spheres are filled exactly, with points on the poles or without, and where the first and
// the last longitude are one; regions by sin b (a2 - a1).
TEST(Globe, CellsFillTheShellsThatTheyStandFor) {
    struct Case {
        Axis x, y;
        double share;  // of a sphere
    };
    const double toDegrees = kPi / 180;
    for (const auto& [x, y, share] :
         {Case{east(0, 350, 36), north(-90, 90, 19), 1},
          Case{east(-180, 180, 37), north(-85, 85, 18), 1},
          Case{east(350, 0, 36), north(90, -90, 37), 1},
          Case{east(10, 40, 31), north(30, 60, 31),
               31.0 / 360 * (std::sin(60.5 * toDegrees) - std::sin(29.5 * toDegrees)) / 2}}) {
        const auto grid = gridOf(x, y, levels(4));
        const Globe globe(*grid, 2.0);  // degrees a level
        const auto mesh = globe.meshOf(*grid);
        double sum = 0;
        for (std::uint64_t i = 0; i < grid->count(); ++i) sum += mesh->volume(i);
        // Half a level beyond the first and the last.
        const auto cubed = [&](double level) { return std::pow(globe.radius(level), 3); };
        const double expected = share * 4.0 / 3 * kPi * (cubed(3.5) - cubed(-0.5));
        EXPECT_NEAR(sum / expected, 1, 1e-6) << x.coordinates[0] << ", " << y.coordinates[0];
        EXPECT_EQ(mesh->folded() + mesh->flat() + mesh->absent(), 0u);
    }
}

// The same cells, whether axes or columns of two dimensions say where points are.
TEST(Globe, CurvilinearPlacesHaveTheCellsOfUprightOnes) {
    const auto upright = gridOf(east(20, 60, 41), north(-20, 20, 41), levels(3));
    timeseries::MeshPlaces places = tests::placesOf(
        {41, 41, 1}, [](double i, double j, double) { return glm::dvec3(20 + i, -20 + j, 0); });
    places.size[2] = 3;
    places.levels = {0, 1, 2};
    std::array<Axis, 3> axes = upright->axes();
    for (Axis& axis : axes) axis.coordinates.clear();
    const auto columns = std::make_shared<const Grid>(
        axes, std::make_shared<const timeseries::Mesh>(std::move(places)));
    const auto a = Globe(*upright, 1.0).meshOf(*upright), b = Globe(*columns, 1.0).meshOf(*columns);
    ASSERT_TRUE(a->hasNeighbours() && b->hasNeighbours());
    for (std::uint64_t i = 0; i < upright->count(); ++i) {
        ASSERT_LT(glm::distance(a->position(i), b->position(i)), 1e-6);
        const auto one = a->cell(i), other = b->cell(i);
        ASSERT_NEAR(one.determinant() / other.determinant(), 1, 0.02) << i;
        ASSERT_LT(glm::distance(glm::abs(one.diagonal), glm::abs(other.diagonal)),
                  0.03 * glm::length(one.diagonal))
            << i;
    }
}

// The cells before the first and beyond the last longitude meet: every corner between them is one.
TEST(Globe, CellsBetweenPointsAreClosedAtTheSeam) {
    const auto grid = gridOf(east(5, 355, 36), north(-85, 85, 18), levels(3));
    const CellWorld world(tests::stepOf(grid, [](std::size_t i) { return double(i % 36); }),
                          {"0:40"}, 0.5, Map::Globe);
    const auto& corners = world.scene.cells->cornersOf();
    const MeshCells cells(world.placed, corners, world.scene.clip);
    const glm::uvec3 size = corners.size();
    for (unsigned y = 0; y < size.y; ++y)
        for (unsigned z = 0; z < size.z; ++z) {
            const auto first = cells({0, y, z}), last = cells({size.x - 1, y, z});
            ASSERT_TRUE(first && last);
            for (unsigned c = 0; c < 8; c += 2)
                EXPECT_LT(glm::distance(first->at[c], last->at[c + 1]), 1e-6) << y << " " << z;
        }
}

TEST(Globe, AClipBoxIsOfTheFilesCoordinates) {
    const auto grid = gridOf(east(0, 350, 36), north(-85, 85, 18), levels(3));
    timeseries::MeshPlaces places = tests::placesOf({36, 18, 3}, [](double i, double j, double k) {
        return glm::dvec3(10 * i, -85 + 10 * j + 0.1 * i, k);
    });
    std::array<Axis, 3> axes = grid->axes();
    for (Axis& axis : axes) axis.coordinates.clear();
    const auto curved = std::make_shared<const Grid>(
        axes, std::make_shared<const timeseries::Mesh>(std::move(places)));
    const glm::dvec3 lo(30, -45, 1), hi(200, 25, 2);
    for (const auto& each : {grid, curved}) {
        const PlacedPoints placed(*each, {}, Map::Globe);
        const IndexBox box = indexBox(*each, lo, hi);
        int inside = 0;
        for (std::uint64_t i = 0; i < each->count(); ++i) {
            const glm::dvec3 at = each->position(i);
            const bool expected = at.x >= lo.x && at.x <= hi.x && at.y >= lo.y && at.y <= hi.y &&
                                  at.z >= lo.z && at.z <= hi.z;
            ASSERT_EQ(placed.inside(i, box), expected) << i;
            inside += expected;
        }
        EXPECT_GT(inside, 100);
    }
}

// What is told of a point is what the file says, and the Earth hides what lies behind it.
TEST(Globe, WhatIsPickedIsOnTheNearSide) {
    const auto grid = gridOf(east(0, 355, 72), north(-87.5, 87.5, 36), levels(3));
    const auto value = [&](std::size_t i) {  // opposite sides differ
        const double longitude = grid->position(i).x;
        return longitude < 180 ? 1.0 : 2.0;
    };
    for (const bool far : {false, true}) {
        const CellWorld world(tests::stepOf(grid, value), {far ? "1" : "2"}, 0.9, Map::Globe);
        const View view = tests::lookFrom({0, -4, 0}, {41, 41});  // from longitude 270
        const glm::dvec2 middle(20.5, 20.5);
        Scene points = world.scene;
        points.cells.reset();
        const auto cell = pickCell(world.scene, view, middle), point = pick(points, view, middle);
        EXPECT_EQ(cell.has_value(), !far);
        EXPECT_EQ(point.has_value(), !far);
        if (far) continue;
        for (const std::uint64_t index : {cell->gridIndex, point->gridIndex}) {
            EXPECT_NEAR(grid->position(index).x, 270, 5);
            EXPECT_NEAR(grid->position(index).y, 0, 5);
        }
    }
}

// Nothing beyond the horizon is drawn, and the Earth fills its disc.
TEST(Globe, LinesEndAtTheHorizon) {
    const auto grid = gridOf(east(0, 355, 72), north(-87.5, 87.5, 36), levels(3));
    const PlacedPoints placed(*grid, {}, Map::Globe);
    const glm::ivec2 size(400, 400);
    const glm::dvec3 eye(0, -4, 1);
    const View view = tests::lookFrom(eye, size, 0.3);
    const AxesMeshes meshes = axesMeshes(*grid, placed, view, {eye}, tests::fontFor(size));
    ASSERT_FALSE(meshes.labels.covers().empty());
    ASSERT_TRUE(meshes.mapBehind.triangles().empty() && meshes.mapBefore.triangles().empty());
    const glm::dmat4 worldFromClip = glm::inverse(view.clipFromView * view.viewFromWorld);
    const double surface = placed.scale().x, ball = placed.ball()->radius;
    double farthest = 0, area = 0;
    const auto& v = meshes.behind.triangles();
    for (std::size_t i = 0; i + 2 < v.size(); i += 3) {
        const glm::dvec2 a(v[i].at), b(v[i + 1].at), c(v[i + 2].at);
        // A line's soft edges reach beyond it, a ball's triangles do not.
        if (v[i].edge.x == 0)
            area += std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
        const glm::dvec4 clip(2 * a.x / size.x - 1, 1 - 2 * a.y / size.y,
                              static_cast<double>(v[i].at.z), 1);
        const glm::dvec4 world = worldFromClip * clip;
        const double away = glm::distance(glm::dvec3(world) / world.w, eye);
        farthest = std::max(farthest, away);
    }
    const double distance = glm::length(eye);
    EXPECT_LT(farthest, std::sqrt(distance * distance - ball * ball) + 0.01);
    EXPECT_GT(farthest, std::sqrt(distance * distance - surface * surface) - 0.05);
    const double seen = ball / std::sqrt(distance * distance - ball * ball) / 0.3 * 200;
    EXPECT_NEAR(area / (kPi * seen * seen), 1, 0.01);
}

// Of fields turned to the front alike, the one with the Earth's seam in its middle has no more.
TEST(Globe, AMeridianHasOneLabel) {
    const auto labelsOf = [](double west) {
        const auto grid = gridOf(east(west, west + 140, 36), north(-40, 40, 9), levels(3));
        const PlacedPoints placed(*grid, {}, Map::Globe);
        const glm::ivec2 size(900, 900);
        const glm::dvec3 eye = 4.0 * placed.globe()->directionsAt({west + 70, 0, 0}).up;
        return axesMeshes(*grid, placed, tests::lookFrom(eye, size, 0.5), {eye},
                          tests::fontFor(size))
            .labels.covers()
            .size();
    };
    EXPECT_GT(labelsOf(-70), 2u);
    EXPECT_EQ(labelsOf(110), labelsOf(-70));
}

TEST(Globe, DegreesAreCalledAsOnMaps) {
    EXPECT_EQ(latitudeText(30), "30° N");
    EXPECT_EQ(latitudeText(-7.5), "7.5° S");
    EXPECT_EQ(latitudeText(0), "0°");
    EXPECT_EQ(longitudeText(30), "30° E");
    EXPECT_EQ(longitudeText(330), "30° W");
    EXPECT_EQ(longitudeText(-180), "180°");
    EXPECT_EQ(longitudeText(540), "180°");
    EXPECT_EQ(longitudeText(360), "0°");
}

TEST(Globe, IsMadeOnceWhileSomebodyHasIt) {
    const auto grid = gridOf(east(0, 350, 36), north(-85, 85, 18), levels(3));
    const PlacedPoints a(*grid, {}, Map::Globe), b(*grid, {}, Map::Globe);
    const PlacedPoints other(*grid, glm::dvec3(1, 1, 3), Map::Globe);
    EXPECT_EQ(a.mesh(), b.mesh());
    EXPECT_NE(a.mesh(), other.mesh());
    EXPECT_EQ(grid->mesh(), nullptr);
    // Each is found while it is there, whichever was made last.
    const Globe globe(*grid);
    EXPECT_EQ(globe.meshIfMade(*grid), a.mesh());
    EXPECT_EQ(Globe(*grid, 3).meshIfMade(*grid), other.mesh());
    EXPECT_EQ(Globe(*grid, 5).meshIfMade(*grid), nullptr);
    EXPECT_EQ(PlacedPoints(*grid, {}, Map::Globe).mesh(), a.mesh());
}

TEST(Globe, IsNotMadeForNobody) {
    const auto upright = gridOf(east(0, 350, 36), north(-85, 85, 18), levels(3));
    const auto curved = tests::curvilinear(
        {9, 8, 7}, [](double i, double j, double k) { return glm::dvec3(3 * i + j, 2 * j, k); });
    for (const auto& grid : {upright, curved}) {
        const Globe globe(*grid);
        std::atomic<bool> wanted = false;
        EXPECT_EQ(globe.meshOf(*grid, wanted), nullptr);
        EXPECT_EQ(globe.meshIfMade(*grid), nullptr);
        wanted = true;
        EXPECT_NE(globe.meshOf(*grid, wanted), nullptr);
    }
}

}  // namespace
}  // namespace on_globe
}  // namespace render
