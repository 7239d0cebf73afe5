// The order in which a block of points is drawn. Pure.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace render {

// Of points whose grid indices are given in order of value, the first one's position in the step a
// multiple of kSubsetPeriod: the subset of the largest stride first, then what each smaller stride
// adds to it, so that every subset is drawn as the block's beginning. Inside each of these levels
// neighbours are near: by cells of the lattice's box, 32 along each axis, along Morton's curve; in
// a cell as given. [i] is a position in `gridIndex`. `size` is the lattice's, in points. REQUIRES:
// at most kSubsetPeriod points.
std::vector<std::uint16_t> blockOrder(std::span<const std::uint32_t> gridIndex, glm::uvec3 size);

}  // namespace render
