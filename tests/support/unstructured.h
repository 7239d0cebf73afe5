// Unstructured grids of a lattice of bricks, cut into other cells.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "timeseries/grid/cell_types.h"
#include "timeseries/grid/grid.h"
#include "timeseries/grid/solid_cells.h"
#include "timeseries/grid/unstructured.h"

namespace tests {

inline void addCell(timeseries::UnstructuredGrid& grid, std::uint8_t type,
                    std::initializer_list<std::uint32_t> corners) {
    grid.types.push_back(type);
    grid.corners.insert(grid.corners.end(), corners);
    grid.ends.push_back(grid.corners.size());
}

enum class Cut { Hexahedra, Voxels, Tetrahedra, Wedges, Polyhedra };
inline constexpr std::array kCuts{Cut::Hexahedra, Cut::Voxels, Cut::Tetrahedra, Cut::Wedges,
                                  Cut::Polyhedra};

// size[a] points along each index, at place(i, j, k) of doubles. A brick is five tetrahedra, turned
// from one to the next, or two wedges.
template <typename Place>
timeseries::UnstructuredGrid bricks(std::array<std::uint32_t, 3> size, Cut cut,
                                    const Place& place) {
    timeseries::UnstructuredGrid grid;
    const auto [ni, nj, nk] = size;
    for (std::uint32_t k = 0; k < nk; ++k)
        for (std::uint32_t j = 0; j < nj; ++j)
            for (std::uint32_t i = 0; i < ni; ++i)
                grid.points.push_back(place(double(i), double(j), double(k)));
    for (std::uint32_t k = 0; k + 1 < nk; ++k)
        for (std::uint32_t j = 0; j + 1 < nj; ++j)
            for (std::uint32_t i = 0; i + 1 < ni; ++i) {
                std::array<std::uint32_t, 8> c;  // as of a voxel
                for (std::uint32_t n = 0; n < 8; ++n)
                    c[n] = i + (n & 1) + ni * (j + (n >> 1 & 1) + nj * (k + (n >> 2)));
                switch (cut) {
                    case Cut::Voxels:
                        addCell(grid, 11, {c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7]});
                        break;
                    case Cut::Hexahedra:
                        addCell(grid, 12, {c[0], c[1], c[3], c[2], c[4], c[5], c[7], c[6]});
                        break;
                    case Cut::Wedges:
                        addCell(grid, 13, {c[0], c[2], c[1], c[4], c[6], c[5]});
                        addCell(grid, 13, {c[1], c[2], c[3], c[5], c[6], c[7]});
                        break;
                    case Cut::Tetrahedra: {
                        const std::uint32_t flip = (i + j + k) % 2;
                        const auto at = [&](std::uint32_t n) { return c[n ^ flip]; };
                        addCell(grid, 10, {at(0), at(1), at(2), at(4)});
                        addCell(grid, 10, {at(3), at(1), at(2), at(7)});
                        addCell(grid, 10, {at(5), at(1), at(4), at(7)});
                        addCell(grid, 10, {at(6), at(2), at(4), at(7)});
                        addCell(grid, 10, {at(1), at(2), at(4), at(7)});
                        break;
                    }
                    case Cut::Polyhedra: {
                        addCell(grid, timeseries::kPolyhedron,
                                {c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7]});
                        const auto& voxel = *timeseries::cellTypeOf(11);
                        grid.faces.push_back(6);
                        for (std::size_t n = 0; n < voxel.faces.size(); ++n) {
                            if (n % 4 == 0) grid.faces.push_back(4);
                            grid.faces.push_back(c[voxel.faces[n]]);
                        }
                        grid.faceEnds.push_back(grid.faces.size());
                        break;
                    }
                }
            }
    return grid;
}

// The same cells of points that are numbered otherwise.
inline timeseries::UnstructuredGrid renumbered(const timeseries::UnstructuredGrid& grid,
                                               std::mt19937& random) {
    std::vector<std::uint32_t> to(grid.points.size());
    std::iota(to.begin(), to.end(), 0u);
    std::ranges::shuffle(to, random);
    timeseries::UnstructuredGrid out = grid;
    for (std::size_t i = 0; i < to.size(); ++i) out.points[to[i]] = grid.points[i];
    for (std::uint32_t& corner : out.corners) corner = to[corner];
    for (std::size_t cell = 0; cell < grid.faceEnds.size(); ++cell)
        for (std::size_t at = (cell == 0 ? 0 : grid.faceEnds[cell - 1]) + 1;
             at < grid.faceEnds[cell]; at += 1 + grid.faces[at])
            for (std::size_t i = 1; i <= grid.faces[at]; ++i)
                out.faces[at + i] = to[grid.faces[at + i]];
    return out;
}

// Bent inside a box of 4 x 3 x 5, whose sides stay flat.
inline glm::dvec3 bent(double i, double j, double k) {
    const double inside = i * (4 - i) * j * (3 - j) * k * (5 - k) / 100;
    return {i + 0.3 * inside, j - 0.2 * inside, k + 0.25 * inside};
}
inline timeseries::UnstructuredGrid bentBricks(Cut cut) { return bricks({5, 4, 6}, cut, bent); }

inline timeseries::Mesh atCells(const timeseries::UnstructuredGrid& grid) {
    return meshOfCells(grid, timeseries::UnstructuredShapes(grid));
}
inline timeseries::Mesh atPoints(const timeseries::UnstructuredGrid& grid) {
    return meshOfPoints(grid, timeseries::UnstructuredShapes(grid));
}

// Of the cell that a point stands for.
inline double volume(const timeseries::Mesh& mesh, std::uint64_t index) {
    return mesh.volume(index);
}
inline double volume(const timeseries::Mesh& mesh) {
    double sum = 0;
    for (std::uint64_t i = 0; i < mesh.count(); ++i) sum += volume(mesh, i);
    return sum;
}

// Of what lies between its points, the shorter way round.
inline double volumeBetween(const timeseries::Mesh& mesh) {
    const timeseries::SolidCells& solids = *mesh.solids();
    double sum = 0;
    for (std::uint64_t cell = 0; cell < solids.count(); ++cell)
        solids.forEachTet(cell, [&](const std::array<std::uint32_t, 4>& points) {
            const auto way = [&](std::size_t i) {
                return timeseries::shorterWay(mesh.position(points[i]) - mesh.position(points[0]),
                                              mesh.period());
            };
            sum += std::abs(glm::dot(way(1), glm::cross(way(2), way(3)))) / 6;
        });
    return sum;
}

// How many nodes the cells of a mesh have between them, whose middles are its points.
inline std::size_t nodesOf(const timeseries::Mesh& mesh) {
    std::set<std::uint32_t> nodes;
    for (std::uint64_t cell = 0; cell < mesh.solids()->count(); ++cell)
        mesh.solids()->forEachNode(cell, [&](std::uint32_t node) { nodes.insert(node); });
    return nodes.size();
}

inline std::shared_ptr<const timeseries::Grid> gridOf(timeseries::Mesh mesh) {
    return std::make_shared<timeseries::Grid>(
        std::array{timeseries::Axis{"x", "m", {}}, timeseries::Axis{"y", "m", {}},
                   timeseries::Axis{"z", "m", {}}},
        std::make_shared<const timeseries::Mesh>(std::move(mesh)));
}

}  // namespace tests
