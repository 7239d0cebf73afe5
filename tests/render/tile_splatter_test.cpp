// What is the tiles' own; what they share with rows is in plane_sums_test.cpp.
#include "render/splat/tile_splatter.h"
#include "render/splat/depth_order.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "render/reference/cpu_splatter.h"
#include "render/reference/exact_order.h"
#include "render/reference/image_compare.h"
#include "tests/support/noise_plane.h"
#include "tests/support/vector_targets.h"

namespace render {
namespace {

using timeseries::RangeSet;

class TileSplatter : public tests::NoisePlane {};

// Large splats touch many tiles each; memory is bounded all the same.
TEST_F(TileSplatter, NotABitDependsOnHowManyAreSortedAtOnce) {
    scene_.footprint.size = 4;
    const DrawList list = Runs{};
    const auto summed = [&](std::uint64_t pairs) {
        TileSum sum(scene_, list, view_, Channels::WeightedColor, 0, opaque_, 2, {}, pairs);
        while (!sum.done()) sum.add(1 << 20);
        return std::vector<float>(sum.plane().begin(), sum.plane().end());
    };
    const auto whole = summed(TileSum::kPairs);
    for (const std::uint64_t pairs : {1u, 1000u, 100000u}) EXPECT_EQ(summed(pairs), whole) << pairs;
}

TEST_F(TileSplatter, EveryKindOfVectorsSumsTheTruth) {
    timeseries::Axis uneven = tests::axis(9);
    for (double& x : uneven.coordinates) x *= 1 + 0.05 * x;
    const auto unevenStep = tests::noise(std::make_shared<const timeseries::Grid>(
        std::array{uneven, tests::axis(8), tests::axis(7)}));
    const PlacedPoints unevenPoints(unevenStep.grid());
    Scene unevenScene{.step = unevenStep,
                      .placed = unevenPoints,
                      .layers = {{unevenStep.select(RangeSet::everything()), {Constant{}, 0.2}}},
                      .footprint = {},
                      .order = Order::None,
                      .clip = {}};
    tests::onEachVectorTarget([&] {
        for (const Scene* scene : {&scene_, &unevenScene})
            for (const Order order : {Order::None, Order::BackToFront}) {
                Scene drawn = *scene;
                drawn.order = order;
                const Channels channels = channelsFor(drawn)[0];
                const glm::dvec3 eye = pixelRays(view_).eye;
                Accumulator<double> truth(view_.size, {channels});
                splat(drawn, orderExactly(drawn, eye), view_, {}, truth);
                const auto summed =
                    sumTiles(drawn, orderExactly(drawn, eye), view_, channels, 0, {});
                EXPECT_LE(compareScalars(summed, truth.planes[0]).relativeL2, 1e-5);
            }
    });
}

}  // namespace
}  // namespace render
