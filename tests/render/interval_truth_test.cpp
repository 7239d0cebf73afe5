// The continuous truth of interval volumes, against path lengths in closed form.
#include "render/reference/interval_truth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tests/support/true_world.h"

namespace render {
namespace {

using namespace true_world;

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

}  // namespace
}  // namespace render
