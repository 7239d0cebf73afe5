// Interval volumes drawn cell by cell, against path lengths in closed form and against samples of
// the interpolated field along rays.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numeric>
#include <random>

#include "render/model/cell_splat.h"
#include "render/reference/interval_truth.h"
#include "tests/support/cell_worlds.h"
#include "tests/support/rounds.h"
#include "tests/support/scenes.h"

namespace render {
namespace {

using tests::axis;
using tests::CellWorld;
using tests::drawn;
using timeseries::Grid;
using timeseries::RangeSet;

constexpr std::uint64_t kAll = tests::kAllCells;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// A ray in axis coordinates, a unit of which is `length` long in the world.
struct Ray {
    glm::dvec3 from, along;
    double length, near;
};
Ray rayOf(const CellWorld& world, const View& view, const glm::dvec2& pixel) {
    const PixelRays rays = pixelRays(world.placed.inAxes(view));
    const glm::dvec2 o = pixel - rays.centre;
    const glm::dvec3 along = rays.axis + o.x * rays.perPixelX + o.y * rays.perPixelY;
    return {rays.eye, along, glm::length(world.placed.worldFromAxes() * along), rays.near};
}

// Where a ray is inside a box: [first, second] of it, empty where first > second.
std::pair<double, double> inside(const Ray& ray, const PlacedPoints::Box& box) {
    double from = ray.near, to = std::numeric_limits<double>::infinity();
    for (int a = 0; a < 3; ++a) {
        const double one = (box.lo[a] - ray.from[a]) / ray.along[a];
        const double other = (box.hi[a] - ray.from[a]) / ray.along[a];
        from = std::max(from, std::min(one, other));
        to = std::min(to, std::max(one, other));
    }
    return {from, to};
}

double pathThrough(const CellWorld& world, const View& view, int x, int y,
                   const PlacedPoints::Box& box) {
    const Ray ray = rayOf(world, view, {x + 0.5, y + 0.5});
    const auto [from, to] = inside(ray, box);
    return std::max(to - from, 0.0) * ray.length / world.placed.unitLength();
}

// The cell that a point stands for.
PlacedPoints::Box boxOf(const PlacedPoints& placed, const glm::uvec3& point) {
    PlacedPoints::Box box{};
    for (int a = 0; a < 3; ++a) {
        const auto& at = placed.positions()[std::size_t(a)];
        const auto& width = placed.widths()[std::size_t(a)];
        const std::size_t i = point[a], last = at.size() - 1;
        const double up = at.front() > at.back() ? -1 : 1;
        const double one = i > 0 ? (at[i] + at[i - 1]) / 2 : at[0] - up * width[0] / 2;
        const double other = i < last ? (at[i] + at[i + 1]) / 2 : at[i] + up * width[i] / 2;
        box.lo[a] = std::min(one, other);
        box.hi[a] = std::max(one, other);
    }
    return box;
}

// The field at a place, linear along each axis between points and constant beyond the last.
double fieldAt(const CellWorld& world, const std::vector<float>& values, const glm::dvec3& place) {
    glm::uvec3 at{0};
    glm::dvec3 share{0};
    const glm::uvec3 n = world.placed.size();
    for (int a = 0; a < 3; ++a) {
        const auto& p = world.placed.positions()[std::size_t(a)];
        if (p.size() == 1) continue;
        const bool down = p.front() > p.back();
        unsigned i = 0;
        while (i + 2 < p.size() && (down ? p[i + 1] > place[a] : p[i + 1] < place[a])) ++i;
        at[a] = i;
        share[a] = std::clamp((place[a] - p[i]) / (p[i + 1] - p[i]), 0.0, 1.0);
    }
    double sum = 0;
    for (unsigned c = 0; c < 8; ++c) {
        double weight = 1;
        glm::uvec3 i = at;
        for (int a = 0; a < 3; ++a) {
            weight *= c >> a & 1 ? share[a] : 1 - share[a];
            if (c >> a & 1) i[a] = std::min(i[a] + 1, n[a] - 1);
        }
        if (weight > 0)
            sum += weight * double(values[i.x + std::size_t(n.x) * (i.y + std::size_t(n.y) * i.z)]);
    }
    return sum;
}

// What a pixel sees of lo <= field <= hi, by samples, in units of l.
double sampled(const CellWorld& world, const std::vector<float>& values, const View& view, int x,
               int y, double lo, double hi) {
    constexpr int kRays = 3, kSamples = 500;
    double sum = 0;
    for (int s = 0; s < kRays * kRays; ++s) {
        const Ray ray =
            rayOf(world, view, {x + (s % kRays + 0.5) / kRays, y + (s / kRays + 0.5) / kRays});
        const auto [from, to] = inside(ray, world.placed.domain());
        if (!(to > from)) continue;
        int in = 0;
        for (int i = 0; i < kSamples; ++i) {
            const double t = from + (to - from) * (i + 0.5) / kSamples;
            const double f = fieldAt(world, values, ray.from + t * ray.along);
            in += f >= lo && f <= hi ? 1 : 0;
        }
        sum += (to - from) * ray.length * in / kSamples;
    }
    return sum / (kRays * kRays) / world.placed.unitLength();
}

double relativeL2(const std::vector<float>& is, const std::vector<double>& wanted) {
    double difference = 0, size = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        difference += std::pow(double(is[i]) - wanted[i], 2);
        size += wanted[i] * wanted[i];
    }
    return std::sqrt(difference / size);
}

std::shared_ptr<const Grid> unevenGrid() {
    auto uneven = axis(5);
    uneven.coordinates = {0, 1, 1.5, 3, 5};
    auto down = axis(4, 7, -1.3);
    return std::make_shared<Grid>(std::array{uneven, down, axis(3, 0, 2)});
}

const std::array<glm::dvec3, 3> kFrom = {glm::dvec3(0.7, -3, 1.1), glm::dvec3(-1.3, 1.2, -0.8),
                                         glm::dvec3(0.06, -0.11, 0.05)};  // the last from inside

TEST(CellSplatter, AFieldSelectedWholeIsAsDeepAsTheRaysWayThroughTheDomain) {
    const auto lean = tests::leaning({1, 0, 0.2}, {0.5, 1, 0}, {-0.3, 0.3, 1});
    const std::array axes{axis(4), axis(5, 0, 0.7), axis(1)};
    for (const auto& grid :
         {unevenGrid(), std::make_shared<const Grid>(axes, timeseries::Frame{lean})}) {
        const CellWorld world(tests::noise(grid), {"min:max"});
        for (const glm::dvec3& from : kFrom) {
            const View view = tests::lookFrom(from, {40, 30});
            const std::vector<float> w = drawn(world.scene, view);
            for (int y = 0; y < view.size.y; ++y)
                for (int x = 0; x < view.size.x; ++x) {
                    const double path = pathThrough(world, view, x, y, world.placed.domain());
                    ASSERT_NEAR(w[std::size_t(y) * 40 + std::size_t(x)], path, 2e-5 * (1 + path))
                        << x << ' ' << y << " from " << from.x;
                }
        }
    }
}

// Along a ray a linear field takes each value once: a range is as deep as it is thick, however
// thin.
TEST(CellSplatter, AThinRangeOfALinearFieldIsAClosedShellOfItsThickness) {
    const auto grid = tests::cube(9);
    for (const double width : {2.0, 0.1, 0.001}) {
        const CellWorld world(
            tests::stepOf(grid, [&](std::size_t i) { return double(grid->indices(i).x); }),
            {"4.3~" + std::to_string(width / 2)});
        const View view = tests::lookFrom({3, -0.4, 0.3}, {64, 64}, 0.05);
        const std::vector<float> w = drawn(world.scene, view);
        const double spacing =
            std::abs(world.placed.positions()[0][1] - world.placed.positions()[0][0]);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                const Ray ray = rayOf(world, view, {x + 0.5, y + 0.5});
                const double wanted = width * spacing / std::abs(ray.along.x) * ray.length /
                                      world.placed.unitLength();
                ASSERT_NEAR(w[std::size_t(y) * 64 + std::size_t(x)], wanted, 2e-2 * wanted)
                    << width << " at " << x << ' ' << y;
            }
    }
}

