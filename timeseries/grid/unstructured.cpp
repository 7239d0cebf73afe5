#include "timeseries/grid/unstructured.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
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

// Near 1 sooner than others': its series leaves 4e-6 of it at most, Halley's step the cube of that.
double cubeRoot(double x) {
    const double away = x - 1;
    if (!(std::abs(away) < 0.1)) return std::cbrt(x);
    const double root = 1 + away * (1.0 / 3 - away * (1.0 / 9 - away * (5.0 / 81)));
    const double cube = root * root * root;
    return root * (cube + 2 * x) / (2 * cube + x);
}

// The steps whose cell reaches as far as these second moments, and has the volume.
void setSteps(const glm::dmat3& second, double volume, MeshPoint& point) {
    point.rows = {};
    if (!(volume > 0)) return;
    // 12 M = L L^T, but for what rounding leaves of a flat cell's.
    const glm::dmat3 m = 12.0 * second;
    const double least = 1e-18 * (m[0][0] + m[1][1] + m[2][2]);
    const auto root = [&](double square) { return std::sqrt(std::max(square, least)); };
    const double xx = root(m[0][0]), xy = m[0][1] / xx, xz = m[0][2] / xx;
    const double yy = root(m[1][1] - xy * xy), yz = (m[1][2] - xy * xz) / yy;
    const double zz = root(m[2][2] - xz * xz - yz * yz);
    const double scale = cubeRoot(volume / (xx * yy * zz));
    point.rows[0].x = scale * xx;
    point.rows[1].x = scale * xy;
    point.rows[1].y = scale * yy;
    point.rows[2].x = scale * xz;
    point.rows[2].y = scale * yz;
    point.rows[2].z = scale * zz;
}

// As high as the first level, with the area that the surface had, as thick as it was taken for.
void makePrism(const glm::dmat3& second, double volume, const std::vector<double>& levels,
               MeshPoint& point) {
    if (levels.size() < 2 || !(volume > 0)) return;
    auto& rows = point.rows;
    const double area = volume / std::sqrt(12 * second[2][2]);
    const double scale = std::sqrt(area / (rows[0].x * rows[1].y));
    rows = {scale * glm::dvec3(rows[0].x, 0, 0),
            scale * glm::dvec3(rows[1].x, rows[1].y, 0),
            {0, 0, std::abs(levels[1] - levels[0])}};
}

// For every point, the cells that it is of: those of point p stand from first[p] to first[p + 1].
struct Stars {
    std::vector<std::uint64_t> first;
    PageVector<std::uint32_t> cells;
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

// Of a number of points, those that cells are of: what no cell has may lie anywhere.
template <typename IsUsed>
std::array<glm::dvec3, 2> boxOf(const UnstructuredGrid& grid, const IsUsed& isUsed) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    std::array<glm::dvec3, 2> box{glm::dvec3(kInfinity), glm::dvec3(-kInfinity)};
    for (std::size_t p = 0; p < grid.points.size(); ++p) {
        if (!isUsed(p) || !isPlace(grid.points[p])) continue;
        box[0] = glm::min(box[0], grid.points[p]);
        box[1] = glm::max(box[1], grid.points[p]);
    }
    return box;
}

std::array<glm::dvec3, 2> boxOf(const UnstructuredGrid& grid) {
    std::vector<std::uint8_t> used(grid.points.size());
    // More corners are no cell's.
    const std::uint64_t corners = grid.ends.empty() || grid.points.empty() ? 0 : grid.ends.back();
    inParts(corners, threadsFor(corners, kCellsAThread), [&](std::size_t first, std::size_t last) {
        for (; first < last; ++first)
            std::atomic_ref(used[grid.corners[first]]).store(1, std::memory_order_relaxed);
    });
    return boxOf(grid, [&](std::size_t p) { return used[p] != 0; });
}

// Whether any solid has these: a ball reaches least far, and fills 1.13 times the brick that has
// its second moments.
bool areOfASolid(const CellMoments& of) {
    const glm::dmat3 m = 12.0 * of.second;
    const double face = m[0][0] * m[1][1] - m[0][1] * m[0][1];
    return m[0][0] >= 0 && face >= 0 && of.volume * of.volume <= 1.3 * glm::determinant(m);
}

// The same, but where the centroid lies beside a solid or mass would be beyond its corners or
// nowhere, as of one that crosses itself, those of a brick with corners as far apart.
CellMoments withinCell(const UnstructuredGrid& grid, std::size_t cell, const CellMoments& of) {
    constexpr double kRounded = 1e-6;  // of the cell
    const CellType* const type = cellTypeOf(grid.types[cell]);
    // Of a polyhedron other corners than its own may be listed.
    if (!type || type->dimension != 3 || grid.types[cell] == kPolyhedron || !(of.volume > 0))
        return of;
    const auto corners = listOf(grid.corners, grid.ends, cell).first(type->corners);
    const auto count = static_cast<double>(corners.size());
    glm::dvec3 lo(std::numeric_limits<double>::infinity()), hi = -lo, mean(0);
    for (const std::uint32_t corner : corners) {
        const glm::dvec3& at = grid.points[corner];
        lo = glm::min(lo, at);
        hi = glm::max(hi, at);
        mean += at / count;
    }
    const glm::dvec3 beside = glm::max(lo - of.centroid, of.centroid - hi), side = hi - lo;
    const double most = std::max({side.x, side.y, side.z});
    bool isWithin =
        !(std::max({beside.x, beside.y, beside.z}) > kRounded * most) && areOfASolid(of);
    for (int c = 0; c < 3; ++c)
        isWithin =
            isWithin && !(of.second[c][c] > 0.25 * side[c] * side[c] + kRounded * most * most);
    if (isWithin) return of;
    glm::dmat3 second(0.0);
    for (const std::uint32_t corner : corners) {
        const glm::dvec3 away = grid.points[corner] - mean;
        second += glm::outerProduct(away, away) / (3 * count);
    }
    return {of.volume, mean, second};
}

