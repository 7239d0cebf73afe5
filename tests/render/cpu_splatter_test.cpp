// The truth itself against closed forms: if these fail, no other picture test means anything.
#include "render/reference/cpu_splatter.h"
#include "render/splat/depth_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <numeric>
#include <random>

#include "render/model/footprint.h"
#include "tests/support/scenes.h"

namespace render {
namespace {

using tests::axis;
using timeseries::Grid;
using timeseries::RangeSet;

// Everything of a step in one layer.
struct World {
    explicit World(timeseries::SortedStep s, const RangeSet& range = RangeSet::everything(),
                   Footprint footprint = {})
        : step(std::move(s)),
          placed(step.grid()),
          scene{.step = step,
                .placed = placed,
                .layers = {{step.select(range), {Constant{glm::dvec3(1)}, 0.5}}},
                .footprint = footprint,
                .order = Order::None,
                .clip = {}} {}
    timeseries::SortedStep step;
    PlacedPoints placed;
    Scene scene;
};

std::vector<double> weights(const World& world, const View& view) {
    Accumulator<double> sums(view.size, {Channels::Weight});
    splat(world.scene, Runs{}, view, {}, sums);
    return sums.planes[0];
}

// Sum over pixels of W times the area that a pixel sees at the depth of the points: the mass that
// was drawn, in units of l. Exact for parallel rays; the views below are nearly that.
double massDrawn(const std::vector<double>& w, const View& view, double depth) {
    const PixelRays rays = pixelRays(view);
    double sum = 0;
    for (int y = 0; y < view.size.y; ++y)
        for (int x = 0; x < view.size.x; ++x) {
            const glm::dvec2 slope = (glm::dvec2(x + 0.5, y + 0.5) - rays.centre) / rays.focal;
            const double cosine = 1 / std::sqrt(1 + glm::dot(slope, slope));
            sum += w[std::size_t(y) * view.size.x + x] * cosine;
        }
    return sum * depth * depth / (rays.focal.x * rays.focal.y);
}

// Of long cells whose points all stand at corners of the domain: what their cut splats lack there
// (tests/render/footprint_test.cpp).
constexpr double kAtCorners = 0.011;

timeseries::SortedStep onePoint() {
    return tests::stepOf(std::make_shared<Grid>(std::array{axis(1), axis(1), axis(1)}),
                         [](std::size_t) { return 1.0; });
}

TEST(Truth, ASingleSplatsCentreIsTheKernelsPeak) {
    // V = l = 1, a = R: W = 5 / (pi R^2). An odd picture has a pixel on the axis.
    const auto w = weights(World(onePoint()), tests::lookFrom({0, -50, 0}, {201, 201}, 0.05));
    EXPECT_NEAR(w[100 * 201 + 100], 5 / (std::numbers::pi * kQuarticRadius * kQuarticRadius),
                1e-12);
}

TEST(Truth, ASingleSplatsTotalIsItsCellsVolume) {
    const View view = tests::lookFrom({0, -50, 0}, {201, 201}, 0.05);
    for (const Footprint footprint :
         {Footprint{Kernel::Quartic, 1}, Footprint{Kernel::Quartic, 1.5},
          Footprint{Kernel::Point, 1}, Footprint{Kernel::Point, 7}}) {
        const World world(onePoint(), RangeSet::everything(), footprint);
        // Rays diverge by up to a / z over the splat: 1.5 R / 50 squared is 2e-3.
        EXPECT_NEAR(massDrawn(weights(world, view), view, 50), 1, 2e-3)
            << "kernel " << int(footprint.kernel) << " size " << footprint.size;
    }
}

// The formula of footprint.h, with b as the distance of a ray from a centre in kernel space.
TEST(Truth, NearSplatsAreTheKernelsLineIntegralsOnEveryRay) {
    const World world(
        tests::stepOf(std::make_shared<Grid>(std::array{axis(2), axis(2, 0, 1.5), axis(2, 0, 0.8)}),
                      [](std::size_t i) { return double(i); }));
    ASSERT_FALSE(world.placed.longCells());
    const View view = tests::lookFrom({0.7, -2.2, 0.4}, {60, 50}, 0.9);
    const PixelRays rays = pixelRays(view);
    const auto w = weights(world, view);
    for (int y = 0; y < 50; ++y)
        for (int x = 0; x < 60; ++x) {
            const glm::dvec2 o = glm::dvec2(x + 0.5, y + 0.5) - rays.centre;
            const glm::dvec3 d = rays.axis + o.x * rays.perPixelX + o.y * rays.perPixelY;
            double expected = 0;
            for (std::size_t i = 0; i < world.step.size(); ++i) {
                const glm::dvec3 cell = world.placed.cell(i), a = kQuarticRadius * cell;
                const glm::dvec3 from = (world.placed.position(i) - rays.eye) / a, along = d / a;
                const double passed = glm::dot(from, along) / glm::length(along);
                const double b2 = glm::dot(from, from) - passed * passed;
                if (b2 < 1)
                    expected += cell.x * cell.y * cell.z /
                                (world.placed.unitLength() * a.x * a.y * a.z) * 5 /
                                std::numbers::pi * std::pow(1 - b2, 4) * glm::length(d) /
                                glm::length(along);
            }
            ASSERT_NEAR(w[std::size_t(y) * 60 + x], expected, 1e-9) << x << ' ' << y;
        }
}

TEST(Truth, ASplatOfTwiceTheSizeIsAQuarterAsDense) {
    const auto peak = [](double size) {
        const World world(onePoint(), RangeSet::everything(), {Kernel::Quartic, size});
        return weights(world, tests::lookFrom({0, -5, 0}, {101, 101}))[50 * 101 + 50];
    };
    EXPECT_NEAR(peak(2), peak(1) / 4, 1e-12);
    EXPECT_NEAR(peak(3), peak(1) / 9, 1e-12);
}

TEST(Truth, ASubsetHasTheMassOfTheWhole) {
    // Far away every point weighs the same.
    const View view = tests::lookFrom({0, -400, 0}, {65, 65}, 0.005);
    World world(tests::noise(tests::cube(12)), RangeSet::parse("0.1:0.2,0.5:0.83"));
    const double whole = massDrawn(weights(world, view), view, 400);
    for (const std::uint32_t stride : {1u, 2u, 8u, 128u, kMaxStride}) {
        world.scene.stride = stride;
        EXPECT_NEAR(massDrawn(weights(world, view), view, 400), whole, 1e-2 * whole) << stride;
    }
    // Ordered, the list holds the subset.
    world.scene.order = Order::BackToFront;
    world.scene.stride = 8;
    auto listed = std::get<Sorted>(order(world.scene, {0, -3, 0})).point;
    std::ranges::sort(listed);
    std::vector<std::uint32_t> expected;
    for (const auto& run : world.scene.layers[0].runs)
        for (std::uint64_t p = run.first; p < run.first + run.count; ++p)
            if (inSubset(p, 8)) expected.push_back(static_cast<std::uint32_t>(p));
    EXPECT_EQ(listed, expected);
    EXPECT_EQ(expected.size(), splatCount(world.scene.layers[0], 8));
}

TEST(Truth, ALayerOfFewPointsKeepsItsMassAtEveryStride) {
    for (std::uint64_t first = 0; first < 600; ++first)
        for (const std::uint64_t count : {1u, 3u, 70u})
            for (const std::uint32_t stride : {2u, 64u, kMaxStride}) {
                const Layer layer{{{first, count}}, {}};
                const auto splats = static_cast<double>(splatCount(layer, stride));
                ASSERT_GE(splats, 1);
                ASSERT_LE(splats, count);
                ASSERT_DOUBLE_EQ(splats * pointsPerSplat(layer, stride),
                                 static_cast<double>(count));
            }
    EXPECT_EQ(splatCount({}, kMaxStride), 0u);
}

TEST(Truth, TheTotalStaysWhenTheSplatIsSmallerThanAPixel) {
    // From far away the cell is a tenth of a pixel; its position between the pixels must not show.
    for (const double shift : {0.0, 0.2, 0.37, 0.5}) {
        View view = tests::lookFrom({0, -1000, 0}, {65, 65}, 0.325);
        view.viewFromWorld[3].x += shift * 2 * 0.325 / 65 * 1000;
        EXPECT_NEAR(massDrawn(weights(World(onePoint()), view), view, 1000), 1, 5e-3) << shift;
    }
}

TEST(Truth, ItStaysWherePixelsAreNotSquareEither) {
    // Of a tenth of the pixel's longer side; a radius of the shorter one alone would show.
    for (const glm::dvec2 half : {glm::dvec2(0.325, 0.1), glm::dvec2(0.1, 0.325)})
        for (const double shift : {0.0, 0.2, 0.37, 0.5}) {
            View view = tests::lookFrom({0, -1000, 0}, {65, 65});
            view.clipFromView = clipFromView({-half.x, half.x, -half.y, half.y, 0.01, 5000});
            view.viewFromWorld[3] += glm::dvec4(shift * 2.0 * half / 65.0 * 1000.0, 0, 0);
            EXPECT_NEAR(massDrawn(weights(World(onePoint()), view), view, 1000), 1, 5e-3)
                << half.x << ' ' << shift;
        }
}

TEST(Truth, UnequalSpacingsKeepTheTotalFromEverySide) {
    const auto grid = std::make_shared<Grid>(std::array{axis(2), axis(2, 0, 4), axis(2, 0, 0.25)});
    const World world(tests::stepOf(grid, [](std::size_t) { return 1.0; }));
    const glm::dvec3 cell = world.placed.cell(0);
    const double volume = 8 * cell.x * cell.y * cell.z / world.placed.unitLength();
    for (const glm::dvec3 from :
         {glm::dvec3(7, -60, 4), glm::dvec3(0, -1, 60), glm::dvec3(40, -40, 20)}) {
        const View view = tests::lookFrom(from, {301, 301}, 0.08);
        EXPECT_NEAR(massDrawn(weights(world, view), view, glm::length(from)), volume,
                    kAtCorners * volume)
            << from.x << ' ' << from.y << ' ' << from.z;
    }
}

TEST(Truth, ASlabOfUniformOpticalDepthIsItsThickness) {
    // 40 x 40 columns of 8 cells, seen from far: W is 8 along the axis, 8 / cos obliquely, to the
    // kernel's ripple of half a per cent.
    const auto grid = std::make_shared<Grid>(std::array{axis(40), axis(40), axis(8)});
    const World world(tests::stepOf(grid, [](std::size_t) { return 1.0; }));
    for (const double tilt : {0.0, 0.3, 0.6}) {
        const glm::dvec3 from = 200.0 * glm::dvec3(0, -std::sin(tilt) - 1e-9, std::cos(tilt));
        const View view = tests::lookFrom(from, {64, 64}, 0.2 / 200);
        for (const double w : weights(world, view))
            EXPECT_NEAR(w, 8 / std::cos(tilt), 0.005 * 8 / std::cos(tilt)) << "tilt " << tilt;
    }
}

TEST(Truth, AShearedSlabIsAsDeepAsTheRaysPathThroughIt) {
    // The same columns leaning: k is 30 degrees off the slab's normal, j 20 degrees off its own.
    const glm::dmat3 lean =
        tests::leaning({1, 0, 0}, {std::tan(0.35), 1, 0}, {0.5, 0, std::sqrt(0.75)});
    const auto grid =
        std::make_shared<Grid>(std::array{axis(40), axis(40), axis(8)}, timeseries::Frame{lean});
    const World world(tests::stepOf(grid, [](std::size_t) { return 1.0; }));
    const double cell = world.placed.cell(0).x;
    const double thickness = 8 * cell * std::sqrt(0.75) / world.placed.unitLength();
    for (const double tilt : {0.0, 0.3, 0.6}) {
        for (const double turn : {0.0, 2.0, 4.0}) {
            const glm::dvec3 from =
                200.0 * glm::dvec3(std::cos(turn) * std::sin(tilt),
                                   std::sin(turn) * std::sin(tilt) - 1e-9, std::cos(tilt));
            const View view = tests::lookFrom(from, {48, 48}, 0.15 / 200);
            const double path = thickness / std::cos(tilt);
            for (const double w : weights(world, view))
                EXPECT_NEAR(w, path, 0.005 * path) << "tilt " << tilt << " turn " << turn;
        }
    }
}

TEST(Truth, ShearedCellsKeepTheTotalFromEverySide) {
    const auto grid = std::make_shared<Grid>(
        std::array{axis(2), axis(2, 0, 2), axis(2, 0, 0.5)},
        timeseries::Frame{tests::leaning({1, 0, 0.2}, {1.5, 1, 0}, {-0.6, 0.3, 1})});
    for (const Footprint footprint : {Footprint{Kernel::Quartic, 1}, Footprint{Kernel::Point, 3}}) {
        const World world(tests::stepOf(grid, [](std::size_t) { return 1.0; }),
                          RangeSet::everything(), footprint);
        // Each cell is l^3 large, 8 of them, counted in units of l.
        const double volume = 8 * std::pow(world.placed.unitLength(), 2);
        // Near, and so far that a pixel is larger than a cell.
        for (const double distance : {60.0, 2000.0})
            for (const glm::dvec3& from :
                 {glm::dvec3(0, -1, 0), glm::dvec3(0, -0.1, 1), glm::dvec3(1, -1, 0.5)}) {
                const View view = tests::lookFrom(distance * glm::normalize(from), {201, 201},
                                                  distance == 60 ? 0.08 : 0.2);
                EXPECT_NEAR(massDrawn(weights(world, view), view, distance), volume,
                            kAtCorners * volume)
                    << from.x << ' ' << from.z << " from " << distance;
            }
    }
}

// The upright scene and the oblique one, whose camera has turned with the grid.
void expectSamePicture(const Grid& upright, const Grid& turned, const glm::dmat3& turn) {
    const auto value = [](std::size_t i) { return static_cast<double>(i * 7919 % 101); };
    for (const Footprint footprint : {Footprint{Kernel::Quartic, 1}, Footprint{Kernel::Point, 2}}) {
        const World a(tests::stepOf(std::make_shared<Grid>(upright), value),
                      RangeSet::parse("20:60"), footprint);
        const World b(tests::stepOf(std::make_shared<Grid>(turned), value),
                      RangeSet::parse("20:60"), footprint);
        for (const glm::dvec3& from : {glm::dvec3(0.3, -3, 1.1), glm::dvec3(0.1, -0.2, 0.15)}) {
            const View view = tests::lookFrom(from, {90, 70});
            View turnedView = view;
            turnedView.viewFromWorld *= glm::dmat4(glm::transpose(turn));
            const auto expected = weights(a, view), drawn = weights(b, turnedView);
            EXPECT_GT(std::accumulate(expected.begin(), expected.end(), 0.0), 1);
            for (std::size_t i = 0; i < expected.size(); ++i)
                ASSERT_NEAR(drawn[i], expected[i], 1e-11 * (1 + expected[i])) << i;
        }
        // Ordered from the same place, the points come in the same order.
        Scene sortedA = a.scene, sortedB = b.scene;
        sortedA.order = sortedB.order = Order::BackToFront;
        const glm::dvec3 eye(0.31, -2.9, 0.97);
        EXPECT_EQ(std::get<Sorted>(orderExactly(sortedB, turn * eye)).point,
                  std::get<Sorted>(orderExactly(sortedA, eye)).point);
    }
}

TEST(Truth, ATurnedGridSeenByATurnedCameraIsTheSamePicture) {
    const std::array axes{axis(7), axis(6, 3, -0.8), axis(5, 0, 1.7)};
    const glm::dmat3 turn = tests::rotation(1.1);
    expectSamePicture(Grid(axes), Grid(axes, {turn, {5, 6, 7}}), turn);
    const std::array cubic{axis(7), axis(6), axis(5)};
    expectSamePicture(Grid(cubic), Grid(cubic, {turn}), turn);
}

TEST(Truth, AMirroredAxisIsADescendingOne) {
    const std::array ascending{axis(7, 2), axis(6), axis(5)};
    const std::array descending{axis(7, -2, -1), axis(6), axis(5)};
    const glm::dmat3 turn = tests::rotation(0.4);
    const glm::dmat3 mirror(glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1));
    expectSamePicture(Grid(descending), Grid(ascending, {turn * mirror}), turn);
}

TEST(Truth, AShellIsAsDeepAsTheChordsThroughIt) {
    // Radii 12 to 20 cells; a ray at r cells from the middle meets 2 (sqrt(400 - r^2) - sqrt(144 -
    // r^2)) of them. Which points are inside is decided point by point, so single rays are
    // uncertain by a cell or so; over the middle's pixels, seen along no axis of the grid, that
    // averages out.
    const std::size_t n = 48;
    const auto radius = [](std::size_t i) {
        const glm::dvec3 p(i % n, i / n % n, i / n / n);
        return glm::length(p - glm::dvec3((n - 1) / 2.0));
    };
    const World world(tests::stepOf(tests::cube(n), radius), RangeSet::parse("12:20"));
    const View view = tests::lookFrom(200.0 * glm::normalize(glm::dvec3(0.31, -0.83, 0.47)),
                                      {128, 128}, 1.0 / 200);
    const auto w = weights(world, view);
    const double cellsPerPixel = 1.0 / 64 / world.placed.cell(0).x;
    double drawn = 0, chords = 0;
    for (int y = 54; y < 74; ++y)
        for (int x = 54; x < 74; ++x) {
            const double r = glm::length(glm::dvec2(x - 63.5, y - 63.5)) * cellsPerPixel;
            if (r > 6) continue;
            chords += 2 * (std::sqrt(400 - r * r) - std::sqrt(144 - r * r));
            drawn += w[std::size_t(y) * 128 + x];
        }
    EXPECT_NEAR(drawn, chords, 0.02 * chords);
    // The whole: the volume of the selected cells, l = cell.
    const double l = world.placed.unitLength();
    const auto selected = static_cast<double>(world.step.count(RangeSet::parse("12:20")));
    EXPECT_NEAR(massDrawn(w, view, 200), selected * l * l, 2e-3 * selected * l * l);
}

TEST(Truth, OffAxisSplatsAreTheEllipsesThatALensWouldDraw) {
    // A sphere at 50 degrees off the axis covers more pixels than on it (by about 1 / cos^3): its
    // total, weighed by solid angle, stays. On the plane at unit depth a pixel's solid angle is
    // cos^3 / focal^2.
    const World world(onePoint());
    const double distance = 40, angle = 50 * std::numbers::pi / 180, t = std::tan(angle);
    for (const bool upward : {false, true}) {
        View view = tests::lookFrom({0, -distance, 0}, {501, 501}, 0.1);
        // Turn the head: the splat stands at `angle`, an asymmetric frustum looks there.
        view.viewFromWorld =
            glm::rotate(glm::dmat4(1.0), upward ? angle : -angle, glm::dvec3(upward, !upward, 0)) *
            view.viewFromWorld;
        view.clipFromView = upward ? clipFromView({-0.2, 0.2, t - 0.2, t + 0.2, 0.1, 100})
                                   : clipFromView({t - 0.2, t + 0.2, -0.2, 0.2, 0.1, 100});
        const auto w = weights(world, view);
        const PixelRays rays = pixelRays(view);
        double mass = 0;
        for (int y = 0; y < 501; ++y)
            for (int x = 0; x < 501; ++x) {
                const glm::dvec2 slope = (glm::dvec2(x + 0.5, y + 0.5) - rays.centre) / rays.focal;
                mass += w[std::size_t(y) * 501 + x] * std::pow(1 + glm::dot(slope, slope), -1.5);
            }
        mass *= distance * distance / (rays.focal.x * rays.focal.y);
        EXPECT_NEAR(mass, 1, 3e-3) << upward;
    }
}

TEST(Truth, APointSplatIsASquareOfPixelsWithTheMassOfItsCell) {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> uniform(-0.5, 0.5);
    for (int trial = 0; trial < 60; ++trial) {
        View view = tests::lookFrom({0, -5, 0}, {33, 40});
        // On the axis, anywhere in the picture, and partly beside it.
        view.viewFromWorld[3] +=
            (trial % 3) * 3.0 * glm::dvec4(uniform(random), uniform(random), uniform(random), 0);
        const glm::dvec4 centre = view.viewFromWorld * glm::dvec4(0, 0, 0, 1);
        const double size = std::array{0.2, 1.0, 2.0, 3.4, 5.0}[std::size_t(trial) % 5];
        const double side = std::max(1.0, std::round(size));
        const glm::dmat3 directions = tests::leaning({1, 0.4, 0}, {0, 1, 0.5}, {0.3, 0, 1});
        const World world(
            tests::stepOf(std::make_shared<Grid>(std::array{axis(1), axis(1), axis(1)},
                                                 timeseries::Frame{directions}),
                          [](std::size_t) { return 1.0; }),
            RangeSet::everything(), {Kernel::Point, size});
        const double volume = glm::determinant(directions) * std::pow(world.placed.cell(0).x, 3);
        const auto w = weights(world, view);
        const PixelRays rays = pixelRays(view);
        const glm::dvec2 first =
            glm::floor(rays.centre - rays.focal * glm::dvec2(centre) / centre.z - (side - 1) / 2);
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 33; ++x) {
                const bool in =
                    x >= first.x && x < first.x + side && y >= first.y && y < first.y + side;
                const glm::dvec2 slope = (glm::dvec2(x + 0.5, y + 0.5) - rays.centre) / rays.focal;
                const double onPixel = volume / std::cbrt(volume) * rays.focal.x * rays.focal.y /
                                       (centre.z * centre.z) *
                                       std::sqrt(1 + glm::dot(slope, slope));
                ASSERT_NEAR(w[std::size_t(y) * 33 + x], in ? onPixel / (side * side) : 0,
                            1e-10 * onPixel)
                    << "trial " << trial << ", pixel " << x << ' ' << y;
            }
    }
}

