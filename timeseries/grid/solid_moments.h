// The moments of solids of one type (cell_types.h), of many side by side in vectors.
#pragma once

#include <cstddef>

#include "timeseries/grid/cell_moments.h"
#include "timeseries/grid/cell_types.h"

namespace timeseries {

// One solid a column. A face is what cell_moments.h says.
struct SolidColumns {
    static constexpr std::size_t kMost = 64, kMostCorners = 12;
    using Row = double[kMost];

    void setCorner(std::size_t solid, std::size_t corner, const glm::dvec3& at) {
        for (int c = 0; c < 3; ++c) corners[corner][c][solid] = at[c];
    }
    CellMoments moments(std::size_t solid) const {
        const auto s = [&](std::size_t i) { return second[i][solid]; };
        return {volume[solid],
                {centroid[0][solid], centroid[1][solid], centroid[2][solid]},
                {s(0), s(1), s(2), s(1), s(3), s(4), s(2), s(4), s(5)}};
    }

    alignas(64) Row corners[kMostCorners][3];
    // What measureSolids() puts there.
    alignas(64) Row volume, centroid[3], second[6];  // xx, xy, xz, yy, yz, zz
};

// Measures so many, whose corners are there. REQUIRES: a solid that is no polyhedron.
void measureSolids(const CellType& type, std::size_t count, SolidColumns& solids);

}  // namespace timeseries
