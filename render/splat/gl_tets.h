// The tetrahedra of a mesh's cells on the GPU.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <optional>

#include "render/splat/gl_pieces.h"

namespace render {

// A tetrahedron with one range, as TetSplat (render/model/tet_splat.h) has it: a corner, and the
// ways from it to the others, in axis coordinates, in w the field there as f.
// GLSL mirror: Piece in shaders/tet.vert.
struct GlTet {
    std::array<glm::vec4, 4> corners;
    float least, most, perRange, steep;
    GlMapPlace map;
    // Bits 4 and 5: crossesLeast, crossesMost; from 8: layer.
    std::uint32_t kind;
    std::uint32_t cell;  // its number
};

class GlTets final : public GlPieces {
 public:
    GlTets(const Scene& scene, std::uint64_t mostBytes);
    // How many a cell has, in the mean, where nothing of it is missing or clipped.
    static double perCell(const Scene& scene);

    std::uint64_t bytes() const override;

 private:
    glm::dvec3 keyOf(const CellRank& rank) const override { return rank.from(); }
    std::shared_ptr<const gl::Buffer> order(const CellRank& rank, GlTetOrder& order) const override;

    double radius_ = 0;        // of the middles about the origin
    std::uint32_t count_ = 0;  // of all pieces
    // Of each piece, which of the cells that follow each other in one layer has it; their middles.
    std::optional<gl::Buffer> cells_, middles_;
};

}  // namespace render
