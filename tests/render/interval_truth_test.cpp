// The continuous truth of interval volumes, against path lengths and light in closed form.
#include "render/reference/interval_truth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <numeric>

#include "tests/support/scenes.h"

namespace render {
namespace {

using tests::axis;
using timeseries::Field;
using timeseries::Grid;
using timeseries::Interval;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const glm::ivec2 kSize(20, 16);

using OfPoint = std::function<double(const glm::uvec3&)>;

template <typename T = double>
Field fieldOn(std::shared_ptr<const Grid> grid, const OfPoint& f) {
    std::vector<T> values(grid->count());
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = static_cast<T>(f(glm::uvec3(grid->indices(i))));
    return {std::move(grid), std::move(values), {}};
}

// A field and layers of ranges in it.
struct TrueWorld {
    TrueWorld(Field of, const std::vector<std::vector<Interval<double>>>& layers)
        : field(std::move(of)),
          step(timeseries::SortedStep::build(field)),
          placed(*field.grid),
          scene{.step = step,
                .placed = placed,
                .layers = {},
                .footprint = {},
                .order = Order::BackToFront,
                .clip = {}} {
        for (const auto& ranges : layers) {
            Layer layer{{}, {Constant{glm::dvec3(1)}, 0.5}};
            layer.cells.ranges = ranges;
            scene.layers.push_back(layer);
        }
    }
    std::vector<double> weight(const View& view, std::size_t layer = 0, int across = 1) const {
        return IntervalTruth(scene, field, across, 2).weight(view, layer);
    }

