// The pieces of a scene's cells in order of depth, put so by the GPU.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>

#include "render/gl/object.h"
#include "render/splat/gl_radix_sort.h"

namespace render {

// Of an upright grid; GlCells has them.
struct CellsToOrder {
    std::uint32_t count;
    glm::uvec3 size;  // of the grid, in cells
    const gl::Buffer& pieces;
};
// Of a mesh; GlTets has them.
struct TetsToOrder {
    std::uint32_t count;
    double radius;  // of their cells' middles about the origin of the axes
    const gl::Buffer &pieces, &cells, &middles;
    const gl::Buffer* places;  // of the cells in their order, the nearest first; null: by middles
};

class GlPieceOrder {
 public:
    // Places of all as uints, the farthest first.
    // From an eye in, or beside, this cell: an order of cells that hide each other, those of one
    // cell with the last first.
    std::shared_ptr<const gl::Buffer> operator()(const CellsToOrder& cells, const glm::uvec3& eye);
    // From an eye in axis coordinates: cell by cell, by their places or the distances of their
    // middles, and tetrahedra of a cell by the distances of
    // their middles: of the six about a diagonal, where the cell is a brick, that is the order in
    // which they hide each other.
    std::shared_ptr<const gl::Buffer> operator()(const TetsToOrder& tets, const glm::dvec3& eye);
    std::uint64_t bytes() const { return sort_.bytes(); }  // on the GPU

 private:
    enum class Keys { OwnMiddles, CellsMiddles, CellsPlaces };  // as tet_keys.comp has them
    void findKeys(const TetsToOrder& tets, const glm::dvec3& eye, Keys keys);
    // Sorts by so many digits of the keys.
    std::shared_ptr<const gl::Buffer> sorted(std::uint32_t count, unsigned digits);

    GlRadixSort sort_;
    std::optional<gl::Program> cellKeys_, tetKeys_, places_;  // when there is an order
};

}  // namespace render
