// What is the tiles' own; what any sum of planes does is in plane_sums_test.cpp.
#include "render/splat/tile_splatter.h"
#include "render/splat/depth_order.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <array>
#include <vector>

#include "render/reference/cpu_splatter.h"
#include "render/reference/exact_order.h"
#include "render/reference/image_compare.h"
#include "render/splat/tile_kernels.h"
#include "tests/support/meshes.h"
#include "tests/support/noise_plane.h"
#include "tests/support/vector_targets.h"

namespace render {
namespace {

using timeseries::RangeSet;

class TileSplatter : public tests::NoisePlane {};

// Large splats touch many tiles each; memory is bounded all the same.
TEST_F(TileSplatter, NotABitDependsOnHowManyAreSortedAtOnce) {
    scene_.footprint.size = 4;
    scene_.layers[0].runs = step_.select(RangeSet::parse("0.1:0.14,0.5:0.55"));
    const DrawList list = Runs{};
    const auto summed = [&](std::uint64_t pairs) {
        TileSum sum(scene_, list, view_, Channels::WeightedColor, 0, opaque_, 2, {}, pairs);
        while (!sum.done()) sum.add(1 << 20);
        return std::vector<float>(sum.plane().begin(), sum.plane().end());
    };
    const auto whole = summed(TileSum::kPairs);
    for (const std::uint64_t pairs : {1u, 100u, 10000u}) EXPECT_EQ(summed(pairs), whole) << pairs;
}

TEST_F(TileSplatter, EveryKindOfVectorsSumsTheTruth) {
    timeseries::Axis uneven = tests::axis(9);
    for (double& x : uneven.coordinates) x *= 1 + 0.05 * x;
    const auto unevenStep = tests::noise(std::make_shared<const timeseries::Grid>(
        std::array{uneven, tests::axis(8), tests::axis(7)}));
    const PlacedPoints unevenPoints(unevenStep.grid());
    // Their splats end at the domain's faces.
    const auto longStep = tests::noise(std::make_shared<const timeseries::Grid>(
        std::array{tests::axis(14), tests::axis(13), tests::axis(3, 0, 6)}));
    const PlacedPoints longPoints(longStep.grid());
    ASSERT_TRUE(longPoints.longCells());
    const auto leaningStep =
        tests::noise(tests::curvilinear({9, 8, 7}, [](double i, double j, double k) {
            return glm::dvec3(i + 0.3 * j + 0.02 * k * k, j - 0.2 * k, k + 0.01 * i * j);
        }));
    const PlacedPoints leaningPoints(leaningStep.grid());
    const auto sceneOf = [](const timeseries::SortedStep& step, const PlacedPoints& placed) {
        return Scene{.step = step,
                     .placed = placed,
                     .layers = {{step.select(RangeSet::everything()), {Constant{}, 0.2}}},
                     .footprint = {},
                     .order = Order::None,
                     .clip = {}};
    };
    std::vector<Scene> scenes{scene_, sceneOf(unevenStep, unevenPoints),
                              sceneOf(longStep, longPoints), sceneOf(leaningStep, leaningPoints)};
    for (std::size_t i = 0; i < 4; ++i) {
        scenes.push_back(scenes[i]);
        scenes.back().footprint = {Kernel::Point, 3};
    }
    const glm::dvec3 eye = pixelRays(view_).eye;
    tests::onEachVectorTarget([&] {
        for (const Scene& scene : scenes)
            for (const Order order : {Order::None, Order::BackToFront}) {
                SCOPED_TRACE(testing::Message() << &scene - scenes.data()
                                                << (order == Order::None ? "" : " in order"));
                Scene drawn = scene;
                drawn.order = order;
                const DrawList list = orderExactly(drawn, eye);
                for (const Channels channels : {channelsFor(drawn)[0], Channels::Count}) {
                    Accumulator<double> truth(view_.size, {channels});
                    splat(drawn, list, view_, {}, truth);
                    const auto summed = sumTiles(drawn, list, view_, channels, 0, {});
                    // A count is whole: at a rim a pixel's middle may be taken for outside.
                    EXPECT_LE(compareScalars(summed, truth.planes[0]).relativeL2,
                              channels == Channels::Count ? 1e-3 : 1e-5);
                }
            }
    });
}

// Each tile's splats put in order alone, or all of them before: not a bit is another.
class OrderInTiles : public TileSplatter {
 protected:
    const glm::dvec3 eye_ = pixelRays(view_).eye;
    void SetUp() override { scene_.order = Order::BackToFront; }
    static Scene ordered(const timeseries::SortedStep& step, const PlacedPoints& placed,
                         const RangeSet& ranges = RangeSet::everything()) {
        return {.step = step,
                .placed = placed,
                .layers = {{step.select(ranges), {ByValue{{}, 0, 1}, 0.3}}},
                .footprint = {},
                .order = Order::BackToFront,
                .clip = {}};
    }
    std::vector<float> summed(const Scene& scene, const DrawList& list, unsigned threads = 2,
                              std::uint64_t pairs = TileSum::kPairs) const {
        TileSum sum(scene, list, view_, Channels::Over, 0, opaque_, threads, {}, pairs);
        std::uint64_t added = 0;
        while (!sum.done()) added += sum.add(1);
        const auto* const sorted = std::get_if<Sorted>(&list);  // without those clipped
        EXPECT_EQ(added, sorted ? sorted->point.size() : splatCount(scene));
        return std::vector<float>(sum.plane().begin(), sum.plane().end());
    }
    void expectTheSame(const Scene& scene) const {
        const auto before = summed(scene, order(scene, eye_));
        EXPECT_GT(*std::ranges::max_element(before), 0.1);
        for (const unsigned threads : {1u, 2u, 5u})
            EXPECT_EQ(summed(scene, SortWhenDrawn{eye_}, threads), before) << threads;
    }
};

TEST_F(OrderInTiles, IsTheListsOfAllLayers) {
    expectTheSame(scene_);
    for (const char* range : {"0.4:0.5", "0.45:1"})
        scene_.layers.push_back(
            {step_.select(RangeSet::parse(range)),
             {Constant{glm::dvec3(0.1, 0.2, range[3] == ':' ? 0.9 : 0.3)}, 0.7}});
    expectTheSame(scene_);
    scene_.stride = 4;
    expectTheSame(scene_);
}

TEST_F(OrderInTiles, IsTheListsOfEqualDistances) {
    // All of a plane that is seen along its normal, at a few distances from an eye far away.
    const auto step = tests::noise(tests::cube(16));
    const PlacedPoints placed(step.grid());
    const Scene scene = ordered(step, placed);
    const glm::dvec3 far(1e9, 0, 0);
    EXPECT_EQ(summed(scene, SortWhenDrawn{far}), summed(scene, order(scene, far)));
}

TEST_F(OrderInTiles, IsTheListsWhereClippedHiddenOrClosed) {
    scene_.clip.lo = {10, 0, 5};
    for (std::size_t i = 0; i < opaque_.size(); i += 3)
        opaque_[i] = static_cast<float>(windowDepth(view_, 3));
    expectTheSame(scene_);
    scene_.layers[0].style.opacity = 1;
    expectTheSame(scene_);
}

TEST_F(OrderInTiles, IsTheListsOfAMesh) {
    const auto grid = tests::curvilinear({20, 20, 20}, [](double i, double j, double k) {
        return glm::dvec3(i + 0.02 * j * k, j, k - 0.01 * i * i);
    });
    const auto step = tests::noise(grid);
    const PlacedPoints placed(step.grid());
    expectTheSame(ordered(step, placed, RangeSet::parse("0.2:0.9")));
}

TEST_F(OrderInTiles, IsTheListsWhereSplatsEndAtTheFaces) {
    const auto step = tests::noise(std::make_shared<const timeseries::Grid>(
        std::array{tests::axis(30), tests::axis(30), tests::axis(4, 0, 8)}));
    const PlacedPoints placed(step.grid());
    ASSERT_TRUE(placed.longCells());
    const Scene scene = ordered(step, placed, RangeSet::parse("0.2:0.9"));
    expectTheSame(scene);
    const auto before = summed(scene, order(scene, eye_));
    for (const std::uint64_t pairs : {1u, 1000u, 100000u})
        EXPECT_EQ(summed(scene, SortWhenDrawn{eye_}, 2, pairs), before) << pairs;
}

// A list of all of them then is made.
TEST_F(OrderInTiles, IsTheListsWhereTilesHaveNoRoomForAll) {
    scene_.footprint.size = 4;
    const auto before = summed(scene_, order(scene_, eye_));
    for (const std::uint64_t pairs : {1000u, 100000u})
        EXPECT_EQ(summed(scene_, SortWhenDrawn{eye_}, 2, pairs), before) << pairs;
}

TEST_F(OrderInTiles, IsTheListsOfMoreThanAreSortedAtOnce) {
    const auto step = tests::noise(tests::cube(102));
    ASSERT_GT(step.size(), TileSum::kAtOnce);
    const PlacedPoints placed(step.grid());
    const Scene scene = ordered(step, placed);
    EXPECT_EQ(summed(scene, SortWhenDrawn{eye_}), summed(scene, order(scene, eye_)));
}

TEST_F(OrderInTiles, OfNothingIsNothing) {
    scene_.layers[0].runs.clear();
    const auto plane = summed(scene_, SortWhenDrawn{eye_});
    EXPECT_EQ(std::ranges::count(plane, 0.0f), std::ssize(plane));
}

// What grids of a thousand million points have, whose indices along three axes fill no word, and
// what those have whose points are not evenly spaced, told apart here by nothing but that.
TEST_F(TileSplatter, PointsAreSeenAlikeHoweverTheyAreToldWhereTheyLie) {
    const TileView packed(scene_, view_, Channels::Weight, 0);
    ASSERT_TRUE(packed.packs && packed.evenlySpaced && packed.count() > 3);
    TileView linear = packed, byTables = packed;
    linear.packs = false;
    byTables.evenlySpaced = false;
    const auto summed = [&](const TileView& view) {
        const auto all = std::span(step_.columns().gridIndex).first(1001);  // no whole vectors
        std::vector<std::uint32_t> points(all.begin(), all.end());
        std::vector<TileSpan> spans(points.size());
        findTiles(view, points, spans);
        EXPECT_EQ(std::ranges::equal(points, all), !view.packs);
        TileRoom room(view);
        std::vector<float> sums;
        for (std::size_t tile = 0; tile < view.count(); ++tile) {
            room.enter(view, tile, {}, view_.size.x);
            std::ranges::fill(room.sums, 0.0f);
            sumTile(view, points, {}, room);
            sums.insert(sums.end(), room.sums.begin(), room.sums.end());
        }
        return sums;
    };
    const auto sums = summed(packed);
    EXPECT_GT(*std::ranges::max_element(sums), 0);
    EXPECT_EQ(summed(linear), sums);
    EXPECT_LE(
        compareScalars(summed(byTables), std::vector<double>(sums.begin(), sums.end())).relativeL2,
        1e-6);
}

}  // namespace
}  // namespace render
