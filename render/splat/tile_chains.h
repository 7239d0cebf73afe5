// What touches each tile of a picture, as it comes: entries of one or a few words, in chains of
// blocks that are full lines of the cache, so that nothing need be counted before. One a thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "timeseries/grid/pages.h"

namespace render {

class TileChains {
 public:
    // Nothing, of so many tiles. Memory is kept, but for what is more than `most` words.
    void clear(std::size_t tiles, std::size_t most);
    // All entries between two clear() have as many words, a power of two.
    template <std::size_t kEntry>
    void put(std::uint32_t tile, const std::array<std::uint32_t, kEntry>& entry) {
        static_assert(kWords % kEntry == 0);
        std::uint32_t* to = end_[tile];
        // A block's end is a block's beginning, or nothing yet.
        if (reinterpret_cast<std::uintptr_t>(to) % sizeof(Block) == 0) [[unlikely]]
            to = moreFor(tile);
        std::memcpy(to, entry.data(), sizeof entry);
        end_[tile] = to + kEntry;
    }
    bool holds(std::size_t tile) const { return end_[tile] != nullptr; }
    // Those of a tile, in the order in which they came.
    void append(std::size_t tile, std::vector<std::uint32_t>& words) const;

 private:
    static constexpr std::size_t kWords = 128;
    struct alignas(kWords * sizeof(std::uint32_t)) Block {
        std::array<std::uint32_t, kWords> words;
    };
    std::uint32_t* moreFor(std::uint32_t tile);
    Block& at(std::size_t block) const { return pages_[block / kPage].data()[block % kPage]; }

    static constexpr std::size_t kPage = 1 << 14;  // blocks: 8 MB, so in large pages
    std::vector<timeseries::Pages<Block>> pages_;
    std::size_t used_ = 0;                     // blocks
    std::vector<std::uint32_t> next_;          // the block after each
    std::vector<std::uint32_t> first_, last_;  // blocks of each tile that holds anything
    std::vector<std::uint32_t*> end_;          // where its next entry goes
};

}  // namespace render
