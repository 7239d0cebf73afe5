#include "app/picture/fitted_map.h"

#include <algorithm>
#include <cmath>

#include "app/choices/choice_text.h"
#include "app/picture/resolved.h"

namespace app {
namespace {

using timeseries::RangeSet;

Extent exactFit(const RangeSet& ranges, const Extent& data) { return finiteEnds(ranges, data); }

Extent darkFit(const RangeSet& ranges, const Extent& data) {
    return darkEnds(finiteEnds(ranges, data));
}

// Where a range ends beyond the data, as firstChoice() has it beside a fill value.
Extent darkFitWithin(const RangeSet& ranges, const Extent& data) {
    const Extent ends = finiteEnds(ranges, data);
    const Extent within{std::max(ends.lo, data.lo), std::min(ends.hi, data.hi)};
    return darkEnds(within.lo < within.hi ? within : ends);
}

// None where the map is not fitted to its ranges.
std::optional<Extent> refitted(const Extent& map, const RangeSet& before, const RangeSet& next,
                               std::span<const Extent> seen) {
    // Dark ones first: where the range is one value all are alike.
    for (const auto fit : {darkFit, exactFit, darkFitWithin})
        for (const Extent& data : seen)
            if (fit(before, data) == map) return fit(next, data);
    return std::nullopt;
}

const MapChoice* mapOf(const LayerChoice& layer) {
    return layer.color ? std::get_if<MapChoice>(&*layer.color) : nullptr;
}

// What data of that type have nearest to it.
double nearestOf(timeseries::ValueType type, double value) {
    if (type == timeseries::ValueType::F64) return value;
    return type == timeseries::ValueType::F32 ? static_cast<float>(value) : std::round(value);
}

}  // namespace

// Doubles are dense: of these the step shown has to begin there.
std::optional<double> darkMapsData(const Extent& map, const RangeSet& ranges,
                                   const timeseries::SortedStep& step) {
    if (finiteEnds(ranges, map).hi != map.hi) return std::nullopt;
    const double begin = (map.lo + kDarkEnd * map.hi) / (1 + kDarkEnd);
    const double least = timeseries::toDouble(step.statistics().finiteMin);
    const bool isDense = step.type() == timeseries::ValueType::F64;
    const double data = isDense ? least : nearestOf(step.type(), begin);
    return darkEnds({data, map.hi}).lo == map.lo ? std::optional(data) : std::nullopt;
}

void refitMaps(Explorer& next, const Explorer& now, const Explorer& before,
               std::span<const Extent> seen) {
    const std::size_t count = next.layers.size();
    if (now.layers.size() != count || before.layers.size() != count) return;
    for (std::size_t i = 0; i < count; ++i) {
        LayerChoice& layer = next.layers[i];
        const LayerChoice &last = now.layers[i], &first = before.layers[i];
        const MapChoice* map = mapOf(first);
        if (layer.motion || layer.ranges == last.ranges || layer.color != last.color ||
            map == nullptr || !map->lo || !map->hi || mapOf(layer) == nullptr)
            continue;
        const auto ends = refitted({*map->lo, *map->hi}, first.ranges, layer.ranges, seen);
        if (!ends) continue;
        layer.color = MapChoice{map->map, std::clamp(ends->lo, -kMostFinite, kMostFinite),
                                std::clamp(ends->hi, -kMostFinite, kMostFinite)};
    }
}

}  // namespace app
