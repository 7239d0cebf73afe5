#include "app/picture/resolved.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "app/choices/choice_text.h"
#include "app/choices/first_choice.h"
#include "app/choices/layer_colors.h"

namespace app {
namespace {

using timeseries::Range;
using timeseries::RangeSet;

Quantiles quantilesOf(const Steps& sampled) {
    Quantiles rows;
    for (const auto& [index, step] : sampled)
        rows.push_back(step->quantiles(timeseries::kStepQuantiles));
    return rows;
}

// {0, 0} where there are none.
Range endsOf(const Explorer& e, const Steps& sampled) {
    std::optional<Range> all;
    for (const auto& [index, step] : sampled) all = around(all, endsOf(e, *step));
    return all.value_or(Range{{0.0}, {0.0}});
}

Extent extentOf(const Range& ends) {
    return {timeseries::toDouble(ends.lo.value), timeseries::toDouble(ends.hi.value)};
}

std::uint64_t mostSelected(const RangeSet& ranges, const Steps& sampled) {
    std::uint64_t most = 0;
    for (const auto& [index, step] : sampled)
        most = std::max(most, step->count(step->keptPart(ranges)));
    return most;
}

bool openStyle(const LayerChoice& layer) {
    if (!layer.color || !layer.opacity) return true;
    const auto* map = std::get_if<MapChoice>(&*layer.color);
    return map != nullptr && !(map->lo && map->hi);
}

bool infinite(const RangeSet& ranges) {
    for (const Range& range : ranges.ranges())
        if (!std::isfinite(timeseries::toDouble(range.lo.value)) ||
            !std::isfinite(timeseries::toDouble(range.hi.value)))
            return true;
    return false;
}

// A style for layer `place` of `count`; a lone layer is coloured by value.
void style(LayerChoice& layer, const Extent& ends, std::size_t place, std::size_t count) {
    if (!layer.color) {
        if (count == 1) {
            // Nobody asked for exact ends.
            const Extent dark = darkEnds(ends);
            layer.color = MapChoice{{}, dark.lo, dark.hi};
        } else {
            layer.color = kLayerColors[place];
        }
    }
    if (auto* map = std::get_if<MapChoice>(&*layer.color)) {
        map->lo = map->lo.value_or(ends.lo);
        map->hi = map->hi.value_or(ends.hi);
    }
}

// Through finite values alone. Throws ChoiceError where that leaves none.
RangeSet finitePart(const RangeSet& animation, const Range& data) {
    std::vector<Range> finite;
    for (Range range : animation.ranges()) {
        if (!std::isfinite(timeseries::toDouble(range.lo.value))) range.lo = data.lo;
        if (!std::isfinite(timeseries::toDouble(range.hi.value))) range.hi = data.hi;
        finite.push_back(range);
    }
    RangeSet within(std::move(finite));
    if (within.empty())
        throw ChoiceError(fmt::format("sweep {} reaches none of the data's values, {} to {}",
                                      animation.text(), timeseries::toText(data.lo.value),
                                      timeseries::toText(data.hi.value)));
    return within;
}

// Of data that are classes: a layer each, but for the class that most points have; the most common
// that have colours. None where that is one, or where they are too many to be classes.
std::vector<LayerChoice> classLayers(const Steps& sampled) {
    constexpr std::size_t kMostClasses = 256;
    std::map<double, std::uint64_t> points;
    for (const auto& [index, step] : sampled) {
        if (!step->ofCategories()) return {};
        for (std::uint64_t at = 0; at < step->size() && points.size() <= kMostClasses;) {
            const timeseries::Number value = step->value(at);
            if (timeseries::compare(timeseries::toDouble(value), value) != 0)
                return {};  // of more than 53 bits
            const std::uint64_t count = step->count(RangeSet(std::vector{Range{{value}, {value}}}));
            points[timeseries::toDouble(value)] += count;
            at += count;
        }
    }
    if (points.size() < 3 || points.size() > kMostClasses) return {};
    std::vector<std::pair<std::uint64_t, double>> common;
    for (const auto& [value, count] : points) common.emplace_back(count, value);
    std::ranges::stable_sort(common, std::greater<>(), &std::pair<std::uint64_t, double>::first);
    const std::size_t shown = std::min(common.size() - 1, kLayerColors.size());
    std::vector<double> values;
    for (std::size_t i = 1; i <= shown; ++i) values.push_back(common[i].second);
    std::ranges::sort(values);
    std::vector<LayerChoice> layers;
    for (const double value : values)
        layers.push_back(
            {.ranges = RangeSet(std::vector{Range{{value}, {value}}}), .color = {}, .opacity = {}});
    return layers;
}

// What of the data it shows, and its style where a map alone was asked for.
void chooseFirst(LayerChoice& layer, const Steps& sampled) {
    const LayerChoice first = firstChoice(quantilesOf(sampled));
    layer.ranges = first.ranges;
    auto* map = layer.color ? std::get_if<MapChoice>(&*layer.color) : nullptr;
    const auto* chosen = first.color ? std::get_if<MapChoice>(&*first.color) : nullptr;
    if (!layer.color)
        layer.color = first.color;
    else if (map && chosen)  // where it says nothing else, it spans what was chosen
        *map = {map->map, map->lo ? map->lo : chosen->lo, map->hi ? map->hi : chosen->hi};
    if (!sampled.empty()) layer.ranges = sampled.begin()->second->keptPart(layer.ranges);
}

}  // namespace

Extent finiteEnds(const RangeSet& ranges, const Extent& data) {
    if (ranges.empty()) return data;
    const double lo = timeseries::toDouble(ranges.ranges().front().lo.value);
    double hi = -kInfinity;
    for (const Range& range : ranges.ranges())
        hi = std::max(hi, timeseries::toDouble(range.hi.value));
    const bool low = std::isfinite(lo), high = std::isfinite(hi);
    if (low && high) return {lo, hi};
    if (low) return {lo, std::max(data.hi, lo)};
    if (high) return {std::min(data.lo, hi), hi};
    return data;
}

std::optional<Range> around(const std::optional<Range>& a, const std::optional<Range>& b) {
    if (!a || !b) return a ? a : b;
    const auto less = [](const timeseries::Bound& one, const timeseries::Bound& other) {
        return timeseries::compare(one.value, other.value) < 0;
    };
    return Range{std::min(a->lo, b->lo, less), std::max(a->hi, b->hi, less)};
}

std::optional<Range> endsOf(const Explorer& e, const timeseries::SortedStep& step) {
    const timeseries::Run kept = step.finite();
    if (e.keep && kept.count == 0) return std::nullopt;
    if (e.keep) return Range{{step.value(kept.first)}, {step.value(kept.first + kept.count - 1)}};
    const auto& whole = step.statistics();
    if (std::isnan(timeseries::toDouble(whole.finiteMin))) return std::nullopt;
    return Range{{whole.finiteMin}, {whole.finiteMax}};
}

std::optional<Extent> extentOf(const Explorer& e, const timeseries::SortedStep& step) {
    const auto ends = endsOf(e, step);
    return ends ? std::optional(extentOf(*ends)) : std::nullopt;
}

bool sweepsOn(const Explorer& e) {
    return std::ranges::any_of(e.layers, [](const LayerChoice& layer) {
        return layer.motion && infinite(layer.motion->animation);
    });
}

void endSweeps(Explorer& e, const Range& data) {
    for (LayerChoice& layer : e.layers)
        if (layer.motion) layer.motion->animation = finitePart(layer.motion->animation, data);
}

bool needsSamples(const Explorer& e) {
    const auto open = [](const LayerChoice& layer) {
        return openStyle(layer) ||
               (layer.motion ? infinite(layer.motion->animation) : layer.ranges.empty());
    };
    return std::ranges::any_of(e.layers, open) || (e.layers.empty() && !e.noLayers);
}

RangeSet rangesNeeded(const Explorer& e) {
    const auto mayBeAny = [](const LayerChoice& layer) {
        return layer.motion || layer.ranges.empty();
    };
    if (std::ranges::any_of(e.layers, mayBeAny) || (e.layers.empty() && !e.noLayers))
        return RangeSet::everything();
    std::vector<RangeSet> all;
    for (const LayerChoice& layer : e.layers) all.push_back(layer.ranges);
    return timeseries::unionOf(all);
}

Explorer resolved(const Explorer& explorer, const Steps& sampled) {
    Explorer e = explorer;
    const Range ends = endsOf(e, sampled);
    const Extent data = extentOf(ends);
    if (e.layers.empty() && !e.noLayers) e.layers = classLayers(sampled);
    if (e.layers.empty() && !e.noLayers) e.layers.push_back({});
    endSweeps(e, ends);
    for (std::size_t place = 0; place < e.layers.size(); ++place) {
        LayerChoice& layer = e.layers[place];
        if (!layer.motion && layer.ranges.empty()) chooseFirst(layer, sampled);
        const RangeSet& all = layer.motion ? layer.motion->animation : layer.ranges;
        style(layer, finiteEnds(all, data), place, e.layers.size());
        // A swept window holds about its share of the animation's points.
        if (!layer.opacity) {
            const std::uint64_t points = mostSelected(all, sampled) / (layer.motion ? 8 : 1);
            layer.opacity = sampled.empty() ? opacityFor(points)
                                            : opacityFor(points, sampled.begin()->second->grid());
        }
    }
    return e;
}

}  // namespace app
