// What rows and tiles have in common; that they sum the truth, for every kind of scene, is tested
// beside the GL splatter (tests/gl/splat_test.cpp).
#include <gtest/gtest.h>

#include <algorithm>

#include "render/cpu_splatter.h"
#include "render/image_compare.h"
#include "render/row_splatter.h"
#include "render/tile_splatter.h"
#include "tests/support/noise_plane.h"

namespace render {
namespace {

struct Rows {
    static std::vector<float> sum(const Scene& scene, const View& view, Channels channels,
                                  std::span<const float> opaque, unsigned threads) {
        return sumRows(scene, view, channels, 0, opaque, threads);
    }
    static RowSum begin(const Scene& scene, const View& view, Channels channels,
                        std::span<const float> opaque) {
        return {scene, view, channels, 0, opaque};
    }
};
struct Tiles {
    static inline const DrawList kRuns = Runs{};
    static std::vector<float> sum(const Scene& scene, const View& view, Channels channels,
                                  std::span<const float> opaque, unsigned threads) {
        return sumTiles(scene, kRuns, view, channels, 0, opaque, threads);
    }
    static TileSum begin(const Scene& scene, const View& view, Channels channels,
                         std::span<const float> opaque) {
        return {scene, kRuns, view, channels, 0, opaque};
    }
};

template <typename By>
class PlaneSummed : public tests::NoisePlane {
 protected:
    std::vector<float> sum(Channels channels, unsigned threads) const {
        return By::sum(scene_, view_, channels, opaque_, threads);
    }
    auto begin(Channels channels) const { return By::begin(scene_, view_, channels, opaque_); }
};
using Ways = testing::Types<Rows, Tiles>;
TYPED_TEST_SUITE(PlaneSummed, Ways);

TYPED_TEST(PlaneSummed, NotABitDependsOnTheThreads) {
    for (const Channels channels : {Channels::Weight, Channels::WeightedColor}) {
        const auto alone = this->sum(channels, 1);
        for (const unsigned threads : {0u, 2u, 3u, 16u})
            EXPECT_EQ(this->sum(channels, threads), alone) << threads;
    }
}

TYPED_TEST(PlaneSummed, NotABitDependsOnTheCalls) {
    for (const std::uint32_t stride : {1u, 8u}) {
        this->scene_.stride = stride;
        const std::uint64_t all = splatCount(this->scene_.layers[0], stride);
        auto atOnce = this->begin(Channels::Weight);
        atOnce.add(all);
        const std::vector<float> whole(atOnce.plane().begin(), atOnce.plane().end());
        for (const std::uint64_t splats : {std::uint64_t{1}, all / 2}) {
            auto parts = this->begin(Channels::Weight);
            std::uint64_t added = 0;
            int calls = 0;
            for (; !parts.done(); ++calls) added += parts.add(splats);
            EXPECT_EQ(added, all);
            EXPECT_TRUE(std::ranges::equal(parts.plane(), whole)) << splats << " at a time";
            EXPECT_GE(calls, all > 2 * decltype(parts)::kLeast ? 2 : 1);
        }
    }
}

TYPED_TEST(PlaneSummed, WhatIsOpaqueHidesPixelByPixel) {
    // Walls of every depth among the points, and none.
    const double nearest = windowDepth(this->view_, 2), farthest = windowDepth(this->view_, 5);
    for (std::size_t i = 0; i < this->opaque_.size(); ++i)
        this->opaque_[i] = static_cast<float>(
            nearest + (farthest - nearest) * static_cast<double>(i * 37 % 101) / 100);
    Accumulator<double> truth(this->view_.size, {Channels::WeightedColor});
    splat(this->scene_, Runs{}, this->view_, this->opaque_, truth);
    // A point within float rounding of its wall may stand before or behind it.
    EXPECT_LE(compareScalars(this->sum(Channels::WeightedColor, 2), truth.planes[0]).relativeL2,
              1e-4);
    Accumulator<double> unhidden(this->view_.size, {Channels::WeightedColor});
    splat(this->scene_, Runs{}, this->view_, {}, unhidden);
    EXPECT_GT(compareScalars(truth.planes[0], unhidden.planes[0]).relativeL2, 0.1)
        << "or nothing was hidden";
}

TYPED_TEST(PlaneSummed, WhereThereIsNothingOpaqueItNeedNotBeSaid) {
    std::ranges::fill(this->opaque_, 1.0f);
    const auto said = this->sum(Channels::WeightedColor, 2);
    this->opaque_.clear();
    EXPECT_EQ(this->sum(Channels::WeightedColor, 2), said);
    EXPECT_GT(*std::ranges::max_element(said), 0);
}

}  // namespace
}  // namespace render
