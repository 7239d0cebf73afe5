#include "timeseries/readers/amrex/amrex_grid.h"

#include <algorithm>
#include <cmath>

#include "timeseries/grid/cell_types.h"
#include "timeseries/grid/solid_cells.h"
#include "timeseries/grid/unstructured.h"

namespace timeseries {
namespace {

// Of a level's cells: their sides, and the middle of one.
struct Lattice {
    glm::dvec3 lo, side;
    std::array<std::int64_t, 3> first;

    glm::dvec3 middle(const std::array<std::int64_t, 3>& cell) const {
        glm::dvec3 at;
        for (int a = 0; a < 3; ++a)
            at[a] = along(static_cast<std::size_t>(a), cell[std::size_t(a)]);
        return at;
    }
    double along(std::size_t a, std::int64_t cell) const {
        const int c = static_cast<int>(a);
        return lo[c] + side[c] * (static_cast<double>(cell - first[a]) + 0.5);
    }
    // A cell's first corner; the next one's is its last.
    glm::dvec3 corner(const std::array<std::int64_t, 3>& cell) const {
        glm::dvec3 at;
        for (std::size_t a = 0; a < 3; ++a) {
            const int c = static_cast<int>(a);
            at[c] = lo[c] + side[c] * static_cast<double>(cell[a] - first[a]);
        }
        return at;
    }
};

Lattice latticeOf(const AmrexPlotfile& file, std::size_t level) {
    const IndexBox& domain = file.lattice[level].domain;
    Lattice lattice{file.lo, glm::dvec3(0), domain.first};
    for (std::size_t a = 0; a < file.dimensions; ++a) {
        const int c = static_cast<int>(a);
        lattice.side[c] = (file.hi[c] - file.lo[c]) / static_cast<double>(domain.size()[a]);
    }
    return lattice;
}

// What boxes without common cells fill, if they leave nothing of it out.
std::optional<IndexBox> filledBy(const std::vector<IndexBox>& boxes) {
    IndexBox bounds = boxes[0];
    std::uint64_t count = 0;
    for (const IndexBox& box : boxes) {
        count += box.count();
        bounds = around(bounds, box);
    }
    return count == bounds.count() ? std::optional(bounds) : std::nullopt;
}

Grid uprightGrid(const AmrexPlotfile& file, const IndexBox& whole) {
    const Lattice lattice = latticeOf(file, 0);
    std::array<Axis, 3> axes = spaceAxes();
    for (std::size_t a = 0; a < 3; ++a)
        for (std::int64_t i = whole.first[a]; i <= whole.last[a]; ++i)
            axes[a].coordinates.push_back(lattice.along(a, i));
    return Grid(std::move(axes));
}

// A cell that no other covers: of which box of all levels', which one.
struct Leaf {
    std::uint32_t box, cell;
};
struct LeafBox {
    IndexBox cells;
    std::size_t level;
    std::array<std::int64_t, 3> at(const std::array<std::uint64_t, 3>& size,
                                   std::uint64_t number) const {
        const auto along = indicesOf<std::uint64_t>(number, {size[0], size[1], size[2]});
        std::array<std::int64_t, 3> place = cells.first;
        for (std::size_t a = 0; a < 3; ++a)
            place[a] += static_cast<std::int64_t>(along[static_cast<int>(a)]);
        return place;
    }
};

// With their corners, of which each box has its own.
UnstructuredGrid cellsOf(std::span<const Leaf> leaves, std::span<const LeafBox> boxes,
                         std::span<const Lattice> lattices) {
    UnstructuredGrid grid;
    grid.inParts = true;
    grid.types.assign(leaves.size(), kVoxelCell);
    std::vector<std::uint32_t> numbers;  // of the box's corners: of points, where they are some
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        const LeafBox& box = boxes[leaves[i].box];
        const auto size = box.cells.size();
        const std::array<std::uint64_t, 3> corners{size[0] + 1, size[1] + 1, size[2] + 1};
        if (i == 0 || leaves[i].box != leaves[i - 1].box)
            numbers.assign(corners[0] * corners[1] * corners[2], kNoPoint);
        const auto at = indicesOf<std::uint64_t>(leaves[i].cell, {size[0], size[1], size[2]});
        for (std::uint64_t n = 0; n < 8; ++n) {
            const std::uint64_t number =
                at.x + (n & 1) +
                corners[0] * (at.y + (n >> 1 & 1) + corners[1] * (at.z + (n >> 2)));
            if (numbers[number] == kNoPoint) {
                numbers[number] = static_cast<std::uint32_t>(grid.points.size());
                grid.points.push_back(lattices[box.level].corner(box.at(corners, number)));
            }
            grid.corners.push_back(numbers[number]);
        }
        grid.ends.push_back(grid.corners.size());
    }
    return grid;
}

Grid gridOfLeaves(const AmrexPlotfile& file,
                  const std::vector<std::vector<std::vector<bool>>>& covered) {
    std::vector<LeafBox> boxes;
    std::vector<Lattice> lattices;
    std::vector<Leaf> leaves;
    double area = 0;  // of a layer
    for (std::size_t l = 0; l < file.lattice.size(); ++l) {
        lattices.push_back(latticeOf(file, l));
        for (std::size_t b = 0; b < file.lattice[l].boxes.size(); ++b) {
            const IndexBox& box = file.lattice[l].boxes[b];
            for (std::uint64_t cell = 0; cell < box.count(); ++cell)
                if (covered[l][b].empty() || !covered[l][b][cell]) {
                    leaves.push_back({static_cast<std::uint32_t>(boxes.size()),
                                      static_cast<std::uint32_t>(cell)});
                    area += lattices[l].side.x * lattices[l].side.y;
                }
            boxes.push_back({box, l});
        }
    }
    // As thick as its cells are wide in the mean, as of surfaces (unstructured.h).
    const double thickness = std::sqrt(area / static_cast<double>(leaves.size()));
    const auto point = [&](std::uint64_t index) {
        const Leaf& leaf = leaves[index];
        const LeafBox& box = boxes[leaf.box];
        const Lattice& lattice = lattices[box.level];
        glm::dvec3 side = lattice.side;
        if (file.dimensions == 2) side.z = thickness;
        return MeshPoint{lattice.middle(box.at(box.cells.size(), leaf.cell)),
                         {glm::dvec3(side.x, 0, 0), {0, side.y, 0}, {0, 0, side.z}}};
    };
    auto mesh = std::make_shared<Mesh>(leaves.size(), std::vector{file.lo, file.hi}, 1, point);
    MeshAbout about;
    about.points = MeshAbout::Points::Cells;
    about.cells = {{file.dimensions == 2 ? kPixelCell : kVoxelCell, leaves.size()}};
    about.levels = file.lattice.size();
    mesh->setAbout(std::move(about));
    constexpr std::size_t kMostWithCorners = std::size_t{1} << 25;  // or these take gigabytes
    if (file.dimensions == 3 && leaves.size() <= kMostWithCorners) {
        const UnstructuredGrid cells = cellsOf(leaves, boxes, lattices);
        mesh->setSolids(SolidCells::aboutMiddles(cells));
        mesh->setNodes(cells.points, {file.lo, file.hi});
    }
    return Grid(spaceAxes(), std::move(mesh));
}

}  // namespace

AmrexGrid amrexGridOf(const AmrexPlotfile& file, bool mayBeUpright) {
    AmrexGrid found;
    found.covered = coveredCells(file.lattice);
    if (mayBeUpright && file.lattice.size() == 1) found.whole = filledBy(file.lattice[0].boxes);
    found.grid = std::make_shared<const Grid>(found.whole ? uprightGrid(file, *found.whole)
                                                          : gridOfLeaves(file, found.covered));
    return found;
}

}  // namespace timeseries
