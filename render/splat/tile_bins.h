// Which tiles of a picture what is drawn touches, and what touches each tile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace render {

// The tiles that a splat or cell may touch: from this one on so many columns and rows; none when it
// is not drawn.
struct TileSpan {
    std::uint32_t first;
    std::uint16_t columns, rows;
};
template <typename Visit>
void forEachTile(const TileSpan& span, int across, const Visit& visit) {
    std::uint32_t tile = span.first;
    for (unsigned row = 0; row < span.rows; ++row, tile += static_cast<std::uint32_t>(across))
        for (unsigned column = 0; column < span.columns; ++column) visit(tile + column);
}

// The places that belong to each tile, one behind another in the order of the tiles. One a thread.
class TileBins {
 public:
    // Of what has the spans [first, last), in their order: resize(n) makes n places, and
    // put(to, i) puts what has span i there, for every tile that it touches.
    template <typename Resize, typename Put>
    void fill(std::size_t tiles, int across, std::span<const TileSpan> spans, std::size_t first,
              std::size_t last, const Resize& resize, const Put& put) {
        end_.assign(tiles + 1, 0);
        for (std::size_t i = first; i < last; ++i)
            forEachTile(spans[i], across, [&](std::uint32_t tile) { ++end_[tile + 1]; });
        std::partial_sum(end_.begin(), end_.end(), end_.begin());
        resize(std::size_t{end_.back()});
        // From each tile's beginning on; its end is then the beginning of the next.
        for (std::size_t i = first; i < last; ++i)
            forEachTile(spans[i], across, [&](std::uint32_t tile) { put(end_[tile]++, i); });
    }
    std::uint32_t first(std::size_t tile) const { return tile > 0 ? end_[tile - 1] : 0; }
    std::uint32_t count(std::size_t tile) const { return end_[tile] - first(tile); }

 private:
    std::vector<std::uint32_t> end_;
};

}  // namespace render
