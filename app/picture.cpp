#include "app/picture.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "app/choice_text.h"
#include "app/first_choice.h"
#include "app/layer_colors.h"
#include "render/color.h"
#include "render/ticks.h"

namespace app {
namespace {

using timeseries::Range;
using timeseries::RangeSet;
using timeseries::SortedStep;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Quantiles quantilesOf(const Steps& sampled) {
    constexpr std::size_t kQuantiles = 1025;
    Quantiles rows;
    for (const auto& [index, step] : sampled) rows.push_back(step->quantiles(kQuantiles));
    return rows;
}

// Ends of a layer in doubles, in order; infinite ones are the samples', or, where the layer lies
// beyond these, its other end.
Extent finiteEnds(const RangeSet& ranges, const Extent& data) {
    if (ranges.empty()) return data;
    const double lo = timeseries::toDouble(ranges.ranges().front().lo.value);
    const double hi = timeseries::toDouble(ranges.ranges().back().hi.value);
    const bool low = std::isfinite(lo), high = std::isfinite(hi);
    if (low && high) return {lo, hi};
    if (low) return {lo, std::max(data.hi, lo)};
    if (high) return {std::min(data.lo, hi), hi};
    return data;
}

// The least and the greatest value of a step; where that is infinite, or there is none,
// `otherwise`.
Extent valuesOf(const SortedStep& step, const Extent& otherwise) {
    const double lo = timeseries::toDouble(step.statistics().min);
    const double hi = timeseries::toDouble(step.statistics().max);
    return {std::isfinite(lo) ? lo : otherwise.lo, std::isfinite(hi) ? hi : otherwise.hi};
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
            // Nobody asked for exact ends: the map's dark end lies below the range, where it would
            // not be seen on the dark ground.
            layer.color = MapChoice{{}, ends.lo - kDarkEnd * (ends.hi - ends.lo), ends.hi};
        } else {
            layer.color = kLayerColors[place];
        }
    }
    if (auto* map = std::get_if<MapChoice>(&*layer.color)) {
        map->lo = map->lo.value_or(ends.lo);
        map->hi = map->hi.value_or(ends.hi);
    }
}

render::RangeStyle rangeStyle(const LayerChoice& layer) {
    render::RangeStyle out{render::Constant{}, layer.opacity.value()};
    if (const auto* rgb = std::get_if<glm::dvec3>(&*layer.color)) {
        out.color = render::Constant{render::linearFromSrgb(*rgb)};
    } else {
        const auto& map = std::get<MapChoice>(*layer.color);
        out.color = render::ByValue{map.map, *map.lo, *map.hi};
    }
    return out;
}

// The texts of a range's bounds. Doubles of many digits, as a swept window has, are rounded to as
// few (at least seven) as tell the two apart; `rounded` then becomes true.
std::pair<std::string, std::string> shortBounds(const Range& range, bool& rounded) {
    const auto text = [](const timeseries::Number& number, int digits) {
        const auto* real = std::get_if<double>(&number);
        std::string exact = timeseries::toText(number);
        if (real == nullptr || !std::isfinite(*real)) return exact;
        std::string few = fmt::format("{:.{}g}", *real, digits);
        return few.size() < exact.size() ? few : exact;
    };
    const std::string exactLo = timeseries::toText(range.lo.value);
    const std::string exactHi = timeseries::toText(range.hi.value);
    for (int digits = 7; digits < 17; ++digits) {
        const std::string lo = text(range.lo.value, digits), hi = text(range.hi.value, digits);
        if (lo == hi && exactLo != exactHi) continue;
        rounded = rounded || lo != exactLo || hi != exactHi;
        return {lo, hi};
    }
    return {exactLo, exactHi};
}

}  // namespace

bool needsSamples(const Explorer& e) {
    if (e.sweep && (infinite(e.sweep->animation) || openStyle(e.sweepLayer))) return true;
    const auto open = [](const LayerChoice& layer) {
        return layer.ranges.empty() || openStyle(layer);
    };
    return std::ranges::any_of(e.layers, open) || (e.layers.empty() && !e.sweep);
}

Explorer resolved(const Explorer& explorer, const Steps& sampled) {
    Explorer e = explorer;
    const Quantiles quantiles = quantilesOf(sampled);
    const Extent data = extentOf(quantiles);
    if (e.layers.empty() && !e.sweep) e.layers.push_back({});
    const std::size_t count = e.layers.size() + (e.sweep ? 1 : 0);
    std::size_t place = 0;
    if (e.sweep) {
        std::vector<Range> finite;
        for (Range range : e.sweep->animation.ranges()) {
            if (!std::isfinite(timeseries::toDouble(range.lo.value))) range.lo = {data.lo};
            if (!std::isfinite(timeseries::toDouble(range.hi.value))) range.hi = {data.hi};
            finite.push_back(range);
        }
        const RangeSet within(std::move(finite));
        if (within.empty())
            throw std::invalid_argument(
                fmt::format("sweep {} reaches none of the data's values, {} to {}",
                            e.sweep->animation.text(), data.lo, data.hi));
        e.sweep->animation = within;
        style(e.sweepLayer, finiteEnds(e.sweep->animation, data), place++, count);
        // A swept window holds about its share of the animation's points.
        if (!e.sweepLayer.opacity)
            e.sweepLayer.opacity = opacityFor(mostSelected(e.sweep->animation, sampled) / 8);
    }
    for (LayerChoice& layer : e.layers) {
        if (layer.ranges.empty()) {
            const LayerChoice first = firstChoice(quantiles);
            layer.ranges = first.ranges;
            // A map alone was asked for: it spans what was chosen.
            auto* map = layer.color ? std::get_if<MapChoice>(&*layer.color) : nullptr;
            const auto* chosen = first.color ? std::get_if<MapChoice>(&*first.color) : nullptr;
            if (!layer.color)
                layer.color = first.color;
            else if (map && chosen)
                *map = {map->map, chosen->lo, chosen->hi};
            if (!sampled.empty()) layer.ranges = sampled.begin()->second->keptPart(layer.ranges);
        }
        style(layer, finiteEnds(layer.ranges, data), place++, count);
        if (!layer.opacity) layer.opacity = opacityFor(mostSelected(layer.ranges, sampled));
    }
    return e;
}

