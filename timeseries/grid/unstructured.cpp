#include "timeseries/grid/unstructured.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <span>

#include "timeseries/grid/cell_types.h"
#include "timeseries/grid/scattered.h"
#include "timeseries/grid/solid_cells.h"
#include "timeseries/together.h"

namespace timeseries {
namespace {

// Fewer are not worth a thread.
constexpr std::size_t kCellsAThread = 1 << 12;

std::span<const std::uint32_t> listOf(const std::vector<std::uint32_t>& all,
                                      const std::vector<std::uint64_t>& ends, std::size_t cell) {
    const std::uint64_t first = cell == 0 ? 0 : ends[cell - 1];
    return {all.data() + first, all.data() + ends[cell]};
}

// Not finite where there are none.
glm::dvec3 centreOf(std::span<const glm::dvec3> places) {
    glm::dvec3 sum(places.empty() ? std::numeric_limits<double>::quiet_NaN() : 0.0);
    for (const glm::dvec3& place : places) sum += place / static_cast<double>(places.size());
    return sum;
}

// How the cells of a grid measure: those of fewer dimensions than others take no space.
class Measure {
 public:
    explicit Measure(const UnstructuredGrid& grid) : grid_(grid) {
        for (const std::uint8_t number : grid.types)
            if (const CellType* type = cellTypeOf(number))
                dimension_ = std::max(dimension_, type->dimension);
        if (dimension_ == 1 || dimension_ == 2) thickness_ = thickness();
    }
    int dimension() const { return dimension_; }
    CellMoments operator()(std::size_t cell) const;

 private:
    CellMoments plain(std::size_t cell) const;
    CellMoments polyhedron(std::size_t cell) const;
    double thickness() const;
    void thicken(CellMoments& moments, std::size_t cell) const;
    std::vector<glm::dvec3>& cornersOf(std::size_t cell, const CellType& type) const;

