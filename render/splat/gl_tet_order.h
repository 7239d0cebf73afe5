// The tetrahedra of a mesh's cells in order of depth, put so by the GPU: cell by cell, and those of
// a cell by the distances of their middles: of the six about a diagonal, where the cell is a brick,
// that is the order in which they hide each other.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>

#include "render/gl/object.h"
#include "render/splat/gl_radix_sort.h"

namespace render {

// GlTets has them.
struct TetsToOrder {
    std::uint32_t count;
    double radius;  // of their cells' middles about the origin of the axes
    const gl::Buffer &pieces, &cells, &middles;
};

class GlTetOrder {
 public:
    // Places of all as uints, the farthest from the eye, in axis coordinates, first.
    std::shared_ptr<const gl::Buffer> operator()(const TetsToOrder& tets, const glm::dvec3& eye);
    std::uint64_t bytes() const { return sort_.bytes(); }  // on the GPU

 private:
    void findKeys(const TetsToOrder& tets, const glm::dvec3& eye, bool ofCells);

    GlRadixSort sort_;
    struct Programs {
        gl::Program keys, places;
    };
    std::optional<Programs> programs_;  // when there is an order
};

}  // namespace render
