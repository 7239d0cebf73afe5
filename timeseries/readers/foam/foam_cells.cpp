#include "timeseries/readers/foam/foam_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "timeseries/grid/cell_types.h"

namespace timeseries {
namespace {

using Face = std::span<const std::uint32_t>;

constexpr std::uint8_t kTetrahedron = 10, kHexahedronCell = 12, kPyramidCell = 14;

bool isIn(Face face, std::uint32_t point) { return std::ranges::find(face, point) != face.end(); }

// The shape that so many triangles and quadrilaterals may bound; 0: none.
std::uint8_t shapeOf(std::span<const Face> faces) {
    std::size_t triangles = 0, quads = 0;
    for (const Face face : faces) (face.size() == 3 ? triangles : quads) += 1;
    if (std::ranges::any_of(faces, [](Face face) { return face.size() > 4; })) return 0;
    if (triangles == 4 && quads == 0) return kTetrahedron;
    if (triangles == 4 && quads == 1) return kPyramidCell;
    if (triangles == 2 && quads == 3) return kWedgeCell;
    return triangles == 0 && quads == 6 ? kHexahedronCell : 0;
}

// The corner that an edge joins to this one of the base, beside it; none where there is none.
std::optional<std::uint32_t> cornerAbove(std::span<const Face> faces, Face base,
                                         std::uint32_t corner) {
    for (const Face face : faces) {
        if (face.data() == base.data()) continue;
        for (std::size_t i = 0; i < face.size(); ++i) {
            const std::uint32_t a = face[i], b = face[(i + 1) % face.size()];
            if (a == corner && !isIn(base, b)) return b;
            if (b == corner && !isIn(base, a)) return a;
        }
    }
    return std::nullopt;
}

// Whether these are the corners of a cell of the type that the faces bound.
bool bound(std::span<const Face> faces, const CellType& type, Face corners) {
    for (std::size_t i = 0; i < corners.size(); ++i)
        if (isIn(corners.subspan(i + 1), corners[i])) return false;
    std::size_t first = 0;
    for (const std::uint8_t size : type.faceSizes) {
        const auto isThis = [&](Face face) {
            if (face.size() != size) return false;
            for (std::size_t i = 0; i < size; ++i)
                if (!isIn(face, corners[type.faces[first + i]])) return false;
            return true;
        };
        if (std::ranges::none_of(faces, isThis)) return false;
        first += size;
    }
    return true;
}

// The corners of the shape in the order of cell_types.h, so many; false where it is none.
bool cornersOf(std::uint8_t shape, std::span<const Face> faces,
               PageVector<std::uint32_t>& corners) {
    const CellType& type = *cellTypeOf(shape);
    const std::size_t sides = shape == kTetrahedron || shape == kWedgeCell ? 3 : 4;
    const Face base = *std::ranges::find(faces, sides, &Face::size);
    const std::size_t first = corners.size();
    corners.insert(corners.end(), base.begin(), base.end());
    for (std::size_t i = 0; corners.size() < first + type.corners; ++i) {
        const auto above = cornerAbove(faces, base, base[i]);
        if (!above) break;
        corners.push_back(*above);
    }
    if (corners.size() == first + type.corners && bound(faces, type, Face(corners).subspan(first)))
        return true;
    corners.resize(first);
    return false;
}

void addPolyhedron(std::span<const Face> faces, UnstructuredGrid& grid) {
    const auto first = static_cast<std::ptrdiff_t>(grid.corners.size());
    grid.faces.push_back(static_cast<std::uint32_t>(faces.size()));
    for (const Face face : faces) {
        grid.faces.push_back(static_cast<std::uint32_t>(face.size()));
        grid.faces.insert(grid.faces.end(), face.begin(), face.end());
        grid.corners.insert(grid.corners.end(), face.begin(), face.end());
    }
    std::sort(grid.corners.begin() + first, grid.corners.end());
    grid.corners.erase(std::unique(grid.corners.begin() + first, grid.corners.end()),
                       grid.corners.end());
}

// Of each cell its faces, those of the cell before it first, and where they end.
struct FaceLists {
    std::vector<std::uint64_t> ends;
    std::vector<std::uint32_t> faces;
    explicit FaceLists(const FacesOfCells& of) : ends(of.cells() + 2) {
        const auto forEach = [&](const auto& use) {
            for (std::uint32_t face = 0; face < of.owner.size(); ++face) {
                use(of.owner[face], face);
                if (face < of.neighbour.size() && of.neighbour[face] != kNoPoint)
                    use(of.neighbour[face], face);
            }
        };
        forEach([&](std::uint32_t cell, std::uint32_t) { ++ends[cell + 2]; });
        for (std::size_t i = 2; i < ends.size(); ++i) ends[i] += ends[i - 1];
        faces.resize(ends.back());
        forEach([&](std::uint32_t cell, std::uint32_t face) { faces[ends[cell + 1]++] = face; });
        ends.pop_back();
    }
};

}  // namespace

std::uint64_t FacesOfCells::cells() const {
    std::uint64_t count = 0;
    for (const auto* const list : {&owner, &neighbour})
        for (const std::uint32_t cell : *list)
            if (cell != kNoPoint) count = std::max<std::uint64_t>(count, cell + std::uint64_t{1});
    return count;
}

std::string addCells(FacesOfCells faces, std::uint32_t firstPoint, UnstructuredGrid& grid) {
    for (std::uint32_t& point : faces.corners) point += firstPoint;
    const FaceLists lists(faces);
    std::vector<Face> own;
    for (std::size_t cell = 0; cell + 1 < lists.ends.size(); ++cell) {
        own.clear();
        for (std::uint64_t i = lists.ends[cell]; i < lists.ends[cell + 1]; ++i) {
            const std::uint32_t face = lists.faces[i];
            const std::uint64_t first = face == 0 ? 0 : faces.ends[face - 1];
            own.push_back(Face(faces.corners).subspan(first, faces.ends[face] - first));
        }
        if (own.size() < 4)
            return fmt::format("cell {} has {} faces, fewer than 4", cell, own.size());
        const std::uint8_t shape = shapeOf(own);
        const bool isShape = shape != 0 && cornersOf(shape, own, grid.corners);
        if (!isShape) {
            grid.faceEnds.resize(grid.types.size(), grid.faces.size());
            addPolyhedron(own, grid);
        }
        grid.types.push_back(isShape ? shape : kPolyhedron);
        grid.ends.push_back(grid.corners.size());
        if (!grid.faces.empty()) grid.faceEnds.resize(grid.types.size(), grid.faces.size());
    }
    return "";
}

}  // namespace timeseries