// Of a passage through all of a range that is thinner than a cell, a contour keeps W = 1; a range
// that is so wide that its length says more has its length. Also of one value alone.
TEST(CellSplatter, PerCrossingAThinRangeOfALinearFieldStaysVisible) {
    const auto grid = tests::cube(9);
    // The last ones end in two cells each, at a face between them.
    for (const std::string range :
         {"3.3:6.3", "4.25:4.35", "4.2999:4.3001", "4.3", "4.3:max", "3.95:4.05", "3.99:4.03"}) {
        CellWorld world(
            tests::stepOf(grid, [&](std::size_t i) { return double(grid->indices(i).x); }),
            {range});
        const View view = tests::lookFrom({3, -0.4, 0.3}, {64, 64}, 0.05);
        const std::vector<float> length = drawn(world.scene, view);
        world.scene.opacityPer = OpacityPer::Crossing;
        const std::vector<float> w = drawn(world.scene, view);
        const bool isWide = range == "3.3:6.3" || range == "4.3:max";
        for (std::size_t i = 0; i < w.size(); ++i)
            ASSERT_NEAR(w[i], isWide ? length[i] : 1, isWide ? 1e-6 * length[i] : 5e-3)
                << range << " at " << i;
        if (isWide) continue;
        // Of pixels that are wider than the range, and of those at its rim, it is no more.
        const View oblique = tests::lookFrom({0.9, -3, 1.1}, {32, 32});
        EXPECT_LT(std::ranges::max(drawn(world.scene, oblique)), 1.1) << range;
    }
}

