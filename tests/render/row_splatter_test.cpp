// What is the rows' own; that they sum the truth, for every kind of scene, is tested beside the GL
// splatter (tests/gl/splat_test.cpp).
#include "render/row_splatter.h"

#include <gtest/gtest.h>

#include "render/cpu_splatter.h"
#include "render/image_compare.h"
#include "tests/support/scenes.h"

namespace render {
namespace {

using timeseries::RangeSet;

// More points than are summed at once, in a picture whose rows do not divide evenly.
class RowSplatter : public testing::Test {
 protected:
    std::vector<float> sum(Channels channels, unsigned threads) const {
        return sumRows(scene_, view_, channels, 0, opaque_, threads);
    }

    timeseries::SortedStep step_ = tests::noise(tests::cube(40));
    Lattice lattice_{step_.grid()};
    Scene scene_{
        .step = step_,
        .lattice = lattice_,
        .layers = {{step_.select(RangeSet::parse("0.1:0.4,0.5:0.9")), {ByValue{{}, 0, 1}, 0.2}}},
        .footprint = {},
        .order = Order::None,
        .clip = {}};
    View view_ = tests::lookFrom({1, -3, 0.5}, {211, 157});
    std::vector<float> opaque_ = std::vector<float>(211 * 157, 1.0f);
};

TEST_F(RowSplatter, NotABitDependsOnTheThreads) {
    for (const Channels channels : {Channels::Weight, Channels::WeightedColor}) {
        const auto alone = sum(channels, 1);
        for (const unsigned threads : {0u, 2u, 3u, 16u})
            EXPECT_EQ(sum(channels, threads), alone) << threads;
    }
}

TEST_F(RowSplatter, NotABitDependsOnTheCalls) {
    for (const std::uint32_t stride : {1u, 8u}) {
        scene_.stride = stride;
        const std::uint64_t all = splatCount(scene_.layers[0], stride);
        const auto whole = sum(Channels::Weight, 2);
        for (const std::uint64_t splats : {std::uint64_t{1}, all / 2}) {
            RowSum parts(scene_, view_, Channels::Weight, 0, opaque_);
            std::uint64_t added = 0;
            int calls = 0;
            for (; !parts.done(); ++calls) added += parts.add(splats);
            EXPECT_EQ(added, all);
            EXPECT_EQ(parts.plane(), whole) << splats << " at a time";
            EXPECT_GE(calls, all > 2 * RowSum::kLeast ? 2 : 1);
        }
    }
}

TEST_F(RowSplatter, WhatIsOpaqueHidesPixelByPixel) {
    // Walls of every depth among the points, and none.
    const double nearest = windowDepth(view_, 2), farthest = windowDepth(view_, 5);
    for (std::size_t i = 0; i < opaque_.size(); ++i)
        opaque_[i] = static_cast<float>(nearest + (farthest - nearest) *
                                                      static_cast<double>(i * 37 % 101) / 100);
    Accumulator<double> truth(view_.size, {Channels::WeightedColor});
    splat(scene_, Runs{}, view_, opaque_, truth);
    // A point within float rounding of its wall may stand before or behind it.
    EXPECT_LE(compareScalars(sum(Channels::WeightedColor, 2), truth.planes[0]).relativeL2, 1e-4);
    Accumulator<double> unhidden(view_.size, {Channels::WeightedColor});
    splat(scene_, Runs{}, view_, {}, unhidden);
    EXPECT_GT(compareScalars(truth.planes[0], unhidden.planes[0]).relativeL2, 0.1)
        << "or nothing was hidden";
}

}  // namespace
}  // namespace render
