#include "render/annotate/stretch_text.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "render/annotate/ticks.h"

namespace render {

using timeseries::Axis;
using timeseries::Grid;

std::string stretchText(const Grid& grid, const PlacedPoints& placed) {
    const glm::dvec3 s = glm::abs(placed.scale());
    std::string text;
    for (int a = 1; a < 3; ++a) {
        const double ratio = s[a] / s[0];
        const Axis &axis = grid.axes()[a], &first = grid.axes()[0];
        if (axis.coordinates.size() == 1) continue;
        if (comparableUnit(axis) == comparableUnit(first)) {
            if (std::abs(ratio - 1) < 1e-9) continue;
            text += fmt::format("{}{} \u00d7 {:.3g}", text.empty() ? "" : ", ", axis.name, ratio);
        } else {
            // So many of its own units are drawn as long as one unit of the first axis.
            const auto unit = [](const Axis& of) {
                const std::string name = shownUnit(comparableUnit(of));
                const char* gap = name.starts_with("\u00b0") ? "" : " ";
                return name.empty() ? " " + of.name : gap + name + " " + of.name;
            };
            const double rounded = std::stod(fmt::format("{:.3g}", 1 / ratio));
            text += fmt::format("{}{}{} drawn as 1{}", text.empty() ? "" : ", ",
                                tickTexts(std::array{rounded})[0], unit(axis), unit(first));
        }
    }
    return text;
}

}  // namespace render
