// What space the cells of unstructured grids take, and what of that is a guess.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <span>

#include "timeseries/grid/cell_types.h"
#include "timeseries/grid/solid_moments.h"
#include "timeseries/grid/unstructured.h"
#include "timeseries/together.h"

namespace timeseries {
namespace {

// Not finite where there are none.
glm::dvec3 centreOf(std::span<const glm::dvec3> places) {
    glm::dvec3 sum(places.empty() ? std::numeric_limits<double>::quiet_NaN() : 0.0);
    for (const glm::dvec3& place : places) sum += place / static_cast<double>(places.size());
    return sum;
}

// Of those whose type this is true.
template <typename Is>
std::uint64_t countOf(const TypeCounts& counts, const Is& is) {
    std::uint64_t count = 0;
    for (std::size_t number = 0; number < counts.size(); ++number)
        if (const CellType* type = cellTypeOf(static_cast<std::uint8_t>(number)); type && is(*type))
            count += counts[number];
    return count;
}

// How the cells of a grid measure: those of fewer dimensions than others take no space.
class Measure {
 public:
    Measure(const UnstructuredGrid& grid, int dimension, double thickness)
        : grid_(grid), dimension_(dimension), thickness_(thickness) {}
    // Solids from `first` on that are of one type, side by side, and how many they are: none where
    // this is a cell of another kind.
    std::size_t solids(std::size_t first, std::span<CellMoments> cells) const;
    // One of another kind.
    CellMoments operator()(std::size_t cell) const;
    double thickness() const;

 private:
    CellMoments plain(std::size_t cell) const;
    CellMoments polyhedron(std::size_t cell) const;
    void thicken(CellMoments& moments, std::size_t cell) const;
    std::vector<glm::dvec3>& cornersOf(std::size_t cell, const CellType& type) const;

    const UnstructuredGrid& grid_;
    int dimension_;
    double thickness_;
};

std::size_t Measure::solids(std::size_t first, std::span<CellMoments> cells) const {
    const std::uint8_t number = grid_.types[first];
    const CellType* const type = cellTypeOf(number);
    if (!type || type->dimension < 3 || number == kPolyhedron) return 0;
    thread_local SolidColumns columns;
    const std::size_t most = std::min(cells.size(), SolidColumns::kMost);
    std::size_t count = 0;
    for (; count < most && grid_.types[first + count] == number; ++count) {
        const auto corners = listOf(grid_.corners, grid_.ends, first + count);
        for (std::size_t i = 0; i < type->corners; ++i)
            columns.setCorner(count, i, grid_.points[corners[i]]);
    }
    measureSolids(*type, count, columns);
    for (std::size_t i = 0; i < count; ++i) cells[i] = columns.moments(i);
    return count;
}

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

}  // namespace

UnstructuredShapes::UnstructuredShapes(const UnstructuredGrid& grid) {
    const TypeCounts counts = countTypes(grid.types);
    const auto some = [&](int least) {
        return countOf(counts, [&](const CellType& type) { return type.dimension >= least; }) > 0;
    };
    while (dimension < 3 && some(dimension + 1)) ++dimension;
    areScattered = dimension == 0 && some(0);
    const std::uint64_t bricks = countOf(counts, [](const CellType& type) { return type.isBrick; });
    spread = 2 * bricks > grid.types.size() ? 1 : 1.5;
    if (dimension == 1 || dimension == 2) thickness = Measure(grid, dimension, 0).thickness();
}

void UnstructuredShapes::measure(const UnstructuredGrid& grid, std::uint64_t first,
                                 std::span<CellMoments> cells) const {
    const Measure measure(grid, dimension, thickness);
    for (std::size_t i = 0; i < cells.size();) {
        const std::size_t solids = measure.solids(first + i, cells.subspan(i));
        if (solids == 0) cells[i] = measure(first + i);
        i += std::max<std::size_t>(solids, 1);
    }
}

std::vector<std::string> notesOf(const UnstructuredGrid& grid) {
    const auto curved =
        countOf(countTypes(grid.types), [](const CellType& type) { return type.isCurved; });
    if (curved == 0) return {};
    return {fmt::format("{} of {} cells are curved: taken as straight between their corners",
                        curved, grid.types.size())};
}

}  // namespace timeseries
