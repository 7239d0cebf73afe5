// The cells of a curvilinear grid, from where its points lie.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "timeseries/grid/axis_rings.h"

namespace timeseries {

// What is known of each point; a coordinate that is not finite says that it has no place.
struct MeshPlaces {
    std::array<std::size_t, 3> size{1, 1, 1};  // points along the indices i, j, k
    // [k][j][i], i fastest, in the file's space, of all points; or [j][i] when there are `levels`.
    std::vector<glm::dvec3> at;
    // [k]: the third coordinates of the places above each other, whose own are 0, strictly
    // ascending or descending. None: all are in `at`.
    std::vector<double> levels = {};
    // After how much each coordinate comes round to itself, as longitude does; 0: never.
    glm::dvec3 period{0};
    // Of points that are the middles of a file's cells, without levels: the corners of these, in
    // the same order. One more along each index than points, or one where the cells have no extent
    // along it.
    struct Corners {
        std::array<std::size_t, 3> size{};
        std::span<const glm::dvec3> at = {};
    } corners = {};
    bool isThin(std::size_t axis) const {
        return corners.at.empty() ? size[axis] == 1 : corners.size[axis] == 1;
    }
};

bool isPlace(const glm::dvec3& at);
// Of ways that coordinates with these periods may go, the shortest.
inline glm::dvec3 shorterWay(glm::dvec3 along, const glm::dvec3& period) {
    for (int c = 0; c < 3; ++c)
        if (period[c] > 0) along[c] -= period[c] * std::round(along[c] / period[c]);
    return along;
}

// Looks at `places`, which must outlive it, and be as many as their size says.
class CurvilinearCells {
 public:
    explicit CurvilinearCells(const MeshPlaces& places);
    // Columns: the steps along i, j and k that this point of `at` stands for, half the way between
    // its neighbours, or the whole way to the only one that has a place; of columns, on the first
    // level. Between corners that are known: the cell's sides, each in the mean of four, times what
    // makes their volume the cell's own. An index without extent is as thick as the mean of the
    // cells is wide. On rings about an axis they are widened (timeseries/grid/axis_rings.h); where
    // a line's last point is its first, both have the cell about that place, and half of its volume
    // each: it is widened once, too.
    struct Cell {
        glm::dmat3 steps;
        unsigned widened;
    };
    Cell operator()(std::uint64_t row) const;
    // How far neighbours are apart along each coordinate, at most.
    glm::dvec3 longestWay() const;
    // Points of `at` that have cells, and a neighbour without a place.
    std::uint64_t oneSided() const;

 private:
    // The shorter one.
    glm::dvec3 way(std::uint64_t from, std::uint64_t to) const;
    glm::dmat3 stepsAt(std::uint64_t row) const;
    glm::dmat3 sidesAt(const glm::vec<3, std::uint64_t>& at) const;
    // None where the line does not end where it began, or the point is at neither.
    std::optional<glm::dvec3> stepAcrossSeam(std::uint64_t row, std::size_t axis,
                                             std::uint64_t at) const;
    glm::dvec3 stepAlong(std::uint64_t row, std::size_t axis, bool hasBefore, bool hasAfter) const;
    double meanWidth() const;

    const MeshPlaces& places_;
    AxisRings rings_;
    std::array<std::uint64_t, 3> stride_;
    double firstHeight_;  // the step along levels on the first one
    double thickness_ = 0;
};

}  // namespace timeseries
