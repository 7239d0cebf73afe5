// The gradient by which light falls on cells: central differences at points, trilinear between
// them. It is the same on both sides of a face, which a cell's own is not, so that a surface looks
// as smooth as the field is.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "render/model/scene.h"
#include "render/splat/slope_batch.h"

namespace render {

// Of an upright grid. At its borders, and beside what is missing, differences are to one side. The
// scene must outlive it.
class PointSlopes {
 public:
    explicit PointSlopes(const Scene& scene);

    // Of the cell whose octant was asked about last: most are asked about one after another.
    struct OfOctants {
        std::uint32_t cell = 0xffffffffu;
        double unit = 0;  // a power of two, so that nothing depends on which octant was the first
        std::array<glm::dvec3, 8> gradients{};
    };
    // Adds a whole cell, as those that in() says. REQUIRES: there is room.
    void add(std::uint32_t cell, const glm::dvec3& size, double extent, SlopeBatch& batch) const;
    // Of a cell's octant, or of all of it (kWholeCell), which is of this size.
    CellSlopes in(std::uint32_t cell, unsigned octant, const glm::dvec3& size, double extent,
                  OfOctants& last) const;
    // At the corners of a cell of this size what f changes over it, along each axis.
    CellSlopes atCorners(const glm::uvec3& cell, const glm::dvec3& size, double extent) const;
    // And what values / extent change there, a unit of length.
    std::array<glm::dvec3, 8> gradients(const glm::uvec3& cell, double extent) const;

 private:
    // Of a point along an axis: its neighbours, and what a difference is divided by.
    struct Neighbours {
        std::uint32_t below, above;
        double perBoth, perBelow, perAbove;
    };
    glm::dvec3 at(const glm::uvec3& point, double extent) const;

    const Scene& scene_;
    timeseries::IndicesAlong cells_;
    std::array<std::vector<Neighbours>, 3> along_;
};

}  // namespace render
