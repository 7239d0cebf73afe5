#include "render/annotate/stretch_text.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>

#include "render/annotate/ticks.h"

namespace render {

using timeseries::Axis;
using timeseries::Grid;

namespace {

// Of an axis that is drawn to a scale of its own: "° lon", " hPa lev".
std::string unitOf(const Axis& of) {
    const std::string name = shownUnit(comparableUnit(of));
    const char* gap = name.starts_with("\u00b0") ? "" : " ";
    return name.empty() ? " " + of.name : gap + name + " " + of.name;
}

// To three digits.
std::string numberText(double number) {
    const double rounded = std::strtod(fmt::format("{:.3g}", number).c_str(), nullptr);
    return tickTexts(std::array{rounded})[0];
}

// So many units of an axis as long as one of another.
std::string unitsText(double count, const Axis& of) { return numberText(count) + unitOf(of); }

std::string globeText(const Globe& globe, const Axis& third) {
    if (const auto times = globe.exaggeration())
        return fmt::format("{} \u00d7 {}", third.name, numberText(*times));
    const double perUnit = globe.degreesPerUnit();
    return perUnit > 0 ? unitsText(1 / perUnit, third) + " drawn as 1\u00b0" : "";
}

}  // namespace

std::string stretchText(const Grid& grid, const PlacedPoints& placed) {
    if (placed.globe()) return globeText(*placed.globe(), grid.axes()[2]);
    const glm::dvec3 s = glm::abs(placed.scale());
    std::string text;
    for (int a = 1; a < 3; ++a) {
        const double ratio = s[a] / s[0];
        const Axis &axis = grid.axes()[a], &first = grid.axes()[0];
        if (axis.coordinates.size() == 1) continue;
        if (const auto units = unitRatio(axis, first)) {
            const std::string times = fmt::format("{:.3g}", ratio / *units);
            if (times == "1") continue;  // less than is told
            text += fmt::format("{}{} \u00d7 {}", text.empty() ? "" : ", ", axis.name, times);
        } else {
            // So many of its own units are drawn as long as one unit of the first axis.
            text += fmt::format("{}{} drawn as 1{}", text.empty() ? "" : ", ",
                                unitsText(1 / ratio, axis), unitOf(first));
        }
    }
    return text;
}

}  // namespace render
