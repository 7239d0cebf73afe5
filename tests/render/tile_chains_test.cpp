#include "render/splat/tile_chains.h"

#include <gtest/gtest.h>

#include <random>

namespace render {
namespace {

// Each tile has what was put there, in that order, across any number of blocks, and nothing of what
// was there before.
template <std::size_t kEntry>
void expectWhatWasPut(TileChains& chains, std::size_t tiles, std::size_t entries) {
    std::mt19937 random(static_cast<unsigned>(entries));
    std::vector<std::vector<std::uint32_t>> expected(tiles);
    chains.clear(tiles, 0);
    for (std::size_t i = 0; i < entries; ++i) {
        // The last tile stays empty.
        const auto tile = static_cast<std::uint32_t>(random() % (tiles - 1));
        std::array<std::uint32_t, kEntry> entry;
        for (std::uint32_t& word : entry) word = static_cast<std::uint32_t>(random());
        chains.put(tile, entry);
        expected[tile].insert(expected[tile].end(), entry.begin(), entry.end());
    }
    for (std::size_t tile = 0; tile < tiles; ++tile) {
        std::vector<std::uint32_t> words{7};
        chains.append(tile, words);
        EXPECT_EQ(chains.holds(tile), !expected[tile].empty());
        EXPECT_EQ(words.front(), 7u);
        words.erase(words.begin());
        EXPECT_EQ(words, expected[tile]) << tile;
    }
}

TEST(TileChains, HoldWhatWasPutInItsOrder) {
    TileChains chains;
    expectWhatWasPut<1>(chains, 5, 100'000);
    expectWhatWasPut<2>(chains, 300, 100'000);
    expectWhatWasPut<4>(chains, 3, 400'000);  // more than a page
    expectWhatWasPut<1>(chains, 2, 128);      // a whole block
    expectWhatWasPut<1>(chains, 2, 129);
    expectWhatWasPut<4>(chains, 9, 0);
}

}  // namespace
}  // namespace render
