#include "timeseries/readers/zarr/zarr_multiscales.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace timeseries {
namespace {

// From version 0.5 on all that OME says stands under "ome".
const ZarrJson* saidByOme(const ZarrGroup& group, const char* name) {
    if (const ZarrJson* const ome = jsonMember(&group.attributes, "ome"))
        return jsonMember(ome, name);
    return jsonMember(&group.attributes, name);
}

// Axes in space are told by their names, else by their order: z, y, x.
void tellSpace(std::vector<ZarrAxis>& axes, const std::vector<std::size_t>& inSpace) {
    constexpr std::array kFromBehind{AxisKind::X, AxisKind::Y, AxisKind::Z};
    std::vector<AxisKind> named;
    for (const std::size_t i : inSpace)
        if (const auto kind = kindByName(axes[i].name);
            kind && std::ranges::find(kFromBehind, *kind) != kFromBehind.end() &&
            std::ranges::find(named, *kind) == named.end())
            named.push_back(*kind);
    const bool byName = named.size() == inSpace.size();
    for (std::size_t n = 0; n < inSpace.size(); ++n) {
        const std::size_t fromBehind = inSpace.size() - 1 - n;
        if (byName)
            axes[inSpace[n]].kind = named[n];
        else if (fromBehind < kFromBehind.size())
            axes[inSpace[n]].kind = kFromBehind[fromBehind];
    }
}

// Objects with name, type and unit from version 0.4 on; names in 0.3; none before, where there are
// t, c, z, y, x.
std::vector<ZarrAxis> namedAxes(const ZarrJson& multiscale) {
    const ZarrJson* const list = jsonMember(&multiscale, "axes");
    ZarrJson names = list ? *list : ZarrJson{"t", "c", "z", "y", "x"};
    if (!names.is_array() || names.empty() || names.size() > kMaxZarrRank)
        throw std::invalid_argument(
            fmt::format("multiscales: axes: expected a list of axes, found {}", jsonBriefly(list)));
    std::vector<ZarrAxis> axes;
    std::vector<std::size_t> inSpace;
    for (const ZarrJson& each : names) {
        ZarrAxis axis;
        axis.name = each.is_string() ? jsonText(&each) : jsonText(jsonMember(&each, "name"));
        if (axis.name.empty())
            throw std::invalid_argument(fmt::format(
                "multiscales: axes: expected an axis with a name, found {}", jsonBriefly(&each)));
        axis.units = jsonText(jsonMember(&each, "unit"));
        std::string type = jsonText(jsonMember(&each, "type"));
        if (type.empty()) type = axis.name == "t" ? "time" : axis.name == "c" ? "channel" : "space";
        if (type == "time") axis.kind = AxisKind::T;
        if (type == "space") inSpace.push_back(axes.size());
        axis.isChannel = type == "channel";
        axes.push_back(std::move(axis));
    }
    tellSpace(axes, inSpace);
    return axes;
}

std::optional<std::vector<double>> finiteNumbers(const ZarrJson* list, std::size_t count) {
    if (!list || !list->is_array() || list->size() != count) return std::nullopt;
    std::vector<double> numbers;
    for (const ZarrJson& each : *list) {
        if (!each.is_number() || !std::isfinite(each.get<double>())) return std::nullopt;
        numbers.push_back(each.get<double>());
    }
    return numbers;
}

// One after another. Whether all of them are scales and translations, whose numbers stand there.
bool transformed(const ZarrJson* list, std::vector<ZarrAxis>& axes) {
    if (!list) return true;
    if (!list->is_array()) return false;
    for (const ZarrJson& each : *list) {
        const std::string type = jsonText(jsonMember(&each, "type"));
        if (type == "identity") continue;
        const auto numbers = finiteNumbers(jsonMember(&each, type.c_str()), axes.size());
        if ((type != "scale" && type != "translation") || !numbers) return false;
        for (std::size_t i = 0; i < axes.size(); ++i) {
            if (!axes[i].places) axes[i].places = ZarrPlaces();
            if (type == "scale") {
                axes[i].places->scale *= (*numbers)[i];
                axes[i].places->offset *= (*numbers)[i];
            } else {
                axes[i].places->offset += (*numbers)[i];
            }
        }
    }
    return true;
}

std::vector<std::string> channelsOf(const ZarrGroup& group) {
    std::vector<std::string> names;
    const ZarrJson* const list = jsonMember(saidByOme(group, "omero"), "channels");
    if (!list || !list->is_array()) return names;
    for (const ZarrJson& each : *list) names.push_back(jsonText(jsonMember(&each, "label")));
    return names;
}

ZarrLevel levelOf(const ZarrHierarchy& hierarchy, const ZarrGroup& group,
                  const ZarrJson& multiscale, const ZarrJson& dataset) {
    const ZarrJson* const path = jsonMember(&dataset, "path");
    ZarrLevel level;
    level.array = (group.name.empty() ? "" : group.name + '/') + jsonText(path);
    // Whatever the path says, it can but name an array that was found.
    const auto array = std::ranges::find(hierarchy.arrays, level.array, &ZarrArray::name);
    if (array == hierarchy.arrays.end())
        throw std::invalid_argument(fmt::format(
            "multiscales: path: expected an array of the group, found {}", jsonBriefly(path)));
    level.axes = namedAxes(multiscale);
    if (level.axes.size() != array->shape.size())
        throw std::invalid_argument(
            fmt::format("multiscales: axes: expected one for each of the {} dimensions of {}, "
                        "found {}",
                        array->shape.size(), level.array, level.axes.size()));
    if (!transformed(jsonMember(&dataset, "coordinateTransformations"), level.axes) ||
        !transformed(jsonMember(&multiscale, "coordinateTransformations"), level.axes))
        for (ZarrAxis& axis : level.axes) axis.places.reset();
    level.channels = channelsOf(group);
    level.areLabels = saidByOme(group, "image-label") != nullptr;
    return level;
}

}  // namespace

std::vector<ZarrLevel> zarrLevelsOf(const ZarrHierarchy& hierarchy, const ZarrGroup& group) {
    std::vector<ZarrLevel> levels;
    const ZarrJson* const multiscales = saidByOme(group, "multiscales");
    if (!multiscales) return levels;
    if (!multiscales->is_array())
        throw std::invalid_argument(
            fmt::format("multiscales: expected a list, found {}", jsonBriefly(multiscales)));
    for (const ZarrJson& multiscale : *multiscales) {
        const ZarrJson* const datasets = jsonMember(&multiscale, "datasets");
        if (!datasets || !datasets->is_array())
            throw std::invalid_argument(fmt::format(
                "multiscales: datasets: expected a list, found {}", jsonBriefly(datasets)));
        for (const ZarrJson& dataset : *datasets)
            levels.push_back(levelOf(hierarchy, group, multiscale, dataset));
    }
    return levels;
}

}  // namespace timeseries
