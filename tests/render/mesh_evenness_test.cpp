// How even the splats of a mesh are, and that their mass is the space that its cells fill.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "render/splat/tile_splatter.h"
#include "tests/support/meshes.h"
#include "tests/support/splat_world.h"
#include "tests/support/unstructured.h"
#include "timeseries/grid/cell_types.h"

namespace render {
namespace {

using tests::curvilinear;
using namespace render::splat_world;

// Optical depth of what is seen from above between these places of the file, over a slab's
// thickness: how far it is from even.
struct Evenness {
    double mean, rms;  // from 1
    double about;      // the mean, relative: rms
};
Evenness evennessOf(const World& world, double thickness, const glm::dvec2& lo,
                    const glm::dvec2& hi) {
    const double scale = world.placed.scale().x;
    const auto& axes = world.step.grid().axes();
    const auto middle = [](const timeseries::Axis& axis) {
        return (axis.coordinates.front() + axis.coordinates.back()) / 2;
    };
    const glm::dvec2 centre(middle(axes[0]), middle(axes[1]));
    const View view = fromAbove(600);
    const auto w = weights(world, view);
    const PixelRays rays = besideFaces(pixelRays(view));
    double sum = 0, squares = 0;
    int pixels = 0;
    for (int y = 0; y < view.size.y; ++y)
        for (int x = 0; x < view.size.x; ++x) {
            const glm::dvec2 at =
                centre + (glm::dvec2(x + 0.5, y + 0.5) - rays.centre) / rays.focal * 1000.0 / scale;
            if (at.x < lo.x || at.y < lo.y || at.x > hi.x || at.y > hi.y) continue;
            const double depth = w[std::size_t(y) * std::size_t(view.size.x) + std::size_t(x)] *
                                 world.placed.unitLength() / scale / thickness;
            sum += depth;
            squares += (depth - 1) * (depth - 1);
            ++pixels;
        }
    EXPECT_GT(pixels, 2000);
    const double mean = sum / pixels, square = squares / pixels;
    return {mean, std::sqrt(square), std::sqrt(square - (mean - 1) * (mean - 1))};
}

World evenOf(std::shared_ptr<const Grid> grid) {
    return World(tests::stepOf(std::move(grid), [](std::size_t) { return 1; }));
}

// 0.2 % rms are asked for.
TEST(MeshEvenness, ASlabOfALatticeThatLeansIsAsEvenAsAnUprightOne) {
    for (const double lean : {0.0, 0.3, 1.0}) {
        const auto slab = evenOf(curvilinear({21, 21, 9}, [&](double i, double j, double k) {
            return glm::dvec3(i + lean * j - 0.2 * lean * k, j, k);
        }));
        // Away from the rims: of the middle of the rows that lean.
        const double middle = 10 + lean * (10 - 0.2 * 4);
        const auto seen = evennessOf(slab, 9, {middle - 4, 6}, {middle + 4, 14});
        EXPECT_NEAR(seen.mean, 1, 5e-4) << lean;
        EXPECT_LT(seen.rms, 0.002) << lean;
    }
}

// Steps that grow by a ratio from each to the next: a ripple of 1.5 % rms about the mean at a
// tenth, about a mean that is too great by sinh(a) / a of half the way between neighbours for the
// step, and by R^2 a^2 / 12 of splats that reach where steps are others, a being the ratio's
// logarithm.
TEST(MeshEvenness, ASlabOfCellsThatGrowIsAsEvenAsTheirRatioSays) {
    for (const auto& [ratio, ripple] : {std::pair(1.1, 0.015), {1.2, 0.028}, {1.5, 0.053}})
        for (int along = 0; along < 2; ++along) {
            const double a = std::log(ratio);
            const auto place = [&](double i) { return std::expm1(a * i) / a; };
            const int each = ratio < 1.4 ? 10 : 6;
            const std::size_t n = 2 * std::size_t(each) + 1;
            const auto slab = evenOf(curvilinear({n, n, 9}, [&](double i, double j, double k) {
                glm::dvec3 at(i - each, j - each, k);
                at[along] = place(at[along]);
                return at;
            }));
            glm::dvec2 lo(-3.5), hi(3.5);  // whole cells, away from the rims
            lo[along] = place(3 - each);
            hi[along] = place(each - 3);
            const auto seen = evennessOf(slab, 9, lo, hi);
            EXPECT_NEAR(seen.about, ripple, 5e-4) << ratio;
            EXPECT_NEAR(seen.mean, std::sinh(a) / a + kQuarticRadius * kQuarticRadius * a * a / 12,
                        1.5e-3)
                << ratio;
        }
}

// Rings about an axis, as far as three steps from it, with a ring of no volume on it or none. As
// needles, which all reach across it, they add up to 16 on it where the first ring is beside it.
TEST(MeshEvenness, ADiskOfRingsIsEvenAboutItsAxis) {
    for (const double first : {0.0, 0.5}) {
        const auto disk = evenOf(tests::rings(9, first));
        const double rim = 2.1;
        const auto seen = evennessOf(disk, 3, {-rim, -rim}, {rim, rim});
        EXPECT_NEAR(seen.mean, 1, 0.04) << first;
        EXPECT_LT(seen.rms, 0.1) << first;
    }
}

// Where a line ends where it began the seam is as even as the rest; both ends' whole steps would
// make it twice as dense.
TEST(MeshEvenness, AnAnnulusIsEvenAtItsSeam) {
    const auto annulus = evenOf(curvilinear({49, 15, 9}, [](double i, double j, double k) {
        const double angle = i * std::numbers::pi / 24, r = 8 + j;
        return glm::dvec3(r * std::cos(angle), r * std::sin(angle), k);
    }));
    const auto seam = evennessOf(annulus, 9, {12, -4}, {18, 4});
    const auto beside = evennessOf(annulus, 9, {-18, -4}, {-12, 4});
    EXPECT_NEAR(seam.mean, beside.mean, 1e-3);
    EXPECT_NEAR(seam.rms, beside.rms, 1e-3);
}

// What all splats stand for, as the world has it, where cells tile it: of each kind alone, of kinds
// side by side, and above each other.
TEST(MeshEvenness, OfCellsThatTileItHaveTheMassOfTheMesh) {
    const auto expectMass = [](timeseries::Mesh mesh, double volume) {
        const auto grid = tests::gridOf(std::move(mesh));
        const PlacedPoints placed(*grid);
        double mass = 0;
        for (std::uint64_t i = 0; i < grid->count(); ++i) mass += placed.meshVolume(i);
        const glm::dvec3 scale = glm::abs(placed.scale());
        const double expected = volume * scale.x * scale.y * scale.z;
        EXPECT_NEAR(mass, expected, 1e-6 * expected);
        return grid->count();
    };
    for (const auto cut : tests::kCuts) {
        const auto grid = tests::bentBricks(cut);  // in a box of 4 x 3 x 5
        expectMass(tests::atCells(grid), 60);
        expectMass(tests::atPoints(grid), 60);
    }
    // Two layers of bricks; those above are each six pyramids about their middle, or two wedges.
    timeseries::UnstructuredGrid mixed = tests::bricks(
        {4, 4, 3}, tests::Cut::Hexahedra, [](double i, double j, double k) -> glm::dvec3 {
            return {i + 0.1 * i * j, 1.3 * j, k * (1 + 0.1 * k)};
        });
    timeseries::UnstructuredGrid other;
    other.points = mixed.points;
    const auto& faces = timeseries::cellTypeOf(12)->faces;
    for (std::size_t cell = 0; cell < mixed.types.size(); ++cell) {
        const auto c = listOf(mixed.corners, mixed.ends, cell);
        if (cell < 9) {
            tests::addCell(other, 12, {c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7]});
        } else if (cell % 2 == 0) {
            tests::addCell(other, 13, {c[0], c[1], c[2], c[4], c[5], c[6]});
            tests::addCell(other, 13, {c[0], c[2], c[3], c[4], c[6], c[7]});
        } else {
            glm::dvec3 middle(0);
            for (const std::uint32_t corner : c) middle += other.points[corner] / 8.0;
            const auto apex = static_cast<std::uint32_t>(other.points.size());
            other.points.push_back(middle);
            for (std::size_t f = 0; f < 24; f += 4)
                tests::addCell(
                    other, 14,
                    {c[faces[f]], c[faces[f + 1]], c[faces[f + 2]], c[faces[f + 3]], apex});
        }
    }
    // A trapezium: 3.9 high, 3 wide at j = 0, 3.9 at j = 3; up to 2.4.
    const double volume = 3.9 * (3 + 3.9) / 2 * 2.4;
    ASSERT_EQ(flawOf(other), "");
    EXPECT_EQ(expectMass(tests::atCells(other), volume), 9u + 5 * 6 + 4 * 2);
    expectMass(tests::atPoints(other), volume);
    // Two triangles and a rectangle, 6 in all, on levels that stand for 10, 15 and 20.
    timeseries::UnstructuredGrid flat;
    flat.points = {{0, 0, 0}, {2, 0, 0}, {3, 0, 0}, {0, 2, 0}, {2, 2, 0}, {3, 2, 0}};
    tests::addCell(flat, 5, {0, 1, 3});
    tests::addCell(flat, 5, {1, 4, 3});
    tests::addCell(flat, 9, {1, 2, 5, 4});
    const timeseries::UnstructuredShapes shapes(flat);
    EXPECT_EQ(expectMass(meshOfCells(flat, shapes, {0, 10, 30}), 6 * 45), 9u);
    EXPECT_EQ(expectMass(meshOfPoints(flat, shapes, {0, 10, 30}), 6 * 45), 18u);
}

// A grid of every step, as a reader makes it of places that move, which here do not.
TEST(MeshEvenness, OfAMeshThatMovesNowhereAreThoseOfOneThatStands) {
    const auto cells = tests::bentBricks(tests::Cut::Tetrahedra);
    for (const auto& make : std::vector<std::function<std::shared_ptr<const Grid>()>>{
             [] { return tests::twisted(); },
             [] {
                 return tests::columns({0, 1, 3});
             },
             [&] { return tests::gridOf(tests::atCells(cells)); },
             [&] { return tests::gridOf(tests::atPoints(cells)); }}) {
        const auto still = make(), again = make();
        EXPECT_EQ(gridOfStep(still, again), still) << "nothing is kept twice";
        const auto moving = std::make_shared<const Grid>(still->axes(), again->mesh(), true);
        const View view = tests::lookFrom({1.4, -2.3, 1.1}, {90, 80}, 0.5);
        const auto drawn = weights(evenOf(still), view);
        EXPECT_GT(*std::ranges::max_element(drawn), 0);
        EXPECT_EQ(drawn, weights(evenOf(moving), view));
        const World a = evenOf(still), b = evenOf(moving);
        EXPECT_EQ(sumTiles(a.scene, Runs{}, view, Channels::Weight, 0, {}),
                  sumTiles(b.scene, Runs{}, view, Channels::Weight, 0, {}));
    }
}

// At their cells and at their points, bent a little, seen through their middle: as even as
// ellipsoids on no lattice are (2.8 % rms). The whole mass is there in any case.
TEST(MeshEvenness, ASlabOfOtherCellsIsEvenAndKeepsItsMass) {
    const auto place = [](double i, double j, double k) {
        const double wave = 0.1 * std::sin(2.1 * i) * std::sin(1.7 * j) * std::sin(1.3 * k);
        return glm::dvec3(i + wave, j - wave, k + wave);
    };
    for (const auto cut : {tests::Cut::Hexahedra, tests::Cut::Tetrahedra, tests::Cut::Wedges}) {
        const auto grid = tests::bricks({17, 17, 9}, cut, place);
        for (const auto& meshOf : {tests::atCells, tests::atPoints}) {
            const World world(
                tests::stepOf(tests::gridOf(meshOf(grid)), [](std::size_t) { return 1; }));
            const auto seen = evennessOf(world, 8, {4, 4}, {12, 12});
            EXPECT_NEAR(seen.mean, 1, 0.01);
            EXPECT_LT(seen.rms, 0.028);
            const double scale = world.placed.scale().x;
            const View view = fromAbove(400);
            const auto w = weights(world, view);
            EXPECT_NEAR(massDrawn(w, view, 1000) * world.placed.unitLength(),
                        16 * 16 * 8 * scale * scale * scale,
                        0.01 * 16 * 16 * 8 * scale * scale * scale);
        }
    }
}

}  // namespace
}  // namespace render