RangeSet sweptRanges(const Explorer& e, const SortedStep& step, std::int64_t tick) {
    return step.keptPart(RangeSet(std::vector{timeseries::ValueSweep(*e.sweep).window(tick)}));
}

Explorer onlyThis(const Explorer& explorer, std::size_t stepIndex, const SortedStep& step,
                  std::int64_t tick) {
    Explorer e = explorer;
    e.steps = StepChoice{stepIndex, stepIndex};
    if (!e.sweep) return e;
    LayerChoice swept = e.sweepLayer;
    swept.ranges = sweptRanges(e, step, tick);
    // A layer without ranges would be the first choice: such a picture keeps its sweep.
    if (swept.ranges.empty()) return e;
    e.layers.insert(e.layers.begin(), std::move(swept));
    e.sweep.reset();
    e.sweepLayer = {};
    return e;
}

std::string rangeLabel(const RangeSet& ranges, const std::string& units) {
    std::string text;
    bool rounded = false;
    for (const Range& r : ranges.ranges()) {
        const auto isUnbounded = [](const timeseries::Bound& b, double end) {
            return timeseries::toDouble(b.value) == end && !b.open;
        };
        const bool down = isUnbounded(r.lo, -kInfinity), up = isUnbounded(r.hi, kInfinity);
        const auto bounds = shortBounds(r, rounded);
        const std::string lo = render::withMinusSigns(bounds.first);
        const std::string hi = render::withMinusSigns(bounds.second);
        if (!text.empty()) text += ", ";
        if (down && up) return "all values";
        if (lo == hi)
            text += lo;
        else if (down)
            text += fmt::format("{} {}", r.hi.open ? "<" : "≤", hi);
        else if (up)
            text += fmt::format("{} {}", r.lo.open ? ">" : "≥", lo);
        else if (r.lo.open || r.hi.open)
            text += fmt::format("{}{}, {}{}", r.lo.open ? '(' : '[', lo, hi, r.hi.open ? ')' : ']');
        else
            text += fmt::format("{} to {}", lo, hi);
    }
    if (text.empty()) return "no values";
    if (rounded) text = "≈ " + text;
    const std::string unit = render::shownUnit(units);
    return unit.empty() ? text : text + " " + unit;
}

Picture makePicture(const Explorer& e, const timeseries::Variable& about, std::size_t stepIndex,
                    const SortedStep& step, const render::Lattice& lattice, std::int64_t tick) {
    Picture picture{{.step = step,
                     .lattice = lattice,
                     .layers = {},
                     .footprint = e.footprint,
                     .order = e.order,
                     .clip = {}},
                    {}};
    if (e.clip) picture.scene.clip = render::indexBox(step.grid(), e.clip->lo, e.clip->hi);
    const auto add = [&](const RangeSet& ranges, const LayerChoice& layer) {
        if (!layer.visible) return;
        render::Layer drawn{step.select(ranges), rangeStyle(layer)};
        std::uint64_t selected = 0;
        for (const timeseries::Run& run : drawn.runs) selected += run.count;
        const std::uint64_t points = step.statistics().points;
        const double percent =
            points == 0 ? 0 : 100 * static_cast<double>(selected) / static_cast<double>(points);
        render::LegendLayer& told = picture.legend.layers.emplace_back(render::LegendLayer{
            drawn.style, rangeLabel(ranges, about.units),
            fmt::format("{} {}, {} %", withCommas(selected), selected == 1 ? "point" : "points",
                        render::withMinusSigns(fmt::format("{:.3g}", percent)))});
        if (const auto* byValue = std::get_if<render::ByValue>(&drawn.style.color)) {
            const Extent ends = finiteEnds(ranges, valuesOf(step, {byValue->lo, byValue->hi}));
            told.shown.emplace(ends.lo, ends.hi);
        }
        picture.scene.layers.push_back(std::move(drawn));
    };
    if (e.sweep) add(sweptRanges(e, step, tick), e.sweepLayer);
    for (const LayerChoice& layer : e.layers) add(layer.ranges, layer);

    picture.legend.title = about.longName.empty() ? about.name : about.longName;
    if (const std::string unit = render::shownUnit(about.units); !unit.empty())
        picture.legend.title += " (" + unit + ")";
    const std::size_t steps = about.time->points.size();
    const bool timed = !about.time->counted;
    if (timed) picture.legend.time = timeText(*about.time, stepIndex);
    if (steps > 1)
        picture.legend.time +=
            fmt::format("{}step {} of 0\u2013{}", timed ? ", " : "", stepIndex, steps - 1);
    picture.legend.notes = about.notes;
    if (const std::string stretch = render::stretchText(step.grid(), lattice); !stretch.empty())
        picture.legend.notes.push_back(stretch);
    if (e.clip)
        picture.legend.notes.push_back("drawn inside " + clipText(*e.clip) +
                                       " only; counts are of the whole step");
    return picture;
}

}  // namespace app
