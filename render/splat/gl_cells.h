// The cells of an upright grid on the GPU.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "render/splat/gl_pieces.h"

namespace render {

// A cell or an octant of one with one range, as CellSplat (render/model/cell_splat.h) has it.
// GLSL mirror: Piece in shaders/cell.vert.
struct GlCell {
    std::uint32_t cell;  // its number
    // Bits 0 to 3: which octant, or kWholeCell; 4 and 5: crossesLeast, crossesMost; from 8: layer.
    std::uint32_t kind;
    float least, most, perRange;
    GlMapPlace map;
    float steep;
    float f[8];
};

class GlCells final : public GlPieces {
 public:
    GlCells(const Scene& scene, std::uint64_t mostBytes);
    std::uint64_t bytes() const override { return GlPieces::bytes() + sides_.bytes(); }
    const gl::BufferTexture* sides() const override { return &sidesTexture_; }

 private:
    glm::dvec3 keyOf(const CellRank& rank) const override { return rank.eye(); }
    // By the processor: it changes when the eye comes into another cell.
    std::shared_ptr<const gl::Buffer> order(const CellRank& rank, GlTetOrder&) const override;

    std::vector<glm::uvec3> cells_;  // of each piece, along the axes
    gl::Buffer sides_;
    gl::BufferTexture sidesTexture_;
};

}  // namespace render