// As a headset's views are scaled: how thin a range is, is asked of the world.
TEST(CellSplatter, PerCrossingAViewsScaleChangesNothing) {
    const auto grid = tests::cube(9);
    CellWorld world(tests::stepOf(grid, [&](std::size_t i) { return double(grid->indices(i).x); }),
                    {"4.25:4.35"});
    world.scene.opacityPer = OpacityPer::Crossing;
    const View view = tests::lookFrom({3, -0.4, 0.3}, {32, 32}, 0.05);
    const std::vector<float> w = drawn(world.scene, view);
    for (const double scale : {0.02, 50.0}) {
        View scaled = view;
        scaled.viewFromWorld = glm::scale(glm::dmat4(1.0), glm::dvec3(scale)) * view.viewFromWorld;
        EXPECT_THAT(drawn(world.scene, scaled), testing::Pointwise(testing::FloatNear(1e-3f), w))
            << scale;
    }
}

// Of a shell that is thinner than what a pixel sees of the field, a pixel sees all values,
// whichever cells its rays have of it.
TEST(CellSplatter, AThinShellHasTheColorOfItsMiddleEverywhere) {
    const auto grid = tests::cube(9);
    CellWorld world(tests::stepOf(grid, [&](std::size_t i) { return double(grid->indices(i).x); }),
                    {"4.29:4.31"});
    world.scene.layers[0].style.color = ByValue{ColorMap(), 4.29, 4.31};
    world.scene.order = Order::BackToFront;
    world.scene.opacityPer = OpacityPer::Crossing;
    const View view = tests::lookFrom({0.9, -3, 1.1}, {64, 64});
    const std::vector<float> pixels = drawn(world.scene, view, Channels::Over);
    const glm::dvec3 middle = colorOf(world.scene.layers[0].style, 4.3);
    int seen = 0;
    for (std::size_t i = 0; i < pixels.size(); i += 4) {
        if (pixels[i + 3] < 0.05f) continue;
        ++seen;
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(pixels[i + std::size_t(c)] / pixels[i + 3], middle[c], 0.05)
                << "pixel " << i / 4;
    }
    EXPECT_GT(seen, 100);
}

