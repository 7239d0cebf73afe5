// What is said of a picture.
#include <fmt/format.h>

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "app/choices/choice_text.h"
#include "app/choices/decimals.h"
#include "app/picture/clip_counts.h"
#include "app/picture/fitted_map.h"
#include "app/picture/picture.h"
#include "app/picture/range_label.h"
#include "app/picture/resolved.h"
#include "render/annotate/stretch_text.h"
#include "render/annotate/ticks.h"
#include "timeseries/grid/mesh.h"
#include "timeseries/grid/solid_cells.h"

namespace app {
namespace {

using timeseries::Range;
using timeseries::RangeSet;

constexpr const char* kInterpolated = "interpolated between points";
constexpr const char* kAboutMiddles = "interpolated between the middles of cells";
constexpr const char* kByPointsAlone = " by points alone";  // after which layers are
// After how many are selected: nothing lies between them and others.
constexpr const char* kInfinite = " of infinite value counted, not drawn: points show them";

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

// "layer 2", "layers 1 and 3", counted among all, also those that are not seen.
std::string pointLayers(const Explorer& e, const render::Scene& scene) {
    std::vector<std::string> numbers;
    std::size_t k = 0;
    for (std::size_t i = 0; i < e.layers.size(); ++i)
        if (e.layers[i].visible && scene.layers[k++].byPoints)
            numbers.push_back(std::to_string(i + 1));
    if (numbers.size() < 2) return numbers.empty() ? "" : "layer " + numbers.front();
    const std::string last = std::exchange(numbers.back(), "");
    numbers.pop_back();
    return fmt::format("layers {} and {}", fmt::join(numbers, ", "), last);
}

// Selected, of layers that are drawn between points: infinite values have nothing beside them.
std::uint64_t infinitePoints(const render::Scene& scene) {
    const timeseries::StepStatistics& all = scene.step.statistics();
    // The first and the last of the sorted ones; most steps have none, and are not looked into.
    const auto pointsAt = [&](double end, const timeseries::Number& outermost) -> std::uint64_t {
        if (timeseries::toDouble(outermost) != end) return 0;
        const RangeSet alone({Range{{end}, {end}}});
        return scene.step.count(scene.step.keptPart(alone));
    };
    const std::uint64_t least = pointsAt(-kInfinity, all.min), most = pointsAt(kInfinity, all.max);
    if (least == 0 && most == 0) return 0;
    const std::uint64_t end = scene.step.size();
    std::uint64_t points = 0;
    for (const render::Layer& layer : scene.layers)
        for (const timeseries::Run& run : layer.runs) {
            if (layer.byPoints) continue;
            const std::uint64_t last = run.first + run.count;
            points += std::min(last, least) - std::min(run.first, least);
            points += std::max(last, end - most) - std::max(run.first, end - most);
        }
    return points;
}

// Where a mesh that moves has left the box that all steps are drawn in; "" where it has not.
std::string beyondBox(const timeseries::Grid& grid) {
    constexpr double kRounding = 1e-5;  // of the box, that places are kept to
    if (!grid.ofOneStep()) return "";
    std::string beyond;
    for (int a = 0; a < 3; ++a) {
        const auto along = static_cast<std::size_t>(a);
        const auto [least, most] = grid.ends(along);
        const auto [lo, hi] = grid.mesh()->ends(a);
        const double rounding = kRounding * std::max(most - least, hi - lo);
        if (lo >= least - rounding && hi <= most + rounding) continue;
        const timeseries::Axis& axis = grid.axes()[along];
        const std::string unit = render::shownUnit(axis.units);
        beyond += fmt::format("{}{}, {} to {}{}{}", beyond.empty() ? "" : "; ", axis.name,
                              render::withMinusSigns(fmt::format("{:.4g}", lo)),
                              render::withMinusSigns(fmt::format("{:.4g}", hi)),
                              unit.empty() ? "" : " ", unit);
    }
    return beyond.empty() ? "" : "beyond the box that all steps are drawn in: " + beyond;
}

// What a sweep reaches beyond is neither drawn nor counted.
bool sweepsBeyond(const timeseries::SweepSettings& sweep, const RangeSet& kept) {
    std::vector<Range> swept(sweep.animation.ranges().begin(), sweep.animation.ranges().end());
    for (Range& range : swept) {
        range.lo = {timeseries::toDouble(range.lo.value) - sweep.delta};
        range.hi = {timeseries::toDouble(range.hi.value) + sweep.delta};
    }
    const std::array both{kept, RangeSet(std::move(swept))};
    return !(timeseries::unionOf(both) == kept);
}

// What a map without a width, such as one that was chosen for a field of one value, or of none,
// colours alike.
std::string oneColorText(const timeseries::SortedStep& step, timeseries::ValueType type) {
    if (step.size() == 0) return "no values";
    const timeseries::Number least = step.value(0);
    if (timeseries::compare(least, step.value(step.size() - 1)) != 0) return "all values alike";
    const auto* number = std::get_if<double>(&least);
    return "all " +
           render::withMinusSigns(timeseries::toText(number ? shortestIn(type, *number) : least));
}

// A colour bar's ends come from what was chosen alone, not from the step: they stand still while
// time and sweep play, and an export, which sees one step at a time, has the same. An open end of a
// range is the map's, which was taken from the data when the layer was made; of a map that begins
// below these for its dark end, where they begin, or where the step's do if that is lower.
void tellBar(render::LegendLayer& told, const LayerChoice& layer, const Extent& map,
             const std::optional<Extent>& data, const timeseries::SortedStep& step,
             timeseries::ValueType type) {
    const RangeSet& ranges = layer.motion ? layer.motion->animation : layer.ranges;
    double low = map.lo;
    if (const auto begin = darkMapsData(map, ranges, step))
        low = std::max(map.lo, std::min(*begin, data ? data->lo : *begin));
    if (layer.motion) {  // a window leaves nothing out between the ranges that it swings through
        const Extent ends = finiteEnds(ranges, {low, map.hi});
        told.shown.emplace_back(ends.lo, ends.hi);
        return;
    }
    for (const Range& range : ranges.ranges()) {
        const double lo = timeseries::toDouble(range.lo.value),
                     hi = timeseries::toDouble(range.hi.value);
        if (lo == kInfinity || hi == -kInfinity) continue;  // no place on a bar
        told.openBelow = told.openBelow || lo == -kInfinity;
        told.openAbove = told.openAbove || hi == kInfinity;
        told.shown.emplace_back(std::isinf(lo) ? std::min(low, hi) : lo,
                                std::isinf(hi) ? std::max(map.hi, lo) : hi);
    }
    if (told.shown.empty()) told.shown.emplace_back(map.lo, map.hi);
    told.openBelow = told.openBelow && told.shown.front().first <= map.lo;
    if (map.lo == map.hi && told.openBelow && told.openAbove)
        told.ofOneColor = oneColorText(step, type);
}

// A map's ends are doubles, and so are the values that stand between them: 64-bit integers are told
// less apart.
std::string coarseColors(const render::Scene& scene, timeseries::ValueType type) {
    constexpr double kShades = 64;
    if (type != timeseries::ValueType::I64 && type != timeseries::ValueType::U64) return "";
    double coarsest = 0;
    for (const render::Layer& layer : scene.layers)
        if (const auto* map = std::get_if<render::ByValue>(&layer.style.color)) {
            const double most = std::max(std::abs(map->lo), std::abs(map->hi));
            const double apart = most - std::nextafter(most, 0.0);
            if (apart * kShades > 2 * map->halfWidth()) coarsest = std::max(coarsest, apart);
        }
    return coarsest > 1
               ? fmt::format("colours tell values apart that differ by {:g} or more", coarsest)
               : "";
}

}  // namespace

bool isOfCells(const std::string& note) {
    return note == kInterpolated || note.ends_with(kByPointsAlone) || note.ends_with(kInfinite);
}

std::string whyNothing(const Explorer& e) {
    if (std::ranges::any_of(e.layers, &LayerChoice::visible)) {
        const bool isClear = std::ranges::none_of(
            e.layers, [](const LayerChoice& layer) { return layer.visible && layer.opacity != 0; });
        return isClear ? "nothing is seen: the opacity of every layer is 0" : "";
    }
    return e.layers.empty() ? "nothing is drawn: there is no layer"
                            : "nothing is drawn: every layer is hidden";
}

render::Legend makeLegend(const Explorer& e, const timeseries::Variable& variable,
                          std::size_t stepIndex, const render::Scene& scene, std::int64_t tick) {
    render::Legend legend;
    const std::vector<std::string> amountOf = amounts(scene, e.clip.has_value());
    const std::string unit = render::shownUnit(variable.units);
    const auto add = [&](std::string range, const LayerChoice& layer) {
        const std::size_t k = legend.layers.size();
        render::LegendLayer& told = legend.layers.emplace_back(
            render::LegendLayer{scene.layers[k].style, std::move(range), amountOf[k]});
        if (const auto* byValue = std::get_if<render::ByValue>(&told.style.color))
            tellBar(told, layer, {byValue->lo, byValue->hi}, extentOf(e, scene.step), scene.step,
                    variable.type);
    };
    for (const LayerChoice& layer : e.layers) {
        if (!layer.visible) continue;
        if (layer.motion)
            add(sweptText(timeseries::ValueSweep(*layer.motion), tick) +
                    (unit.empty() ? "" : " " + unit),
                layer);
        else if (const std::string classes = classLabel(layer.ranges, variable); !classes.empty())
            add(fmt::format("{}: {}", rangeLabel(layer.ranges, variable.units), classes), layer);
        else
            add(rangeLabel(layer.ranges, variable.units), layer);
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
    if (std::string coarse = coarseColors(scene, variable.type); !coarse.empty())
        legend.notes.push_back(std::move(coarse));
    if (std::string why = whyNothing(e); !why.empty()) legend.notes.push_back(std::move(why));
    if (const std::string stretch = render::stretchText(scene.step.grid(), scene.placed);
        !stretch.empty())
        legend.notes.push_back(stretch);
    if (scene.cells && !scene.layers.empty()) {
        const auto& mesh = scene.step.grid().mesh();
        const bool ofMiddles = mesh && mesh->solids() && mesh->solids()->haveMiddles();
        legend.notes.emplace_back(ofMiddles ? kAboutMiddles : kInterpolated);
        if (const std::uint64_t points = infinitePoints(scene); points > 0)
            legend.notes.push_back(withCommas(points) + kInfinite);
        if (const std::string which = pointLayers(e, scene); !which.empty())
            legend.notes.push_back(which + kByPointsAlone);
    } else if (modelOf(e) == Model::Cells && !scene.step.canHaveCells()) {
        legend.notes.push_back(fmt::format("drawn by points: {}", scene.step.whyNoCells()));
    } else if (modelOf(e) == Model::Cells && scene.step.cellsAreGivenUp()) {
        legend.notes.emplace_back("drawn by points: there is no memory for so many cells");
    }
    if (std::string beyond = beyondBox(scene.step.grid()); !beyond.empty())
        legend.notes.push_back(std::move(beyond));
    const std::string clipped = e.clip ? clipLabel(*e.clip, scene.step.grid()) : "";
    if (!clipped.empty()) legend.notes.push_back("drawn inside " + clipped + " only");
    if (const auto* sweep = sweepOf(e); sweep && e.keep && sweepsBeyond(*sweep, *e.keep))
        legend.notes.push_back("kept, drawn and counted: " + rangeLabel(*e.keep, variable.units) +
                               " only");
    return legend;
}

}  // namespace app