TEST(Truth, EveryPixelThatASplatReachesIsDrawn) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const World world(
        tests::stepOf(std::make_shared<Grid>(
                          std::array{axis(1), axis(1), axis(1)},
                          timeseries::Frame{tests::leaning({1, 0.4, 0}, {0, 1, 0.5}, {0.3, 0, 1})}),
                      [](std::size_t) { return 1.0; }));
    for (int trial = 0; trial < 300; ++trial) {
        const glm::dvec3 way(uniform(random), uniform(random), uniform(random));
        const double distance = 6 + 30 * std::abs(uniform(random));
        View view = tests::lookFrom(distance * glm::normalize(way), {40, 40});
        const Frustum seenPart = std::array{Frustum{-0.5, 0.6, -0.2, 0.3, 0.01, 100},
                                            Frustum{-0.2, 0.3, -0.5, 0.6, 0.01, 100},
                                            Frustum{0.8, 2.6, -0.7, 0.9, 0.01, 100}}[trial % 3];
        view.clipFromView = clipFromView(seenPart);
        const double right = std::abs(uniform(random)), up = std::abs(uniform(random));
        view.viewFromWorld[3] +=
            distance * glm::dvec4(std::lerp(seenPart.left, seenPart.right, right),
                                  std::lerp(seenPart.down, seenPart.up, up), 0, 0);
        const PointsView seen(world.placed, view);
        const auto s = splatAt<double>(seen, 0, {});
        const auto w = weights(world, view);
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 40; ++x) {
                const glm::dvec2 at = glm::dvec2(x + 0.5, y + 0.5) - seen.rays.centre;
                const auto expected = weightOn<double>(s, Kernel::Quartic, at - s.centre,
                                                       at / seen.rays.focal, seen.rayLength);
                const double drawn = w[std::size_t(y) * 40 + x];
                ASSERT_EQ(drawn > 0, expected.value_or(0) > 0) << "trial " << trial;
                ASSERT_NEAR(drawn, expected.value_or(0), 1e-12) << "trial " << trial;
            }
    }
}