// Against samples of dW = max(ds / l, |df| / (hi - lo)).
TEST(CellSplatter, PerCrossingEachPieceOfTheWayCountsForItsLengthOrItsChange) {
    const auto grid = tests::cube(8);
    std::vector<float> values(grid->count());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const glm::dvec3 p = grid->position(i);
        values[i] = static_cast<float>(std::sin(0.9 * p.x + 0.3) * std::cos(0.8 * p.y) +
                                       0.3 * p.z * std::sin(0.6 * p.y));
    }
    constexpr int kSamples = tests::rounds(4000);
    // Thin ranges need many.
    const std::vector<double> halves =
        tests::kSanitized ? std::vector{0.25} : std::vector{0.25, 0.05};
    for (const double half : halves) {
        CellWorld world(tests::stepOf(grid, [&](std::size_t i) { return values[i]; }),
                        {"0.3~" + std::to_string(half)});
        world.scene.opacityPer = OpacityPer::Crossing;
        for (const glm::dvec3& from : kFrom) {
            const View view = tests::lookFrom(from, {24, 20}, 0.002);
            std::vector<double> wanted;
            for (int pixel = 0; pixel < 480; ++pixel) {
                const Ray ray = rayOf(world, view, {pixel % 24 + 0.5, pixel / 24 + 0.5});
                const auto [begin, end] = inside(ray, world.placed.domain());
                const double step = (end - begin) / kSamples;
                const auto at = [&, begin = begin](int i) {
                    return fieldAt(world, values, ray.from + (begin + step * i) * ray.along);
                };
                double sum = 0, last = at(0);
                for (int i = 1; i <= kSamples && step > 0; ++i) {
                    const double now = at(i), middle = (last + now) / 2;
                    if (std::abs(middle - 0.3) <= half)
                        sum += std::max(step * ray.length / world.placed.unitLength(),
                                        std::abs(now - last) / (2 * half));
                    last = now;
                }
                wanted.push_back(sum);
            }
            EXPECT_LT(relativeL2(drawn(world.scene, view), wanted), 0.02) << half << ' ' << from.x;
        }
    }
}

TEST(CellSplatter, IsTheIntervalVolumeOfTheInterpolatedField) {
    const auto grid = std::make_shared<Grid>(std::array{axis(12), axis(10, 7, -1.3), axis(9)});
    std::vector<float> values(grid->count());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const glm::dvec3 p = grid->position(i);
        values[i] = static_cast<float>(std::sin(0.5 * p.x + 0.3) * std::cos(0.4 * p.y) +
                                       0.2 * p.z * std::sin(0.3 * p.y));
    }
    const CellWorld world(tests::stepOf(grid, [&](std::size_t i) { return values[i]; }),
                          {"0.1:0.5"});
    // What linear pieces leave of a cubic, and the samples of the truth.
    for (const glm::dvec3& from : kFrom) {
        const View view = tests::lookFrom(from, {24, 20}, 0.12);
        std::vector<double> wanted;
        for (int y = 0; y < 20; ++y)
            for (int x = 0; x < 24; ++x)
                wanted.push_back(sampled(world, values, view, x, y, 0.1, 0.5));
        EXPECT_LT(relativeL2(drawn(world.scene, view), wanted), 0.02) << from.x;
    }
}

// Of a field of many waves, as turbulence is. A range's width is told in steps between neighbours,
// root mean square.
TEST(CellSplatter, AThinRangesErrorIsBoundedHoweverThinItIs) {
    constexpr unsigned kSide = 20;
    const auto grid = tests::cube(kSide);
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    std::vector<float> values(grid->count());
    for (int wave = 0; wave < 60; ++wave) {
        const glm::dvec3 k = 0.35 * glm::dvec3(normal(random), normal(random), normal(random));
        const double phase = 10 * normal(random);
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] += static_cast<float>(std::sin(glm::dot(k, grid->position(i)) + phase) /
                                            std::sqrt(60));
    }
    double squares = 0;
    for (std::size_t i = 0; i + 1 < values.size(); ++i)
        if ((i + 1) % kSide != 0) squares += std::pow(double(values[i + 1]) - double(values[i]), 2);
    const double between = std::sqrt(squares / double(values.size() - kSide * kSide));
    // With two pieces, or ramps as wide as both changes together, at least one of them is passed.
    for (const auto& [width, bound] : {std::pair(3.0, 0.0025), {0.3, 0.015}, {0.03, 0.06}}) {
        const CellWorld world(tests::stepOf(grid, [&](std::size_t i) { return values[i]; }),
                              {"0.2~" + std::to_string(width * between / 2)});
        const IntervalTruth truth(world.scene, world.scene.cells->field(), 5);
        const View view = tests::lookFrom({0.7, -2, 1.1}, {64, 64}, 0.1);
        EXPECT_LT(relativeL2(drawn(world.scene, view), truth.weight(view, 0)), bound) << width;
    }
}

