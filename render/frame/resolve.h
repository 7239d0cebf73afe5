// Accumulated sums into light, on the processor: the formulas are those of shaders/resolve.frag and
// of resolvePixel (render/reference/cpu_splatter.h). Pure.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "render/model/scene.h"

namespace render {

// A plane's sums from a pixel on, and what they stand for.
struct SummedRow {
    Channels channels;
    const float* sums;         // [x][1 or 4]
    float perWeight;           // optical depth; of Weight and WeightedColor
    std::array<float, 3> rgb;  // linear; of Weight
};

// Blends so many pixels over light: linear, premultiplied, four floats each. REQUIRES: one Over, or
// any number of others.
void resolveRow(std::span<const SummedRow> planes, std::size_t pixels, float* light);

}  // namespace render
