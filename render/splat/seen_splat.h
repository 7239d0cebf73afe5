// Splats as a view sees them, each worked out once for all tiles that it touches: those of a mesh,
// whose cells come from neighbours' places, anywhere in memory, and those that end at the domain's
// faces.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "render/splat/tile_bins.h"
#include "timeseries/grid/mesh.h"

namespace render {

struct Scene;
struct TileView;

// A line of the caches. The forms are those of Splat in render/model/footprint.h; where splats end
// at the domain's faces, of (x + m y, y), with n = n[0] (x + m y)^2 + n[2] y^2 and m = n[1]: of a
// slim one the other's terms cancel.
struct alignas(64) SeenSplat {
    // The pixel that the centre lies in, from the corner of the layout's box, and where in it.
    std::array<std::int32_t, 2> pixel;
    std::array<float, 2> within;
    std::uint32_t columns, rows;  // [first, last) in the box, below 2^16: first + 2^16 last
    float weight, depth;          // depth in the depth buffer
    std::array<float, 3> n, d;
    std::array<float, 2> l;
};

// As kernels take it, one field of many at once: where each field is.
constexpr std::size_t kSeenFloats = sizeof(SeenSplat) / sizeof(float);
constexpr std::size_t kSeenPixel = offsetof(SeenSplat, pixel) / sizeof(float),
                      kSeenWithin = offsetof(SeenSplat, within) / sizeof(float),
                      kSeenColumns = offsetof(SeenSplat, columns) / sizeof(float),
                      kSeenRows = offsetof(SeenSplat, rows) / sizeof(float),
                      kSeenWeight = offsetof(SeenSplat, weight) / sizeof(float),
                      kSeenDepth = offsetof(SeenSplat, depth) / sizeof(float),
                      kSeenN = offsetof(SeenSplat, n) / sizeof(float),
                      kSeenD = offsetof(SeenSplat, d) / sizeof(float),
                      kSeenL = offsetof(SeenSplat, l) / sizeof(float);
inline const float* floatsOf(const SeenSplat& splat) {
    return reinterpret_cast<const float*>(&splat);
}
inline float* floatsOf(SeenSplat& splat) { return reinterpret_cast<float*>(&splat); }

// What Splat::insideShare() is worked out from; a depth of 0 where the splat ends nowhere.
struct alignas(64) SplatCut {
    std::array<float, 3> c, x, y, loFace, hiFace;
    float depth;
};

// Those of the points of these grid indices, which the mesh keeps so, as splatAt() has them, their
// places in double, several at once; and the tiles that each touches. REQUIRES: a scene of a mesh
// that is not seen one by one (TileView::oneByOne); as many of each as indices.
void seeSplats(const Scene& scene, const TileView& view, std::span<const std::uint32_t> gridIndex,
               std::span<const timeseries::Mesh::Point> points, std::span<SeenSplat> splats,
               std::span<TileSpan> spans);

}  // namespace render
