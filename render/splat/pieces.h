// A draw list in pieces, each little beside a frame's splats, so that a long list can be drawn over
// several frames: the same pieces in the same order, hence the same picture. Pure.
#pragma once

#include <cstdint>
#include <vector>

#include "render/model/scene.h"

namespace render {

struct Piece {
    std::size_t layer;  // of a sorted list, which brings its own: 0
    // Of what is sent, these places in the sorted step's block are drawn; of a sorted list, which
    // has no blocks: 0, 0.
    std::uint32_t from, last;
    std::uint32_t stride;  // and of those only this subset
    // What is sent to the vertex shader: points of one block in blockOrder, the first by its number
    // in the step, or entries of the sorted list.
    std::uint64_t first, count;
    std::uint64_t cost;  // in splats
};

// The most that a piece sends.
constexpr std::uint64_t kPiecePoints = 1 << 13;

// In the order of drawing; those of a layer follow each other.
std::vector<Piece> piecesOfRuns(const Scene& scene);
// Of a sorted list of so many.
std::vector<Piece> piecesOfSorted(std::uint64_t count);

}  // namespace render
