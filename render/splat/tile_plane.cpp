#include "render/splat/tile_plane.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace render {
namespace {

// Sums times a pixel's factor if there are any.
void storeRow(const float* sums, const float* factor, std::size_t width, float* to) {
    for (std::size_t x = 0; x < width; ++x) to[x] = factor ? factor[x] * sums[x] : sums[x];
}

}  // namespace

TilePlane::TilePlane(const TileLayout& layout, std::span<const float> opaqueDepth, int pictureWidth,
                     unsigned threads, PlanePixels& plane, PlanePixels& rays)
    : layout_(layout),
      opaqueDepth_(opaqueDepth),
      pictureWidth_(pictureWidth),
      plane_(plane),
      rays_(rays),
      floats_(floatsPerPixel(layout.channels)),
      rooms_(threads, TileRoom(layout)),
      tiles_(layout.count()) {
    plane_.resize(floatsOf(layout.pixels));
}

std::size_t TilePlane::floatsOf(const PixelBox& box) const {
    return static_cast<std::size_t>(box.size.x) * static_cast<std::size_t>(box.size.y) * floats_;
}

float* TilePlane::raysOf(glm::ivec2 tileAt, int row) {
    return &rays_[(static_cast<std::size_t>(tileAt.y + row) *
                       static_cast<std::size_t>(layout_.box.size.x) +
                   static_cast<std::size_t>(tileAt.x)) *
                  floats_];
}

float* TilePlane::pixelsOf(glm::ivec2 tileAt, int row) {
    const glm::ivec2 at = glm::ivec2(tileAt.x, tileAt.y + row) / layout_.raysAcross;
    return &plane_[(static_cast<std::size_t>(at.y) *
                        static_cast<std::size_t>(layout_.pixels.size.x) +
                    static_cast<std::size_t>(at.x)) *
                   floats_];
}

bool TilePlane::isPerRay() const {
    return layout_.channels == Channels::Weight || layout_.channels == Channels::WeightedColor;
}

void TilePlane::clear(std::size_t tile) {
    const glm::ivec2 at = cornerOf(layout_, tile);
    const glm::ivec2 size = glm::min(layout_.tile, layout_.box.size - at);
    const auto pixels = static_cast<std::size_t>(size.x / layout_.raysAcross);
    for (int row = 0; row < size.y; row += layout_.raysAcross)
        std::fill_n(pixelsOf(at, row), pixels * floats_, 0.0f);
}

// Into sums channel by channel; of a tile that nothing has touched yet, none.
void TilePlane::load(std::size_t tile, TileRoom& room) {
    room.enter(layout_, tile, opaqueDepth_, pictureWidth_);
    if (tiles_[tile] == Tile::Untouched) {
        tiles_[tile] = Tile::Begun;
        std::ranges::fill(room.sums, 0.0f);
        return;
    }
    for (int row = 0; row < room.size.y; ++row) {
        const float* from = raysOf(room.at, row);
        for (int x = 0; x < room.size.x; ++x)
            for (std::size_t c = 0; c < floats_; ++c)
                room.sums[c * room.plane + static_cast<std::size_t>(row * kTileStride + x)] =
                    *from++;
    }
}

void TilePlane::store(const TileRoom& room, bool lastOfAll) {
    if (lastOfAll && layout_.raysAcross > 1) return storeMeans(room);
    const auto width = static_cast<std::size_t>(room.size.x);
    for (int row = 0; row < room.size.y; ++row) {
        const std::size_t at = static_cast<std::size_t>(row) * kTileStride;
        const float* const factor = lastOfAll && isPerRay() ? room.factor.data() + at : nullptr;
        const float* const sums = room.sums.data() + at;
        if (floats_ == 1)
            storeRow(sums, factor, width, raysOf(room.at, row));
        else
            interleaveRow(sums, room.plane, factor, width, raysOf(room.at, row));
    }
}

// Of each pixel, of its rays.
void TilePlane::storeMeans(const TileRoom& room) {
    const int rays = layout_.raysAcross;
    const auto width = static_cast<std::size_t>(room.size.x);
    const float share = 1 / static_cast<float>(rays * rays);
    const bool byFactor = isPerRay();
    std::array<float, kTileWidth> columns;
    for (int first = 0; first < room.size.y; first += rays)
        for (std::size_t c = 0; c < floats_; ++c) {
            columns.fill(0);
            for (int row = first; row < first + rays; ++row) {
                const std::size_t at = static_cast<std::size_t>(row) * kTileStride;
                const float* const sums = room.sums.data() + c * room.plane + at;
                const float* const factor = room.factor.data() + at;
                for (std::size_t x = 0; x < width; ++x)
                    columns[x] += byFactor ? factor[x] * sums[x] : sums[x];
            }
            float* to = pixelsOf(room.at, first) + c;
            for (std::size_t x = 0; x < width; x += static_cast<std::size_t>(rays), to += floats_)
                *to = share * std::accumulate(&columns[x], &columns[x] + rays, 0.0f);
        }
}

}  // namespace render
