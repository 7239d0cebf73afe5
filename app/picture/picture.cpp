#include "app/picture/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

#include "app/choices/camera.h"
#include "app/choices/choice_text.h"
#include "app/choices/decimals.h"
#include "app/choices/first_choice.h"
#include "app/choices/layer_colors.h"
#include "app/picture/clip_counts.h"
#include "render/annotate/stretch_text.h"
#include "render/annotate/ticks.h"
#include "render/frame/mean_depth.h"
#include "render/image/color.h"

namespace app {
namespace {

using timeseries::Range;
using timeseries::RangeSet;
using timeseries::SortedStep;

constexpr double kLeastResolution = std::numeric_limits<double>::min();

Quantiles quantilesOf(const Steps& sampled) {
    Quantiles rows;
    for (const auto& [index, step] : sampled)
        rows.push_back(step->quantiles(timeseries::kStepQuantiles));
    return rows;
}

// The finite values that may be shown; {0, 0} where there are none.
Extent extentOf(const Explorer& e, const Steps& sampled) {
    Extent all{kInfinity, -kInfinity};
    for (const auto& [index, step] : sampled) {
        const auto& whole = step->statistics();
        Quantiles ends{
            {timeseries::toDouble(whole.finiteMin), timeseries::toDouble(whole.finiteMax)}};
        if (e.keep) ends = {step->quantiles(2)};
        for (const double end : ends.front()) {
            if (std::isnan(end)) continue;
            all = {std::min(all.lo, end), std::max(all.hi, end)};
        }
    }
    return all.lo <= all.hi ? all : Extent{};
}

// Ends of a layer in doubles, in order; infinite ones are those of `data`, or, where the layer lies
// beyond these, its other end.
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

// The text of a bound. Doubles of many digits, as a swept window has, are rounded to these.
std::string boundText(const timeseries::Number& number, int digits) {
    const auto* real = std::get_if<double>(&number);
    std::string exact = timeseries::toText(number);
    if (real == nullptr || !std::isfinite(*real)) return exact;
    std::string few = fmt::format("{:.{}g}", *real, digits);
    return few.size() < exact.size() ? few : exact;
}

// As few digits (at least seven) as tell all bounds apart that differ.
int digitsOf(const RangeSet& ranges) {
    constexpr int kFew = 7, kExact = 17;
    std::vector<timeseries::Number> bounds;
    for (const Range& range : ranges.ranges()) {
        bounds.push_back(range.lo.value);
        bounds.push_back(range.hi.value);
    }
    for (int digits = kFew; digits < kExact; ++digits) {
        std::map<std::string, std::string> exact;  // of each rounded text
        const bool apart = std::ranges::all_of(bounds, [&](const timeseries::Number& bound) {
            const std::string text = timeseries::toText(bound);
            return exact.emplace(boundText(bound, digits), text).first->second == text;
        });
        if (apart) return digits;
    }
    return kExact;
}

}  // namespace

bool needsSamples(const Explorer& e) {
    const auto open = [](const LayerChoice& layer) {
        return openStyle(layer) ||
               (layer.motion ? infinite(layer.motion->animation) : layer.ranges.empty());
    };
    return std::ranges::any_of(e.layers, open) || (e.layers.empty() && !e.noLayers);
}

namespace {

// Through finite values alone. Throws ChoiceError where that leaves none.
RangeSet finitePart(const RangeSet& animation, const Extent& data) {
    std::vector<Range> finite;
    for (Range range : animation.ranges()) {
        if (!std::isfinite(timeseries::toDouble(range.lo.value))) range.lo = {data.lo};
        if (!std::isfinite(timeseries::toDouble(range.hi.value))) range.hi = {data.hi};
        finite.push_back(range);
    }
    RangeSet within(std::move(finite));
    if (within.empty())
        throw ChoiceError(fmt::format("sweep {} reaches none of the data's values, {} to {}",
                                      animation.text(), data.lo, data.hi));
    return within;
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
    const Extent data = extentOf(e, sampled);
    if (e.layers.empty() && !e.noLayers) e.layers.push_back({});
    for (std::size_t place = 0; place < e.layers.size(); ++place) {
        LayerChoice& layer = e.layers[place];
        if (layer.motion)
            layer.motion->animation = finitePart(layer.motion->animation, data);
        else if (layer.ranges.empty())
            chooseFirst(layer, sampled);
        const RangeSet& all = layer.motion ? layer.motion->animation : layer.ranges;
        style(layer, finiteEnds(all, data), place, e.layers.size());
        // A swept window holds about its share of the animation's points.
        if (!layer.opacity)
            layer.opacity = opacityFor(mostSelected(all, sampled) / (layer.motion ? 8 : 1));
    }
    return e;
}

RangeSet rangesAt(const LayerChoice& layer, const SortedStep& step, std::int64_t tick) {
    if (!layer.motion) return layer.ranges;
    return step.keptPart(RangeSet(std::vector{timeseries::ValueSweep(*layer.motion).window(tick)}));
}

Explorer onlyThis(const Explorer& explorer, std::size_t stepIndex, std::int64_t tick) {
    Explorer e = explorer;
    e.steps = StepChoice{stepIndex, stepIndex};
    e.oneTick = sweepOf(e) != nullptr;
    if (e.oneTick) e.play.tick = tick;
    return e;
}

std::string rangeLabel(const RangeSet& ranges, const std::string& units) {
    std::string text;
    bool rounded = false;
    const int digits = digitsOf(ranges);
    for (const Range& r : ranges.ranges()) {
        const auto isUnbounded = [](const timeseries::Bound& b, double end) {
            return timeseries::toDouble(b.value) == end && !b.open;
        };
        const bool down = isUnbounded(r.lo, -kInfinity), up = isUnbounded(r.hi, kInfinity);
        const auto shown = [&](const timeseries::Number& bound) {
            const std::string number = boundText(bound, digits);
            rounded = rounded || number != timeseries::toText(bound);
            return render::withMinusSigns(number);
        };
        const std::string lo = shown(r.lo.value), hi = shown(r.hi.value);
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

std::string sweptText(const timeseries::ValueSweep& sweep, std::int64_t tick) {
    const double delta = sweep.settings().delta, contour = sweep.contour(tick);
    // As many decimals at every tick: the text does not tremble while it plays.
    const double resolution =
        delta > 0 ? delta / 50 : std::max(1e-6 * std::abs(contour), kLeastResolution);
    const int decimals = static_cast<int>(std::ceil(-std::log10(resolution)));
    const bool isPlain = decimals <= 9 && std::abs(contour) < 1e9;
    const std::string centre =
        isPlain ? fmt::format("{:.{}f}", roundedTo(contour, resolution), std::max(0, decimals))
                : timeseries::toText(roundedTo(contour, resolution));
    return render::withMinusSigns(centre) + " ± " + timeseries::toText(delta);
}

std::vector<timeseries::Interval<double>> cellsNeeded(const Explorer& e,
                                                      timeseries::ValueType type) {
    std::vector<timeseries::Interval<double>> all;
    for (const LayerChoice& layer : e.layers) {
        if (!layer.visible) continue;
        if (layer.motion) return {timeseries::kAllNumbers};
        std::ranges::copy(timeseries::betweenPoints(layer.ranges, type), std::back_inserter(all));
    }
    return all;
}

render::Scene makeScene(const Explorer& e, const SortedStep& step,
                        const render::PlacedPoints& placed, std::int64_t tick, Await await) {
    render::Scene scene{.step = step,
                        .placed = placed,
                        .layers = {},
                        .footprint = e.footprint,
                        .order = e.order,
                        .clip = {}};
    if (e.clip) scene.clip = render::indexBox(step.grid(), e.clip->lo, e.clip->hi);
    if (e.model == Model::Cells) {
        const auto needed = cellsNeeded(e, step.type());
        scene.cells = await == Await::Cells ? step.cells(needed) : step.cellsIfMade(needed);
    }
    if (scene.cells && scene.order == render::Order::BackToFront) scene.light = e.light;
    scene.opacityPer = e.opacityPer;
    for (const LayerChoice& layer : e.layers) {
        if (!layer.visible) continue;
        const RangeSet ranges = rangesAt(layer, step, tick);
        scene.layers.push_back({step.select(ranges), rangeStyle(layer)});
        render::Cells& cells = scene.layers.back().cells;
        cells.ranges = timeseries::betweenPoints(ranges, step.type());
        if (scene.cells) cells.candidates = scene.cells->select(cells.ranges);
    }
    // The same picture without it.
    if (scene.light == render::Light::Off && render::areOneColor(scene.layers))
        scene.order = render::Order::None;
    return scene;
}

namespace {

// "1,204 points, 6.2 %", "1 point in the clip box, 0.01 % of all".
std::vector<std::string> amounts(const render::Scene& scene, bool isClipped) {
    std::vector<std::uint64_t> points;
    if (isClipped) {
        std::vector<std::vector<timeseries::Run>> sets;
        for (const render::Layer& layer : scene.layers) sets.push_back(layer.runs);
        points = countsInside(scene.step, scene.clip, sets);
    } else {
        for (const render::Layer& layer : scene.layers) points.push_back(render::pointCount(layer));
    }
    const auto all = static_cast<double>(scene.step.statistics().points);
    std::vector<std::string> texts;
    for (const std::uint64_t count : points) {
        const double percent = all > 0 ? 100 * static_cast<double>(count) / all : 0;
        texts.push_back(fmt::format(
            "{} {}{}, {} %{}", withCommas(count), count == 1 ? "point" : "points",
            isClipped ? " in the clip box" : "",
            render::withMinusSigns(fmt::format("{:.3g}", percent)), isClipped ? " of all" : ""));
    }
    return texts;
}

}  // namespace

render::Legend makeLegend(const Explorer& e, const timeseries::Variable& variable,
                          std::size_t stepIndex, const render::Scene& scene, std::int64_t tick) {
    render::Legend legend;
    const std::vector<std::string> amountOf = amounts(scene, e.clip.has_value());
    const std::string unit = render::shownUnit(variable.units);
    // A colour bar's ends come from what was chosen alone, not from the step: they stand still
    // while time and sweep play, and an export, which sees one step at a time, has the same. An
    // open end of a range is the map's, which was taken from the data when the layer was made.
    const auto add = [&](std::string range, const RangeSet& span) {
        const std::size_t k = legend.layers.size();
        render::LegendLayer& told = legend.layers.emplace_back(
            render::LegendLayer{scene.layers[k].style, std::move(range), amountOf[k]});
        if (const auto* byValue = std::get_if<render::ByValue>(&told.style.color)) {
            const Extent ends = finiteEnds(span, {byValue->lo, byValue->hi});
            told.shown.emplace(ends.lo, ends.hi);
        }
    };
    for (const LayerChoice& layer : e.layers) {
        if (!layer.visible) continue;
        if (layer.motion)
            add(sweptText(timeseries::ValueSweep(*layer.motion), tick) +
                    (unit.empty() ? "" : " " + unit),
                layer.motion->animation);
        else
            add(rangeLabel(layer.ranges, variable.units), layer.ranges);
    }

    legend.title = variable.longName.empty() ? variable.name : variable.longName;
    if (!unit.empty()) legend.title += " (" + unit + ")";
    const std::size_t steps = variable.time->points.size();
    const bool timed = !variable.time->counted;
    if (timed) legend.time = timeText(*variable.time, stepIndex);
    if (steps > 1)
        legend.time +=
            fmt::format("{}step {} of 0\u2013{}", timed ? ", " : "", stepIndex, steps - 1);
    if (scene.step.statistics().points == 0)
        legend.emptiness = fmt::format("all {} points of this step are missing",
                                       withCommas(scene.step.statistics().missing));
    legend.notes = variable.notes;
    if (legend.layers.empty())
        legend.notes.push_back(e.layers.empty() ? "nothing is drawn: there is no layer"
                                                : "nothing is drawn: every layer is hidden");
    if (const std::string stretch = render::stretchText(scene.step.grid(), scene.placed);
        !stretch.empty())
        legend.notes.push_back(stretch);
    if (scene.cells && !scene.layers.empty())
        legend.notes.emplace_back(kInterpolated);
    else if (e.model == Model::Cells && !scene.step.canHaveCells())
        legend.notes.push_back(fmt::format("drawn by points: {}", scene.step.whyNoCells()));
    if (e.clip) legend.notes.push_back("drawn inside " + clipText(*e.clip) + " only");
    return legend;
}

bool isMixed(const Explorer& e, const render::Scene& scene) {
    return render::isMixed(scene,
                           eyes(e.view, e.stereo, scene.placed.boxHalfEdges(), e.size).front());
}

Picture makePicture(const Explorer& e, const timeseries::Variable& variable, std::size_t stepIndex,
                    const SortedStep& step, const render::PlacedPoints& placed, std::int64_t tick) {
    render::Scene scene = makeScene(e, step, placed, tick);
    render::Legend legend = makeLegend(e, variable, stepIndex, scene, tick);
    return {std::move(scene), std::move(legend)};
}

}  // namespace app
