#include "app/exploration/reading.h"

#include <fmt/format.h>

#include <cmath>

#include "app/picture/range_label.h"
#include "render/annotate/ticks.h"
#include "render/points/globe.h"
#include "timeseries/grid/cell_types.h"

namespace app {
namespace {

// Which are not those of space.
bool hasTurnedAxes(const timeseries::Grid& grid) { return !grid.mesh() && !grid.frame().aligned(); }

}  // namespace

std::string withUnit(const std::string& number, const std::string& unit) {
    const std::string shown = render::shownUnit(unit);
    return shown.empty() || shown == "index" ? number : number + " " + shown;
}

std::string valueText(const Reading& reading, const Shown& shown) {
    const std::string number =
        shown.sorted->type() == timeseries::ValueType::F32
            ? fmt::format("{}", static_cast<float>(timeseries::toDouble(reading.value)))
            : timeseries::toText(reading.value);
    const timeseries::Range alone{{reading.value}, {reading.value}};
    const std::string called =
        classLabel(timeseries::RangeSet(std::vector{alone}), shown.dataset.variable);
    return withUnit(number, shown.dataset.variable.units) + (called.empty() ? "" : ", " + called);
}

std::string betweenText(const Reading& reading, const Shown& shown) {
    if (!reading.between) return "";
    return withUnit(fmt::format("{:.5g}", *reading.between), shown.dataset.variable.units) +
           " between points";
}

glm::dvec3 alongAxes(const Reading& reading, const timeseries::Grid& grid) {
    if (!hasTurnedAxes(grid)) return reading.position;
    glm::dvec3 along;
    for (std::size_t a = 0; a < 3; ++a)
        along[static_cast<int>(a)] = grid.axes()[a].coordinates[reading.index[a]];
    return along;
}

std::string positionText(const Reading& reading, const Shown& shown, std::size_t axis) {
    const std::string& unit = shown.sorted->grid().axes()[axis].units;
    const double place = alongAxes(reading, shown.sorted->grid())[static_cast<int>(axis)];
    const std::string at = withUnit(fmt::format("{:.6g}", place), unit);
    // Points that have no neighbours are numbered by one index.
    const auto& mesh = shown.sorted->grid().mesh();
    if (axis > 0 && mesh && !mesh->hasNeighbours()) return at;
    return fmt::format("{}   [{}]", at, reading.index[axis]);
}

std::optional<std::string> unitOfSpace(const timeseries::Grid& grid) {
    const auto& axes = grid.axes();
    const bool isOne = axes[0].units == axes[1].units && axes[1].units == axes[2].units;
    return isOne ? std::optional(axes[0].units) : std::nullopt;
}

std::optional<glm::dvec2> onEarth(const Reading& reading, const timeseries::Grid& grid) {
    if (!render::isOnEarth(grid)) return std::nullopt;
    if (!grid.earth()) return glm::dvec2(reading.position);
    const glm::dvec2 at = (*grid.earth())[reading.index[0] + grid.size()[0] * reading.index[1]];
    return std::isnan(at.x) ? std::nullopt : std::optional(at);
}

std::vector<PlaceLine> placeLines(const Reading& reading, const Shown& shown) {
    const timeseries::Grid& grid = shown.sorted->grid();
    std::vector<PlaceLine> lines;
    for (std::size_t a = 0; a < 3; ++a)
        lines.push_back({grid.axes()[a].name, positionText(reading, shown, a)});
    for (int c = 0; c < 3 && hasTurnedAxes(grid); ++c)
        lines.push_back(
            {grid.frame().names[static_cast<std::size_t>(c)],
             withUnit(fmt::format("{:.6g}", reading.position[c]), unitOfSpace(grid).value_or(""))});
    if (const auto at = grid.earth() ? onEarth(reading, grid) : std::nullopt) {
        lines.push_back({"longitude", withUnit(fmt::format("{:.6g}", at->x), "degrees_east")});
        lines.push_back({"latitude", withUnit(fmt::format("{:.6g}", at->y), "degrees_north")});
    }
    return lines;
}

std::string cellText(const timeseries::Grid& grid, const std::array<std::size_t, 3>& index) {
    const timeseries::Mesh* mesh = grid.mesh().get();
    const auto type = mesh ? mesh->about().typeOf(index[0]) : std::nullopt;
    if (!type) return "";
    const std::string level = mesh->size()[2] > 1 ? fmt::format(", level {}", index[2]) : "";
    return fmt::format("{}, {}{}", index[0], timeseries::cellName(*type, 1), level);
}

}  // namespace app
