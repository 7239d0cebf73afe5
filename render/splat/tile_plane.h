// One plane of a picture, summed a tile after another, in as many goes as one likes.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/splat/plane_pixels.h"
#include "render/splat/tile_layout.h"
#include "render/splat/tile_room.h"
#include "render/together.h"

namespace render {

class TilePlane {
 public:
    // `opaqueDepth` is the picture's, a pixel each, or none. `plane` is the result when all is
    // done: [y][x][channel] of the layout's pixels. `rays` is where sums stand between goes: of its
    // box; the same vector where a pixel has one ray. The layout and all of these must outlive
    // this.
    TilePlane(const TileLayout& layout, std::span<const float> opaqueDepth, int pictureWidth,
              unsigned threads, PlanePixels& plane, PlanePixels& rays);

    // Calls add(thread, tile, room) for every tile that holds(tile), on so many threads, a tile on
    // one. The last go of all also writes those that nothing has touched.
    template <typename Holds, typename Add>
    void sum(unsigned threads, bool lastOfAll, const Holds& holds, const Add& add) {
        if (!lastOfAll) rays_.resize(floatsOf(layout_.box));
        std::atomic<std::size_t> next{0};
        together(threads, [&](unsigned k) {
            for (std::size_t tile; (tile = next++) < tiles_.size();) {
                const bool held = holds(tile) && !isClosed(tile);
                if (!held && !lastOfAll) continue;
                if (!held && tiles_[tile] == Tile::Untouched) {
                    clear(tile);
                    continue;
                }
                load(tile, rooms_[k]);
                if (held) add(k, tile, rooms_[k]);
                store(rooms_[k], lastOfAll);
                if (held && layout_.channels == Channels::Over && rooms_[k].isClosed())
                    tiles_[tile] = Tile::Closed;
            }
        });
    }

    // Nothing that comes later is seen anywhere in it.
    bool isClosed(std::size_t tile) const { return tiles_[tile] == Tile::Closed; }

 private:
    enum class Tile : std::uint8_t { Untouched, Begun, Closed };
    std::size_t floatsOf(const PixelBox& box) const;
    void clear(std::size_t tile);
    void load(std::size_t tile, TileRoom& room);
    void store(const TileRoom& room, bool lastOfAll);
    void storeMeans(const TileRoom& room);
    bool isPerRay() const;
    // Of one of a tile's rows, its rays and, of as many rows as a pixel has, its pixels.
    float* raysOf(glm::ivec2 tileAt, int row);
    float* pixelsOf(glm::ivec2 tileAt, int row);

    const TileLayout& layout_;
    std::span<const float> opaqueDepth_;
    int pictureWidth_;
    PlanePixels &plane_, &rays_;
    std::size_t floats_;
    std::vector<TileRoom> rooms_;
    std::vector<Tile> tiles_;
};

}  // namespace render
