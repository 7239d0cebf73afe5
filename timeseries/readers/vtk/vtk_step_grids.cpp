#include "timeseries/readers/vtk/vtk_step_grids.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "timeseries/grid/mesh.h"
#include "timeseries/readers/ordinary_file.h"
#include "timeseries/readers/vtk/vtk_file.h"
#include "timeseries/readers/vtk/vtk_parts.h"

namespace timeseries {
namespace {

struct Counts {
    std::uint64_t points = 0, cells = 0;
    void add(const XmlFile& file) {
        if (isEmptyVtkFile(file)) return;
        for (const VtkPiece& piece : readVtkXmlHeader(file).pieces) {
            points += piece.points;
            cells += piece.cells;
        }
    }
};

// Nothing where a header does not count them: of blocks, and of legacy files, whose words stand
// between values.
std::optional<Counts> countsOf(const std::filesystem::path& path) {
    expectFile(path);
    if (isVtkLegacy(path) || isVtkSeries(path)) return std::nullopt;
    const XmlFile file = readXml(path);
    const std::string_view type = file.root.attribute("type");
    Counts counts;
    if (type == "PUnstructuredGrid" || type == "PPolyData")
        forEachVtkPart(file, [&](const XmlFile& part) {
            counts.add(part);
            return true;
        });
    else if (type == "UnstructuredGrid" || type == "PolyData")
        counts.add(file);
    else
        return std::nullopt;
    return counts;
}

std::optional<Counts> countsOf(const VtkMember& member) try {
    auto all = countsOf(member.path);
    for (const auto& path : member.beside) {
        const auto more = countsOf(path);
        if (!all || !more) return std::nullopt;
        all->points += more->points;
        all->cells += more->cells;
    }
    return all;
} catch (const FileError&) {
    return std::nullopt;
}

// The least and the most, where all tell it and they are few enough to look at each.
std::optional<std::pair<Counts, Counts>> rangeOf(std::span<const VtkMember> members) {
    constexpr std::size_t kMostLookedAt = 256;
    if (members.size() > kMostLookedAt) return std::nullopt;
    constexpr std::uint64_t kMax = std::numeric_limits<std::uint64_t>::max();
    Counts least{kMax, kMax}, most;
    for (const VtkMember& member : members) {
        const auto counts = countsOf(member);
        if (!counts) return std::nullopt;
        least = {std::min(least.points, counts->points), std::min(least.cells, counts->cells)};
        most = {std::max(most.points, counts->points), std::max(most.cells, counts->cells)};
    }
    return std::pair(least, most);
}

StepGrids::Are heldAgainst(const VtkMember& first, const VtkMember& other) try {
    const VtkHeader a = vtkContentsOf(first).whole, b = vtkContentsOf(other).whole;
    if (isStructured(a.kind))
        return a.places == b.places ? StepGrids::Are::One : StepGrids::Are::Moved;
    const UnstructuredGrid &one = a.unstructured, &its = b.unstructured;
    const bool joinedAlike = one.points.size() == its.points.size() && one.types == its.types &&
                             one.ends == its.ends && one.corners == its.corners &&
                             one.faceEnds == its.faceEnds && one.faces == its.faces;
    if (!joinedAlike) return StepGrids::Are::Own;
    return one.points == its.points ? StepGrids::Are::One : StepGrids::Are::Moved;
} catch (const FileError&) {
    return StepGrids::Are::One;
}

}  // namespace

StepGrids vtkStepGrids(std::span<const VtkMember> members, const Grid& first) {
    if (members.size() == 1 || !first.mesh()) return {};
    const bool atCells = first.mesh()->about().points == MeshAbout::Points::Cells;
    StepGrids grids;
    if (const auto range = first.mesh()->hasNeighbours() ? std::nullopt : rangeOf(members)) {
        const auto& [least, most] = *range;
        grids.least = atCells ? least.cells : least.points;
        grids.most = atCells ? most.cells : most.points;
        if (least.points != most.points || least.cells != most.cells)
            grids.are = StepGrids::Are::Own;
    }
    if (grids.are != StepGrids::Are::Own) grids.are = heldAgainst(members.front(), members.back());
    return grids;
}

}  // namespace timeseries
