#include "app/picture/picture.h"

#include <fmt/format.h>

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include "app/choices/camera.h"
#include "app/choices/choice_text.h"
#include "app/choices/decimals.h"
#include "app/picture/clip_counts.h"
#include "app/picture/resolved.h"
#include "render/annotate/stretch_text.h"
#include "render/annotate/ticks.h"
#include "render/frame/mean_depth.h"
#include "render/image/color.h"
#include "render/splat/mixed_splatter.h"

namespace app {
namespace {

using timeseries::Range;
using timeseries::RangeSet;
using timeseries::SortedStep;

constexpr double kLeastResolution = std::numeric_limits<double>::min();

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
        if (!layer.visible || modelOf(e, layer) == Model::Points) continue;
        if (layer.motion) return {timeseries::kAllNumbers};
        std::ranges::copy(timeseries::betweenPoints(layer.ranges, type), std::back_inserter(all));
    }
    return all;
}

bool needsCells(const Explorer& e, const SortedStep& step, const render::PlacedPoints& placed) {
    return modelOf(e) == Model::Cells && step.canHaveCells() &&
           (!mixesModels(e) || render::MixedSum::canSum(placed, e.footprint));
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
    if (needsCells(e, step, placed)) {
        const auto needed = cellsNeeded(e, step.type());
        scene.cells = await == Await::Cells ? step.cells(needed) : step.cellsIfMade(needed);
    }
    if (scene.cells && scene.order == render::Order::BackToFront) scene.light = e.light;
    if (e.lamp) scene.lamp = directionOf(e.lamp->azimuthDegrees, e.lamp->elevationDegrees);
    scene.opacityPer = e.opacityPer;
    for (const LayerChoice& layer : e.layers) {
        if (!layer.visible) continue;
        const RangeSet ranges = rangesAt(layer, step, tick);
        scene.layers.push_back({step.select(ranges), rangeStyle(layer)});
        const bool byCells = modelOf(e, layer) == Model::Cells;
        scene.layers.back().byPoints = scene.cells && !byCells;
        render::Cells& cells = scene.layers.back().cells;
        cells.ranges = timeseries::betweenPoints(ranges, step.type());
        if (scene.cells && byCells) cells.candidates = scene.cells->select(cells.ranges);
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

namespace {

// "layer 2", "layers 1 and 3", counted among those that are seen.
std::string pointLayers(const render::Scene& scene) {
    std::vector<std::string> numbers;
    for (std::size_t k = 0; k < scene.layers.size(); ++k)
        if (scene.layers[k].byPoints) numbers.push_back(std::to_string(k + 1));
    if (numbers.size() < 2) return numbers.empty() ? "" : "layer " + numbers.front();
    const std::string last = std::exchange(numbers.back(), "");
    numbers.pop_back();
    return fmt::format("layers {} and {}", fmt::join(numbers, ", "), last);
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
    if (scene.cells && !scene.layers.empty()) {
        legend.notes.emplace_back(kInterpolated);
        if (const std::string which = pointLayers(scene); !which.empty())
            legend.notes.push_back(which + kByPointsAlone);
    } else if (modelOf(e) == Model::Cells && !scene.step.canHaveCells()) {
        legend.notes.push_back(fmt::format("drawn by points: {}", scene.step.whyNoCells()));
    } else if (mixesModels(e) && !render::MixedSum::canSum(scene.placed, e.footprint)) {
        legend.notes.emplace_back(
            "drawn by points: the splats of one layer have no order among another's cells here");
    }
    if (e.clip) legend.notes.push_back("drawn inside " + clipText(*e.clip) + " only");
    return legend;
}

bool isMixed(const Explorer& e, const render::Scene& scene) {
    return render::isMixed(scene, eyes(e.view, e.stereo, scene.placed.outline(), e.size).front());
}

Picture makePicture(const Explorer& e, const timeseries::Variable& variable, std::size_t stepIndex,
                    const SortedStep& step, const render::PlacedPoints& placed, std::int64_t tick) {
    render::Scene scene = makeScene(e, step, placed, tick);
    render::Legend legend = makeLegend(e, variable, stepIndex, scene, tick);
    return {std::move(scene), std::move(legend)};
}

}  // namespace app