    Field field;
    timeseries::SortedStep step;
    PlacedPoints placed;
    Scene scene;
};

struct Ray {
    glm::dvec3 from, along;  // axis coordinates, a unit of view depth
    double weight, near;     // W of that unit
};
Ray rayOf(const TrueWorld& world, const View& view, double x, double y) {
    const PixelRays rays = pixelRays(world.placed.inAxes(view));
    const glm::dvec3 along = rays.along(glm::dvec2(x, y) - rays.centre);
    return {rays.eye, along,
            glm::length(world.placed.worldFromAxes() * along) / world.placed.unitLength(),
            rays.near};
}

struct Way {
    double from, to;
};
Way within(const Ray& ray, const glm::dvec3& lo, const glm::dvec3& hi) {
    Way way{ray.near, kInfinity};
    for (int a = 0; a < 3; ++a) {
        const double one = (lo[a] - ray.from[a]) / ray.along[a];
        const double other = (hi[a] - ray.from[a]) / ray.along[a];
        way.from = std::max(way.from, std::min(one, other));
        way.to = std::min(way.to, std::max(one, other));
    }
    return way;
}
double pathThrough(const Ray& ray, const glm::dvec3& lo, const glm::dvec3& hi) {
    const Way way = within(ray, lo, hi);
    return std::max(way.to - way.from, 0.0) * ray.weight;
}

// wanted(ray) of every pixel's middle.
void expectOfRays(const TrueWorld& world, const View& view, const std::vector<double>& is,
                  const std::function<double(const Ray&)>& wanted, double tolerance = 1e-9) {
    for (int y = 0; y < view.size.y; ++y)
        for (int x = 0; x < view.size.x; ++x) {
            const double path = wanted(rayOf(world, view, x + 0.5, y + 0.5));
            ASSERT_NEAR(is[std::size_t(y) * std::size_t(view.size.x) + std::size_t(x)], path,
                        tolerance * (1 + path))
                << x << ' ' << y;
        }
}

// The faces around a point, where its neighbours become nearer.
std::pair<glm::dvec3, glm::dvec3> boxOf(const PlacedPoints& placed, const glm::uvec3& point) {
    glm::dvec3 lo(0), hi(0);
    for (int a = 0; a < 3; ++a) {
        const auto& at = placed.positions()[std::size_t(a)];
        const std::size_t i = point[a];
        const double domainLo = placed.domain().lo[a], domainHi = placed.domain().hi[a];
        const bool down = at.front() > at.back();
        const double before = i > 0 ? (at[i] + at[i - 1]) / 2 : (down ? domainHi : domainLo);
        const double after =
            i + 1 < at.size() ? (at[i] + at[i + 1]) / 2 : (down ? domainLo : domainHi);
        lo[a] = std::min(before, after);
        hi[a] = std::max(before, after);
    }
    return {lo, hi};
}

std::shared_ptr<const Grid> unevenGrid() {
    auto uneven = axis(5);
    uneven.coordinates = {0, 1, 1.5, 3, 5};
    return std::make_shared<Grid>(std::array{uneven, axis(4, 7, -1.3), axis(3, 0, 2)});
}
std::shared_ptr<const Grid> shearedGrid() {
    const auto lean = tests::leaning({1, 0, 0.2}, {0.5, 1, 0}, {-0.3, 0.3, 1});
    return std::make_shared<Grid>(std::array{axis(4), axis(5, 0, 0.7), axis(1)},
                                  timeseries::CoordinateFrame{lean});
}

const std::array<glm::dvec3, 3> kFrom = {glm::dvec3(0.7, -3, 1.1), glm::dvec3(-1.3, 1.2, -0.8),
                                         glm::dvec3(0.06, -0.11, 0.05)};  // the last from inside

TEST(IntervalTruth, AConstantFieldIsAsDeepAsTheRaysWayThroughTheDomain) {
    for (const auto& grid : {unevenGrid(), shearedGrid()}) {
        // In its range, at its ends, beside it.
        const TrueWorld world(fieldOn(grid, [](const glm::uvec3&) { return 7.0; }),
                              {{{6, 8}}, {{7, 7}}, {{7, 9}}, {{5, 7}}, {{7.5, 8}, {1, 6.5}}});
        for (const glm::dvec3& from : kFrom) {
            const View view = tests::lookFrom(from, kSize);
            const auto domain = world.placed.domain();
            for (std::size_t layer = 0; layer < 4; ++layer)
                expectOfRays(world, view, world.weight(view, layer), [&](const Ray& ray) {
                    return pathThrough(ray, domain.lo, domain.hi);
                });
            EXPECT_THAT(world.weight(view, 4), testing::Each(0));
        }
    }
}

// Of a field that is linear along x a range is a slab between two planes, also where it is so thin
// that no point lies in it; where it reaches the last point's value, it goes on to the domain's
// face.
TEST(IntervalTruth, ARangeOfALinearFieldIsASlabBetweenTwoPlanes) {
    for (const auto& grid : {unevenGrid(), shearedGrid()}) {
        const auto& x = grid->axes()[0].coordinates;
        const Field field = fieldOn(grid, [&](const glm::uvec3& p) { return x[p.x]; });
        const TrueWorld world(field, {{{0.3, 2.4}}, {{1.2, 1.2 + 1e-9}}, {{2.2, x.back()}}});
        const auto planeAt = [&](double value) {
            return world.placed.axesFromGrid(glm::dvec3(value, 0, 0)).x;
        };
        const auto domain = world.placed.domain();
        for (const glm::dvec3& from : kFrom) {
            const View view = tests::lookFrom(from, kSize);
            const auto slab = [&](double lo, double hi) {
                return [&domain, lo, hi](const Ray& ray) {
                    glm::dvec3 first = domain.lo, last = domain.hi;
                    first.x = lo;
                    last.x = hi;
                    return pathThrough(ray, first, last);
                };
            };
            expectOfRays(world, view, world.weight(view, 0), slab(planeAt(0.3), planeAt(2.4)));
            // The thin one is as thick as it is, to a millionth of it.
            const double thick = planeAt(1.2 + 1e-9) - planeAt(1.2);
            const std::vector<double> thin = world.weight(view, 1);
            for (int y = 0; y < kSize.y; ++y)
                for (int i = 0; i < kSize.x; ++i) {
                    const Ray ray = rayOf(world, view, i + 0.5, y + 0.5);
                    const double at = (planeAt(1.2) - ray.from.x) / ray.along.x;
                    const Way way = within(ray, domain.lo, domain.hi);
                    const double path = at > way.from && at < way.to
                                            ? thick / std::abs(ray.along.x) * ray.weight
                                            : 0;
                    ASSERT_NEAR(thin[std::size_t(y) * std::size_t(kSize.x) + std::size_t(i)], path,
                                1e-6 * path)
                        << i << ' ' << y;
                }
            expectOfRays(world, view, world.weight(view, 2), slab(planeAt(2.2), domain.hi.x));
        }
    }
}

// x y z on one cell: along its diagonal t^3, from 0 at one end of the cell to 1 at the other.
TEST(IntervalTruth, TakesTheRootsOfTheCubicAlongARay) {
    const TrueWorld world(
        fieldOn(tests::cube(2), [](const glm::uvec3& p) { return double(p.x * p.y * p.z); }),
        {{{0.001, 0.729}}, {{0.729, 1}}, {{0, 0.001}}});
    const double half = world.placed.boxHalf().x;
    // From beside the far end of the diagonal, so that no half cell is in the way of what is asked.
    const View view = tests::lookFrom(3.0 * glm::normalize(glm::dvec3(1, 1, 1)), {1, 1}, 1e-7);
    const double diagonal = 2 * std::sqrt(3.0) * half / world.placed.unitLength();
    EXPECT_NEAR(world.weight(view, 0)[0], 0.8 * diagonal, 1e-6);
    // Beyond the points the field goes on as it is at them: half a cell at either end.
    EXPECT_NEAR(world.weight(view, 1)[0], (0.1 + 0.5) * diagonal, 1e-6);
    EXPECT_NEAR(world.weight(view, 2)[0], (0.1 + 0.5) * diagonal, 1e-6);
}

// x y on one cell: where x + y = 1 it is t (1 - t), which rises and falls between two ends of 0.
TEST(IntervalTruth, FindsWhatARayEntersAndLeavesWithinACell) {
    const TrueWorld world(
        fieldOn(tests::cube(2), [](const glm::uvec3& p) { return double(p.x * p.y); }),
        {{{0.16, 1}}, {{-1, 0.16}}});
    const View view = tests::lookFrom({2, -2, 1e-9}, {1, 1}, 1e-7);
    const double diagonal =
        2 * std::sqrt(2.0) * world.placed.boxHalf().x / world.placed.unitLength();
    EXPECT_NEAR(world.weight(view, 0)[0], 0.6 * diagonal, 1e-6);
    EXPECT_NEAR(world.weight(view, 1)[0], (0.4 + 1) * diagonal, 1e-6);  // with both half cells
}

// The ramp |p| is linear only between points, and off by the square of the spacing: but for rays
// that graze the shell, so is its path. Halving the spacing more than halves the error.
TEST(IntervalTruth, AShellOfASphericalRampConvergesWithTheSpacing) {
    constexpr double kInner = 0.31, kOuter = 0.43;
    const auto errorOf = [&](std::size_t n) {
        const auto grid = tests::cube(n);
        const double middle = double(n - 1) / 2;
        const TrueWorld world(fieldOn(grid,
                                      [&](const glm::uvec3& p) {
                                          return glm::length(glm::dvec3(p) - middle) /
                                                 double(n - 1);
                                      }),
                              {{{kInner, kOuter}}});
        const double side = 2 * world.placed.boxHalf().x;
        const View view = tests::lookFrom({0.7, -3, 1.1}, {24, 24}, 0.2);
        const std::vector<double> is = world.weight(view);
        double squared = 0, whole = 0;
        for (int y = 0; y < 24; ++y)
            for (int x = 0; x < 24; ++x) {
                const Ray ray = rayOf(world, view, x + 0.5, y + 0.5);
                const glm::dvec3 d = glm::normalize(ray.along);
                const double missed = glm::length(glm::cross(ray.from, d));
                const auto chord = [&](double radius) {
                    return 2 * std::sqrt(std::max(radius * radius - missed * missed, 0.0));
                };
                const double wanted =
                    (chord(kOuter * side) - chord(kInner * side)) / world.placed.unitLength();
                squared += std::pow(is[std::size_t(y * 24 + x)] - wanted, 2);
                whole += wanted * wanted;
            }
        return std::sqrt(squared / whole);
    };
    const double coarse = errorOf(9), fine = errorOf(17), finest = errorOf(33);
    EXPECT_LT(finest, 0.01);
    EXPECT_GT(coarse / fine, 2);
    EXPECT_GT(fine / finest, 2);
}

// 0 below, 1 above, one cell between: a range that ends at a plateau's value holds all of it.
TEST(IntervalTruth, APlateauAtARangesEndIsWhole) {
    const auto grid = tests::cube(6);
    const TrueWorld world(fieldOn(grid, [](const glm::uvec3& p) { return p.x < 3 ? 0.0 : 1.0; }),
                          {{{0, 0}}, {{1, 1}}, {{0, 1}}, {{-5, 0}}, {{1, kInfinity}}, {{0, 0.25}}});
    const auto& at = world.placed.positions()[0];
    const View view = tests::lookFrom(kFrom[0], kSize);
    const auto domain = world.placed.domain();
    const auto slab = [&](double lo, double hi) {
        return [&domain, lo, hi](const Ray& ray) {
            glm::dvec3 first = domain.lo, last = domain.hi;
            first.x = lo;
            last.x = hi;
            return pathThrough(ray, first, last);
        };
    };
    for (const std::size_t layer : {0u, 3u})
        expectOfRays(world, view, world.weight(view, layer), slab(domain.lo.x, at[2]));
    for (const std::size_t layer : {1u, 4u})
        expectOfRays(world, view, world.weight(view, layer), slab(at[3], domain.hi.x));
    expectOfRays(world, view, world.weight(view, 2), slab(domain.lo.x, domain.hi.x));
    expectOfRays(world, view, world.weight(view, 5),
                 slab(domain.lo.x, at[2] + 0.25 * (at[3] - at[2])));
}

TEST(IntervalTruth, AUnionIsTheSumOfItsDisjointParts) {
    const auto grid = unevenGrid();
    const Field field = fieldOn(grid, [](const glm::uvec3& p) {
        return std::sin(0.4 + 3.0 * p.x + 5.0 * p.y + 7.0 * p.z);
    });
    const TrueWorld world(field, {{{-0.7, -0.1}, {0.2, 0.3}, {0.5, 2}},
                                  {{-0.7, -0.1}},
                                  {{0.2, 0.3}},
                                  {{0.5, 2}},
                                  {{-2, 0}},
                                  {{0, 2}}});
    const View view = tests::lookFrom(kFrom[0], kSize);
    std::vector<std::vector<double>> w;
    for (std::size_t layer = 0; layer < 6; ++layer) w.push_back(world.weight(view, layer));
    EXPECT_GT(std::accumulate(w[2].begin(), w[2].end(), 0.0), 1);
    for (std::size_t i = 0; i < w[0].size(); ++i)
        ASSERT_NEAR(w[0][i], w[1][i] + w[2][i] + w[3][i], 1e-9);
    // And two that only touch make the whole.
    const auto domain = world.placed.domain();
    std::vector<double> both(w[4].size());
    std::ranges::transform(w[4], w[5], both.begin(), std::plus<>());
    expectOfRays(world, view, both,
                 [&](const Ray& ray) { return pathThrough(ray, domain.lo, domain.hi); });
}

TEST(IntervalTruth, WhatIsNearestToAMissingOrClippedPointIsNowhere) {
    const auto grid = unevenGrid();
    const glm::uvec3 gone(2, 1, 1);
    for (const double missing : {kNan, kInfinity, -kInfinity}) {
        const TrueWorld holed(
            fieldOn(grid, [&](const glm::uvec3& p) { return p == gone ? missing : 1.0; }),
            {{{0, 2}}});
        TrueWorld marked(fieldOn(grid, [](const glm::uvec3&) { return 1.0; }), {{{0, 2}}});
        marked.field.missing.assign(grid->count(), false);
        const glm::uvec3 n = marked.placed.size();
        marked.field.missing[gone.x + n.x * (gone.y + n.y * gone.z)] = true;
        TrueWorld clipped(fieldOn(grid, [](const glm::uvec3&) { return 1.0; }), {{{0, 2}}});
        clipped.scene.clip = {gone, gone};
        const auto [lo, hi] = boxOf(holed.placed, gone);
        const glm::dvec3 first = lo, last = hi;
        const auto domain = holed.placed.domain();
        for (const glm::dvec3& from : kFrom) {
            const View view = tests::lookFrom(from, kSize);
            const auto one = [&](const Ray& ray) { return pathThrough(ray, first, last); };
            const auto others = [&](const Ray& ray) {
                return pathThrough(ray, domain.lo, domain.hi) - one(ray);
            };
            expectOfRays(holed, view, holed.weight(view), others);
            expectOfRays(marked, view, marked.weight(view), others);
            expectOfRays(clipped, view, clipped.weight(view), one);
        }
    }
}

TEST(IntervalTruth, AFieldOfNothingButMissingValuesIsEmpty) {
    const TrueWorld world(fieldOn(tests::cube(3), [](const glm::uvec3&) { return kNan; }),
                          {{{-kInfinity, kInfinity}}});
    const View view = tests::lookFrom(kFrom[0], kSize);
    EXPECT_THAT(world.weight(view), testing::Each(0));
    EXPECT_THAT(IntervalTruth(world.scene, world.field, 1, 2).light(view),
                testing::Each(glm::dvec4(0)));
}

// A slab's ends scale with the values, whatever their size.
template <typename T>
void expectScales(double unit, double lo, double hi) {
    const TrueWorld plain(
        fieldOn(tests::cube(5), [](const glm::uvec3& p) { return double(p.x) - 2; }), {{{lo, hi}}});
    const TrueWorld scaled(
        fieldOn<T>(tests::cube(5), [&](const glm::uvec3& p) { return unit * (double(p.x) - 2); }),
        {{{unit * lo, unit * hi}}});
    const View view = tests::lookFrom(kFrom[0], kSize);
    const std::vector<double> wanted = plain.weight(view), is = scaled.weight(view);
    EXPECT_GT(*std::ranges::max_element(wanted), 0.5);
    for (std::size_t i = 0; i < wanted.size(); ++i)
        ASSERT_NEAR(is[i], wanted[i], 1e-9) << unit << ", pixel " << i;
}

TEST(IntervalTruth, HugeAndTinyValuesAreValuesLikeOthers) {
    for (const double unit : {1e300, 8e307, 1e-300, 0x1p-1060})
        expectScales<double>(unit, -0.75, 1.5);
    for (const double unit : {0x1p100, 0x1p-149, 0x1p-140}) expectScales<float>(unit, -1, 1);
}

// Both ends of doubles in one cell: their difference is more than the greatest double.
TEST(IntervalTruth, CellsThatSpanAllDoublesHaveTheirMiddle) {
    constexpr double kMost = std::numeric_limits<double>::max();
    const TrueWorld world(
        fieldOn(tests::cube(2), [](const glm::uvec3& p) { return p.x == 0 ? -kMost : kMost; }),
        {{{0, kMost}}});
    const View view = tests::lookFrom(kFrom[0], kSize);
    const auto domain = world.placed.domain();
    expectOfRays(world, view, world.weight(view), [&](const Ray& ray) {
        return pathThrough(ray, {0, domain.lo.y, domain.lo.z}, domain.hi);
    });
}

// A pixel is the mean of its rays.
TEST(IntervalTruth, APixelIsTheMeanOfItsRays) {
    const TrueWorld world(fieldOn(tests::cube(4), [](const glm::uvec3&) { return 1.0; }),
                          {{{0, 2}}});
    const View view = tests::lookFrom(kFrom[0], {7, 5});
    const std::vector<double> is = world.weight(view, 0, 3);
    const auto domain = world.placed.domain();
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 7; ++x) {
            double sum = 0;
            for (const double j : {1.0 / 6, 0.5, 5.0 / 6})
                for (const double i : {1.0 / 6, 0.5, 5.0 / 6})
                    sum += pathThrough(rayOf(world, view, x + i, y + j), domain.lo, domain.hi);
            ASSERT_NEAR(is[std::size_t(y * 7 + x)], sum / 9, 1e-9);
        }
}

TEST(IntervalTruth, IsTheSameForAnyThreads) {
    const TrueWorld world(
        fieldOn(unevenGrid(), [](const glm::uvec3& p) { return std::sin(3.0 * p.x + 5.0 * p.y); }),
        {{{-0.5, 0.2}}});
    const View view = tests::lookFrom(kFrom[1], kSize);
    const auto with = [&](unsigned threads) {
        return IntervalTruth(world.scene, world.field, 2, threads);
    };
    EXPECT_EQ(with(1).weight(view, 0), with(3).weight(view, 0));
    EXPECT_EQ(with(1).light(view), with(3).light(view));
}

// One colour: what is taken of the light behind is 1 - e^-tau.
TEST(IntervalTruth, LightOfOneColourIsAbsorbedByItsOpticalDepth) {
    TrueWorld world(fieldOn(tests::cube(5), [](const glm::uvec3& p) { return double(p.x); }),
                    {{{0.5, 2.2}}});
    world.scene.layers[0].style = {Constant{glm::dvec3(0.2, 0.5, 0.9)}, 0.4};
    const View view = tests::lookFrom(kFrom[0], kSize);
    const std::vector<double> w = world.weight(view);
    const auto light = IntervalTruth(world.scene, world.field, 1, 2).light(view);
    for (std::size_t i = 0; i < w.size(); ++i) {
        const double alpha = 1 - std::pow(1 - 0.4, w[i]);
        ASSERT_NEAR(light[i].a, alpha, 1e-9);
        ASSERT_NEAR(light[i].r, 0.2 * alpha, 1e-9);
        ASSERT_NEAR(light[i].b, 0.9 * alpha, 1e-9);
    }
}

// From +x: the blue slab stands before the red one. Where both are, they share what is taken by
// their optical depths.
TEST(IntervalTruth, LightComesFromWhatIsInFront) {
    TrueWorld world(fieldOn(tests::cube(5), [](const glm::uvec3& p) { return double(p.x); }),
                    {{{0.5, 1.5}}, {{2.5, 3.5}}, {{2.5, 3.5}}});
    world.scene.layers[0].style = {Constant{glm::dvec3(1, 0, 0)}, 0.6};
    world.scene.layers[1].style = {Constant{glm::dvec3(0, 0, 1)}, 0.3};
    world.scene.layers[2].style = {Constant{glm::dvec3(0, 1, 0)}, 0.3};
    const View view = tests::lookFrom({3, 1e-3, 2e-3}, {3, 3}, 0.001);
    const glm::dvec4 light = IntervalTruth(world.scene, world.field, 1, 2).light(view)[4];
    const double front = 1 - 0.7 * 0.7;  // each slab is l thick
    EXPECT_NEAR(light.b, front / 2, 1e-5);
    EXPECT_NEAR(light.g, front / 2, 1e-5);
    EXPECT_NEAR(light.r, (1 - front) * 0.6, 1e-5);
    EXPECT_NEAR(light.a, 1 - (1 - front) * 0.4, 1e-5);
}

}  // namespace
}  // namespace render
