// What sums of planes by tiles do whatever the scene; that they are the truth, for every kind of
// scene, is tested beside the GL splatter (tests/gl/splat_test.cpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <span>

#include "render/reference/cpu_splatter.h"
#include "render/reference/image_compare.h"
#include "render/splat/depth_order.h"
#include "render/splat/tile_splatter.h"
#include "tests/support/noise_plane.h"

namespace render {
namespace {

constexpr std::array kChannels{Channels::Weight, Channels::WeightedColor, Channels::Over,
                               Channels::Count};

class PlaneSummed : public tests::NoisePlane {
 protected:
    // Of the scene as it is now.
    void makeList() {
        scene_.order = Order::BackToFront;
        list_ = order(scene_, pixelRays(view_).eye);
    }
    void SetUp() override { makeList(); }
    std::vector<float> sum(Channels channels, unsigned threads) const {
        return sumTiles(scene_, list_, view_, channels, 0, opaque_, threads);
    }
    TileSum begin(Channels channels) const { return {scene_, list_, view_, channels, 0, opaque_}; }
    std::vector<double> truth(Channels channels, std::span<const float> opaque) const {
        Accumulator<double> sums(view_.size, {channels});
        splat(scene_, list_, view_, opaque, sums);
        return sums.planes[0];
    }
    DrawList list_;
};

TEST_F(PlaneSummed, NotABitDependsOnTheThreads) {
    for (const Channels channels : kChannels) {
        const auto alone = sum(channels, 1);
        for (const unsigned threads : {0u, 2u, 3u, 16u})
            EXPECT_EQ(sum(channels, threads), alone) << threads;
    }
}

TEST_F(PlaneSummed, NotABitDependsOnTheCalls) {
    for (const std::uint32_t stride : {1u, 8u}) {
        scene_.stride = stride;
        makeList();
        const std::uint64_t all = splatCount(scene_.layers[0], stride);
        for (const Channels channels : kChannels) {
            auto atOnce = begin(channels);
            atOnce.add(all);
            const std::vector<float> whole(atOnce.plane().begin(), atOnce.plane().end());
            for (const std::uint64_t splats : {std::uint64_t{1}, all / 2}) {
                auto parts = begin(channels);
                std::uint64_t added = 0;
                int calls = 0;
                for (; !parts.done(); ++calls) added += parts.add(splats);
                EXPECT_EQ(added, all);
                EXPECT_TRUE(std::ranges::equal(parts.plane(), whole)) << splats << " at a time";
                EXPECT_GE(calls, all > 2 * TileSum::kLeast ? 2 : 1);
            }
        }
    }
}

TEST_F(PlaneSummed, WhatIsOpaqueHidesPixelByPixel) {
    // Walls of every depth among the points, and none.
    const double nearest = windowDepth(view_, 2), farthest = windowDepth(view_, 5);
    for (std::size_t i = 0; i < opaque_.size(); ++i)
        opaque_[i] = static_cast<float>(nearest + (farthest - nearest) *
                                                      static_cast<double>(i * 37 % 101) / 100);
    for (const Channels channels : kChannels) {
        const auto wanted = truth(channels, opaque_);
        // A point within float rounding of its wall may stand before or behind it.
        const double most = channels == Channels::Count ? 1e-3 : 1e-4;
        EXPECT_LE(compareScalars(sum(channels, 2), wanted).relativeL2, most);
        EXPECT_GT(compareScalars(wanted, truth(channels, {})).relativeL2, 0.1)
            << "or nothing was hidden";
    }
}

// Whichever vector of pixels, or rest of one, it lies in.
TEST_F(PlaneSummed, AColumnThatIsHiddenIsAllThatIsHidden) {
    const auto width = static_cast<std::size_t>(view_.size.x);
    const auto open = sum(Channels::Weight, 2);
    for (std::size_t hidden = 0; hidden < width; hidden += hidden < width - 20 ? 7 : 1) {
        auto expected = open;
        for (std::size_t i = hidden; i < expected.size(); i += width) expected[i] = opaque_[i] = 0;
        EXPECT_EQ(sum(Channels::Weight, 2), expected) << hidden;
        std::ranges::fill(opaque_, 1.0f);
    }
}

TEST_F(PlaneSummed, WhereThereIsNothingOpaqueItNeedNotBeSaid) {
    std::ranges::fill(opaque_, 1.0f);
    const auto said = sum(Channels::WeightedColor, 2);
    opaque_.clear();
    EXPECT_EQ(sum(Channels::WeightedColor, 2), said);
    EXPECT_GT(*std::ranges::max_element(said), 0);
}

// All layers, each with its own style, in one plane.
TEST_F(PlaneSummed, LayersAreLaidOverEachOtherInOrderOfDepth) {
    for (const char* range : {"0.4:0.5", "0.95:1"})
        scene_.layers.push_back(
            {step_.select(timeseries::RangeSet::parse(range)),
             {Constant{glm::dvec3(0.1, 0.2, range[2] == '4' ? 0.9 : 0.3)}, 0.7}});
    makeList();
    const auto wanted = truth(Channels::Over, {});
    EXPECT_LE(compareScalars(sum(Channels::Over, 2), wanted).relativeL2, 1e-4);
    scene_.layers.resize(1);
    makeList();
    EXPECT_GT(compareScalars(wanted, truth(Channels::Over, {})).relativeL2, 0.1);
}

}  // namespace
}  // namespace render
