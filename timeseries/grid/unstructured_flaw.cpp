#include <fmt/format.h>

#include <algorithm>

#include "timeseries/grid/cell_types.h"
#include "timeseries/grid/unstructured.h"
#include "timeseries/together.h"

namespace timeseries {
namespace {

constexpr std::size_t kCellsWorthAThread = 1 << 12;

// The first cell of which this is true; as many as there are where there is none.
template <typename Is>
std::size_t firstCell(std::size_t cells, const Is& is) {
    std::vector<std::size_t> found(threadsFor(cells, kCellsWorthAThread), cells);
    const auto threads = static_cast<unsigned>(found.size());
    together(threads, [&](unsigned k) {
        const std::size_t end = cells * (k + 1) / threads;
        std::size_t cell = cells * k / threads;
        while (cell < end && !is(cell)) ++cell;
        if (cell < end) found[k] = cell;
    });
    return *std::ranges::min_element(found);
}

std::string flawOfEnds(std::span<const std::uint64_t> ends, std::size_t size) {
    const std::size_t flawed = firstCell(ends.size(), [&](std::size_t cell) {
        return ends[cell] < (cell == 0 ? 0 : ends[cell - 1]) || ends[cell] > size;
    });
    if (flawed == ends.size()) return "";
    return fmt::format("cell {} ends at {} of {} entries", flawed, ends[flawed], size);
}

// REQUIRES: ends without a flaw.
std::string flawOfCorners(const UnstructuredGrid& grid) {
    const auto cornersOf = [&](std::size_t cell) { return listOf(grid.corners, grid.ends, cell); };
    const auto isPoint = [&](std::uint32_t corner) { return corner < grid.points.size(); };
    const std::size_t flawed = firstCell(grid.types.size(), [&](std::size_t cell) {
        const CellType* type = cellTypeOf(grid.types[cell]);
        const auto corners = cornersOf(cell);
        return !std::ranges::all_of(corners, isPoint) || (type && corners.size() < type->corners);
    });
    if (flawed == grid.types.size()) return "";
    const auto corners = cornersOf(flawed);
    const auto other = std::ranges::find_if_not(corners, isPoint);
    if (other != corners.end()) {
        const auto at = static_cast<std::uint64_t>(&*other - grid.corners.data());
        const auto& known = grid.noPoint;
        if (*other != kNoPoint)
            return fmt::format("cell {} has point {} of {}", flawed, *other, grid.points.size());
        if (known && known->corner == at)
            return fmt::format("cell {} has point {} of {}", flawed, known->number, known->points);
        return fmt::format("cell {} has points that there are not", flawed);
    }
    return fmt::format("cell {} of type {} has {} points, fewer than {}", flawed,
                       grid.types[flawed], corners.size(), cellTypeOf(grid.types[flawed])->corners);
}

std::string flawOfFaces(const UnstructuredGrid& grid, std::size_t cell) {
    const auto list = listOf(grid.faces, grid.faceEnds, cell);
    std::size_t next = 1;
    for (std::uint32_t left = list.empty() ? 0 : list[0]; left > 0; --left) {
        const std::size_t corners = next < list.size() ? list[next] : list.size();
        if (corners >= list.size() - std::min(next, list.size()))
            return fmt::format("the faces of cell {} end early", cell);
        for (std::size_t i = 0; i < corners; ++i) {
            const std::uint32_t point = list[next + 1 + i];
            if (point == kNoPoint)
                return fmt::format("a face of cell {} has points that there are not", cell);
            if (point >= grid.points.size())
                return fmt::format("a face of cell {} has point {} of {}", cell, point,
                                   grid.points.size());
        }
        next += 1 + corners;
    }
    return "";
}

}  // namespace

std::string flawOf(const UnstructuredGrid& grid) {
    const std::size_t cells = grid.types.size();
    if (grid.ends.size() != cells) return "cells of other numbers of types and of lists of corners";
    if (std::string flaw = flawOfEnds(grid.ends, grid.corners.size()); !flaw.empty()) return flaw;
    if (std::string flaw = flawOfCorners(grid); !flaw.empty()) return flaw;
    const bool hasFaces = !grid.faceEnds.empty();
    if (hasFaces && grid.faceEnds.size() != cells) return "lists of faces of other cells";
    if (const std::string flaw = flawOfEnds(grid.faceEnds, grid.faces.size()); !flaw.empty())
        return "faces: " + flaw;
    const auto isPolyhedron = [&](std::size_t cell) { return grid.types[cell] == kPolyhedron; };
    const std::size_t first = firstCell(cells, isPolyhedron);
    if (first < cells && !hasFaces)
        return fmt::format("cell {} is a polyhedron without faces", first);
    for (std::size_t cell = first; cell < cells; ++cell)
        if (isPolyhedron(cell))
            if (std::string flaw = flawOfFaces(grid, cell); !flaw.empty()) return flaw;
    return "";
}

}  // namespace timeseries
