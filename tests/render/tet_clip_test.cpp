// Clip boxes of meshes: cells are cut where the box ends, whatever their shapes, against what rays
// pass of the box.
#include "render/splat/tet_clip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "render/model/tet_splat.h"
#include "render/reference/cells_on_rays.h"
#include "tests/support/bent_grids.h"
#include "tests/support/cell_rays.h"
#include "tests/support/geographic.h"

namespace render {
namespace tet_clip {
namespace {

using tests::CellWorld;
using tests::stepOfPlaces;
using tests::cells::inside;
using tests::cells::kFrom;

IndexBox boxOf(const glm::dvec3& from, const glm::dvec3& to) {
    IndexBox box;
    box.from = from;
    box.to = to;
    return box;
}

PlacedPoints::Box inAxes(const CellWorld& world, const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 a = world.placed.axesFromGrid(from), b = world.placed.axesFromGrid(to);
    return {glm::min(a, b), glm::max(a, b)};
}

// What is drawn of a field, all of which is in the range, is the box.
TEST(TetClip, CellsEndWhereTheBoxDoes) {
    const glm::dvec3 from(1.23, 0.71, 0.7), to(2.61, 1.37, 4.3);
    for (const auto& grid : tests::bentMeshes()) {
        CellWorld world(stepOfPlaces(grid, [](const auto& p) { return p.x; }), {"0:4"});
        world.scene.clip = boxOf(from, to);
        const PlacedPoints::Box left = inAxes(world, from, to);
        for (const glm::dvec3& eye : kFrom) {
            const View view = tests::lookFrom(eye, {40, 30}, 0.1);
            std::vector<glm::ivec2> pixels;
            for (int i = 0; i < 1200; ++i) pixels.emplace_back(i % 40, i / 40);
            const std::vector<double> depth = cellDepthAt(world.scene, view, pixels);
            const double perWeight = opticalDepthPerWeight(world.scene.layers[0].style.opacity);
            for (std::size_t i = 0; i < pixels.size(); ++i)
                ASSERT_NEAR(depth[i] / perWeight,
                            tests::cells::pathThrough(world, view, pixels[i].x, pixels[i].y, left),
                            2e-5)
                    << pixels[i].x << " " << pixels[i].y << " from " << eye.x;
            const std::vector<float> w = tests::drawn(world.scene, view);
            for (std::size_t i = 0; i < pixels.size(); ++i)
                ASSERT_NEAR(w[i], depth[i] / perWeight, 1e-3);
        }
    }
}

// In it the field goes on as it was: a range of one that is linear is a slab of the box, lit and
// coloured as without it. In order the parts of a cell come the nearest first.
TEST(TetClip, TheFieldGoesOnInWhatIsLeft) {
    for (const auto& grid : tests::bentMeshes()) {
        CellWorld world(stepOfPlaces(grid, [](const auto& p) { return p.x + 2 * p.y; }), {"1:8"},
                        0.9);
        world.scene.layers[0].style.color = ByValue{{}, 1, 8};
        world.scene.order = Order::BackToFront;
        const View view = tests::lookFrom({-0.6, -3, 0.4}, {40, 30}, 0.1);
        const auto whole = tests::drawn(world.scene, view, Channels::Over);
        // All that the eye, far away on this side, sees lies before this.
        world.scene.clip = boxOf(glm::dvec3(-9), {9, 2.3, 9});
        const auto left = tests::drawn(world.scene, view, Channels::Over);
        double off = 0, all = 0;
        for (std::size_t i = 0; i < whole.size(); ++i) {
            off += (whole[i] - left[i]) * (whole[i] - left[i]);
            all += whole[i] * whole[i];
        }
        EXPECT_LT(std::sqrt(off / all), 3e-2);
        EXPECT_GT(off, 0) << "or nothing was cut";
    }
}

Tetrahedron anyTet(std::mt19937& random) {
    std::uniform_real_distribution<double> any(-1, 1);
    Tetrahedron tet{};
    for (std::size_t i = 0; i < 4; ++i) {
        tet.at[i] = {any(random), any(random), any(random)};
        tet.values[i] = glm::dot(tet.at[i], glm::dvec3(3, -2, 1));
        tet.gradients[i] = 2.0 * tet.at[i];
        tet.corners[i] = unsigned(i);
    }
    return tet;
}

// What both sides of a plane have adds up; parts are turned as they were, linear between corners,
// and know the corner that they are beside.
TEST(TetClip, PartsAreAllOfATetrahedron) {
    const CellWorld world(stepOfPlaces(tests::bentColumns(), [](const auto& p) { return p.x; }),
                          {"0:4"});
    std::mt19937 random(7);
    const double at = world.placed.axesFromGrid({1.7, 0, 0}).x;
    int crossed = 0;
    for (int n = 0; n < 500; ++n) {
        const Tetrahedron tet = anyTet(random);
        double volume = 0;
        int parts = 0;
        for (const bool above : {false, true}) {
            IndexBox box;
            (above ? box.from : box.to).x = 1.7;
            TetClip(world.placed, box)(tet, nullptr, [&](const Tetrahedron& part) {
                ++parts;
                volume += turnOf(part.at);
                for (std::size_t i = 0; i < 4; ++i) {
                    EXPECT_TRUE(above ? part.at[i].x >= at : part.at[i].x <= at);
                    EXPECT_NEAR(part.values[i], glm::dot(part.at[i], glm::dvec3(3, -2, 1)), 1e-12);
                    EXPECT_NEAR(glm::length(part.gradients[i] - 2.0 * part.at[i]), 0, 1e-12);
                    const double corner = tet.at[part.corners[i]].x;
                    EXPECT_TRUE(above ? corner >= at : corner <= at);
                }
            });
        }
        EXPECT_NEAR(volume, turnOf(tet.at), 1e-12);
        crossed += parts > 1 ? 1 : 0;
    }
    EXPECT_GT(crossed, 100);
}

// Where a line from a place is within a tetrahedron: [first, second] of it.
std::pair<double, double> inside(const Tetrahedron& tet, const glm::dvec3& eye,
                                 const glm::dvec3& along) {
    const auto slopes = tet::slopesOf(tet.at);
    double from = 0, to = 1e9;
    for (std::size_t i = 0; i < 4; ++i) {
        const double share = (i == 0 ? 1 : 0) + glm::dot(slopes[i], eye - tet.at[0]);
        const double change = glm::dot(slopes[i], along);
        if (change > 0) from = std::max(from, -share / change);
        if (change < 0) to = std::min(to, -share / change);
        if (change == 0 && share < 0) return {1, 0};
    }
    return {from, to};
}

// By all six planes of a box: rays meet parts one after another, and between them all that lies in
// the tetrahedron and the box.
TEST(TetClip, PartsInABoxComeAsRaysMeetThem) {
    const CellWorld world(stepOfPlaces(tests::bentColumns(), [](const auto& p) { return p.x; }),
                          {"0:4"});
    const PlacedPoints::Box box = inAxes(world, {1, 1, 1.5}, {3, 2, 3.5});
    const TetClip clip(world.placed, boxOf({1, 1, 1.5}, {3, 2, 3.5}));
    std::mt19937 random(8);
    std::uniform_real_distribution<double> any(0, 1);
    int passed = 0;
    for (int n = 0; n < 300; ++n) {
        const Tetrahedron tet = anyTet(random);
        const glm::dvec3 eye = glm::dvec3(2, 1, -3) * (n % 2 ? 1.0 : 0.1);
        std::vector<Tetrahedron> parts;
        clip(tet, &eye, [&](const Tetrahedron& part) { parts.push_back(part); });
        for (int k = 0; k < 40; ++k) {
            const glm::dvec3 to =
                glm::mix(box.lo, box.hi, glm::dvec3(any(random), any(random), any(random)));
            const glm::dvec3 along = glm::normalize(to - eye);
            double before = 0, sum = 0;
            for (const Tetrahedron& part : parts) {
                const auto [from, until] = inside(part, eye, along);
                if (until - from < 1e-9) continue;
                ASSERT_GE(from, before - 1e-9);
                before = until;
                sum += until - from;
                ++passed;
            }
            auto [from, until] = inside(tet, eye, along);
            for (int a = 0; a < 3; ++a) {
                const double one = (box.lo[a] - eye[a]) / along[a];
                const double other = (box.hi[a] - eye[a]) / along[a];
                from = std::max(from, std::min(one, other));
                until = std::min(until, std::max(one, other));
            }
            ASSERT_NEAR(sum, std::max(until - from, 0.0), 1e-6);
        }
    }
    EXPECT_GT(passed, 5000);
}

// A box that is a plane holds points alone, with what is nearest to them.
TEST(TetClip, PlanesAreByPoints) {
    const auto grid = tests::bentCurvilinear();
    EXPECT_FALSE(TetClip(PlacedPoints(*grid), boxOf({0, 0, 2}, {4, 3, 2})).cuts());
    EXPECT_TRUE(TetClip(PlacedPoints(*grid), boxOf({0, 0, 2}, {4, 3, 2.1})).cuts());
}

// A face of the box that no point is beyond cuts nothing of the half cells around the outermost.
TEST(TetClip, HalfCellsStayWhereTheBoxHoldsAllPoints) {
    const auto grid = tests::bentCurvilinear();
    CellWorld world(stepOfPlaces(grid, [](const auto& p) { return p.x; }), {"0:4"});
    const View view = tests::lookFrom(kFrom[0], {40, 30}, 0.1);
    const auto all = tests::drawn(world.scene, view);
    world.scene.clip = boxOf({0, 0, 0}, {4, 3, 5});
    EXPECT_EQ(tests::drawn(world.scene, view), all);
}

// A globe's box is of its longitudes and latitudes, which are no planes.
TEST(TetClip, OfAGlobeIsByPoints) {
    const auto belt =
        tests::gridOf(tests::east(0, 40, 5), tests::north(0, 30, 4), tests::levels(3));
    const IndexBox box = indexBox(*belt, {0, 0, 0}, {40, 10, 2});
    EXPECT_FALSE(TetClip(PlacedPoints(*belt, {}, Map::Globe), box).cuts());
    EXPECT_FALSE(TetClip(PlacedPoints(*tests::bentCurvilinear()), {}).cuts());
    EXPECT_TRUE(
        TetClip(PlacedPoints(*tests::bentCurvilinear()), boxOf({0, 0, 0}, {4, 1, 5})).cuts());
}

}  // namespace
}  // namespace tet_clip
}  // namespace render
