// The order in which a block of points is drawn. Pure.
#pragma once

#include <bit>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "timeseries/grid/mesh.h"

namespace render {

// Of points whose grid indices are given in order of value, the first one's position in the step a
// multiple of kSubsetPeriod: the subset of the largest prefixStride first, then what each smaller
// one adds to it. Inside each of these levels neighbours are near: by cells of the points' box,
// 32 along each axis, along Morton's curve; in a cell as given. [i] is a position in `gridIndex`.
// `size` is the grid's, in points. REQUIRES: at most kSubsetPeriod points.
std::vector<std::uint16_t> blockOrder(std::span<const std::uint32_t> gridIndex, glm::uvec3 size);
// The same of a mesh's points, whose places say what is near.
std::vector<std::uint16_t> blockOrder(std::span<const std::uint32_t> gridIndex,
                                      const timeseries::Mesh& mesh);

// The largest power of four up to `stride`: its subset, which holds that of `stride`, is a block's
// beginning. A level for every power of two would make drawing all points slower by a tenth: the
// points of a level are farther apart (tests/bench/NOTES.md).
constexpr std::uint32_t prefixStride(std::uint32_t stride) {
    return std::countr_zero(stride) % 2 == 0 ? stride : stride / 2;
}

}  // namespace render
