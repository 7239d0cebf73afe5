// What a mesh's points are in their file, and of how many what they stand for is a guess: for who
// tells it. Nothing is drawn by it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "timeseries/grid/pages.h"

namespace timeseries {

struct MeshAbout {
    enum class Points {
        Lattice,    // along indices
        Cells,      // one a cell, in the order of the file
        Corners,    // of cells
        Edges,      // of cells, one each
        Scattered,  // by themselves
        Particles   // likewise, each as large as the file says
    };
    Points points = Points::Lattice;
    // How many cells there are of each kind that has a name of its own, the most first; those that
    // take no space, too. `type` as in cell_types.h.
    struct Kind {
        std::uint8_t type;
        std::uint64_t count;
        friend bool operator==(const Kind&, const Kind&) = default;
    };
    std::vector<Kind> cells;
    // [cell]: where points are cells of several types, each one's.
    PageVector<std::uint8_t> types;
    std::size_t levels = 0;  // of an adaptive mesh, whose leaves the cells are; else 0
    // Points that have a place, and
    std::uint64_t apart = 0;     // are corners of no cell
    std::uint64_t beside = 0;    // of some with a volume, and others without one
    std::uint64_t oneSided = 0;  // along indices: whose neighbour to one side has no place
    friend bool operator==(const MeshAbout&, const MeshAbout&) = default;

    // Of a point that is a cell.
    std::optional<std::uint8_t> typeOf(std::uint64_t cell) const;
};

// How many cells have each number of a type.
using TypeCounts = std::array<std::uint64_t, 256>;
TypeCounts countTypes(std::span<const std::uint8_t> types);

// Of cells of these types, and points that are these, or their corners.
MeshAbout aboutCells(MeshAbout::Points points, std::span<const std::uint8_t> types);

}  // namespace timeseries