// A range that ends at a plateau's value holds all of it, and what two ranges hold is their sum.
TEST(CellSplatter, PlateausAndUnionsAreWhole) {
    const auto grid = tests::cube(6);
    const auto step = [&](std::size_t i) { return grid->indices(i).x < 3 ? 0.0 : 1.0; };
    const View view = tests::lookFrom({0.7, -3, 1.1}, {30, 24});
    const CellWorld both(tests::stepOf(grid, step),
                         {"0:1", "0:0,1:1", "0:0.25,0.75:1", "0:0.25", "0.75:1"});
    const std::vector<float> whole = drawn(both.scene, view);
    std::vector<double> parts(whole.size());
    for (const std::size_t layer : {3u, 4u}) {
        const std::vector<float> part = drawn(both.scene, view, Channels::Weight, layer);
        for (std::size_t i = 0; i < parts.size(); ++i) parts[i] += double(part[i]);
    }
    const std::vector<float> plateaus = drawn(both.scene, view, Channels::Weight, 1);
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 30; ++x) {
            const std::size_t at = std::size_t(y) * 30 + std::size_t(x);
            ASSERT_NEAR(whole[at], pathThrough(both, view, x, y, both.placed.domain()), 1e-4);
            // Between the plateaus there is one cell, which holds neither value but at its ends.
            PlacedPoints::Box between = both.placed.domain();
            between.lo.x = both.placed.positions()[0][2];
            between.hi.x = both.placed.positions()[0][3];
            const double without = whole[at] - pathThrough(both, view, x, y, between);
            ASSERT_NEAR(plateaus[at], without, 0.02 * (1 + without)) << x << ' ' << y;
        }
    EXPECT_LT(relativeL2(drawn(both.scene, view, Channels::Weight, 2), parts), 1e-6);
}

// What is nearest to a missing point, or to one beside the clip box, is not there.
TEST(CellSplatter, MissingAndClippedPointsTakeTheirCellsAway) {
    const auto grid = unevenGrid();
    const glm::uvec3 gone(2, 1, 1);
    const auto isGone = [&](std::size_t i) { return glm::uvec3(grid->indices(i)) == gone; };
    const CellWorld holed(
        tests::stepOf(grid, [&](std::size_t i) { return isGone(i) ? kNan : 1.0; }), {"0:2"});
    CellWorld clipped(tests::stepOf(grid, [](std::size_t) { return 1.0; }), {"0:2"});
    clipped.scene.clip = {gone, gone};
    const View view = tests::lookFrom(kFrom[0], {40, 30});
    const std::vector<float> without = drawn(holed.scene, view), alone = drawn(clipped.scene, view);
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x) {
            const double all = pathThrough(holed, view, x, y, holed.placed.domain());
            const double one = pathThrough(holed, view, x, y, boxOf(holed.placed, gone));
            const std::size_t at = std::size_t(y) * 40 + std::size_t(x);
            ASSERT_NEAR(without[at], all - one, 1e-4) << x << ' ' << y;
            ASSERT_NEAR(alone[at], one, 1e-4) << x << ' ' << y;
        }
}

// Whole numbers are rounded ones: 3 stands for 2.5 to 3.5.
TEST(CellSplatter, RangesOfWholeNumbersReachHalfANumberFarther) {
    const auto grid = tests::cube(8);
    std::vector<std::uint8_t> values;
    for (std::size_t i = 0; i < grid->count(); ++i)
        values.push_back(static_cast<std::uint8_t>(grid->indices(i).x));
    const CellWorld world(timeseries::SortedStep::build({grid, std::move(values), {}}), {"3"});
    const View view = tests::lookFrom({3, 1e-3, 2e-3}, {9, 9}, 0.01);
    EXPECT_NEAR(drawn(world.scene, view)[4 * 9 + 4], 1, 1e-3);
}

