#include "timeseries/readers/image_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "timeseries/grid/middles.h"

namespace timeseries {
namespace {

constexpr std::array kImageNames{"x", "y", "z"}, kImageIndices{"i", "j", "k"};

// How an image's axes lie in space; `length` is of each as the file has it.
struct ImageDirections {
    glm::dmat3 unit{1.0};
    glm::dvec3 length{1};
};

ImageDirections directionsOf(const ImagePlaces& image) {
    ImageDirections found;
    for (int axis = 0; axis < 3; ++axis) {
        for (int c = 0; c < 3; ++c) found.unit[axis][c] = image.direction[3 * c + axis];
        const glm::dvec3& d = found.unit[axis];
        found.length[axis] = std::hypot(d.x, d.y, d.z);
        found.unit[axis] /= found.length[axis];
    }
    return found;
}

// At first + spacing n of index n.
std::vector<double> coordinatesOf(const ImagePlaces& image, std::size_t axis, double first,
                                  double spacing) {
    auto coordinates = indexCoordinates(image.points[axis]);
    for (double& c : coordinates)
        c = first + spacing * (c + static_cast<double>(image.first[axis]));
    return coordinates;
}

}  // namespace

PlacedImage placedImage(const ImagePlaces& image, bool atCells) {
    const ImageDirections directions = directionsOf(image);
    const auto along = alignedWith(directions.unit);
    const std::string flaw = flawOf(directions.unit);
    PlacedImage result;
    if (!flaw.empty()) result.notes.push_back("drawn in index space: " + flaw);
    CoordinateFrame frame;
    if (!along && flaw.empty())
        frame = {directions.unit, {image.origin[0], image.origin[1], image.origin[2]}};
    std::array<Axis, 3> axes;
    std::size_t stride = 1;
    for (int i = 0; i < 3; ++i) {
        const int to = along ? (*along)[i] : i;
        const char* name = frame.aligned() ? kImageNames[to] : kImageIndices[i];
        const double spacing = image.spacing[i] * directions.length[i];
        const bool isImage = image.coordinates[i].empty();
        std::vector<double> coordinates =
            !isImage ? image.coordinates[i]
            : along  ? coordinatesOf(image, i, image.origin[to],
                                     std::copysign(spacing, spacing * directions.unit[i][to]))
                     : coordinatesOf(image, i, 0, spacing);
        if (atCells) coordinates = middlesOf(coordinates);
        const std::uint64_t size =
            atCells ? std::max<std::uint64_t>(image.points[i], 2) - 1 : image.points[i];
        std::string why = flaw.empty() ? flawOf(coordinates) : "";
        if (!why.empty()) {
            if (isImage && image.spacing[i] == 0) why = "its spacing is 0";
            result.notes.push_back(fmt::format("{} is placed by index: {}", name, why));
        }
        if (flaw.empty() && why.empty())
            axes[to] = {name, "", std::move(coordinates), false};
        else
            axes[to] = {name, "index", indexCoordinates(size), false};
        result.layout.size[to] = size;
        result.layout.stride[to] = stride;
        stride *= size;
    }
    result.grid = std::make_shared<Grid>(std::move(axes), frame);
    return result;
}

}  // namespace timeseries
