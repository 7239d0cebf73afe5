// Splats of points that lie one by one: against upright grids, closed forms, and each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "render/model/pick.h"
#include "render/reference/exact_order.h"
#include "render/splat/tile_splatter.h"
#include "tests/support/meshes.h"
#include "tests/support/splat_world.h"
#include "tests/support/unstructured.h"

namespace render {
namespace {

using tests::curvilinear;
using namespace render::splat_world;

double valueOf(std::size_t i) { return double((i * 7919) % 1000); }

World worldOf(std::shared_ptr<const Grid> grid, Footprint footprint = {},
              const RangeSet& range = RangeSet::everything()) {
    return World(tests::stepOf(std::move(grid), valueOf), range, footprint);
}

// The places of an upright grid, one by one.
std::shared_ptr<const Grid> straight(const Grid& upright) {
    const auto n = upright.size();
    return curvilinear(n, [&](double i, double j, double k) {
        return upright.position(
            static_cast<std::uint64_t>(i + double(n[0]) * (j + double(n[1]) * k)));
    });
}

double greatest(const std::vector<double>& w) { return *std::ranges::max_element(w); }

void expectAlike(const std::vector<double>& a, const std::vector<double>& b, double error) {
    ASSERT_EQ(a.size(), b.size());
    const double most = greatest(a);
    ASSERT_GT(most, 0);
    for (std::size_t i = 0; i < a.size(); ++i)
        ASSERT_NEAR(a[i], b[i], error * most) << "pixel " << i;
}

// Uneven, and larger than pixels: upright splats then grow nowhere.
Grid uneven() {
    timeseries::Axis x = axis(7), y = axis(6, 0, 1.5), z = axis(5, 0, 0.8);
    for (double& c : x.coordinates) c += 0.03 * c * c;
    return Grid({x, y, z});
}

TEST(MeshSplats, OfAStraightMeshAreThoseOfTheUprightGrid) {
    const Grid upright = uneven();
    for (const Footprint footprint :
         {Footprint{}, Footprint{Kernel::Quartic, 1.5}, Footprint{Kernel::Point, 5}})
        for (const glm::dvec3 from : {glm::dvec3(1.2, -2.5, 0.9), glm::dvec3(0.1, -0.2, 0.05)}) {
            const View view = tests::lookFrom(from, {90, 80}, 0.5);
            const auto as = [&](std::shared_ptr<const Grid> grid) {
                return weights(worldOf(std::move(grid), footprint), view);
            };
            // A cell's sides are kept to a 250th.
            expectAlike(as(std::make_shared<Grid>(upright)), as(straight(upright)), 2e-3);
        }
}

TEST(MeshSplats, SmallerThanAPixelAreBlurredALittleMoreAndKeepTheirMass) {
    const View view = tests::lookFrom({20, -60, 20}, {120, 100}, 0.05);  // 0.3 pixels a cell
    const auto upright = std::make_shared<Grid>(std::array{axis(12), axis(12), axis(12)});
    const auto a = weights(worldOf(upright), view), b = weights(worldOf(straight(*upright)), view);
    double massA = 0, massB = 0;
    for (std::size_t i = 0; i < a.size(); ++i) massA += a[i], massB += b[i];
    EXPECT_NEAR(massB, massA, 2e-4 * massA);
    EXPECT_NEAR(greatest(b), greatest(a), 0.05 * greatest(a));
}

// A lattice that leans: what is drawn in all is its volume.
TEST(MeshSplats, DrawTheVolumeOfWhatTheyStandFor) {
    const glm::dmat3 steps({1, 0.2, 0}, {-0.3, 0.9, 0.25}, {0.1, 0.4, 1.2});
    const World world = worldOf(curvilinear(
        {6, 5, 7}, [&](double i, double j, double k) { return steps * glm::dvec3(i, j, k); }));
    const View view = tests::lookFrom({0, -200, 0}, {400, 400}, 0.01);
    const double scale = world.placed.scale().x;
    const double volume = 6 * 5 * 7 * glm::determinant(steps) * scale * scale * scale;
    EXPECT_NEAR(massDrawn(weights(world, view), view, 200) * world.placed.unitLength(), volume,
                0.002 * volume);  // of the depth of the box at this distance
}

TEST(MeshSplats, OrderAndSenseOfTheIndicesChangeNothing) {
    const auto place = [](double i, double j, double k) {
        return glm::dvec3(i + 0.2 * std::sin(j), j + 0.1 * i * k / 5, k - 0.15 * std::cos(i));
    };
    const View view = tests::lookFrom({1.4, -2.3, 1.1}, {90, 80}, 0.5);
    const auto drawn = [&](std::shared_ptr<const Grid> grid) {
        return weights(World(tests::stepOf(std::move(grid), [](std::size_t) { return 1; })), view);
    };
    const auto plain = drawn(curvilinear({6, 5, 4}, place));
    expectAlike(plain,
                drawn(curvilinear({6, 5, 4}, [&](double i, double j,
                                                 double k) { return place(5 - i, j, 3 - k); })),
                1e-6);
    expectAlike(
        plain,
        drawn(curvilinear({4, 6, 5}, [&](double k, double i, double j) { return place(i, j, k); })),
        1e-6);
    expectAlike(
        plain,
        drawn(curvilinear({5, 6, 4}, [&](double j, double i, double k) { return place(i, j, k); })),
        1e-6);
}

// A ring of two radii and a height, in sectors: along its axis the mean optical depth is the
// height, less what splats lose by the curvature that they do not follow, R^2 dtheta^2 / 12, and by
// the chord that stands for an arc.
TEST(MeshSplats, ARingLosesWhatTheFormulaSays) {
    constexpr int kRadii = 24, kLevels = 9;
    for (const auto& [sectors, tolerance] : {std::pair(64, 0.001), {32, 0.002}, {16, 0.01}}) {
        const double turn = 2 * std::numbers::pi / sectors;
        // Closed: the last sector's neighbours are the first's, one round farther.
        const auto grid = curvilinear({kRadii, static_cast<std::size_t>(sectors) + 1, kLevels},
                                      [&](double i, double j, double k) {
                                          const double r = 1 + i / (kRadii - 1);
                                          return glm::dvec3(r * std::cos(turn * j),
                                                            r * std::sin(turn * j), 0.1 * k);
                                      });
        const World world(tests::stepOf(grid, [](std::size_t) { return 1; }));
        const double scale = world.placed.scale().x;
        const View view = fromAbove(600);
        const auto w = weights(world, view);
        const PixelRays rays = pixelRays(view);
        double sum = 0;
        int pixels = 0;
        for (int y = 0; y < 600; ++y)
            for (int x = 0; x < 600; ++x) {
                const glm::dvec2 at =
                    (glm::dvec2(x + 0.5, y + 0.5) - rays.centre) / rays.focal * 1000.0 / scale;
                // Away from the rims, and from the seam, where the ends are.
                const double r = glm::length(at), angle = std::atan2(at.y, at.x);
                if (r < 1.25 || r > 1.75 || std::abs(angle) < 3 * turn) continue;
                sum += w[std::size_t(y) * 600 + x] * world.placed.unitLength() / scale;
                ++pixels;
            }
        const double height = 0.1 * kLevels;
        const double expected =
            std::sin(turn) / turn - 1 - kQuarticRadius * kQuarticRadius / 12 * turn * turn;
        EXPECT_NEAR(sum / pixels / height - 1, expected, tolerance) << sectors << " sectors";
    }
}

TEST(MeshSplats, TilesSumColumnsOfFewLevelsAsTheTruthDoes) {
    const World world = worldOf(tests::columns({0, 1, 3}));
    ASSERT_TRUE(world.placed.longCells());
    for (const auto& from : {glm::dvec3(1.5, -2, 1), {0.2, -0.3, 0.1}, {30, -40, 10}}) {
        const View view = tests::lookFrom(from, {120, 90}, 0.5);
        const auto tiles = sumTiles(world.scene, Runs{}, view, Channels::Weight, 0, {});
        expectAlike(weights(world, view), {tiles.begin(), tiles.end()}, 1e-5);
    }
}

// The same whole pixels as the truth has.
TEST(MeshSplats, TilesSumPointsOfWholePixels) {
    for (const double size : {1.0, 3.0}) {
        const World world = worldOf(tests::twisted(), {Kernel::Point, size});
        const View view = tests::lookFrom({1.5, -2, 1}, {120, 90}, 0.5);
        for (const unsigned threads : {1u, 3u}) {
            const auto tiles =
                sumTiles(world.scene, Runs{}, view, Channels::Weight, 0, {}, threads);
            expectAlike(weights(world, view), {tiles.begin(), tiles.end()}, 1e-5);
        }
    }
}

TEST(MeshSplats, TilesSumWhatTheTruthDoes) {
    for (const auto& [from, size] : {std::pair(glm::dvec3(1.5, -2, 1), 1.0),
                                     {glm::dvec3(0.2, -0.3, 0.1), 1.0},
                                     {glm::dvec3(30, -40, 10), 1.0},
                                     {glm::dvec3(1.5, -2, 1), 2.0}}) {
        const World world = worldOf(tests::twisted(), {Kernel::Quartic, size});
        const View view = tests::lookFrom(from, {120, 90}, 0.5);
        const auto truth = weights(world, view);
        for (const unsigned threads : {1u, 3u}) {
            const auto tiles =
                sumTiles(world.scene, Runs{}, view, Channels::Weight, 0, {}, threads);
            expectAlike(truth, {tiles.begin(), tiles.end()}, 1e-5);
        }
    }
}

// Of few levels: what is drawn in all is the volume of the columns, half a level above and below
// the outermost ones with them, and beyond these nothing.
TEST(MeshSplats, ColumnsOfFewLevelsEndWhereTheyEnd) {
    for (const std::vector<double>& levels :
         {std::vector<double>{0, 20}, {50, 30, 20}, {0, 10, 20, 30, 40}}) {
        auto places = tests::placesOf(
            {20, 20, 1}, [](double i, double j, double) { return glm::dvec3(i + 0.3 * j, j, 0); });
        places.size[2] = levels.size();
        places.levels = levels;
        const World world = worldOf(tests::gridOf(places));
        ASSERT_TRUE(world.placed.longCells());
        const View view = tests::lookFrom({0, -200, 0}, {400, 400}, 0.01);
        const auto w = weights(world, view);
        const glm::dvec3 scale = glm::abs(world.placed.scale());
        const double above = std::abs(levels[1] - levels[0]) / 2,
                     below = std::abs(levels[levels.size() - 2] - levels.back()) / 2;
        const double heights = std::abs(levels.back() - levels.front()) + above + below;
        const double volume = 400 * heights * scale.x * scale.y * scale.z;
        EXPECT_NEAR(massDrawn(w, view, 200) * world.placed.unitLength(), volume, 0.01 * volume)
            << levels.size();
        // Rows of pixels above and below the box.
        const auto box = world.placed.domain();
        const PixelRays rays = pixelRays(view);
        const double pixels = rays.focal.y / 200;  // a unit of the world
        for (int y = 0; y < 400; ++y) {
            const double z = (y + 0.5 - rays.centre.y) / pixels;
            if (z > box.lo.z - 2 / pixels && z < box.hi.z + 2 / pixels) continue;
            for (int x = 0; x < 400; ++x)
                ASSERT_EQ(w[std::size_t(y) * 400 + x], 0) << x << ' ' << y;
        }
    }
    EXPECT_FALSE(
        worldOf(tests::columns({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11})).placed.longCells());
}

// A boundary layer that leans, ten thousand times as wide as high, near by and far below a pixel.
TEST(MeshSplats, FlatCellsThatLeanAreTheTruths) {
    const World world = worldOf(curvilinear({7, 6, 8}, [](double i, double j, double k) {
        return glm::dvec3(i + 0.3 * j, j - 0.2 * i, 0.4 * i + 0.25 * j + 1e-4 * k * (1 + 0.1 * k));
    }));
    for (const auto& from : {glm::dvec3(1.2, -1.6, 0.8), {0.3, -0.2, 0.05}, {40, -60, 30}}) {
        const View view = tests::lookFrom(from, {110, 90}, 0.5);
        const auto truth = weights(world, view);
        const auto tiles = sumTiles(world.scene, Runs{}, view, Channels::Weight, 0, {});
        expectAlike(truth, {tiles.begin(), tiles.end()}, 1e-4);
    }
}

// By value and in order, some of them hidden, and half of the points standing for all.
TEST(MeshSplats, TilesSumEveryChannelAsTheTruthDoes) {
    World world = worldOf(tests::twisted());
    world.scene.layers[0].style = {ByValue{ColorMap(), 0, 1000}, 0.7};
    world.scene.stride = 2;
    const View view = tests::lookFrom({1.5, -2, 1}, {150, 130}, 0.5);
    std::vector<float> opaque(150 * 130, 1.0f);
    for (std::size_t i = 0; i < opaque.size(); i += 3)
        opaque[i] = static_cast<float>(windowDepth(view, 2.6));
    for (const Order by : {Order::None, Order::BackToFront}) {
        world.scene.order = by;
        const Channels channels = by == Order::None ? Channels::WeightedColor : Channels::Over;
        const DrawList list = orderExactly(world.scene, {1.5, -2, 1});
        Accumulator<double> truth(view.size, {channels});
        splat(world.scene, list, view, opaque, truth);
        const auto tiles = sumTiles(world.scene, list, view, channels, 0, opaque);
        expectAlike(truth.planes[0], {tiles.begin(), tiles.end()}, 2e-5);
        // In slices, on any number of threads, a pair of splat and tile at a time.
        for (const unsigned threads : {1u, 3u}) {
            TileSum sum(world.scene, list, view, channels, 0, opaque, threads, {}, threads);
            while (!sum.done()) sum.add(threads);
            const PlanePixels sliced = sum.plane();
            TileSum whole(world.scene, list, view, channels, 0, opaque, 2);
            whole.add(1 << 20);
            EXPECT_EQ(sliced, whole.plane());
        }
    }
}

TEST(MeshSplats, APointWithoutAPlaceIsNotDrawn) {
    const auto grid = tests::twisted();
    const std::size_t hole = 4 + 9 * (4 + 8 * 3);
    const World world(tests::stepOf(grid, [&](std::size_t i) { return i == hole ? 1.0 : 0.0; }),
                      RangeSet::parse("1"));
    ASSERT_EQ(pointCount(world.scene.layers[0]), 1u);
    const View view = tests::lookFrom({1.5, -2, 1}, {60, 50}, 0.5);
    EXPECT_EQ(greatest(weights(world, view)), 0);
}

TEST(MeshSplats, AreOrderedByDistance) {
    World world = worldOf(tests::twisted());
    world.scene.order = Order::BackToFront;
    const glm::dvec3 eye(1.5, -2, 1);
    const auto sorted = std::get<Sorted>(order(world.scene, eye));
    EXPECT_EQ(sorted.point.size(), world.step.size() - 1) << "but the one without a place";
    const auto gridIndex = world.step.gridIndex();
    double before = std::numeric_limits<double>::infinity();
    for (const std::uint32_t point : sorted.point) {
        const double away = glm::distance(world.placed.position(gridIndex[point]), eye);
        EXPECT_LE(away, before + 1e-6);  // keys tell distances to 2^-22 of the box
        before = away;
    }
    EXPECT_EQ(std::get<Sorted>(orderExactly(world.scene, eye)).point.size(), sorted.point.size());
}

// The box is one of the file's coordinates.
TEST(MeshSplats, AreClippedWhereTheyLie) {
    const auto grid = tests::twisted();
    World world = worldOf(grid);
    const glm::dvec3 lo(-2, -1.5, 0.3), hi(3, 2, 2.5);
    world.scene.clip = indexBox(*grid, lo, hi);
    world.scene.order = Order::BackToFront;
    const auto sorted = std::get<Sorted>(order(world.scene, {1.5, -2, 1}));
    std::size_t inside = 0;
    for (std::uint64_t i = 0; i < grid->count(); ++i) {
        const glm::dvec3 at = grid->position(i);
        inside += at.x >= lo.x && at.y >= lo.y && at.z >= lo.z && at.x <= hi.x && at.y <= hi.y &&
                  at.z <= hi.z;
    }
    EXPECT_GT(inside, 10u);
    EXPECT_EQ(sorted.point.size(), inside);
    for (const std::uint32_t point : sorted.point)
        EXPECT_TRUE(world.scene.clip.holdsPlace(grid->position(world.step.gridIndex()[point])));
}

TEST(MeshSplats, ArePickedAsThoseOfTheUprightGrid) {
    const Grid upright = uneven();
    const World a = worldOf(std::make_shared<Grid>(upright)), b = worldOf(straight(upright));
    const View view = tests::lookFrom({1.2, -2.5, 0.9}, {90, 80}, 0.5);
    int found = 0;
    for (double y = 5; y < 80; y += 7.3)
        for (double x = 5; x < 90; x += 7.9) {
            const auto one = pick(a.scene, view, {x, y}), other = pick(b.scene, view, {x, y});
            ASSERT_EQ(one.has_value(), other.has_value());
            if (!one) continue;
            EXPECT_EQ(one->gridIndex, other->gridIndex);
            ++found;
        }
    EXPECT_GT(found, 20);
}

}  // namespace
}  // namespace render