TEST(CellSplatter, IsTheSameForAnyThreadsAndSlices) {
    CellWorld world(tests::noise(unevenGrid()), {"0.2:0.5", "0.4:0.45,0.6:max"});
    for (const Channels channels :
         {Channels::Weight, Channels::WeightedColor, Channels::Over, Channels::Count}) {
        world.scene.order = channels == Channels::Over ? Order::BackToFront : Order::None;
        for (const glm::dvec3& from : kFrom) {
            const View view = tests::lookFrom(from, {40, 30});
            const auto once = drawn(world.scene, view, channels, 0, 1);
            EXPECT_GT(std::accumulate(once.begin(), once.end(), 0.0f), 1);
            EXPECT_EQ(once, drawn(world.scene, view, channels, 0, 2));
            EXPECT_EQ(once, drawn(world.scene, view, channels, 0, 5));
            EXPECT_EQ(once, drawn(world.scene, view, channels, 0, 3, 7));
        }
    }
}

// Each pixel's fragments of all cells, sorted by where its ray enters them, nearest first.
double redByDepth(const CellWorld& world, const View& view, int x, int y) {
    const PointsView seen(world.placed, view);
    const Ray ray = rayOf(world, view, {x + 0.5, y + 0.5});
    const glm::dvec2 at = glm::dvec2(x + 0.5, y + 0.5) - seen.rays.centre;
    struct Part {
        double depth, weight;
        std::size_t layer;
    };
    std::vector<Part> parts;
    const timeseries::CellIndex& cells = *world.scene.cells;
    for (std::uint32_t c = 0; c < cells.size().x * cells.size().y * cells.size().z; ++c) {
        const glm::uvec3 index = timeseries::indicesOf(c, cells.size());
        ValuedCell cell{};
        cell.corners = cells.corners(index);
        PlacedPoints::Box box{};
        for (int a = 0; a < 3; ++a) {
            const auto& p = world.placed.positions()[std::size_t(a)];
            const auto domain = world.placed.domain();
            const bool down = p.front() > p.back();
            cell.from[a] = index[a] > 0 ? p[index[a] - 1] : (down ? domain.hi : domain.lo)[a];
            cell.to[a] = index[a] < p.size() ? p[index[a]] : (down ? domain.lo : domain.hi)[a];
            box.lo[a] = std::min(cell.from[a], cell.to[a]);
            box.hi[a] = std::max(cell.from[a], cell.to[a]);
        }
        for (std::size_t k = 0; k < world.scene.layers.size(); ++k)
            for (const auto& range : world.scene.layers[k].cells.ranges) {
                cell.lo = range.lo;
                cell.hi = range.hi;
                const auto s = cellSplatAt<double>(seen, cell);
                if (!s.visible) continue;
                const auto f = fragmentOn<double>(seen, s, at - s.centre, 1e9);
                if (f.weight > 0) parts.push_back({inside(ray, box).first, f.weight, k});
            }
    }
    std::ranges::stable_sort(parts, {}, &Part::depth);
    double through = 1, red = 0;
    for (const Part& part : parts) {
        const RangeStyle& style = world.scene.layers[part.layer].style;
        const double alpha = -std::expm1(-opticalDepthPerWeight(style.opacity) * part.weight);
        red += through * alpha * colorOf(style, 0).r;
        through *= 1 - alpha;
    }
    return red;
}

TEST(CellSplatter, CellsHideWhatIsBehindThem) {
    CellWorld world(tests::noise(unevenGrid()), {"0:0.5", "0.5:1"}, 0.9);
    world.scene.order = Order::BackToFront;
    for (const glm::dvec3& from : kFrom) {
        const View view = tests::lookFrom(from, {24, 20}, 0.3);
        const std::vector<float> over = drawn(world.scene, view, Channels::Over);
        for (int y = 0; y < 20; ++y)
            for (int x = 0; x < 24; ++x)
                ASSERT_NEAR(over[4 * (std::size_t(y) * 24 + std::size_t(x))],
                            redByDepth(world, view, x, y), 1e-4)
                    << x << ' ' << y << " from " << from.x;
    }
}

