#include "timeseries/readers/vtk/vtk_joined_cells.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace timeseries {
namespace {

void append(UnstructuredGrid& whole, UnstructuredGrid part, bool hasFaces) {
    const auto point = static_cast<std::uint32_t>(whole.points.size());
    const std::uint64_t corner = whole.corners.size(), face = whole.faces.size();
    // What names no point of its part names none of the whole.
    const std::uint64_t points = part.points.size();
    const auto moved = [&](std::uint32_t i) { return i < points ? i + point : kNoPoint; };
    for (const std::uint32_t i : part.corners) whole.corners.push_back(moved(i));
    for (const std::uint64_t end : part.ends) whole.ends.push_back(corner + end);
    std::ranges::copy(part.points, std::back_inserter(whole.points));
    std::ranges::copy(part.types, std::back_inserter(whole.types));
    if (!hasFaces) return;
    // A count of faces, then of each how many points, and which.
    std::uint64_t begin = 0;
    for (std::size_t cell = 0; cell < part.types.size(); ++cell) {
        const std::uint64_t end = part.faceEnds.empty() ? 0 : part.faceEnds[cell];
        std::uint32_t left = 0;
        for (std::uint64_t i = begin; i < std::min<std::uint64_t>(end, part.faces.size()); ++i) {
            const bool isPoint = left > 0;
            if (isPoint)
                --left;
            else if (i > begin)
                left = part.faces[i];
            if (isPoint) part.faces[i] = moved(part.faces[i]);
        }
        begin = std::max(begin, end);
        whole.faceEnds.push_back(face + end);
    }
    std::ranges::copy(part.faces, std::back_inserter(whole.faces));
}

}  // namespace

void joinVtkCells(VtkHeader& whole, std::span<VtkHeader> parts) {
    const bool hasFaces = std::ranges::any_of(
        parts, [](const VtkHeader& part) { return !part.unstructured.faceEnds.empty(); });
    const bool hasGhosts =
        std::ranges::any_of(parts, [](const VtkHeader& part) { return !part.ghostCells.empty(); });
    for (const VtkHeader& part : parts)
        std::ranges::copy(part.pieces, std::back_inserter(whole.pieces));
    checkVtkCount(whole, "pieces");
    whole.unstructured.inParts = whole.pieces.size() > 1;
    for (VtkHeader& part : parts) {
        // Before its numbers are those of all.
        if (const std::string flaw = flawOf(part.unstructured); !flaw.empty())
            failVtk(part.path, "Cells",
                    "expected cells of points that there are, found that " + flaw);
        const std::size_t before = whole.unstructured.types.size();
        append(whole.unstructured, std::move(part.unstructured), hasFaces);
        if (!hasGhosts) continue;
        part.ghostCells.resize(whole.unstructured.types.size() - before);
        std::ranges::copy(part.ghostCells, std::back_inserter(whole.ghostCells));
    }
}

}  // namespace timeseries
