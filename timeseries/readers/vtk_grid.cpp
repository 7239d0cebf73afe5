#include "timeseries/readers/vtk_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace timeseries {
namespace {

constexpr std::array kNames{"x", "y", "z"};

// For each index axis the axis of the world that it runs along, and whether backwards.
struct Turn {
    std::array<std::size_t, 3> world{0, 1, 2};
    std::array<double, 3> sign{1, 1, 1};
};

// Nothing when the image is rotated other than by right angles.
std::optional<Turn> turnOf(const std::array<double, 9>& direction) {
    Turn turn;
    for (std::size_t index = 0; index < 3; ++index) {
        std::size_t ones = 0;
        for (std::size_t world = 0; world < 3; ++world) {
            const double d = direction[3 * world + index];
            // Direction cosines are computed, so that 1e-17 stands for 0.
            if (std::abs(std::abs(d) - 1) < 1e-9) {
                ++ones;
                turn.world[index] = world;
                turn.sign[index] = d < 0 ? -1 : 1;
            } else if (std::abs(d) > 1e-9) {
                return std::nullopt;
            }
        }
        if (ones != 1) return std::nullopt;
    }
    const auto& w = turn.world;
    if (w[0] == w[1] || w[0] == w[2] || w[1] == w[2]) return std::nullopt;
    return turn;
}

std::vector<double> centres(const std::vector<double>& points) {
    if (points.size() < 2) return points;
    std::vector<double> between;
    for (std::size_t i = 1; i < points.size(); ++i)
        between.push_back(points[i - 1] + (points[i] - points[i - 1]) / 2);
    return between;
}

}  // namespace

VtkGrid vtkGridOf(const VtkHeader& header, VtkPlace place) {
    const bool image = header.kind == VtkKind::XmlImage || header.kind == VtkKind::LegacyPoints;
    const auto turn = turnOf(header.direction);
    VtkGrid result;
    if (!turn)
        result.notes.push_back(fmt::format("drawn in index space: the axes are rotated ({})",
                                           fmt::join(header.direction, " ")));
    const Turn axesTurn = turn.value_or(Turn{});
    const auto size = header.size(place), points = header.size(VtkPlace::Points);
    std::array<Axis, 3> axes;
    std::size_t stride = 1;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t w = axesTurn.world[i];
        std::vector<double> coordinates = header.coordinates[i];
        if (image) {
            coordinates = indexCoordinates(points[i]);
            for (double& c : coordinates)
                c = header.origin[w] + axesTurn.sign[i] * header.spacing[i] *
                                           (c + static_cast<double>(header.extent[i][0]));
        }
        if (place == VtkPlace::Cells) coordinates = centres(coordinates);
        std::string why = turn ? flawOf(coordinates) : "";
        if (!why.empty()) {
            if (image && header.spacing[i] == 0) why = "its spacing is 0";
            result.notes.push_back(fmt::format("{} is placed by index: {}", kNames[w], why));
        }
        if (turn && why.empty())
            axes[w] = {kNames[w], "", std::move(coordinates), false};
        else
            axes[w] = {kNames[w], "index", indexCoordinates(size[i]), false};
        result.layout.size[w] = size[i];
        result.layout.stride[w] = stride;
        stride *= size[i];
    }
    result.grid = std::make_shared<Grid>(std::move(axes));
    return result;
}

}  // namespace timeseries