// A view in other units than the world's sees the same.
TEST(Truth, TheUnitOfAViewChangesNothing) {
    const std::array cells{axis(7), axis(6, 3, -0.8), axis(5, 0, 1.7)};
    const std::array slim{axis(7), axis(6), axis(3, 0, 6)};
    for (const auto& axes : {cells, slim})
        for (const Footprint footprint :
             {Footprint{}, Footprint{Kernel::Point, 2}, Footprint{Kernel::Quartic, 1.5}}) {
            const World world(tests::stepOf(std::make_shared<Grid>(
                                                axes, timeseries::Frame{tests::leaning(
                                                          {1, 0.4, 0}, {0, 1, 0.5}, {0.3, 0, 1})}),
                                            [](std::size_t i) { return double(i); }),
                              RangeSet::everything(), footprint);
            View view = tests::lookFrom({1, -2, 0.7}, {64, 48});
            view.clipFromView = clipFromView({-0.4, 0.5, -0.3, 0.4, 1.1, 50});
            const auto w = weights(world, view);
            view.viewFromWorld = glm::scale(glm::dmat4(1.0), glm::dvec3(3)) * view.viewFromWorld;
            view.clipFromView = clipFromView({-0.4, 0.5, -0.3, 0.4, 3.3, 150});
            const auto scaled = weights(world, view);
            const double most = *std::ranges::max_element(w);
            ASSERT_GT(most, 0);
            for (std::size_t i = 0; i < w.size(); ++i) ASSERT_NEAR(scaled[i], w[i], 1e-9 * most);
        }
}

