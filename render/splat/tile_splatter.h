// The splatter on the processor: splats are sorted into tiles of the picture, and a tile is summed
// by one thread while it lies in the first-level cache. The model is that of
// render/model/footprint.h.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "render/model/covered.h"
#include "render/model/scene.h"
#include "render/points/view.h"
#include "render/splat/plane_pixels.h"
#include "render/together.h"

namespace render {

// What planes are made in, to be used again: pages that are new cost much. One that was moved from
// is like a new one.
class TileMemory {
 public:
    TileMemory();
    TileMemory(TileMemory&&) noexcept;
    TileMemory& operator=(TileMemory&&) noexcept;
    ~TileMemory();

 private:
    friend class TileSum;
    struct Kept;
    std::unique_ptr<Kept> kept;
};

// What one plane of a scene adds up to in a view, over as many calls as one likes: not a bit
// depends on their number, nor on that of the threads.
class TileSum {
 public:
    static constexpr std::uint64_t kPairs = 1 << 23;
    // Sorted into tiles at once: more would not make it faster.
    static constexpr std::uint64_t kAtOnce = 1 << 20;
    // So many each tile puts in order by itself, where that is asked for (SortWhenDrawn); of more a
    // list is made before.
    static constexpr std::uint64_t kOrderedAtOnce = 1 << 21;
    // `opaqueDepth` is the depth [0, 1] of the opaque scene, a pixel each, row 0 at the bottom, or
    // empty: a splat whose centre lies behind it is not drawn there. `layer` is the plane's, where
    // it has one; `list` is the scene's. All of them must outlive this. `memory` is what a plane
    // before was made of, if any: pages that are new cost much.
    TileSum(const Scene& scene, const DrawList& list, const View& view, Channels channels,
            std::size_t layer, std::span<const float> opaqueDepth,
            unsigned threads = sharingThreads(), TileMemory memory = {},
            std::uint64_t pairsAtOnce = kPairs);
    TileSum(TileSum&&) noexcept;
    ~TileSum();

    // Adds that many splats, or kLeast if that is more, or what is left, give or take the
    // unevenness of a subset (render/points/subset.h); all of SortWhenDrawn. Returns how many.
    std::uint64_t add(std::uint64_t splats);
    static constexpr std::uint64_t kLeast = 1 << 10;
    bool done() const;
    // The part of the picture that is summed, and, when done, what it sums to: [y][x][1 or 4], row
    // 0 at the bottom. Beside it there is nothing.
    const PixelBox& box() const;
    PlanePixels& plane();
    TileMemory takeMemory();  // the last thing asked for

 private:
    struct Work;
    std::unique_ptr<Work> work_;
};

// All of it at once, for the whole picture.
std::vector<float> sumTiles(const Scene& scene, const DrawList& list, const View& view,
                            Channels channels, std::size_t layer,
                            std::span<const float> opaqueDepth,
                            unsigned threads = sharingThreads());

}  // namespace render