// Of all cells.
Pages<CellMoments> momentsOf(const UnstructuredGrid& grid, const UnstructuredShapes& shapes) {
    const std::size_t cells = grid.types.size();
    Pages<CellMoments> all(cells);
    inParts(cells, threadsFor(cells, kCellsAThread), [&](std::size_t first, std::size_t last) {
        shapes.measure(grid, first, {all.data() + first, all.data() + last});
        for (; first < last; ++first)
            all.data()[first] = withinCell(grid, first, all.data()[first]);
    });
    return all;
}

MeshAbout aboutOf(const UnstructuredGrid& grid, MeshAbout::Points points) {
    MeshAbout about = aboutCells(points, grid.types);
    about.levels = grid.levels;
    return about;
}

}  // namespace

Mesh meshOfCells(const UnstructuredGrid& grid, const UnstructuredShapes& shapes,
                 const std::vector<double>& levels, const std::vector<glm::dvec3>& places) {
    const std::size_t cells = grid.types.size();
    if (shapes.areScattered) {
        const auto moments = momentsOf(grid, shapes);
        std::vector<glm::dvec3> at;
        for (std::size_t i = 0; i < cells; ++i) at.push_back(moments.data()[i].centroid);
        return meshOfScattered(at);
    }
    const auto tell = [&](std::uint64_t first, std::span<MeshPoint> points) {
        std::array<CellMoments, Mesh::kMostAtOnce> moments;
        shapes.measure(grid, first, std::span(moments).first(points.size()));
        for (std::size_t i = 0; i < points.size(); ++i) {
            const CellMoments of = withinCell(grid, first + i, moments[i]);
            const bool hasPlace = !places.empty() && isPlace(places[first + i]);
            points[i].at = hasPlace ? places[first + i] : of.centroid;
            setSteps(of.second, of.volume, points[i]);
            makePrism(of.second, of.volume, levels, points[i]);
        }
    };
    const auto box = boxOf(grid);
    const std::span<const glm::dvec3> between = grid.points.empty() ? std::span(places) : box;
    Mesh mesh(cells, between, shapes.spread, tell, levels);
    if (shapes.dimension == 3 && levels.empty() && places.empty()) {
        mesh.setSolids(SolidCells::aboutMiddles(grid));
        if (mesh.solids()) mesh.setNodes(grid.points, {box[0], box[1]});
    }
    mesh.setAbout(aboutOf(grid, MeshAbout::Points::Cells));
    return mesh;
}

Mesh meshOfPoints(const UnstructuredGrid& grid, const UnstructuredShapes& shapes,
                  const std::vector<double>& levels, std::uint64_t count) {
    count = std::min<std::uint64_t>(count, grid.points.size());
    if (shapes.areScattered) return meshOfScattered(std::span(grid.points).first(count));
    const Stars stars(grid);
    const auto moments = momentsOf(grid, shapes);
    std::atomic<std::uint64_t> apart = 0, beside = 0;
    const auto isFlat = [&](std::uint32_t cell) {
        const CellType* type = cellTypeOf(grid.types[cell]);
        return type && type->dimension == shapes.dimension && !(moments.data()[cell].volume > 0);
    };
    const auto box = boxOf(grid, [&](std::size_t p) { return !stars.of(p).empty(); });
    const auto tellOne = [&](std::uint64_t index, MeshPoint& point) {
        point.at = grid.points[index];
        // Nobody sees where it is, and the others' box is not to be as large.
        if (isPlace(point.at) && stars.of(index).empty())
            point.at = glm::clamp(point.at, box[0], box[1]);
        double volume = 0, whole = 0;
        bool hasFlat = false;
        glm::dmat3 second(0.0);
        for (const std::uint32_t cell : stars.of(index)) {
            const CellMoments& of = moments.data()[cell];
            hasFlat = hasFlat || isFlat(cell);
            if (!(of.volume > 0)) continue;
            const std::uint64_t first = cell == 0 ? 0 : grid.ends[cell - 1];
            volume += of.volume / static_cast<double>(grid.ends[cell] - first);
            whole += of.volume;
            const glm::dvec3 away = of.centroid - point.at;
            second += of.volume * (of.second + glm::outerProduct(away, away));
        }
        if (whole > 0) second /= whole;
        if (isPlace(point.at) && stars.of(index).empty()) ++apart;
        if (isPlace(point.at) && whole > 0 && hasFlat) ++beside;
        setSteps(second, volume, point);
        makePrism(second, volume, levels, point);
    };
    const auto tell = [&](std::uint64_t first, std::span<MeshPoint> points) {
        for (MeshPoint& point : points) tellOne(first++, point);
    };
    Mesh mesh(count, box, shapes.spread, tell, levels);
    if (levels.empty()) mesh.setSolids(SolidCells::of(grid, count));
    MeshAbout about = aboutOf(grid, MeshAbout::Points::Corners);
    about.apart = apart * mesh.size()[2];
    about.beside = beside * mesh.size()[2];
    mesh.setAbout(std::move(about));
    return mesh;
}

}  // namespace timeseries
