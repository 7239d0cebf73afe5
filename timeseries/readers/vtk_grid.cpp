#include "timeseries/readers/vtk_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <stdexcept>

#include "timeseries/grid/middles.h"

namespace timeseries {
namespace {

constexpr std::array kNames{"x", "y", "z"}, kIndices{"i", "j", "k"};

// How an image's axes lie in space; `length` is of each as the file has it.
struct Directions {
    glm::dmat3 unit{1.0};
    glm::dvec3 length{1};
};

Directions directionsOf(const VtkHeader& header) {
    Directions found;
    for (int axis = 0; axis < 3; ++axis) {
        for (int c = 0; c < 3; ++c) found.unit[axis][c] = header.direction[3 * c + axis];
        const glm::dvec3& d = found.unit[axis];
        found.length[axis] = std::hypot(d.x, d.y, d.z);
        found.unit[axis] /= found.length[axis];
    }
    return found;
}

// An image's, at first + spacing n of index n.
std::vector<double> imageCoordinates(const VtkHeader& header, std::size_t axis, double first,
                                     double spacing) {
    auto coordinates = indexCoordinates(header.size(VtkPlace::Points)[axis]);
    for (double& c : coordinates)
        c = first + spacing * (c + static_cast<double>(header.extent[axis][0]));
    return coordinates;
}

VtkGrid structuredGridOf(const VtkHeader& header, VtkPlace place) {
    VtkGrid result;
    const auto size = header.size(place);
    result.layout = {{size[0], size[1], size[2]}, {1, size[0], size[0] * size[1]}};
    try {
        const auto mesh = std::make_shared<const Mesh>(
            MeshPlaces{.size = result.layout.size,
                       .at = place == VtkPlace::Points
                                 ? header.places
                                 : middlesOf(header.places, header.size(VtkPlace::Points))});
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
    if (shapes.cells.empty()) shapes.areScattered = true;
    return shapes;
}

VtkGrid vtkGridOf(const VtkHeader& header, VtkPlace place, const UnstructuredShapes& shapes) {
    const UnstructuredGrid& cells = header.unstructured;
    VtkGrid result;
    const std::uint64_t count = header.count(place);
    result.layout = {{count, 1, 1}, {1, count, count}};
    try {
        const auto mesh = std::make_shared<const Mesh>(
            place == VtkPlace::Points ? meshOfPoints(cells, shapes) : meshOfCells(cells, shapes));
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
    const Directions directions = directionsOf(header);
    const auto along = alignedWith(directions.unit);
    const std::string flaw = flawOf(directions.unit);
    VtkGrid result;
    if (!flaw.empty()) result.notes.push_back("drawn in index space: " + flaw);
    CoordinateFrame frame;
    if (!along && flaw.empty())
        frame = {directions.unit, {header.origin[0], header.origin[1], header.origin[2]}};
    const auto size = header.size(place);
    std::array<Axis, 3> axes;
    std::size_t stride = 1;
    for (int i = 0; i < 3; ++i) {
        const int to = along ? (*along)[i] : i;
        const char* name = frame.aligned() ? kNames[to] : kIndices[i];
        const double spacing = header.spacing[i] * directions.length[i];
        std::vector<double> coordinates =
            !image  ? header.coordinates[i]
            : along ? imageCoordinates(header, i, header.origin[to],
                                       std::copysign(spacing, spacing * directions.unit[i][to]))
                    : imageCoordinates(header, i, 0, spacing);
        if (place == VtkPlace::Cells) coordinates = middlesOf(coordinates);
        std::string why = flaw.empty() ? flawOf(coordinates) : "";
        if (!why.empty()) {
            if (image && header.spacing[i] == 0) why = "its spacing is 0";
            result.notes.push_back(fmt::format("{} is placed by index: {}", name, why));
        }
        if (flaw.empty() && why.empty())
            axes[to] = {name, "", std::move(coordinates), false};
        else
            axes[to] = {name, "index", indexCoordinates(size[i]), false};
        result.layout.size[to] = size[i];
        result.layout.stride[to] = stride;
        stride *= size[i];
    }
    result.grid = std::make_shared<Grid>(std::move(axes), frame);
    return result;
}

}  // namespace timeseries