    const UnstructuredGrid& grid_;
    int dimension_ = 0;
    double thickness_ = 0;
};

// To be used until it is called again by the same thread.
std::vector<glm::dvec3>& Measure::cornersOf(std::size_t cell, const CellType& type) const {
    thread_local std::vector<glm::dvec3> corners;
    auto all = listOf(grid_.corners, grid_.ends, cell);
    if (type.corners > 0) all = all.first(type.corners);
    corners.clear();
    for (const std::uint32_t point : all) corners.push_back(grid_.points[point]);
    if (type.dimension == 2 && !type.faces.empty()) {
        const auto unordered = corners;
        for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = unordered[type.faces[i]];
    }
    return corners;
}

CellMoments Measure::polyhedron(std::size_t cell) const {
    thread_local std::vector<std::vector<glm::dvec3>> faces;
    const auto list = listOf(grid_.faces, grid_.faceEnds, cell);
    if (list.empty()) return {};
    faces.resize(list[0]);
    auto next = list.begin() + 1;
    for (auto& face : faces) {
        face.clear();
        for (std::uint32_t left = *next++; left > 0; --left) face.push_back(grid_.points[*next++]);
    }
    return momentsOfPolyhedron(faces);
}

CellMoments Measure::plain(std::size_t cell) const {
    const CellType* type = cellTypeOf(grid_.types[cell]);
    if (!type || type->dimension < dimension_) {
        std::vector<glm::dvec3> all;
        for (const std::uint32_t point : listOf(grid_.corners, grid_.ends, cell))
            all.push_back(grid_.points[point]);
        return {0, centreOf(all), glm::dmat3(0.0)};
    }
    if (grid_.types[cell] == kPolyhedron) return polyhedron(cell);
    const auto& corners = cornersOf(cell, *type);
    if (corners.empty()) return {0, centreOf(corners), glm::dmat3(0.0)};
    if (type->dimension == 3) return momentsOfSolid(corners, type->faceSizes, type->faces);
    if (type->dimension == 0) return {0, centreOf(corners), glm::dmat3(0.0)};
    return type->dimension == 2 ? momentsOfPolygon(corners) : momentsOfLine(corners);
}

double Measure::thickness() const {
    const glm::dvec2 sum = sumOf(grid_.types.size(), [&](std::size_t cell) {
        const double size = plain(cell).volume;
        return glm::dvec2(size, size > 0 ? 1 : 0);
    });
    const double mean = sum.y > 0 ? sum.x / sum.y : 0;
    return dimension_ == 2 ? std::sqrt(mean) : mean;
}

// Across the cell, which takes no space that way.
void Measure::thicken(CellMoments& moments, std::size_t cell) const {
    const double reach = thickness_ * thickness_ / 12;
    const glm::dmat3 every(reach);
    const auto& corners = cornersOf(cell, *cellTypeOf(grid_.types[cell]));
    glm::dvec3 along = corners.back() - corners.front();  // of a surface its normal
    if (dimension_ == 2) {
        along = glm::dvec3(0);
        for (std::size_t i = 0; i < corners.size(); ++i)
            along += glm::cross(corners[i] - moments.centroid,
                                corners[(i + 1) % corners.size()] - moments.centroid);
    }
    const double length = glm::length(along);
    if (!(length > 0)) return;
    along /= length;
    const glm::dmat3 one = reach * glm::outerProduct(along, along);
    moments.second += dimension_ == 2 ? one : every - one;
    moments.volume *= dimension_ == 2 ? thickness_ : thickness_ * thickness_;
}

CellMoments Measure::operator()(std::size_t cell) const {
    CellMoments moments = plain(cell);
    if (dimension_ < 3 && moments.volume > 0) thicken(moments, cell);
    return moments;
}

double spreadOf(const UnstructuredGrid& grid) {
    const auto bricks = std::ranges::count_if(grid.types, [](std::uint8_t number) {
        const CellType* type = cellTypeOf(number);
        return type && type->isBrick;
    });
    return 2 * static_cast<std::size_t>(bricks) > grid.types.size() ? 1 : 1.5;
}

// The steps whose cell reaches as far as these second moments, and has the volume.
std::array<glm::dvec3, 3> rowsOf(const glm::dmat3& second, double volume) {
    std::array<glm::dvec3, 3> rows{};
    if (!(volume > 0)) return rows;
    // 12 M = L L^T, but for what rounding leaves of a flat cell's.
    const glm::dmat3 m = 12.0 * second;
    const double least = 1e-18 * (m[0][0] + m[1][1] + m[2][2]);
    double product = 1;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c <= r; ++c) {
            double rest = m[r][c];
            for (int k = 0; k < c; ++k) rest -= rows[r][k] * rows[c][k];
            rows[r][c] = r == c ? std::sqrt(std::max(rest, least)) : rest / rows[c][c];
            if (r == c) product *= rows[r][r];
        }
    const double scale = std::cbrt(volume / product);
    for (glm::dvec3& row : rows) row *= scale;
    return rows;
}

// As high as the first level, with the area that the surface had, as thick as it was taken for.
MeshPoint prismOf(MeshPoint point, const glm::dmat3& second, double volume,
                  const std::vector<double>& levels) {
    if (levels.size() < 2 || !(volume > 0)) return point;
    auto& rows = point.rows;
    const double area = volume / std::sqrt(12 * second[2][2]);
    const double scale = std::sqrt(area / (rows[0].x * rows[1].y));
    rows = {scale * glm::dvec3(rows[0].x, 0, 0),
            scale * glm::dvec3(rows[1].x, rows[1].y, 0),
            {0, 0, std::abs(levels[1] - levels[0])}};
    return point;
}

// For every point, the cells that it is of: those of point p stand from first[p] to first[p + 1].
struct Stars {
    std::vector<std::uint64_t> first;
    std::vector<std::uint32_t> cells;
    explicit Stars(const UnstructuredGrid& grid) : first(grid.points.size() + 2) {
        for (std::size_t cell = 0; cell < grid.types.size(); ++cell)
            for (const std::uint32_t point : listOf(grid.corners, grid.ends, cell))
                ++first[point + 2];
        for (std::size_t p = 2; p < first.size(); ++p) first[p] += first[p - 1];
        cells.resize(first.back());
        for (std::size_t cell = 0; cell < grid.types.size(); ++cell)
            for (const std::uint32_t point : listOf(grid.corners, grid.ends, cell))
                cells[first[point + 1]++] = static_cast<std::uint32_t>(cell);
    }
    std::span<const std::uint32_t> of(std::size_t point) const {
        return std::span(cells).subspan(first[point], first[point + 1] - first[point]);
    }
};

}  // namespace

