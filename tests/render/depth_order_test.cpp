#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/model/scene.h"
#include "render/reference/cpu_splatter.h"
#include "render/reference/exact_order.h"
#include "render/splat/depth_order.h"
#include "tests/support/scenes.h"

namespace render {
namespace {

using timeseries::RangeSet;

// Three axes that cannot be mistaken for each other, leaning.
std::shared_ptr<const timeseries::Grid> leaningGrid() {
    return std::make_shared<timeseries::Grid>(
        std::array{tests::axis(20), tests::axis(15, 0, 1.7), tests::axis(24, 3, 0.6)},
        timeseries::CoordinateFrame{tests::leaning({1, 0.3, 0}, {0.5, -1, 0}, {0.4, 0.2, 1}), {}});
}

Scene allOf(const timeseries::SortedStep& step, const PlacedPoints& placed, RangeStyle style = {}) {
    return {.step = step,
            .placed = placed,
            .layers = {{step.select(RangeSet::everything()), std::move(style)}},
            .footprint = {},
            .order = Order::BackToFront,
            .clip = {}};
}

struct OrderedWorld {
    timeseries::SortedStep step = tests::noise(leaningGrid());
    PlacedPoints placed{step.grid()};
    Scene scene{.step = step,
                .placed = placed,
                .layers = {{step.select(RangeSet::parse("0.1:0.5")), {}},
                           {step.select(RangeSet::parse("0.4:0.7")), {}}},
                .footprint = {},
                .order = Order::BackToFront,
                .clip = {}};
    double distance(std::uint32_t point, const glm::dvec3& eye) const {
        return glm::distance(placed.position(step.gridIndex()[point]), eye);
    }
};

const glm::dvec3 kEyes[] = {{0, -3, 0}, {0.1, 0.05, -0.2}, {100, 40, 7}, {1e6, 2e5, 3}};

void expectEveryPointOnce(const OrderedWorld& w, const Sorted& sorted) {
    std::vector<std::pair<int, std::uint32_t>> listed, expected;
    for (std::size_t i = 0; i < sorted.point.size(); ++i)
        listed.emplace_back(sorted.layer[i], sorted.point[i]);
    for (int layer = 0; layer < 2; ++layer)
        for (const auto& run : w.scene.layers[layer].runs)
            for (std::uint64_t p = run.first; p < run.first + run.count; ++p)
                expected.emplace_back(layer, static_cast<std::uint32_t>(p));
    std::ranges::sort(listed);
    EXPECT_EQ(listed, expected);
}

TEST(DepthOrder, EveryPointOfEveryLayerIsThereOnce) {
    const OrderedWorld w;
    expectEveryPointOnce(w, std::get<Sorted>(order(w.scene, kEyes[0])));
    expectEveryPointOnce(w, std::get<Sorted>(orderExactly(w.scene, kEyes[0])));
}

TEST(DepthOrder, NotAskedForItIsTheRunsAsTheyLie) {
    OrderedWorld w;
    w.scene.order = Order::None;
    EXPECT_TRUE(std::holds_alternative<Runs>(order(w.scene, kEyes[0])));
    EXPECT_TRUE(std::holds_alternative<Runs>(orderExactly(w.scene, kEyes[0])));
}

constexpr std::size_t kKeys = 1 << 22;

// As many points as keys, evenly spaced along the ray of an eye: each has a key of its own. Values
// rise with the distance: points of one key would keep the order of value.
TEST(DepthOrder, TheKeysAre4194304) {
    const auto grid = std::make_shared<timeseries::Grid>(
        std::array{tests::axis(kKeys), tests::axis(1), tests::axis(1)});
    const auto step = tests::stepOf(grid, [](std::size_t i) { return double(i); });
    const PlacedPoints placed(step.grid());
    const Scene scene = allOf(step, placed);
    const auto sorted = std::get<Sorted>(order(scene, {-3, 0, 0}));
    ASSERT_EQ(sorted.point.size(), kKeys);
    const auto falls = [](std::uint32_t a, std::uint32_t b) { return a != b + 1; };
    EXPECT_EQ(sorted.point.front(), kKeys - 1);
    EXPECT_EQ(std::ranges::adjacent_find(sorted.point, falls), sorted.point.end());
}

TEST(DepthOrder, FarthestFirstToOneKeyOf4194304) {
    const OrderedWorld w;
    for (const glm::dvec3& eye : kEyes) {
        const auto sorted = std::get<Sorted>(order(w.scene, eye));
        // The farthest corner of the box is 1 from its middle.
        const double away = glm::length(eye);
        const double key = (away + 1 - std::max(away - 1, 0.0)) / (kKeys - 1);
        for (std::size_t i = 1; i < sorted.point.size(); ++i)
            ASSERT_LE(w.distance(sorted.point[i], eye),
                      w.distance(sorted.point[i - 1], eye) + key * 1.000001)
                << "entry " << i << " from " << eye.x;
    }
}

TEST(DepthOrder, TheTruthsOrderIsExact) {
    const OrderedWorld w;
    const auto sorted = std::get<Sorted>(orderExactly(w.scene, kEyes[1]));
    for (std::size_t i = 1; i < sorted.point.size(); ++i)
        ASSERT_GE(w.distance(sorted.point[i - 1], kEyes[1]), w.distance(sorted.point[i], kEyes[1]));
}

TEST(DepthOrder, ClippedPointsAreNotListed) {
    OrderedWorld w;
    w.scene.clip = {glm::uvec3(5, 0, 0), glm::uvec3(9, 14, 3)};
    const auto sorted = std::get<Sorted>(order(w.scene, kEyes[0]));
    ASSERT_FALSE(sorted.point.empty());
    for (const std::uint32_t p : sorted.point) {
        const std::uint32_t i = w.step.gridIndex()[p];
        EXPECT_TRUE(w.scene.clip.holds({i % 20, i / 20 % 15, i / 300}));
    }
}

TEST(DepthOrder, NothingSelectedIsAnEmptyList) {
    OrderedWorld w;
    w.scene.layers.clear();
    EXPECT_TRUE(std::get<Sorted>(order(w.scene, kEyes[0])).point.empty());
}

TEST(DepthOrder, EqualDistancesKeepTheOrderOfValue) {
    // Four corners of a square seen from above its middle: one distance, one key.
    auto grid = std::make_shared<timeseries::Grid>(
        std::array{tests::axis(2), tests::axis(2), tests::axis(1)});
    const auto step = tests::stepOf(grid, [](std::size_t i) { return 3 - double(i); });
    const PlacedPoints placed(step.grid());
    const Scene scene = allOf(step, placed);
    for (const DrawList& list : {order(scene, {0, 0, 3}), orderExactly(scene, {0, 0, 3})})
        EXPECT_EQ(std::get<Sorted>(list).point, (std::vector<std::uint32_t>{0, 1, 2, 3}));
}

TEST(DepthOrder, NothingIsLeftOfTheFrameBefore) {
    OrderedWorld w;
    DepthOrder order;
    for (const char* range : {"0:1", "0.3:0.4", "0.1:0.9"})
        for (const glm::dvec3& eye : kEyes) {
            w.scene.layers[0].runs = w.step.select(RangeSet::parse(range));
            const auto list = std::get<Sorted>(order(w.scene, eye));
            const auto alone = std::get<Sorted>(DepthOrder()(w.scene, eye));
            EXPECT_EQ(list.point, alone.point) << range;
            EXPECT_EQ(list.layer, alone.layer) << range;
        }
}

TEST(DepthOrder, InSlicesIsTheSameList) {
    OrderedWorld w;
    for (const IndexBox& clip : {IndexBox{}, IndexBox{{2, 3, 1}, {15, 9, 20}}})
        for (const std::uint32_t stride : {1u, 8u})
            for (const std::uint64_t slice : {1, 1000, 1 << 16}) {
                w.scene.clip = clip;
                w.scene.stride = stride;
                const auto whole = std::get<Sorted>(order(w.scene, kEyes[1]));
                DepthOrder inSlices;
                inSlices.begin(w.scene, kEyes[1]);
                double share = 0;
                for (int calls = 1; !inSlices.done(); ++calls) {
                    EXPECT_GE(inSlices.share(), share);
                    share = inSlices.share();
                    EXPECT_LT(share, 1);
                    inSlices.goOn(slice);
                    ASSERT_LE(calls, 10 + 3 * whole.point.size() * 40 / slice) << "it goes on";
                }
                EXPECT_EQ(inSlices.share(), 1);
                const auto list = std::get<Sorted>(inSlices.take());
                EXPECT_EQ(list.point, whole.point) << slice;
                EXPECT_EQ(list.layer, whole.layer) << slice;
            }
}

// Where next to nothing comes through, two neighbours in the wrong order are a pixel of the wrong
// colour.
TEST(DepthOrder, OpaqueSplatsAreSeenAsInTheTruthsOrder) {
    const auto step = tests::noise(tests::cube(64));
    const PlacedPoints placed(step.grid());
    const Scene scene = allOf(step, placed, {ByValue{{}, 0, 1}, 1});
    const View view = tests::lookFrom({1.3, -2.4, 0.9}, {150, 150});
    const glm::dvec3 eye = pixelRays(view).eye;
    Accumulator<double> tested(view.size, {Channels::Over}), truth(view.size, {Channels::Over});
    splat(scene, order(scene, eye), view, {}, tested);
    splat(scene, orderExactly(scene, eye), view, {}, truth);
    double most = 0, brightest = 0;
    for (std::size_t i = 0; i < truth.planes[0].size(); ++i) {
        most = std::max(most, std::abs(tested.planes[0][i] - truth.planes[0][i]));
        brightest = std::max(brightest, truth.planes[0][i]);
    }
    EXPECT_LT(most, 1e-3);
    EXPECT_GT(brightest, 0.5) << "or nothing was compared";
}

}  // namespace
}  // namespace render
