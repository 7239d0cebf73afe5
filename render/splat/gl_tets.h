// The tetrahedra of a mesh's cells on the GPU.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

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

 private:
    // Pieces that are of one cell and layer, and that cell's middle.
    struct Group {
        std::uint32_t cell, first;
        glm::vec3 middle;
    };
    glm::dvec3 keyOf(const CellRank& rank) const override { return rank.from(); }
    // A cell's own by the distances of their middles: of the six about a diagonal, where the cell
    // is a brick, that is the order in which they hide each other.
    std::vector<std::uint32_t> order(const CellRank& rank) const override;

    std::vector<Group> groups_;       // and one more, where they end
    std::vector<glm::vec3> middles_;  // of each piece, in axis coordinates
};

}  // namespace render
