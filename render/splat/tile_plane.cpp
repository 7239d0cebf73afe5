#include "render/splat/tile_plane.h"

#include <algorithm>
#include <utility>

namespace render {
namespace {

// Sums channel by channel, `plane` floats apart, times a pixel's factor if there are any, into
// pixels.
template <std::size_t kFloats>
void storeRow(const float* sums, std::size_t plane, const float* factor, std::size_t width,
              float* to) {
    for (std::size_t x = 0; x < width; ++x)
        for (std::size_t c = 0; c < kFloats; ++c)
            to[kFloats * x + c] = factor ? factor[x] * sums[c * plane + x] : sums[c * plane + x];
}

}  // namespace

TilePlane::TilePlane(const TileLayout& layout, std::span<const float> opaqueDepth, int pictureWidth,
                     unsigned threads, std::vector<float>& plane)
    : layout_(layout),
      opaqueDepth_(opaqueDepth),
      pictureWidth_(pictureWidth),
      plane_(plane),
      floats_(floatsPerPixel(layout.channels)),
      rooms_(threads, TileRoom(layout)),
      begun_(layout.count()) {
    plane_.resize(static_cast<std::size_t>(layout.box.size.x) *
                  static_cast<std::size_t>(layout.box.size.y) * floats_);
}

// The pixels of one of a tile's rows.
float* TilePlane::rowOf(glm::ivec2 tileAt, int row) {
    return &plane_[(static_cast<std::size_t>(tileAt.y + row) *
                        static_cast<std::size_t>(layout_.box.size.x) +
                    static_cast<std::size_t>(tileAt.x)) *
                   floats_];
}

void TilePlane::clear(std::size_t tile) {
    const glm::ivec2 at = cornerOf(layout_, tile);
    const glm::ivec2 size = glm::min(layout_.tile, layout_.box.size - at);
    for (int row = 0; row < size.y; ++row)
        std::fill_n(rowOf(at, row), static_cast<std::size_t>(size.x) * floats_, 0.0f);
}

// Into sums channel by channel; of a tile that nothing has touched yet, none.
void TilePlane::load(std::size_t tile, TileRoom& room) {
    room.enter(layout_, tile, opaqueDepth_, pictureWidth_);
    if (!std::exchange(begun_[tile], 1)) {
        std::ranges::fill(room.sums, 0.0f);
        return;
    }
    for (int row = 0; row < room.size.y; ++row) {
        const float* from = rowOf(room.at, row);
        for (int x = 0; x < room.size.x; ++x)
            for (std::size_t c = 0; c < floats_; ++c)
                room.sums[c * room.plane + static_cast<std::size_t>(row * kTileStride + x)] =
                    *from++;
    }
}

void TilePlane::store(const TileRoom& room, bool lastOfAll) {
    const bool isPerRay =
        layout_.channels == Channels::Weight || layout_.channels == Channels::WeightedColor;
    const auto width = static_cast<std::size_t>(room.size.x);
    for (int row = 0; row < room.size.y; ++row) {
        const std::size_t at = static_cast<std::size_t>(row) * kTileStride;
        const float* const factor = lastOfAll && isPerRay ? room.factor.data() + at : nullptr;
        const float* const sums = room.sums.data() + at;
        if (floats_ == 1)
            storeRow<1>(sums, room.plane, factor, width, rowOf(room.at, row));
        else
            storeRow<4>(sums, room.plane, factor, width, rowOf(room.at, row));
    }
}

}  // namespace render
