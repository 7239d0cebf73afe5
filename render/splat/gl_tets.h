// The tetrahedra of a mesh's cells on the GPU.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "render/splat/cell_pieces.h"
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
// Of f at its corners, along each axis: by which light falls on it (tet::gradientsOf).
using GlTetSlopes = std::array<glm::vec4, 3>;

class GlTets final : public GlPieces {
 public:
    GlTets(const Scene& scene, std::uint64_t mostBytes);
    // How many a cell has, in the mean, where nothing of it is missing or clipped.
    static double perCell(const Scene& scene);

    double goOn(const Scene& scene, std::uint64_t cells) override;
    std::uint64_t bytes() const override;
    const gl::Buffer* slopes() const override { return slopes_.get(); }

 private:
    struct Part {
        std::vector<GlTet> tets;
        std::vector<GlTetSlopes> slopes;  // of each, where light falls on them
    };
    // Until all are sent.
    struct Listing {
        std::vector<CellOfLayer> all;
        std::size_t listed = 0;   // of them
        std::vector<Part> parts;  // one after the other
        std::size_t sent = 0;     // parts
        std::uint64_t count = 0, sentTets = 0;
        std::vector<std::uint32_t> cells, firsts;
        std::vector<glm::vec4> middles;
    };
    void list(const Scene& scene, std::uint64_t cells);
    void keep(const Scene& scene, const std::vector<GlTet>& part);
    void send(bool isLit);

    // Where the eye is, in axis coordinates.
    glm::dvec3 keyOf(const Scene& scene, const View& view) const override;
    std::shared_ptr<const gl::Buffer> order(const Scene& scene, const View& view,
                                            GlPieceOrder& order) const override;

    std::uint64_t mostBytes_;
    std::optional<Listing> listing_;
    std::unique_ptr<gl::Buffer> sending_, slopes_;
    double radius_ = 0;  // of the middles about the origin
    // Of each piece, which of the cells that follow each other in one layer has it; their middles,
    // and they themselves.
    std::optional<gl::Buffer> cells_, middles_;
    std::vector<CellOfLayer> of_;
};

}  // namespace render