TEST(Truth, PointsBehindOrNearerThanTheNearPlaneAreNotDrawn) {
    const World world(onePoint());
    View view = tests::lookFrom({0, -1, 0}, {33, 33});
    view.clipFromView = clipFromView({-0.4, 0.4, -0.4, 0.4, 1.5, 100});
    EXPECT_FALSE(splatAt<double>(PointsView(world.placed, view), 0, {}).visible);
    for (const double w : weights(world, view)) EXPECT_EQ(w, 0);
    view = tests::lookFrom({0, 5, 0}, {33, 33});
    view.viewFromWorld =
        glm::rotate(glm::dmat4(1.0), std::numbers::pi, glm::dvec3(0, 1, 0)) * view.viewFromWorld;
    for (const double w : weights(world, view)) EXPECT_EQ(w, 0);
}

TEST(Truth, WeightChangesContinuouslyWhenTheEyeMovesThroughTheNearPlane) {
    // A point splat at 1 puts 15^2 on its pixel, of 15 to a unit of slope.
    for (const auto& [kernel, step] : {std::pair{Kernel::Quartic, 0.02}, {Kernel::Point, 4.5}}) {
        const World world(onePoint(), RangeSet::everything(), {kernel, 1});
        double before = 0, most = 0;
        for (int i = 0; i <= 200; ++i) {
            View view = tests::lookFrom({0, -2.1 + i * 0.006, 0}, {9, 9}, 0.3);
            view.clipFromView = clipFromView({-0.3, 0.3, -0.3, 0.3, 1, 100});
            const double w = weights(world, view)[4 * 9 + 4];
            if (i > 0) {
                EXPECT_LT(std::abs(w - before), step) << i;
            }
            const double depth = 2.1 - i * 0.006, t = std::clamp(depth - 1, 0.0, 1.0);
            if (kernel == Kernel::Point) {
                EXPECT_NEAR(w, 225 / (depth * depth) * (3 * t * t - 2 * t * t * t), 1e-9) << i;
            }
            before = w;
            most = std::max(most, w);
        }
        EXPECT_EQ(before, 0);
        EXPECT_GT(most, 10 * step);
    }
}