// A ramp along x has one gradient everywhere: how bright it is depends on the ray alone. Of one
// colour and one layer, light multiplies what is drawn without.
TEST(CellSplatter, LightIsThatOfARampsOneGradient) {
    const auto lean = tests::leaning({1, 0, 0.2}, {0.5, 1, 0}, {-0.3, 0.3, 1});
    const std::array axes{axis(6), axis(5, 0, 0.7), axis(4)};
    const auto grid = std::make_shared<const Grid>(axes, timeseries::Frame{lean});
    CellWorld world(tests::stepOf(grid, [&](std::size_t i) { return double(grid->indices(i).x); }),
                    {"2.2:3.6"});
    world.scene.order = Order::BackToFront;
    const View view = tests::lookFrom({1.1, -2.5, 0.8}, {40, 30});
    const std::vector<float> dark = drawn(world.scene, view, Channels::Over);
    // Across the planes x = const of the grid: along the product of the two other axes.
    const glm::dmat3& m = world.placed.worldFromAxes();
    const glm::dvec3 normal = glm::normalize(glm::cross(m[1], m[2]));
    const double perLength =
        1 / std::abs(world.placed.positions()[0][1] - world.placed.positions()[0][0]) /
        std::abs(glm::dot(m[0], normal));
    const double steep = world.scene.cells->halfRange(world.scene.layers[0].cells.candidates, 0.9);
    const double certainty = perLength / (perLength + 0.2 * steep / world.placed.unitLength());
    int lit = 0;
    for (const Light light : {Light::Soft, Light::Full}) {
        world.scene.light = light;
        const std::vector<float> is = drawn(world.scene, view, Channels::Over);
        for (int y = 0; y < 30; ++y)
            for (int x = 0; x < 40; ++x) {
                const std::size_t at = 4 * (std::size_t(y) * 40 + std::size_t(x));
                ASSERT_NEAR(is[at + 3], dark[at + 3], 1e-6);
                if (dark[at + 3] < 0.01f) continue;
                ++lit;
                const Ray ray = rayOf(world, view, {x + 0.5, y + 0.5});
                const double facing = std::abs(glm::dot(glm::normalize(m * ray.along), normal));
                const double diffuse = certainty * (0.25 + 0.75 * facing) + (1 - certainty) * 0.625;
                const double specular =
                    light == Light::Full ? certainty * 0.35 * std::pow(facing, 30) : 0;
                ASSERT_NEAR(is[at], double(dark[at]) * diffuse + double(dark[at + 3]) * specular,
                            2e-4)
                    << x << ' ' << y;
            }
    }
    EXPECT_GT(lit, 200);
}

TEST(CellSplatter, APlateauIsLitEvenly) {
    CellWorld world(tests::stepOf(tests::cube(4), [](std::size_t) { return 7.0; }), {"min:max"});
    world.scene.order = Order::BackToFront;
    const View view = tests::lookFrom({1.1, -2.5, 0.8}, {40, 30});
    const std::vector<float> dark = drawn(world.scene, view, Channels::Over);
    world.scene.light = Light::Full;
    const std::vector<float> is = drawn(world.scene, view, Channels::Over);
    for (std::size_t i = 0; i < is.size(); i += 4) ASSERT_NEAR(is[i], 0.625f * dark[i], 1e-5);
}

// Opaque things cut rays where they stand.
TEST(CellSplatter, RaysEndAtWhatIsOpaque) {
    const CellWorld world(tests::noise(tests::cube(5)), {"min:max"});
    const View view = tests::lookFrom({0.7, -3, 1.1}, {40, 30});
    constexpr double kWall = 3.2;  // view depth: through the volume
    const std::vector<float> opaque(40 * 30, static_cast<float>(windowDepth(view, kWall)));
    const auto w = drawn(world.scene, view, Channels::Weight, 0, 2, kAll, opaque);
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x) {
            const Ray ray = rayOf(world, view, {x + 0.5, y + 0.5});
            const auto [from, to] = inside(ray, world.placed.domain());
            const double wanted =
                std::max(std::min(to, kWall) - from, 0.0) * ray.length / world.placed.unitLength();
            ASSERT_NEAR(w[std::size_t(y) * 40 + std::size_t(x)], wanted, 2e-3 * (1 + wanted));
        }
}

}  // namespace
}  // namespace render
