// The cells of an upright grid on the GPU.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>

#include "render/splat/cell_slopes.h"
#include "render/splat/gl_pieces.h"

namespace render {

// A cell or an octant of one with one range, as CellSplat (render/model/cell_splat.h) has it.
// GLSL mirror: Piece in shaders/cell_piece.glsl.
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
    GlCells(const Scene& scene, std::uint64_t mostBytes, GlCellLister& lister);
    std::uint64_t bytes() const override;
    const gl::Buffer* slopes() const override { return slopes_.get(); }
    // In the larger of two buffers.
    static std::uint64_t bytesOfOne(const Scene& scene) {
        return std::max(sizeof(GlCell), scene.light == Light::Off ? 0 : sizeof(CellSlopes));
    }
    const gl::BufferTexture* sides() const override { return &sidesTexture_; }

 private:
    // The cell that the eye is in, or beside.
    glm::dvec3 keyOf(const Scene& scene, const View& view) const override;
    std::shared_ptr<const gl::Buffer> order(const Scene& scene, const View& view,
                                            GlPieceOrder& order) const override;

    glm::uvec3 size_;  // of the grid, in cells
    std::unique_ptr<gl::Buffer> slopes_;
    gl::Buffer sides_;
    gl::BufferTexture sidesTexture_;
};

}  // namespace render
