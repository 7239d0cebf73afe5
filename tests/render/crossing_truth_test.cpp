// The continuous truth of what passes through ranges (OpacityPer::Crossing), against closed forms,
// and cells that are drawn so against it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "render/reference/cubic_on_line.h"
#include "render/reference/image_compare.h"
#include "tests/support/cell_worlds.h"
#include "tests/support/meshes.h"
#include "tests/support/true_world.h"

namespace render {
namespace {

using namespace true_world;
using tests::CellWorld;

TrueWorld crossed(const Field& field, const std::vector<std::vector<Interval<double>>>& layers) {
    TrueWorld world(field, layers);
    world.scene.cells = world.step.cells();
    world.scene.opacityPer = OpacityPer::Crossing;
    return world;
}

// Of a linear field a passage through all of a range counts as one, or as its length where that is
// more; one that the domain ends within, as much of it. Also where no point lies in the range,
// where it is a single value, and where that is the points' own.
TEST(CrossingTruth, APassageThroughASlabIsOneOrItsLength) {
    for (const auto& grid : {unevenGrid(), shearedGrid()}) {
        const auto& x = grid->axes()[0].coordinates;
        const Field field = fieldOn(grid, [&](const glm::uvec3& p) { return x[p.x]; });
        const std::vector<Interval<double>> slabs = {
            {0.3, 2.4}, {1.2, 1.2 + 1e-3}, {1.2, 1.2}, {1, 1}, {0.5, 1.25}};
        std::vector<std::vector<Interval<double>>> layers;
        for (const auto& slab : slabs) layers.push_back({slab});
        const TrueWorld world = crossed(field, layers);
        const auto domain = world.placed.domain();
        const auto planeAt = [&](double value) {
            return world.placed.axesFromGrid(glm::dvec3(value, 0, 0)).x;
        };
        for (const glm::dvec3& from : kFrom) {
            const View view = tests::lookFrom(from, kSize);
            for (std::size_t k = 0; k < slabs.size(); ++k) {
                // As the truth has it of a single value: a millionth of what a cell changes by.
                const double least = 1e-7;
                const double lo = planeAt(std::min(slabs[k].lo, slabs[k].hi - least)),
                             hi = planeAt(std::max(slabs[k].hi, slabs[k].lo + least));
                const std::vector<double> is = world.weight(view, k);
                for (int j = 0; j < kSize.y; ++j)
                    for (int i = 0; i < kSize.x; ++i) {
                        const Ray ray = rayOf(world, view, i + 0.5, j + 0.5);
                        glm::dvec3 first = domain.lo, last = domain.hi;
                        first.x = std::min(lo, hi);
                        last.x = std::max(lo, hi);
                        const Way way = within(ray, first, last);
                        const double depth = std::max(way.to - way.from, 0.0);
                        const double share = depth * std::abs(ray.along.x) / std::abs(hi - lo);
                        // A ray that leaves by another face within so thin a slab is a matter of
                        // rounding.
                        if (slabs[k].lo == slabs[k].hi && share > 0 && share < 0.999) continue;
                        ASSERT_NEAR(is[std::size_t(j * kSize.x + i)],
                                    std::max(depth * ray.weight, share), 2e-6)
                            << k << ": " << i << ' ' << j;
                    }
            }
        }
    }
}

// x y z on one cell, along its diagonal t^3: what it changes by makes more of the way where
// 3 t^2 / (hi - lo) is more than the diagonal.
TEST(CrossingTruth, CountsTheLengthWhereTheFieldIsFlatAndItsChangeWhereItIsSteep) {
    constexpr double kLo = 0.001, kHi = 0.729;  // t of 0.1 and 0.9
    const TrueWorld world = crossed(
        fieldOn(tests::cube(2), [](const glm::uvec3& p) { return double(p.x * p.y * p.z); }),
        {{{kLo, kHi}}});
    const View view = tests::lookFrom(3.0 * glm::normalize(glm::dvec3(1, 1, 1)), {1, 1}, 1e-7);
    const double diagonal =
        2 * std::sqrt(3.0) * world.placed.boxHalf().x / world.placed.unitLength();
    const double bend = std::sqrt(diagonal * (kHi - kLo) / 3);
    ASSERT_TRUE(bend > 0.2 && bend < 0.8) << bend;
    EXPECT_NEAR(world.weight(view, 0)[0],
                diagonal * (bend - 0.1) + (kHi - std::pow(bend, 3)) / (kHi - kLo), 1e-6);
}

// By sums over many steps.
TEST(CrossingTruth, OfAnyCubicIsTheIntegralOfTheGreaterRate) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> some(0, 1);
    constexpr int kSteps = 200000;
    for (int n = 0; n < 40; ++n) {
        const Cubic f{some(random), some(random), some(random), some(random)};
        const double lo = some(random) - 0.2, hi = lo + 0.05 + some(random),
                     whole = 3 * some(random);
        double sum = 0;
        for (int i = 0; i < kSteps; ++i) {
            const double from = valueAt(f, i / double(kSteps)),
                         to = valueAt(f, (i + 1) / double(kSteps)), middle = (from + to) / 2;
            if (middle >= lo && middle <= hi)
                sum += std::max(whole / kSteps, std::abs(to - from) / (hi - lo));
        }
        EXPECT_NEAR(passageWithin(f, lo, hi, hi - lo, whole), sum, 1e-3 * (1 + sum)) << n;
        std::vector<LinePart> parts;
        addPartsWithin(f, lo, hi, parts);
        double length = 0;
        for (const LinePart& part : parts) length += part.to - part.from;
        EXPECT_NEAR(passageWithin(f, lo, hi, kInfinity, whole), length * whole, 1e-12) << n;
    }
}

timeseries::SortedStep waves(std::shared_ptr<const Grid> grid) {
    return tests::stepOf(std::move(grid), [](std::size_t i) {
        const glm::dvec3 p(i % 24, i / 24 % 24, i / 576);
        return std::sin(0.45 * p.x) + std::cos(0.35 * p.y + 0.15 * p.x) * std::sin(0.4 * p.z);
    });
}

// Of what is drawn, against the truth of either.
double errorOf(const CellWorld& world, const View& view, OpacityPer per = OpacityPer::Crossing) {
    Scene scene = world.scene;
    scene.opacityPer = per;
    const IntervalTruth truth(scene, scene.cells->field(), 4);
    return compareScalars(std::span<const float>(tests::drawn(world.scene, view)),
                          truth.weight(view, 0))
        .relativeL2;
}

// Of thin ranges, whose lengths are far less than their crossings, and of wide ones, of which both
// are one.
TEST(CrossingTruth, IsWhatCellsAreDrawnAs) {
    const View view = tests::lookFrom({1.2, -2.5, 1}, {160, 120});
    for (const char* range : {"0.2:0.9", "0.2:0.25", "0.2:0.201", "0.2"}) {
        CellWorld world(waves(tests::cube(24)), {range});
        world.scene.opacityPer = OpacityPer::Crossing;
        EXPECT_LT(errorOf(world, view), 0.06) << range;
        const bool isWide = range == std::string_view("0.2:0.9");
        EXPECT_EQ(errorOf(world, view, OpacityPer::Length) < 0.5, isWide) << range;
    }
}

// Tetrahedra of a mesh, too.
TEST(CrossingTruth, OfAMeshIsWhatItsCellsAreDrawnAs) {
    const View view = tests::lookFrom({1.2, -2.5, 1}, {120, 90});
    for (const char* range : {"0.2:0.9", "0.2:0.25", "0.2"}) {
        CellWorld world(tests::stepOfPlaces(tests::twisted(),
                                            [](const glm::dvec3& p) {
                                                return 0.5 + 0.5 * std::sin(p.x + 0.4) *
                                                                 std::cos(0.9 * p.y - p.z);
                                            }),
                        {range});
        world.scene.opacityPer = OpacityPer::Crossing;
        EXPECT_LT(errorOf(world, view), 0.12) << range;  // one ray a pixel
    }
}

// One colour: what is taken of the light behind is 1 - e^-tau, however a crossing makes it deep.
TEST(CrossingTruth, LightIsAbsorbedByWhatIsCrossed) {
    constexpr double kOpacity = 0.4;
    const View view = tests::lookFrom({1.2, -2.5, 1}, {40, 30});
    const auto wave = [](const glm::dvec3& p) {
        return 0.5 + 0.5 * std::sin(p.x + 0.4) * std::cos(0.9 * p.y - p.z);
    };
    const auto places = [](double i, double j, double k) { return glm::dvec3(i, j, k); };
    for (const auto& grid : {tests::cube(7), tests::curvilinear({7, 7, 7}, places)})
        for (const char* range : {"0.2:0.9", "0.2:0.25", "0.2"}) {
            CellWorld world(tests::stepOf(grid,
                                          [&](std::size_t i) {
                                              return wave(glm::dvec3(i % 7, i / 7 % 7, i / 49));
                                          }),
                            {range}, kOpacity);
            world.scene.opacityPer = OpacityPer::Crossing;
            world.scene.order = Order::BackToFront;
            world.scene.layers[0].style.color = Constant{glm::dvec3(0.2, 0.5, 0.9)};
            const IntervalTruth truth(world.scene, world.scene.cells->field(), 1);
            const std::vector<double> w = truth.weight(view, 0);
            const std::vector<glm::dvec4> light = truth.light(view);
            ASSERT_GT(std::ranges::max(w), 0.9) << range;
            for (std::size_t i = 0; i < w.size(); ++i) {
                const double alpha = 1 - std::pow(1 - kOpacity, w[i]);
                ASSERT_NEAR(light[i].a, alpha, 1e-5) << range << ' ' << i;
                ASSERT_NEAR(light[i].g, 0.5 * alpha, 1e-5) << range << ' ' << i;
            }
        }
}

// Two thin shells of many colours, one before the other.
TEST(CrossingTruth, LightOfThinShellsIsWhatCellsShow) {
    CellWorld world(waves(tests::cube(24)), {"0.2:0.25", "-0.55:-0.5"}, 0.7);
    world.scene.opacityPer = OpacityPer::Crossing;
    world.scene.order = Order::BackToFront;
    world.scene.layers[0].style.color = ByValue{ColorMap(), 0.2, 0.25};
    const View view = tests::lookFrom({1.2, -2.5, 1}, {160, 120});
    const std::vector<float> shown = tests::drawn(world.scene, view, Channels::Over);
    const auto light = IntervalTruth(world.scene, world.scene.cells->field(), 3).light(view);
    double off = 0, all = 0;
    for (std::size_t i = 0; i < light.size(); ++i)
        for (int c = 0; c < 4; ++c) {
            off += std::pow(double(shown[4 * i + std::size_t(c)]) - light[i][c], 2);
            all += light[i][c] * light[i][c];
        }
    EXPECT_LT(std::sqrt(off / all), 0.08);  // one ray a pixel
}

// Layers that are drawn by points have lengths.
TEST(CrossingTruth, IsNoneOfPoints) {
    TrueWorld world = crossed(fieldOn(tests::cube(6), [](const glm::uvec3& p) { return p.x; }),
                              {{{1.2, 1.3}}, {{1.2, 1.3}}});
    world.scene.layers[1].byPoints = true;
    const View view = tests::lookFrom({0.7, -3, 1.1}, kSize);
    const std::vector<double> crossing = world.weight(view, 0), length = world.weight(view, 1);
    world.scene.opacityPer = OpacityPer::Length;
    EXPECT_EQ(world.weight(view, 0), length);
    EXPECT_NE(crossing, length);
}

}  // namespace
}  // namespace render
