// A plane of coarse pixels in the pixels of the picture, on the processor: between the middles of
// coarse ones, what lies around them, as shaders/enlarge.frag has it. Sums of optical depth stay
// sums of optical depth. Pure.
#pragma once

#include <cstddef>
#include <span>

#include "render/model/covered.h"
#include "render/splat/memory_targets.h"

namespace render {

// The picture's pixels in `part`, of a plane whose pixels have so many of them across.
void enlarge(const MemoryTargets::Plane& coarse, int across, const PixelBox& part,
             PlanePixels& pixels);

}  // namespace render
