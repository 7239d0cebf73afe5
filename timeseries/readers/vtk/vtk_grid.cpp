#include "timeseries/readers/vtk/vtk_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "timeseries/grid/middles.h"
#include "timeseries/grid/without_cells.h"
#include "timeseries/readers/image_grid.h"

namespace timeseries {
namespace {

constexpr std::array kIndices{"i", "j", "k"};

VtkGrid structuredGridOf(const VtkHeader& header, VtkPlace place) {
    VtkGrid result;
    const auto size = header.size(place);
    result.layout = {{size[0], size[1], size[2]}, {1, size[0], size[0] * size[1]}};
    try {
        MeshPlaces places{.size = result.layout.size, .at = {}};
        if (place == VtkPlace::Points) {
            places.at = header.places;
        } else {
            places.corners = {header.size(VtkPlace::Points), header.places};
            places.at = middlesOf(header.places, places.corners.size);
        }
        const auto mesh = std::make_shared<const Mesh>(places);
        result.notes = notesOf(*mesh);
        result.grid = std::make_shared<Grid>(spaceAxes(), mesh);
    } catch (const std::invalid_argument& flaw) {
        result.notes.push_back(fmt::format("drawn in index space: {}", flaw.what()));
        std::array<Axis, 3> axes;
        for (std::size_t a = 0; a < 3; ++a)
            axes[a] = {kIndices[a], "index", indexCoordinates(size[a]), false};
        result.grid = std::make_shared<Grid>(std::move(axes));
    }
    return result;
}

}  // namespace

UnstructuredShapes vtkShapesOf(const VtkHeader& header) {
    if (const std::string flaw = flawOf(header.unstructured); !flaw.empty())
        failVtk(header.path, "Cells",
                "expected cells of points that there are, found that " + flaw);
    UnstructuredShapes shapes(header.unstructured);
    // Points without any cell are as good as points that are one each.
    if (header.unstructured.types.empty()) shapes.areScattered = true;
    return shapes;
}

VtkGrid vtkGridOf(const VtkHeader& header, VtkPlace place, const UnstructuredShapes& shapes) {
    const UnstructuredGrid& cells = header.unstructured;
    VtkGrid result;
    const std::uint64_t count = header.count(place);
    result.layout = {{count, 1, 1}, {1, count, count}};
    try {
        const auto mesh = std::make_shared<const Mesh>(
            place == VtkPlace::Points ? meshOfPointsWithout(header.ghostCells, cells, shapes)
                                      : meshOfCells(cells, shapes));
        result.notes = notesOf(cells);
        std::ranges::copy(notesOf(*mesh), std::back_inserter(result.notes));
        result.grid = std::make_shared<Grid>(spaceAxes(), mesh);
    } catch (const std::invalid_argument& flaw) {
        failVtk(header.path, "Cells",
                fmt::format("expected cells that take space, found that {}", flaw.what()));
    }
    return result;
}

VtkGrid vtkGridOf(const VtkHeader& header, VtkPlace place) {
    if (isStructured(header.kind)) return structuredGridOf(header, place);
    const bool image = header.kind == VtkKind::XmlImage || header.kind == VtkKind::LegacyPoints;
    ImagePlaces places{.points = header.size(VtkPlace::Points),
                       .origin = header.origin,
                       .spacing = header.spacing,
                       .direction = header.direction};
    for (std::size_t i = 0; i < 3; ++i) places.first[i] = header.extent[i][0];
    if (!image) places.coordinates = header.coordinates;
    PlacedImage placed = placedImage(places, place == VtkPlace::Cells);
    return {std::move(placed.grid), placed.layout, std::move(placed.notes)};
}

}  // namespace timeseries