std::string flawOf(const UnstructuredGrid& grid) {
    const std::size_t cells = grid.types.size();
    if (grid.ends.size() != cells) return "cells of other numbers of types and of lists of corners";
    const auto flawOfEnds = [&](const std::vector<std::uint64_t>& ends, std::size_t size) {
        for (std::size_t cell = 0; cell < ends.size(); ++cell)
            if (ends[cell] < (cell == 0 ? 0 : ends[cell - 1]) || ends[cell] > size)
                return fmt::format("cell {} ends at {} of {} entries", cell, ends[cell], size);
        return std::string();
    };
    if (const std::string flaw = flawOfEnds(grid.ends, grid.corners.size()); !flaw.empty())
        return flaw;
    for (std::size_t cell = 0; cell < cells; ++cell) {
        const auto corners = listOf(grid.corners, grid.ends, cell);
        for (const std::uint32_t point : corners)
            if (point >= grid.points.size())
                return fmt::format("cell {} has point {} of {}", cell, point, grid.points.size());
        const CellType* type = cellTypeOf(grid.types[cell]);
        if (type && corners.size() < type->corners)
            return fmt::format("cell {} of type {} has {} points, fewer than {}", cell,
                               grid.types[cell], corners.size(), type->corners);
    }
    const bool hasFaces = !grid.faceEnds.empty();
    if (hasFaces && grid.faceEnds.size() != cells) return "lists of faces of other cells";
    if (const std::string flaw = flawOfEnds(grid.faceEnds, grid.faces.size()); !flaw.empty())
        return "faces: " + flaw;
    for (std::size_t cell = 0; cell < cells; ++cell) {
        if (grid.types[cell] != kPolyhedron) continue;
        if (!hasFaces) return fmt::format("cell {} is a polyhedron without faces", cell);
        const auto list = listOf(grid.faces, grid.faceEnds, cell);
        std::size_t next = 1;
        for (std::uint32_t left = list.empty() ? 0 : list[0]; left > 0; --left) {
            const std::size_t corners = next < list.size() ? list[next] : list.size();
            if (corners >= list.size() - std::min(next, list.size()))
                return fmt::format("the faces of cell {} end early", cell);
            for (std::size_t i = 0; i < corners; ++i)
                if (list[next + 1 + i] >= grid.points.size())
                    return fmt::format("a face of cell {} has point {} of {}", cell,
                                       list[next + 1 + i], grid.points.size());
            next += 1 + corners;
        }
    }
    return "";
}

UnstructuredShapes::UnstructuredShapes(const UnstructuredGrid& grid)
    : cells(grid.types.size()), spread(spreadOf(grid)) {
    const Measure measure(grid);
    areScattered =
        measure.dimension() == 0 &&
        std::ranges::any_of(grid.types, [](std::uint8_t type) { return cellTypeOf(type); });
    inParts(cells.size(), threadsFor(cells.size(), kCellsAThread),
            [&](std::size_t first, std::size_t last) {
                for (std::size_t cell = first; cell < last; ++cell) cells[cell] = measure(cell);
            });
}

Mesh meshOfCells(const UnstructuredGrid& grid, const UnstructuredShapes& shapes,
                 const std::vector<double>& levels, const std::vector<glm::dvec3>& places) {
    if (shapes.areScattered) {
        std::vector<glm::dvec3> at;
        for (const CellMoments& cell : shapes.cells) at.push_back(cell.centroid);
        return meshOfScattered(at);
    }
    const auto point = [&](std::uint64_t cell) {
        const CellMoments& of = shapes.cells[cell];
        const bool hasPlace = !places.empty() && isPlace(places[cell]);
        const glm::dvec3& at = hasPlace ? places[cell] : of.centroid;
        return prismOf({at, rowsOf(of.second, of.volume)}, of.second, of.volume, levels);
    };
    return Mesh(grid.types.size(), grid.points.empty() ? places : grid.points, shapes.spread, point,
                levels);
}

Mesh meshOfPoints(const UnstructuredGrid& grid, const UnstructuredShapes& shapes,
                  const std::vector<double>& levels, std::uint64_t count) {
    count = std::min<std::uint64_t>(count, grid.points.size());
    if (shapes.areScattered)
        return meshOfScattered({grid.points.begin(), grid.points.begin() + std::ptrdiff_t(count)});
    const Stars stars(grid);
    const auto pointOf = [&](std::uint64_t point) {
        const glm::dvec3& at = grid.points[point];
        double volume = 0, whole = 0;
        glm::dmat3 second(0.0);
        for (const std::uint32_t cell : stars.of(point)) {
            const CellMoments& of = shapes.cells[cell];
            if (!(of.volume > 0)) continue;
            const std::uint64_t first = cell == 0 ? 0 : grid.ends[cell - 1];
            volume += of.volume / static_cast<double>(grid.ends[cell] - first);
            whole += of.volume;
            const glm::dvec3 away = of.centroid - at;
            second += of.volume * (of.second + glm::outerProduct(away, away));
        }
        if (whole > 0) second /= whole;
        return prismOf({at, rowsOf(second, volume)}, second, volume, levels);
    };
    return Mesh(count, grid.points, shapes.spread, pointOf, levels,
                levels.empty() ? SolidCells::of(grid, count) : nullptr);
}

std::vector<std::string> notesOf(const UnstructuredGrid& grid) {
    const auto curved = std::ranges::count_if(grid.types, [](std::uint8_t number) {
        const CellType* type = cellTypeOf(number);
        return type && type->isCurved;
    });
    if (curved == 0) return {};
    return {fmt::format("{} of {} cells are curved: taken as straight between their corners",
                        curved, grid.types.size())};
}

}  // namespace timeseries
