// Splats summed on the processor, a row of pixels after another, in float: what tiles
// (render/splat/tile_splatter.h) do not know, splats of long cells and counts. The model of
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

// What one plane of a scene adds up to in a view, over as many calls as one likes: not a bit
// depends on their number, nor on that of the threads.
class RowSum {
 public:
    // `opaqueDepth` is the depth [0, 1] of the opaque scene, a pixel each, row 0 at the bottom, or
    // empty: a splat whose centre lies behind it is not drawn there. `layer` is the plane's, where
    // it has one; `list` is the scene's. All of them must outlive this.
    // `memory` is what a plane before was made of, if any: pages that are new cost much.
    RowSum(const Scene& scene, const DrawList& list, const View& view, Channels channels,
           std::size_t layer, std::span<const float> opaqueDepth,
           unsigned threads = sharingThreads(), PlanePixels memory = {});
    RowSum(RowSum&&) noexcept;
    ~RowSum();

    // Adds that many splats, or kLeast if that is more, or what is left, give or take the
    // unevenness of a subset (render/points/subset.h). Returns how many.
    std::uint64_t add(std::uint64_t splats);
    static constexpr std::uint64_t kLeast = 1 << 10;
    bool done() const;
    // The part of the picture that is summed, and what it sums to: [y][x][1 or 4], row 0 at the
    // bottom. Beside it there is nothing.
    const PixelBox& box() const;
    PlanePixels& plane();
    PlanePixels takeMemory();  // the last thing asked for

 private:
    struct Work;
    std::unique_ptr<Work> work_;
};

// All of it at once, for the whole picture.
std::vector<float> sumRows(const Scene& scene, const DrawList& list, const View& view,
                           Channels channels, std::size_t layer, std::span<const float> opaqueDepth,
                           unsigned threads = sharingThreads());

}  // namespace render
