// Splats of a mesh as a view sees them, each worked out once for all tiles that it touches: their
// cells come from neighbours' places, anywhere in memory.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "render/model/footprint.h"
#include "render/model/scene.h"
#include "render/splat/tile_layout.h"

namespace render {

// The forms are those of Splat in render/model/footprint.h. Floats and ints alone, which kernels
// take one field of many at once.
struct SeenSplat {
    // The pixel that the centre lies in, from the corner of the layout's box, and where in it.
    std::array<std::int32_t, 2> pixel;
    std::array<float, 2> within;
    std::array<float, 2> lo, hi;  // offsets between which the footprint lies; none: not drawn
    std::array<float, 3> n, d;
    std::array<float, 2> l;
    float weight, depth;  // depth in the depth buffer
    bool isDrawn() const { return lo[0] < hi[0]; }
};

// Those of the points of these grid indices, whose W is multiplied by `factor`, as splatAt() has
// them, in double, several at once. REQUIRES: a scene of a mesh, whose splats are no points; as
// many `splats` as indices.
void seeSplats(const Scene& scene, const TileLayout& layout, const PointsView& view, double factor,
               std::span<const std::uint32_t> gridIndex, std::span<SeenSplat> splats);

}  // namespace render