TEST(Truth, WhatLiesBehindTheOpaqueSceneIsHidden) {
    const World world(onePoint());
    const View view = tests::lookFrom({0, -5, 0}, {33, 33});
    const auto depthAt = [&](double z) {
        const glm::dvec4 p = view.clipFromView * glm::dvec4(0, 0, -z, 1);
        return std::vector<float>(33 * 33, static_cast<float>(p.z / p.w));
    };
    Accumulator<double> behind(view.size, {Channels::Weight}),
        before(view.size, {Channels::Weight});
    splat(world.scene, Runs{}, view, depthAt(4.9), behind);
    splat(world.scene, Runs{}, view, depthAt(5.1), before);
    EXPECT_EQ(std::accumulate(behind.planes[0].begin(), behind.planes[0].end(), 0.0), 0);
    EXPECT_EQ(before.planes[0], weights(world, view));
}

TEST(Resolve, ManyThinSplatsShowTheOpacityOfTheirSum) {
    // Opacity 1e-7 a unit, W = 1e8: 1 - (1 - 1e-7)^1e8.
    Accumulator<double> sums({1, 1}, {Channels::Weight});
    sums.planes[0][0] = 1e8;
    const std::vector<Layer> layers = {{{}, {Constant{glm::dvec3(0.2, 0.5, 1)}, 1e-7}}};
    const Resolved r = resolvePixel(sums, layers, 0, 0);
    const double expected = -std::expm1(1e8 * std::log1p(-1e-7));
    EXPECT_NEAR(r.alpha, expected, 1e-12);
    EXPECT_NEAR(r.rgb.g, 0.5 * expected, 1e-12);
}

