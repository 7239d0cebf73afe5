#include "render/splat/pieces.h"
#include "render/splat/depth_order.h"

#include <gtest/gtest.h>

#include <numeric>

#include "render/points/block_order.h"
#include "tests/support/scenes.h"

namespace render {
namespace {

// 80,000 points: two whole blocks of 2^15 and a part of a third.
class Pieces : public testing::Test {
 protected:
    Pieces() {
        const auto grid = std::make_shared<timeseries::Grid>(
            std::array{tests::axis(100), tests::axis(100), tests::axis(8)});
        step_.emplace(tests::noise(grid));
        placed_.emplace(step_->grid());
    }
    Scene scene(std::vector<std::vector<timeseries::Run>> layers) const {
        Scene scene{.step = *step_,
                    .placed = *placed_,
                    .layers = {},
                    .footprint = {},
                    .order = Order::None,
                    .clip = {}};
        for (auto& runs : layers) scene.layers.push_back({std::move(runs), {Constant{}, 0.5}});
        return scene;
    }
    static constexpr std::uint64_t kBlock = kSubsetPeriod;
    std::optional<timeseries::SortedStep> step_;
    std::optional<PlacedPoints> placed_;
};

std::uint64_t costOf(const std::vector<Piece>& pieces) {
    return std::accumulate(pieces.begin(), pieces.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const Piece& p) { return sum + p.cost; });
}

TEST_F(Pieces, SendTheBeginningsOfAllBlocksThatARunTouchesOnceInOrder) {
    std::mt19937 random(3);
    for (int i = 0; i < 50; ++i) {
        const timeseries::Run run{random() % 70'000, 1 + random() % 10'000};
        Scene of = scene({{run}});
        of.stride = 1u << (random() % 6);
        const std::uint32_t stride = strideOf(of.layers[0], of.stride);
        std::vector<std::uint64_t> sent, expected;
        for (const Piece& piece : piecesOfRuns(of)) {
            EXPECT_GT(piece.count, 0u);
            EXPECT_LE(piece.count, kPiecePoints);
            const std::uint64_t block = piece.first / kBlock * kBlock;
            EXPECT_EQ(block + piece.from, std::max(run.first, block));
            EXPECT_EQ(block + piece.last + 1,
                      std::min({run.first + run.count, block + kBlock, step_->size()}));
            EXPECT_EQ(piece.stride, stride);
            for (std::uint64_t k = 0; k < piece.count; ++k) sent.push_back(piece.first + k);
        }
        // The subset that holds the one to be drawn lies first in each block.
        for (std::uint64_t b = 0; b < step_->size(); b += kBlock) {
            const std::uint64_t end = std::min(b + kBlock, step_->size());
            if (end <= run.first || b >= run.first + run.count) continue;
            std::uint64_t first = 0;
            for (std::uint64_t p = b; p < end; ++p)
                first += inSubset(p, prefixStride(stride)) ? 1 : 0;
            for (std::uint64_t k = 0; k < first; ++k) expected.push_back(b + k);
        }
        EXPECT_EQ(sent, expected) << run.first << '+' << run.count << " by " << stride;
    }
}

TEST_F(Pieces, CostTheSplatsAndALittleForPointsPassedOver) {
    const std::uint64_t all = step_->size();
    EXPECT_EQ(costOf(piecesOfRuns(scene({{{0, all}}}))), all);
    // Ten points in the middle of a block.
    const std::uint64_t thin = costOf(piecesOfRuns(scene({{{kBlock + 500, 10}}})));
    EXPECT_GT(thin, 10u);
    EXPECT_LT(thin, kBlock / 20);
    // Each piece's cost is rounded up.
    const auto half = piecesOfRuns(scene({{{kBlock / 2, kBlock}}}));
    EXPECT_NEAR(static_cast<double>(costOf(half)), kBlock, static_cast<double>(half.size()));
}

TEST_F(Pieces, OfLayersFollowEachOther) {
    const auto pieces = piecesOfRuns(scene({{{0, 10}, {40'000, 10}}, {}, {{5, 10}}}));
    std::vector<std::size_t> layers;
    for (const Piece& piece : pieces) layers.push_back(piece.layer);
    EXPECT_TRUE(std::ranges::is_sorted(layers));
    EXPECT_EQ(std::ranges::count(layers, 0u), 2 * kBlock / kPiecePoints);
    EXPECT_EQ(std::ranges::count(layers, 1u), 0);
    EXPECT_EQ(std::ranges::count(layers, 2u), kBlock / kPiecePoints);
}

TEST_F(Pieces, OfASortedListAreItsEntries) {
    const auto pieces = piecesOfSorted(20'000);
    std::uint64_t next = 0;
    for (const Piece& piece : pieces) {
        EXPECT_EQ(piece.first, next);
        EXPECT_LE(piece.count, kPiecePoints);
        EXPECT_EQ(piece.from, 0u);  // places of all of them
        EXPECT_EQ(piece.last, 0u);
        EXPECT_EQ(piece.stride, 1u);
        EXPECT_EQ(piece.cost, piece.count);
        next += piece.count;
    }
    EXPECT_EQ(next, 20'000u);
    EXPECT_TRUE(piecesOfSorted(0).empty());
}

}  // namespace
}  // namespace render
