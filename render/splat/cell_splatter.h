// Interval volumes summed on the processor cell by cell, tile by tile, in float: the model of
// render/model/cell_splat.h.
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

// What planes are made in, to be used again. One that was moved from is like a new one.
class CellMemory {
 public:
    CellMemory();
    CellMemory(CellMemory&&) noexcept;
    CellMemory& operator=(CellMemory&&) noexcept;
    ~CellMemory();

 private:
    friend class CellSum;
    struct Seen;
    struct Kept;
    std::unique_ptr<Kept> kept;
};

// As TileSum (render/splat/tile_splatter.h): what one plane of a scene that is drawn by cells adds
// up to in a view; not a bit depends on calls or threads. Over takes cells in their exact order,
// the nearest first. What lies behind `opaqueDepth` is left out of each ray. A pixel shows the mean
// of so many rays across it, and as many above each other (render/model/rays_across.h).
class CellSum {
 public:
    CellSum(const Scene& scene, const View& view, Channels channels, std::size_t layer,
            std::span<const float> opaqueDepth, int raysAcross = 1,
            unsigned threads = sharingThreads(), CellMemory memory = {});
    CellSum(CellSum&&) noexcept;
    ~CellSum();

    // So many, or what is left, or of a mesh, whose cells do not cost alike, fewer; returns how
    // many. First they are listed and put in order, of which some count as one, so that this, too,
    // may be done in slices.
    std::uint64_t add(std::uint64_t cells);
    bool done() const;
    const PixelBox& box() const;
    PlanePixels& plane();
    CellMemory takeMemory();  // the last thing asked for

 private:
    struct Work;
    std::unique_ptr<Work> work_;
};

}  // namespace render
