// A grid placed in the world: where its points are drawn and how large their cells are there.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "timeseries/grid.h"

namespace render {

// World coordinates: z up, the centre of the grid's box at 0, and the box scaled so that its half
// diagonal is 1. That keeps every coordinate near 1 whatever the grid's units and offsets are.
class Lattice {
 public:
    // `stretch` multiplies grid units of x, y, z before the uniform scaling. Without it axes of one
    // unit keep their proportions, and axes of other units (or more than 20 times shorter) are
    // fitted to half the length of the longest. Axes that count downwards are drawn downwards.
    explicit Lattice(const timeseries::Grid& grid, std::optional<glm::dvec3> stretch = {});

    glm::uvec3 size() const;
    glm::dvec3 position(std::uint64_t index) const;
    // Lengths of the cell's sides, all > 0.
    glm::dvec3 cell(std::uint64_t index) const;
    // Per axis, by index along it.
    const std::array<std::vector<double>, 3>& positions() const { return positions_; }
    const std::array<std::vector<double>, 3>& widths() const { return widths_; }

    // The length l in which optical depth is counted: the cube root of the mean cell volume.
    double unitLength() const { return unitLength_; }
    // All cells are cubes of one size, to 1e-12.
    bool cubes() const;
    // Corners of the points' box; half diagonal 1 (all zero for a single point).
    glm::dvec3 boxHalf() const { return boxHalf_; }
    // World length per grid unit along each axis, signed; their ratios are what a picture states.
    glm::dvec3 scale() const;
    glm::dvec3 worldFromGrid(const glm::dvec3& grid) const;

 private:
    std::array<std::vector<double>, 3> positions_, widths_;
    // Long doubles: products and squares of very large or small extents leave the doubles.
    std::array<long double, 3> scale_{}, centre_{};
    glm::dvec3 boxHalf_{0};
    double unitLength_ = 1;
};

// How much the axes are stretched against each other, in words: "5.6 m depth drawn as 1° lon";
// empty when all are drawn to one scale.
std::string stretchText(const timeseries::Grid& grid, const Lattice& lattice);

// Inclusive index ranges per axis; lo > hi along an axis holds nothing.
struct IndexBox {
    glm::uvec3 lo{0}, hi{0xffffffffu};
    bool holds(const glm::uvec3& at) const {
        return at.x >= lo.x && at.y >= lo.y && at.z >= lo.z && at.x <= hi.x && at.y <= hi.y &&
               at.z <= hi.z;
    }
};
// The points inside closed ranges of grid coordinates.
IndexBox indexBox(const timeseries::Grid& grid, const glm::dvec3& lo, const glm::dvec3& hi);

}  // namespace render
