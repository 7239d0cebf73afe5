// Grids of cells of any shape, each of which names its corners: where their cells, or their points,
// lie, and what space each stands for.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "timeseries/grid/cell_moments.h"
#include "timeseries/grid/mesh.h"
#include "timeseries/grid/pages.h"

namespace timeseries {

// What a corner has that names no point, so that it is told as one that there is not.
constexpr std::uint32_t kNoPoint = std::numeric_limits<std::uint32_t>::max();

// What a file has there, and of how many points it names none.
struct NoPoint {
    std::uint64_t corner;  // which of all
    std::int64_t number;
    std::uint64_t points;
};

// Lists of one cell stand behind that of the cell before, and end where `...Ends` says.
struct UnstructuredGrid {
    PageVector<glm::dvec3> points;   // in the file's space
    PageVector<std::uint8_t> types;  // [cell], as in cell_types.h
    PageVector<std::uint64_t> ends;
    PageVector<std::uint32_t> corners;  // of each cell: points
    // Of polyhedra: how many faces, then of each how many corners, and which points. Empty: no
    // cell is one.
    std::vector<std::uint64_t> faceEnds;
    std::vector<std::uint32_t> faces;
    std::size_t levels = 0;               // of an adaptive mesh, whose leaves these are; else 0
    bool inParts = false;                 // which meet where each has points of its own
    std::optional<NoPoint> noPoint = {};  // of the corners that are kNoPoint the first, if known

    void keepFirst(const NoPoint& found) {
        if (!noPoint || found.corner < noPoint->corner) noPoint = found;
    }
};

// A cell's part of a list, of cells whose parts end there.
inline std::span<const std::uint32_t> listOf(std::span<const std::uint32_t> all,
                                             std::span<const std::uint64_t> ends,
                                             std::size_t cell) {
    const std::uint64_t first = cell == 0 ? 0 : ends[cell - 1];
    return all.subspan(first, ends[cell] - first);
}

// The first thing that is wrong, in a few words; "" when all cells name points that there are.
std::string flawOf(const UnstructuredGrid& grid);

// How the cells measure: those of fewer dimensions than others have no volume. Where all are
// surfaces, they are as thick as their mean is wide; lines, as the mean is long. Where there are
// but points, they have no volume here: see scattered.h.
struct UnstructuredShapes {
    // REQUIRES: no flaw.
    explicit UnstructuredShapes(const UnstructuredGrid& grid);
    // Of the cells from `first` on. REQUIRES: the same grid.
    void measure(const UnstructuredGrid& grid, std::uint64_t first,
                 std::span<CellMoments> cells) const;

    // Irregular cells leave gaps unless their splats are wider than a lattice's (1.5: see
    // tests/render/mesh_splats_test.cpp).
    double spread = 1;
    bool areScattered = false;  // points alone
    int dimension = 0;          // of the cells that take space
    double thickness = 0;       // of them along the others
};

// Throw std::invalid_argument when nothing has a volume.
//
// One point a cell: at its centroid, as large as the cell, as far each way as its second moments.
// With levels, surfaces in the plane of the first two coordinates stand for prisms above them, one
// a level. With places, as many as cells, the point of a cell that has one is there.
Mesh meshOfCells(const UnstructuredGrid& grid, const UnstructuredShapes& shapes,
                 const std::vector<double>& levels = {},
                 const std::vector<glm::dvec3>& places = {});
// One point a point, the first `count` of them: of each cell that it is of it has the share that
// all of its points have, and reaches as far as these cells do about it. Levels as above.
Mesh meshOfPoints(const UnstructuredGrid& grid, const UnstructuredShapes& shapes,
                  const std::vector<double>& levels = {},
                  std::uint64_t count = std::numeric_limits<std::uint64_t>::max());

// What is drawn otherwise than the file says, a sentence each.
std::vector<std::string> notesOf(const UnstructuredGrid& grid);

}  // namespace timeseries
