// Cells of grids whose points lie one by one: that their tetrahedra fill the grid, and what is
// drawn of them, against closed forms and against what each ray passes.
#include "render/splat/mesh_cells.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <numbers>
#include <random>

#include "render/reference/cell_pick.h"
#include "render/reference/cells_on_rays.h"
#include "render/reference/interval_truth.h"
#include "render/reference/tets_on_pixels.h"
#include "tests/support/cell_rays.h"
#include "tests/support/meshes.h"
#include "tests/support/rounds.h"

namespace render {
namespace mesh_cells {
namespace {

using tests::CellWorld;
using tests::drawn;
using tests::stepOfPlaces;
using tests::cells::inside;
using tests::cells::kFrom;
using tests::cells::kNan;
using tests::cells::Ray;
using tests::cells::rayOf;
using tests::cells::relativeL2;
using timeseries::Grid;

const glm::dmat3 kLeaning{2, 0.3, 0, -0.4, 1.5, 0.2, 0.3, 0, 1};

std::shared_ptr<const Grid> affine(std::array<std::size_t, 3> size, const glm::dmat3& steps) {
    return tests::curvilinear(
        size, [&](double i, double j, double k) { return steps * glm::dvec3(i, j, k); });
}

// The volume of all tetrahedra, in the grid's units.
double volumeOf(const CellWorld& world) {
    const timeseries::CellCorners& corners = world.scene.cells->cornersOf();
    const MeshCells mesh(world.placed, corners, world.scene.clip);
    const glm::uvec3 size = corners.size();
    double volume = 0;
    for (unsigned c = 0; c < size.x * size.y * size.z; ++c)
        if (const auto cell = mesh(timeseries::indicesOf(c, size)))
            mesh.forEachTet(*cell, nullptr, [&](const MeshCells::Tetrahedron& tet) {
                volume += std::abs(turnOf(tet.at)) / 6;
            });
    const glm::dvec3 scale = glm::abs(world.placed.scale());
    return volume / (scale.x * scale.y * scale.z);
}

// Also where a direction is mirrored, or counted downwards.
TEST(MeshCells, FillWhatThePointsOfAStraightGridStandFor) {
    const double volume = std::abs(glm::determinant(kLeaning));
    for (const glm::dmat3& steps : {kLeaning, glm::dmat3(kLeaning[1], kLeaning[0], kLeaning[2])}) {
        const CellWorld world(
            stepOfPlaces(affine({4, 5, 6}, steps), [](const auto& p) { return p.x; }), {"min:max"});
        EXPECT_NEAR(volumeOf(world), 4 * 5 * 6 * volume, 1e-5 * volume);
    }
    auto axes = affine({4, 5, 6}, kLeaning)->axes();
    axes[2].down = true;
    const auto down = std::make_shared<const Grid>(axes, affine({4, 5, 6}, kLeaning)->mesh());
    EXPECT_NEAR(
        volumeOf(CellWorld(stepOfPlaces(down, [](const auto& p) { return p.x; }), {"min:max"})),
        120 * volume, 1e-5 * volume);
}

TEST(MeshCells, OfALayerAreAsThickAsItsPointsCells) {
    const double area = glm::length(glm::cross(kLeaning[0], kLeaning[1]));
    const CellWorld world(
        stepOfPlaces(affine({5, 4, 1}, kLeaning), [](const auto& p) { return p.x; }), {"min:max"});
    EXPECT_NEAR(volumeOf(world), 20 * area * std::sqrt(area), 1e-4 * area);
}

// A ring whose last points are its first again has no half cells there; one that ends a step before
// is closed by them.
TEST(MeshCells, FillARingOnce) {
    for (const bool isClosed : {true, false}) {
        constexpr int kSectors = 24;
        const auto ring = tests::curvilinear(
            {kSectors + (isClosed ? 1u : 0u), 5, 4}, [&](double i, double j, double k) {
                const double a = 2 * std::numbers::pi * std::fmod(i, kSectors) / kSectors;
                return (3 + j) * glm::dvec3(std::cos(a), std::sin(a), 0) + glm::dvec3(0, 0, k);
            });
        const CellWorld world(stepOfPlaces(ring, [](const auto& p) { return p.z; }), {"min:max"});
        const double wedge = std::sin(2 * std::numbers::pi / kSectors) / 2;
        const double whole = kSectors * wedge * (7.5 * 7.5 - 2.5 * 2.5) * 4;
        // The two half cells of an open ring go straight on where the ring bends.
        EXPECT_NEAR(volumeOf(world), whole, (isClosed ? 1e-5 : 1e-2) * whole) << isClosed;
    }
}

// What is nearest to a point without a value is nowhere, nor is what lies beyond the clip box.
TEST(MeshCells, LackWhatAPointThatIsMissingStandsFor) {
    const double volume = std::abs(glm::determinant(kLeaning));
    const auto grid = affine({4, 5, 6}, kLeaning);
    const CellWorld holed(tests::stepOf(grid, [](std::size_t i) { return i == 50 ? kNan : 1.0f; }),
                          {"min:max"});
    EXPECT_NEAR(volumeOf(holed), 119 * volume, 1e-4 * volume);
    // Of two halves, here and there.
    double both = 0;
    for (const bool above : {false, true}) {
        CellWorld clipped(stepOfPlaces(grid, [](const auto& p) { return p.x; }), {"min:max"});
        (above ? clipped.scene.clip.from : clipped.scene.clip.to).y = 3.1;
        const double half = volumeOf(clipped);
        EXPECT_GT(half, 30 * volume);
        both += half;
    }
    EXPECT_NEAR(both, 120 * volume, 1e-4 * volume);
}

TEST(MeshCells, CrossTheEndOfAPeriodTheShortWay) {
    auto places = tests::placesOf({36, 5, 3}, [](double i, double j, double k) {
        return glm::dvec3(std::fmod(10 * i + 100, 360), 10 * j + 0.1 * i, k);
    });
    places.period = {360, 0, 0};
    const CellWorld world(stepOfPlaces(tests::gridOf(places), [](const auto& p) { return p.y; }),
                          {"min:max"});
    const MeshCells mesh(world.placed, world.scene.cells->cornersOf(), world.scene.clip);
    for (unsigned i = 0; i < 37; ++i) {
        const auto cell = mesh({i, 2, 1});
        ASSERT_TRUE(cell);
        for (const glm::dvec3& at : cell->at)
            EXPECT_LT(std::abs(at.x - cell->at[0].x), 10.5 * world.placed.scale().x) << i;
    }
}

// Columns, folds that random places make, a period, and a hole: no corner is farther, and no pixel
// sees one beside where it is looked for.
TEST(MeshCells, ReachAsFarAsTheySayAndNoFarther) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> any(-1, 1);
    auto period = tests::placesOf({36, 5, 3}, [](double i, double j, double k) {
        return glm::dvec3(std::fmod(10 * i + 100, 360), 10 * j + 0.1 * i, k);
    });
    period.period = {360, 0, 0};
    const auto wild = tests::curvilinear({6, 5, 4}, [&](double i, double j, double k) {
        return glm::dvec3(i, j, k) + 0.9 * glm::dvec3(any(random), any(random), any(random));
    });
    for (const auto& grid :
         {tests::columns({0, 1, 5, 6}), tests::twisted(), wild, tests::gridOf(std::move(period))}) {
        const CellWorld world(stepOfPlaces(grid, [](const auto& p) { return p.x; }), {"min:max"});
        const timeseries::CellCorners& corners = world.scene.cells->cornersOf();
        const MeshCells mesh(world.placed, corners, world.scene.clip);
        ASSERT_TRUE(timeseries::isPlace(mesh.reach()));
        const View view = tests::lookFrom({0.3, -1.8, 0.9}, {64, 64});
        const PointsView seen(world.placed, view);
        const ReachBox reachBox(seen, mesh.reach());
        const glm::uvec3 size = corners.size();
        int cells = 0;
        for (unsigned c = 0; c < size.x * size.y * size.z; ++c) {
            const glm::uvec3 at = timeseries::indicesOf(c, size);
            const auto cell = mesh(at);
            if (!cell) continue;
            ++cells;
            for (const glm::dvec3& corner : cell->at)
                EXPECT_TRUE(
                    glm::all(glm::lessThanEqual(glm::abs(corner - mesh.about(c)), mesh.reach())));
            const WindowBox exact = windowBox(seen, cell->at), reached = reachBox(mesh.about(c));
            EXPECT_TRUE(glm::all(glm::lessThanEqual(reached.lo, exact.lo)));
            EXPECT_TRUE(glm::all(glm::greaterThanEqual(reached.hi, exact.hi)));
        }
        EXPECT_GT(cells, 100);
    }
}

// The way through the parallelepiped that the points' cells fill.
TEST(MeshCells, AFieldSelectedWholeIsAsDeepAsTheRaysWayThroughTheGrid) {
    const CellWorld world(
        stepOfPlaces(affine({4, 5, 6}, kLeaning), [](const auto& p) { return p.x + p.z; }),
        {"min:max"});
    const glm::dvec3 scale = world.placed.scale();
    const glm::dmat3 toIndices = glm::inverse(kLeaning);
    for (const glm::dvec3& from : kFrom) {
        const View view = tests::lookFrom(from, {40, 30});
        const std::vector<float> w = drawn(world.scene, view);
        const auto indices = [&](const glm::dvec3& place) {
            return toIndices * world.placed.gridFromAxes(place);
        };
        for (int y = 0; y < 30; ++y)
            for (int x = 0; x < 40; ++x) {
                Ray ray = rayOf(world, view, {x + 0.5, y + 0.5});
                ray.along = toIndices * (ray.along / scale);
                ray.from = indices(ray.from);
                const auto [enters, leaves] =
                    inside(ray, {glm::dvec3(-0.5), glm::dvec3(3.5, 4.5, 5.5)});
                const double path =
                    std::max(leaves - enters, 0.0) * ray.length / world.placed.unitLength();
                ASSERT_NEAR(w[std::size_t(y) * 40 + std::size_t(x)], path, 3e-5 * (1 + path))
                    << x << ' ' << y << " from " << from.x;
            }
    }
}

// A field that is linear in space is so between points however these lie: a range of it is a slab,
// as deep as it is thick, also where it is far thinner than the way from point to point.
TEST(MeshCells, AThinRangeOfALinearFieldIsAClosedShellOfItsThickness) {
    const auto grid = tests::curvilinear({12, 12, 12}, [](double i, double j, double k) {
        const glm::dvec3 p(i, j, k);
        return p + 0.3 * glm::dvec3(std::sin(0.7 * j), std::sin(0.5 * k + 1), std::sin(0.6 * i));
    });
    for (const double width : {2.0, 0.1, 0.001}) {
        const CellWorld world(stepOfPlaces(grid, [](const auto& p) { return p.x; }),
                              {"5.37~" + std::to_string(width / 2)});
        const View view = tests::lookFrom({3, -0.4, 0.3}, {64, 64}, 0.05);
        const std::vector<float> w = drawn(world.scene, view);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                const Ray ray = rayOf(world, view, {x + 0.5, y + 0.5});
                const double wanted = width * world.placed.scale().x / std::abs(ray.along.x) *
                                      ray.length / world.placed.unitLength();
                ASSERT_NEAR(w[std::size_t(y) * 64 + std::size_t(x)], wanted, 2e-2 * wanted)
                    << width << " at " << x << ' ' << y;
            }
    }
}

struct Noise : CellWorld {
    explicit Noise(const std::vector<std::string>& layers, double opacity = 0.5)
        : CellWorld(tests::noise(tests::twisted()), layers, opacity) {}
};

// Of rays, the picture has what they pass but for the arithmetic; of pixels, what their ramps make
// of the range's ends.
TEST(MeshCells, AreTheIntervalVolumeOfTheFieldInTheirTetrahedra) {
    const Noise world({"0.3:0.6", "min:max", "0.5~0.01"});
    for (const glm::dvec3& from : kFrom) {
        const View view = tests::lookFrom(from, {24, 20}, 0.1);
        // Few rays have an error of their own.
        const double more = tests::kSanitized ? 3 : 1;
        const std::array<double, 3> bounds = {0.08 * more, 2e-5, 0.25 * more};
        for (std::size_t layer = 0; layer < 3; ++layer) {
            // Whole tetrahedra have sharp sides, which a pixel's middle meets or not.
            const int rays = layer == 1 || tests::kSanitized ? 1 : 3;
            const IntervalTruth truth(world.scene, world.scene.cells->field(), rays);
            EXPECT_LT(relativeL2(drawn(world.scene, view, Channels::Weight, layer),
                                 truth.weight(view, layer)),
                      bounds[layer])
                << layer << " from " << from.x;
        }
        std::vector<glm::ivec2> pixels;
        std::vector<double> depth(24 * 20);
        for (int i = 0; i < 24 * 20; ++i) pixels.emplace_back(i % 24, i / 24);
        for (std::size_t layer = 0; layer < 3; ++layer) {
            const auto w = drawn(world.scene, view, Channels::Weight, layer);
            for (std::size_t i = 0; i < depth.size(); ++i)
                depth[i] += opticalDepthPerWeight(0.5) * double(w[i]);
        }
        const auto asked = cellDepthAt(world.scene, view, pixels, 1, 3);
        for (std::size_t i = 0; i < depth.size(); ++i)
            ASSERT_NEAR(asked[i], depth[i], 2e-4 * (1 + depth[i])) << i;
    }
}

TEST(MeshCells, NotABitDependsOnThreadsAndSlices) {
    const Noise world({"0.3:0.6"});
    const View view = tests::lookFrom(kFrom[0], {48, 40});
    const auto whole = drawn(world.scene, view, Channels::Over, 0, 1);
    EXPECT_EQ(drawn(world.scene, view, Channels::Over, 0, 5), whole);
    EXPECT_EQ(drawn(world.scene, view, Channels::Over, 0, 2, 7), whole);
}

TEST(MeshCells, APlaceBetweenPointsIsSeenUnderTheCursor) {
    const auto grid = affine({9, 9, 9}, glm::dmat3(1, 0.1, 0, 0, 1, 0.1, 0.1, 0, 1));
    CellWorld world(stepOfPlaces(grid, [](const auto& p) { return p.x; }), {"5.2:5.6"}, 0.01);
    world.scene.order = Order::BackToFront;
    const View view = tests::lookFrom({3, 0, 0}, {21, 21});
    const auto seen = pickCell(world.scene, view, {10.5, 10.5});
    ASSERT_TRUE(seen && seen->between);
    EXPECT_NEAR(*seen->between, 5.4, 1e-2) << "the middle, as nothing hides anything";
    const double x = world.placed.axesFromGrid({*seen->between, 0, 0}).x;
    EXPECT_NEAR(seen->depth, 3 - x, 1e-6);
    // The eye looks along y = z = 0, the middle of the box.
    const glm::dvec3 place = world.placed.gridFromAxes({x, 0, 0});
    const glm::dvec3 away = grid->position(seen->gridIndex) - place;
    EXPECT_LT(glm::length(away), 1.1);
    EXPECT_EQ(seen->value, timeseries::Number(double(float(grid->position(seen->gridIndex).x))));
    EXPECT_FALSE(pickCell(world.scene, view, {0.5, 0.5}));
}

}  // namespace
}  // namespace mesh_cells
}  // namespace render
