#include "timeseries/readers/vtk/vtk_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "timeseries/grid/without_cells.h"
#include "timeseries/readers/vtk/vtk_library.h"
#include "timeseries/readers/vtk/vtk_xml_cells.h"
#include "timeseries/readers/vtk/vtk_xml_numbers.h"

namespace timeseries {
namespace {

void readGhosts(VtkHeader& header) {
    header.ghostCells = readVtkGhostCells(header);
    if (!isUnstructured(header.kind))
        header.pointsOfGhosts = pointsOfGhosts(header.ghostCells, header.size(VtkPlace::Points));
    // A flaw is told when the cells are looked at.
    else if (!header.ghostCells.empty() && flawOf(header.unstructured).empty())
        header.pointsOfGhosts = pointsOfGhosts(header.ghostCells, header.unstructured);
}

}  // namespace

bool isVtkLegacy(const std::filesystem::path& path) {
    std::string start(5, '\0');
    std::ifstream(path, std::ios::binary).read(start.data(), 5);
    return start == "# vtk";
}

bool isVtkSeries(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    char first = 0;
    return file >> first && first == '{';
}

VtkHeader openVtkLegacy(const std::filesystem::path& path) {
    VtkHeader header = readVtkLegacyHeader(path);
    if (isStructured(header.kind)) header.places = readVtkFrame(header).places;
    readGhosts(header);
    return header;
}

VtkHeader openVtkXml(const XmlFile& file) {
    VtkHeader header = readVtkXmlHeader(file);
    VtkFrame frame = readVtkFrame(header);
    header.coordinates = std::move(frame.coordinates);
    header.places = std::move(frame.places);
    header.unstructured = std::move(frame.unstructured);
    header.time = frame.time;
    readGhosts(header);
    if (header.kind == VtkKind::XmlRectilinear)
        for (std::size_t i = 0; i < 3; ++i)
            if (header.coordinates[i].size() != header.size(VtkPlace::Points)[i])
                failVtk(
                    file.path, "Coordinates",
                    fmt::format("expected {} along {}, found {}", header.size(VtkPlace::Points)[i],
                                "xyz"[i], header.coordinates[i].size()));
    return header;
}

bool isEmptyVtkFile(const XmlFile& file) {
    const std::string_view type = rootOf(file).attribute("type");
    const auto grids = named(file.root, type);
    if (grids.size() != 1) return false;
    if (type == "UnstructuredGrid" || type == "PolyData")
        return std::ranges::all_of(named(*grids[0], "Piece"), [&](const XmlElement* each) {
            return isEmptyVtkPiece(file, *each);
        });
    return isEmptyVtkExtent(vtkExtentOf(file, *grids[0], "WholeExtent"));
}

}  // namespace timeseries
