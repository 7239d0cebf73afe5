#include "timeseries/readers/foam/foam_mesh.h"

#include <fmt/format.h>

#include "timeseries/readers/foam/foam_cells.h"
#include "timeseries/readers/foam/foam_file.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

void expectClass(const FoamFile& file, std::initializer_list<const char*> names) {
    const std::string& found = file.header().className;
    for (const char* const name : names)
        if (found == name) return;
    if (found == "decomposedBlockData")
        file.fail("expected a file that is not collated: reconstructPar makes such a case");
    file.fail(fmt::format("expected a {}, found a {}", *names.begin(), found));
}

std::vector<glm::dvec3> placesIn(const FoamMeshFiles& files) {
    FoamFile file(files.points);
    expectClass(file, {"vectorField"});
    const std::vector<double> all = file.rows<double>(3, 0, kNoPoint - 1);
    std::vector<glm::dvec3> places(all.size() / 3);
    for (std::size_t i = 0; i < places.size(); ++i)
        places[i] = {all[3 * i], all[3 * i + 1], all[3 * i + 2]};
    return places;
}

// Of a cell's number no more is believed than that it has four faces, each of two cells.
FacesOfCells facesIn(const FoamMeshFiles& files, std::uint64_t points) {
    FoamFile file(files.faces);
    expectClass(file, {"faceList", "faceCompactList"});
    auto [ends, corners] = file.lists(points, kNoPoint - 1);
    for (std::size_t face = 0; face < ends.size(); ++face)
        if (ends[face] - (face == 0 ? 0 : ends[face - 1]) < 3)
            file.fail(fmt::format("expected three points or more of face {}", face));
    const std::uint64_t count = ends.size(), mostCells = count / 2 + 1;
    FacesOfCells faces{std::move(ends), std::move(corners), {}, {}};
    FoamFile owner(files.owner), neighbour(files.neighbour);
    expectClass(owner, {"labelList"});
    faces.owner = owner.labels(0, mostCells, count);
    if (faces.owner.size() != count)
        owner.fail(
            fmt::format("expected the cells of {} faces, found {}", count, faces.owner.size()));
    expectClass(neighbour, {"labelList"});
    faces.neighbour = neighbour.labels(-1, mostCells, count);
    return faces;
}

}  // namespace

FoamMesh foamMeshOf(std::span<const FoamMeshFiles> parts) {
    FoamMesh mesh;
    mesh.grid.inParts = parts.size() > 1;
    for (const FoamMeshFiles& files : parts) {
        const std::vector<glm::dvec3> places = placesIn(files);
        FacesOfCells faces = facesIn(files, places.size());
        const std::uint64_t before = mesh.grid.points.size(), cells = mesh.grid.types.size();
        if (before + places.size() >= kNoPoint)
            throw FileError(fmt::format("{}: expected fewer than 2^32 points, found {}",
                                        files.points.string(), before + places.size()));
        mesh.grid.points.insert(mesh.grid.points.end(), places.begin(), places.end());
        if (const std::string flaw = addCells(std::move(faces), std::uint32_t(before), mesh.grid);
            !flaw.empty())
            throw FileError(fmt::format("{}: expected cells between faces, found that {}",
                                        files.owner.string(), flaw));
        mesh.points.push_back(places.size());
        mesh.cells.push_back(mesh.grid.types.size() - cells);
    }
    if (!parts.empty() && mesh.grid.types.empty())
        throw FileError(fmt::format("{}: expected a mesh that has cells", parts[0].faces.string()));
    return mesh;
}

}  // namespace timeseries
