// A picture in order of which some layers are drawn by cells and others by points, summed on the
// processor: both in one list, the nearest first, by the kernels that draw each alone.
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

// As CellSum (render/splat/cell_splatter.h) and TileSum for Channels::Over: not a bit depends on
// calls or threads. Cells are passed in their exact order. A point lies between the eight cells
// about it: it is passed before the farthest of them, and so after the nearest; its splat, which
// reaches beyond these, is in order as its middle is. Of a mesh, both by their distance. Where a
// pixel is the mean of several rays for cells, it is for points, too.
class MixedSum {
 public:
    MixedSum(const Scene& scene, const View& view, std::span<const float> opaqueDepth,
             int raysAcross = 1, unsigned threads = sharingThreads(), PlanePixels memory = {});
    MixedSum(MixedSum&&) noexcept;
    ~MixedSum();

    // So many, or what is left; returns how many. First they are listed and put in order, of which
    // some count as one.
    std::uint64_t add(std::uint64_t cellsAndPoints);
    bool done() const;
    const PixelBox& box() const;
    PlanePixels& plane();
    PlanePixels takeMemory();  // the last thing asked for

 private:
    struct Work;
    std::unique_ptr<Work> work_;
};

}  // namespace render
