// Cells of unstructured grids whose points have the values: that their tetrahedra fill what the
// points lie about, where they are found, and where coordinates begin anew.
#include "render/splat/solid_tets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/vector_relational.hpp>
#include <random>
#include <set>

#include "render/splat/cell_pieces.h"
#include "tests/support/bent_grids.h"
#include "tests/support/cell_rays.h"
#include "tests/support/lon_lat_belt.h"
#include "tests/support/tets_of_world.h"
#include "timeseries/readers/cf/cf_triangles.h"

namespace render {
namespace solid_tets {
namespace {

using tests::CellWorld;
using tests::forEachTetOf;
using tests::stepOfPlaces;
using tests::volumeOf;
using tests::cells::kNan;
using timeseries::Grid;

// Of a tetrahedron each corner has a quarter.
TEST(SolidTets, OfCornersThatAreMissingAQuarterIsNotThere) {
    for (const auto& grid : tests::bentSolids()) {
        const auto x = [](const auto& p) { return p.x; };
        EXPECT_NEAR(volumeOf(CellWorld(stepOfPlaces(grid, x), {"min:max"})), 60, 1e-4);
        const auto isThere = [](std::uint64_t i) { return i % 3 != 1; };
        const CellWorld world(
            tests::stepOf(grid, [&](std::size_t i) { return isThere(i) ? float(i) : kNan; }),
            {"min:max"});
        double expected = 0;
        const auto& solids = *grid->mesh()->solids();
        for (std::uint64_t cell = 0; cell < solids.count(); ++cell)
            solids.forEachTet(cell, [&](const std::array<std::uint32_t, 4>& points) {
                std::array<glm::dvec3, 4> at;
                int there = 0;
                for (std::size_t k = 0; k < 4; ++k) {
                    at[k] = grid->position(points[k]);
                    there += isThere(points[k]) ? 1 : 0;
                }
                expected += there / 4.0 * std::abs(turnOf(at)) / 6;
            });
        EXPECT_LT(expected, 50);
        EXPECT_NEAR(volumeOf(world), expected, 1e-4);
    }
}

// The box is 4 x 3 x 5.
TEST(SolidTets, AreCutWhereTheClipBoxEnds) {
    for (const auto& grid : tests::bentSolids()) {
        CellWorld world(stepOfPlaces(grid, [](const auto& p) { return p.x; }), {"min:max"});
        world.scene.clip.to.y = 1.6;
        EXPECT_NEAR(volumeOf(world), 4 * 1.6 * 5, 1e-4);
    }
}

TEST(SolidTets, ReachAsFarAsTheySayAndNoFarther) {
    for (const auto& grid : tests::bentSolids()) {
        const CellWorld world(stepOfPlaces(grid, [](const auto& p) { return p.x; }), {"min:max"});
        const SolidTets solids(world.placed, world.scene.cells->field(), world.scene.clip);
        forEachTetOf(world, [&](std::uint32_t cell, const MeshCells::Tetrahedron& tet) {
            for (const glm::dvec3& corner : tet.at)
                EXPECT_TRUE(glm::all(
                    glm::lessThanEqual(glm::abs(corner - solids.about(cell)), solids.reach())));
        });
        // Of bricks that are bent by less than a half.
        const glm::dvec3 step = glm::abs(world.placed.scale());
        EXPECT_TRUE(glm::all(glm::lessThanEqual(solids.reach(), 2.5 * step)));
    }
}

// By those of all of their corners; one that has a value itself, and lacks it, is not there.
TEST(SolidTets, AreFoundByTheirValues) {
    auto grids = tests::bentSolids();
    for (const auto& cells : tests::bentCells()) grids.push_back(cells);
    for (const auto& grid : grids) {
        std::mt19937 random(3);
        std::uniform_real_distribution<float> any(0, 1);
        const auto step =
            tests::stepOf(grid, [&](std::size_t i) { return i % 7 == 0 ? kNan : any(random); });
        const auto index = step.cells();
        ASSERT_TRUE(index) << step.whyNoCells();
        const timeseries::SolidCells& cells = *grid->mesh()->solids();
        const SolidTets solids(PlacedPoints(*grid), index->field(), {});
        const std::vector<timeseries::Interval<double>> wanted{{0.1, 0.12}, {0.5, 0.51}};
        std::vector<bool> listed(solids.count());
        std::uint64_t count = 0;
        for (const timeseries::Run& run : index->select(wanted))
            for (std::uint64_t i = 0; i < run.count; ++i) {
                const std::uint32_t cell = index->cell(run.first + i);
                ASSERT_FALSE(listed.at(cell)) << "listed twice";
                listed[cell] = true;
                ++count;
            }
        std::uint64_t needed = 0;
        for (std::uint32_t cell = 0; cell < solids.count(); ++cell) {
            const bool isThere = !cells.haveMiddles() || cells.middle(cell) % 7 != 0;
            double lo = INFINITY, hi = -INFINITY;
            timeseries::SolidCells::Room room;
            for (const std::uint32_t corner : cells.corners(cell, room)) {
                const double v =
                    corner < grid->count()
                        ? double(std::get<std::vector<float>>(index->field().values)[corner])
                        : index->field().atNodes[corner - grid->count()];
                EXPECT_FALSE(cells.haveMiddles() && isThere && std::isnan(v));
                if (std::isnan(v)) continue;
                lo = std::min(lo, v);
                hi = std::max(hi, v);
            }
            const bool reaches = std::ranges::any_of(
                wanted, [&](const auto& each) { return lo <= each.hi && hi >= each.lo; });
            EXPECT_EQ(solids.extentOf(cell), std::pair(lo, hi));
            EXPECT_TRUE(listed[cell] || !reaches || !isThere);
            EXPECT_TRUE(isThere || !listed[cell]);
            needed += reaches && isThere ? 1 : 0;
        }
        EXPECT_GT(needed, 10u);
        EXPECT_LT(count, 2 * needed + 20);
    }
}

std::shared_ptr<const Grid> onSphere(const timeseries::PlaneCoordinates& nodes,
                                     const timeseries::NodesOf& faces) {
    const auto polygons = polygonsAboutNodes(nodes, faces);
    auto mesh = std::make_shared<timeseries::Mesh>(meshOfPoints(
        polygons, timeseries::UnstructuredShapes(polygons), {0, 10, 30}, nodes.x.size()));
    const auto feet = std::make_shared<const std::vector<timeseries::SolidCells::Foot>>(
        timeseries::trianglesOfNodes(faces));
    const auto at = [&](std::uint32_t column) { return glm::dvec2(mesh->position(column)); };
    const glm::dvec3 longest(timeseries::SolidCells::longestOf(*feet, nodes.turn, at), 20);
    mesh->setSolids(timeseries::SolidCells::ofColumns(feet, nodes.x.size(), 3, longest),
                    {nodes.turn, 0, 0});
    return std::make_shared<Grid>(
        std::array{timeseries::Axis{"lon", "degrees_east", {}},
                   timeseries::Axis{"lat", "degrees_north", {}}, timeseries::Axis{"z", "m", {}}},
        mesh);
}

// Columns all about a sphere: where longitudes begin anew the last are beside the first.
std::shared_ptr<const Grid> belt() {
    timeseries::PlaneCoordinates nodes{{}, {}, 360};
    for (int n = 0; n < tests::kNodes; ++n) {
        nodes.x.push_back(tests::lonOf(n % tests::kAround));
        nodes.y.push_back(tests::latOf(n / tests::kAround));
    }
    timeseries::NodesOf faces;
    for (int j = 0; j < tests::kUp; ++j)
        for (int i = 0; i < tests::kAround; ++i) {
            const auto node = [&](int di, int dj) {
                return static_cast<std::uint32_t>((i + di) % tests::kAround +
                                                  tests::kAround * (j + dj));
            };
            faces.push_back({node(0, 0), node(1, 0), node(1, 1), node(0, 1)});
        }
    return onSphere(nodes, faces);
}

TEST(SolidTets, ComeRoundWithTheirCoordinates) {
    const auto grid = belt();
    const auto byLatitude = [](const auto& p) { return p.y; };
    const CellWorld flat(stepOfPlaces(grid, byLatitude), {"min:max"});
    const double all = 360 * tests::kHigh * tests::kUp * 30;
    EXPECT_NEAR(volumeOf(flat), all, 1e-5 * all);
    // None is wider than its columns are apart, on the map as on the globe, and in order each is
    // where its middle is.
    const CellWorld globe(stepOfPlaces(grid, byLatitude), {"min:max"}, 0.5, Map::Globe);
    for (const CellWorld* world : {&flat, &globe}) {
        const glm::dvec3 map =
            glm::dvec3(tests::kWide, tests::kHigh, 20) * glm::abs(world->placed.scale());
        // Radii are at most 1.1, and the way goes along both angles.
        const glm::dvec3 step =
            world->placed.globe()
                ? glm::dvec3(1.1 * kPerDegree * std::hypot(tests::kWide, tests::kHigh) + 0.1)
                : map;
        const SolidTets solids(world->placed, world->scene.cells->field(), world->scene.clip);
        forEachTetOf(*world, [&](std::uint32_t cell, const MeshCells::Tetrahedron& tet) {
            for (const glm::dvec3& corner : tet.at) {
                const glm::dvec3 way = glm::abs(corner - tet.at[0]);
                EXPECT_TRUE(glm::all(glm::lessThanEqual(way, 1.0001 * step)));
                EXPECT_TRUE(glm::all(glm::lessThanEqual(
                    glm::abs(corner - middleOfCell(world->scene, cell)), 1.0001 * step)));
                EXPECT_TRUE(glm::all(
                    glm::lessThanEqual(glm::abs(corner - solids.about(cell)), solids.reach())));
            }
        });
    }
}

// What is about a pole is one cell on the globe; on a map it would lie over all longitudes.
TEST(SolidTets, AboutAPoleAreDrawnOnTheGlobeAlone) {
    const auto grid = onSphere({{0, 120, 240, 60}, {80, 82, 84, 70}, 360}, {{0, 1, 2}, {0, 1, 3}});
    const auto step = stepOfPlaces(grid, [](const auto& p) { return p.z; });
    const CellWorld flat(step, {"min:max"}), globe(step, {"min:max"}, 0.5, Map::Globe);
    std::set<std::uint32_t> onMap, onGlobe;
    forEachTetOf(flat, [&](std::uint32_t cell, const auto&) { onMap.insert(cell); });
    const SolidTets solids(globe.placed, globe.scene.cells->field(), globe.scene.clip);
    forEachTetOf(globe, [&](std::uint32_t cell, const MeshCells::Tetrahedron& tet) {
        onGlobe.insert(cell);
        for (const glm::dvec3& corner : tet.at)
            EXPECT_TRUE(glm::all(
                glm::lessThanEqual(glm::abs(corner - solids.about(cell)), solids.reach())));
    });
    EXPECT_TRUE(onMap.empty());
    EXPECT_EQ(onGlobe.size(), 4u);
    EXPECT_LT(solids.reach().x, 2);  // the globe is as wide
}

// Columns 20 to 70 degrees apart, where longitudes begin anew: beside a pole nothing else of the
// map lies so far beyond its end. At the equator they are as far apart both ways, and are drawn.
TEST(SolidTets, BesideAPoleNoneReachFarBeyondTheMap) {
    const auto drawnOf = [](double south, double north) {
        const auto grid = onSphere({{-170, -140, 170, 150}, {south, north, south, north}, 360},
                                   {{0, 1, 2}, {1, 2, 3}});
        const CellWorld flat(stepOfPlaces(grid, [](const auto& p) { return p.z; }), {"min:max"});
        std::set<std::uint32_t> cells;
        forEachTetOf(flat, [&](std::uint32_t cell, const auto&) { cells.insert(cell); });
        return cells.size();
    };
    EXPECT_EQ(drawnOf(85, 88), 0u);
    EXPECT_EQ(drawnOf(-20, 20), 4u);
}

}  // namespace
}  // namespace solid_tets
}  // namespace render
