// A draw list in pieces, each little beside a frame's splats, so that a long list can be drawn over
// several frames: the same pieces in the same order, hence the same picture. Pure.
#pragma once

#include <cstdint>
#include <vector>

#include "render/model/scene.h"

namespace render {

struct Piece {
    std::size_t layer;     // of a sorted list, which brings its own: 0
    timeseries::Run run;   // of what is sent, only its points are drawn; of a sorted list: all
    std::uint32_t stride;  // and of those only this subset
    // What is sent to the vertex shader: points as GpuStep has them, or entries of the sorted list.
    std::uint64_t first, count;
    std::uint64_t cost;  // in splats
};

// The most that a piece sends.
constexpr std::uint64_t kPiecePoints = 1 << 13;

// In the order of drawing; those of a layer follow each other.
std::vector<Piece> piecesOf(const Scene& scene, const DrawList& list);

}  // namespace render
