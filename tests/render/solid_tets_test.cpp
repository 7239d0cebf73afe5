// Cells of unstructured grids whose points have the values: what is drawn of them, against closed
// forms and against what each ray passes.
#include "render/splat/solid_tets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/vector_relational.hpp>
#include <random>
#include <set>

#include "render/reference/cell_pick.h"
#include "render/reference/cells_on_rays.h"
#include "render/reference/interval_truth.h"
#include "render/reference/tets_on_pixels.h"
#include "render/splat/cell_pieces.h"
#include "tests/support/cell_rays.h"
#include "tests/support/lon_lat_belt.h"
#include "tests/support/meshes.h"
#include "tests/support/unstructured.h"
#include "timeseries/grid/raised.h"
#include "timeseries/readers/cf/cf_triangles.h"

namespace render {
namespace solid_tets {
namespace {

using tests::CellWorld;
using tests::Cut;
using tests::drawn;
using tests::kCuts;
using tests::stepOfPlaces;
using tests::cells::inside;
using tests::cells::kFrom;
using tests::cells::kNan;
using tests::cells::Ray;
using tests::cells::rayOf;
using timeseries::Grid;

std::shared_ptr<const Grid> bentGrid(Cut cut) {
    return tests::gridOf(tests::atPoints(tests::bentBricks(cut)));
}

// Columns above a lattice, of levels that are bent inside the same box.
std::shared_ptr<const Grid> bentColumns() {
    const auto flat = tests::bricks({5, 4, 1}, Cut::Hexahedra, tests::bent);
    timeseries::UnstructuredGrid squares;
    squares.points = flat.points;
    auto feet = std::make_shared<std::vector<timeseries::SolidCells::Foot>>();
    for (std::uint32_t j = 0; j < 3; ++j)
        for (std::uint32_t i = 0; i < 4; ++i) {
            const std::uint32_t first = i + 5 * j;
            tests::addCell(squares, 9, {first, first + 1, first + 6, first + 5});
            feet->push_back({first, first + 1, first + 6});
            feet->push_back({first, first + 6, first + 5});
        }
    auto prisms = meshOfPoints(squares, timeseries::UnstructuredShapes(squares), {0, 1});
    prisms.setSolids(timeseries::SolidCells::ofColumns(feet, 20, 2, {1, 1, 1}));
    std::vector<double> heights;
    for (int k = 0; k < 6; ++k)
        for (int c = 0; c < 20; ++c) heights.push_back(tests::bent(c % 5, c / 5, k).z);
    return tests::gridOf(raised(prisms, heights));
}

std::vector<std::shared_ptr<const Grid>> bentGrids() {
    std::vector<std::shared_ptr<const Grid>> grids;
    for (const Cut cut : kCuts) grids.push_back(bentGrid(cut));
    grids.push_back(bentColumns());
    return grids;
}

// use(cell, tet) for all that is seen.
template <typename Use>
void forEachTetOf(const CellWorld& world, const Use& use) {
    const SolidTets solids(world.placed, world.scene.cells->field(), world.scene.clip);
    const auto always = [](const auto&) { return true; };
    for (std::uint32_t cell = 0; cell < solids.count(); ++cell)
        solids.forEachTet(cell, nullptr, always, [&](const auto& tet) { use(cell, tet); });
}

// In the grid's units.
double volumeOf(const CellWorld& world) {
    double volume = 0;
    forEachTetOf(world, [&](std::uint32_t, const MeshCells::Tetrahedron& tet) {
        volume += std::abs(turnOf(tet.at)) / 6;
    });
    const glm::dvec3 scale = glm::abs(world.placed.scale());
    return volume / (scale.x * scale.y * scale.z);
}

// Of a tetrahedron each corner has a quarter.
TEST(SolidTets, OfCornersThatAreMissingAQuarterIsNotThere) {
    for (const auto& grid : bentGrids()) {
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
    for (const auto& grid : bentGrids()) {
        CellWorld world(stepOfPlaces(grid, [](const auto& p) { return p.x; }), {"min:max"});
        world.scene.clip.to.y = 1.6;
        EXPECT_NEAR(volumeOf(world), 4 * 1.6 * 5, 1e-4);
    }
}

TEST(SolidTets, ReachAsFarAsTheySayAndNoFarther) {
    for (const auto& grid : bentGrids()) {
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

TEST(SolidTets, AreFoundByTheirValues) {
    for (const auto& grid : bentGrids()) {
        std::mt19937 random(3);
        std::uniform_real_distribution<float> any(0, 1);
        const auto step =
            tests::stepOf(grid, [&](std::size_t i) { return i % 7 == 0 ? kNan : any(random); });
        const auto index = step.cells();
        ASSERT_TRUE(index) << step.whyNoCells();
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
            double lo = INFINITY, hi = -INFINITY;
            timeseries::SolidCells::Room room;
            for (const std::uint32_t point : grid->mesh()->solids()->corners(cell, room)) {
                const float v = std::get<std::vector<float>>(index->field().values)[point];
                if (std::isnan(v)) continue;
                lo = std::min(lo, double(v));
                hi = std::max(hi, double(v));
            }
            const bool reaches = std::ranges::any_of(
                wanted, [&](const auto& each) { return lo <= each.hi && hi >= each.lo; });
            EXPECT_EQ(solids.extentOf(cell), std::pair(lo, hi));
            EXPECT_TRUE(listed[cell] || !reaches);
            needed += reaches ? 1 : 0;
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

// A linear field is so between the corners of any cell: a range of it is a slab of the box, as deep
// as a ray's way through that.
TEST(SolidTets, ARangeOfALinearFieldIsASlab) {
    for (const auto& grid : bentGrids())
        for (const auto& [lo, hi] :
             {std::pair(-1.0, 9.0), std::pair(1.1, 2.7), std::pair(1.9, 2.0)}) {
            const CellWorld world(stepOfPlaces(grid, [](const auto& p) { return p.x; }),
                                  {std::to_string(lo) + ":" + std::to_string(hi)});
            PlacedPoints::Box box = world.placed.pointsBox();
            box.lo.x = world.placed.axesFromGrid({std::max(lo, 0.0), 0, 0}).x;
            box.hi.x = world.placed.axesFromGrid({std::min(hi, 4.0), 0, 0}).x;
            for (const glm::dvec3& from : kFrom) {
                const View view = tests::lookFrom(from, {80, 60}, 0.1);
                const std::vector<float> w = drawn(world.scene, view);
                double off = 0, all = 0;
                for (int y = 0; y < 60; ++y)
                    for (int x = 0; x < 80; ++x) {
                        const Ray ray = rayOf(world, view, {x + 0.5, y + 0.5});
                        const auto [enters, leaves] = inside(ray, box);
                        const double way =
                            std::max(leaves - enters, 0.0) * ray.length / world.placed.unitLength();
                        const double d = double(w[std::size_t(y) * 80 + std::size_t(x)]) - way;
                        off += d * d;
                        all += way * way;
                    }
                // Ends of a range are ramps, a pixel wide.
                EXPECT_LE(std::sqrt(off / all), 2e-2) << lo << " to " << hi << " from " << from.x
                                                      << " of " << grid->mesh()->solids()->count();
            }
        }
}

std::vector<std::shared_ptr<const Grid>> allGrids() {
    auto grids = bentGrids();
    grids.push_back(tests::curvilinear(
        {5, 4, 6}, [](double i, double j, double k) { return tests::bent(i, j, k); }));
    return grids;
}

// Also where tiles close, behind which nothing is looked at any more: when that is known depends on
// slices.
TEST(SolidTets, PicturesAreTheSameForAnyThreadsAndSlices) {
    for (const auto& grid : allGrids()) {
        CellWorld world(tests::noise(grid), {"0:1"}, 1 - 1e-9);
        world.scene.layers[0].style.color = ByValue{{}, 0, 1};
        world.scene.order = Order::BackToFront;
        for (const glm::dvec3& from : kFrom) {
            const View view = tests::lookFrom(from, {150, 20}, 0.03);
            const auto once = drawn(world.scene, view, Channels::Over, 0, 1);
            std::size_t opaque = 0;
            for (std::size_t i = 3; i < once.size(); i += 4) opaque += once[i] == 1;
            EXPECT_GT(opaque, 2000u) << "or no tile closes";
            EXPECT_EQ(once, drawn(world.scene, view, Channels::Over, 0, 5));
            EXPECT_EQ(once, drawn(world.scene, view, Channels::Over, 0, 3, 1));
            EXPECT_EQ(once, drawn(world.scene, view, Channels::Over, 0, 2, 7));
        }
    }
}

TEST(SolidTets, AnEyeThatLooksPastThemSeesNothing) {
    for (const auto& grid : allGrids()) {
        CellWorld world(tests::noise(grid), {"0:1"}, 0.5);
        for (const Order order : {Order::None, Order::BackToFront})
            for (const glm::dvec3& to : {glm::dvec3(0, -9, 0), glm::dvec3(9, -3, 0),
                                         glm::dvec3(0, -3, 9), glm::dvec3(0.7, -2.9, 40)}) {
                world.scene.order = order;
                View view = tests::lookFrom({0, -3, 0}, {40, 30}, 0.1);
                view.viewFromWorld = glm::lookAt(glm::dvec3(0, -3, 0), to, glm::dvec3(0.1, 0.2, 1));
                const auto channels = order == Order::None ? Channels::Weight : Channels::Over;
                for (const float v : drawn(world.scene, view, channels)) ASSERT_EQ(v, 0);
            }
    }
}

// Of any field the picture, its rays one by one and the truth by many rays a pixel are the same, to
// what a pixel's width is; missing points among them.
TEST(SolidTets, AreTheIntervalVolumeOfTheFieldInThem) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> any(0, 1);
    const auto step = tests::stepOf(
        bentGrid(Cut::Wedges), [&](std::size_t i) { return i % 11 == 0 ? kNan : any(random); });
    const CellWorld world(step, {"0.3:0.6"});
    for (const glm::dvec3& from : kFrom) {
        const View view = tests::lookFrom(from, {24, 20}, 0.1);
        std::vector<glm::ivec2> pixels;
        for (int y = 0; y < 20; ++y)
            for (int x = 0; x < 24; ++x) pixels.emplace_back(x, y);
        const std::vector<float> w = drawn(world.scene, view);
        const std::vector<double> depth = cellDepthAt(world.scene, view, pixels);
        const std::vector<double> truth = meshWeight(world.scene, world.scene.cells->field(), view,
                                                     0, pixels, placesOfRays(4), 2);
        Scene whole = world.scene;  // without an index all cells are looked at
        whole.cells = nullptr;
        const std::vector<double> again =
            meshWeight(whole, world.scene.cells->field(), view, 0, pixels, placesOfRays(4), 2);
        const double perWeight = opticalDepthPerWeight(world.scene.layers[0].style.opacity);
        double off = 0, all = 0;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            EXPECT_NEAR(double(w[i]), depth[i] / perWeight, 2e-3);
            EXPECT_NEAR(again[i], truth[i], 1e-12 * (1 + truth[i]));
            off += (w[i] - truth[i]) * (w[i] - truth[i]);
            all += truth[i] * truth[i];
        }
        EXPECT_GT(all, 1);
        EXPECT_LE(std::sqrt(off / all), 0.03) << from.x;
    }
}

// In front of each other as they stand, whatever the shapes.
TEST(SolidTets, HideWhatIsBehindThem) {
    for (const auto& grid : bentGrids()) {
        // Of two opaque slabs the nearer one is seen, from either side.
        CellWorld world(stepOfPlaces(grid, [](const auto& p) { return p.x; }),
                        {"0.5:1.5", "2.5:3.5"}, 1.0);
        world.scene.order = Order::BackToFront;
        for (const double side : {-1.0, 1.0}) {
            const View view = tests::lookFrom({3 * side, 0, 0.05}, {9, 9}, 0.02);
            const std::vector<float> light = drawn(world.scene, view, Channels::Over);
            const glm::dvec3 nearer =
                std::get<Constant>(world.scene.layers[side < 0 ? 0 : 1].style.color).linearRgb;
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(double(light[4 * 40 + c]), nearer[c], 1e-3);
        }
    }
}

TEST(SolidTets, APlaceBetweenPointsIsSeenUnderTheCursor) {
    for (const auto& grid : bentGrids()) {
        const CellWorld world(stepOfPlaces(grid, [](const auto& p) { return p.x; }), {"1.3~0.001"},
                              1.0);
        const View view = tests::lookFrom({3, 0.1, 0.2}, {21, 21}, 0.05);
        const auto picked = pickCell(world.scene, view, {10.5, 10.5});
        ASSERT_TRUE(picked);
        EXPECT_NEAR(*picked->between, 1.3, 2e-3);
        const PixelRays rays = besideFaces(pixelRays(view));
        EXPECT_NEAR(rays.eye.x + picked->depth * rays.axis.x,
                    world.placed.axesFromGrid({1.3, 0, 0}).x, 1e-3);
        // The corner with the largest share is one of the cell's.
        EXPECT_EQ(timeseries::toDouble(picked->value),
                  double(float(world.step.grid().position(picked->gridIndex).x)));
        EXPECT_NEAR(timeseries::toDouble(picked->value), 1.3, 1.01);
    }
}

}  // namespace
}  // namespace solid_tets
}  // namespace render
