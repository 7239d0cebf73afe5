#include "render/splat/tile_chains.h"

#include <algorithm>

namespace render {

void TileChains::clear(std::size_t tiles, std::size_t most) {
    pages_.resize(std::min(pages_.size(), most / (kPage * kWords) + 1));
    used_ = 0;
    first_.resize(tiles);
    last_.resize(tiles);
    end_.assign(tiles, nullptr);
}

std::uint32_t* TileChains::moreFor(std::uint32_t tile) {
    if (used_ == pages_.size() * kPage) {
        pages_.emplace_back(kPage);
        next_.resize(pages_.size() * kPage);
    }
    const auto block = static_cast<std::uint32_t>(used_++);
    (end_[tile] ? next_[last_[tile]] : first_[tile]) = block;
    last_[tile] = block;
    return at(block).words.data();
}

void TileChains::append(std::size_t tile, std::vector<std::uint32_t>& words) const {
    if (!holds(tile)) return;
    std::uint32_t block = first_[tile];
    for (; block != last_[tile]; block = next_[block])
        words.insert(words.end(), at(block).words.begin(), at(block).words.end());
    words.insert(words.end(), static_cast<const std::uint32_t*>(at(block).words.data()),
                 static_cast<const std::uint32_t*>(end_[tile]));
}

}  // namespace render