TEST(Resolve, NothingShowsNothingAndFullOpacityStaysFinite) {
    Accumulator<double> sums({1, 1}, {Channels::Weight});
    const std::vector<Layer> layers = {{{}, {Constant{glm::dvec3(1)}, 1}}};
    EXPECT_EQ(resolvePixel(sums, layers, 0, 0).alpha, 0);
    EXPECT_EQ(resolvePixel(sums, layers, 0, 0).rgb, glm::dvec3(0));
    sums.planes[0][0] = 1;
    EXPECT_NEAR(resolvePixel(sums, layers, 0, 0).alpha, 1, 2e-7);
}

TEST(Resolve, TwoColoursMixByTheirOpticalDepths) {
    Accumulator<double> sums({1, 1}, {Channels::Weight, Channels::Weight});
    sums.planes[0][0] = 3;
    sums.planes[1][0] = 1;
    const std::vector<Layer> layers = {{{}, {Constant{{1, 0, 0}}, 0.5}},
                                       {{}, {Constant{{0, 0, 1}}, 0.75}}};
    // Optical depths 3 ln 2 and ln 4 = 2 ln 2: three fifths red of opacity 1 - 2^-5.
    const Resolved r = resolvePixel(sums, layers, 0, 0);
    EXPECT_NEAR(r.alpha, 1 - 1.0 / 32, 1e-12);
    EXPECT_NEAR(r.rgb.r, 0.6 * r.alpha, 1e-12);
    EXPECT_NEAR(r.rgb.b, 0.4 * r.alpha, 1e-12);
}

}  // namespace
}  // namespace render
