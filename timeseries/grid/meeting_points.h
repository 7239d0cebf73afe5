// Points of an unstructured grid that are in one place: where its parts meet, each has its own, and
// where cells of two sizes meet, some of the smaller ones' lie on sides of the larger.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "timeseries/grid/unstructured.h"

namespace timeseries {

// Of a grid: places are told apart to 2^-32 of the extent, along each coordinate, of what cells
// have for corners. What no cell has, or has no place, is alone. The grid must outlive it.
class MeetingPoints {
 public:
    explicit MeetingPoints(const UnstructuredGrid& grid);
    // Of each point the first one that is where it is.
    const std::vector<std::uint32_t>& first() const { return first_; }
    // The first one there, or kNoPoint.
    std::uint32_t at(const glm::dvec3& place) const;

 private:
    using Cell = std::array<std::int64_t, 3>;
    Cell cellOf(const glm::dvec3& place) const;
    static std::uint64_t hashOf(const Cell& cell);  // in the upper half

    std::span<const glm::dvec3> points_;
    bool isWithin(const glm::dvec3& place) const;
    glm::dvec3 lo_{0}, hi_{0}, middle_{0}, half_{0};
    std::vector<std::uint64_t> hashed_;  // ascending: a cell's hash << 32 | point
    std::vector<std::uint32_t> first_;
};

// The grid with voxels and hexahedra that have corners of smaller ones on their sides as polyhedra
// with these: a face is parted where there is a point in its middle, and goes by those on its
// edges, for as many as three levels; thirds of a side do not count. Nothing where there are no
// such cells, or where it has polyhedra. `places` are those of its points.
std::optional<UnstructuredGrid> withHangingPoints(const UnstructuredGrid& grid,
                                                  const MeetingPoints& places);

}  // namespace timeseries
