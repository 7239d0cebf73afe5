#include "app/exploration/point_counts.h"

#include "app/picture/clip_counts.h"
#include "app/picture/picture.h"

namespace app {
namespace {

using timeseries::Run;

std::uint64_t sum(const std::vector<Run>& runs) {
    std::uint64_t points = 0;
    for (const Run& run : runs) points += run.count;
    return points;
}

}  // namespace

PointCounts pointCounts(const Explorer& explorer, const timeseries::SortedStep& step) {
    std::vector<timeseries::RangeSet> visible;
    // Those of the layers, of the swept window and of all that is visible.
    std::vector<std::vector<Run>> sets;
    for (const LayerChoice& layer : explorer.layers) {
        sets.push_back(step.select(layer.ranges));
        if (layer.visible) visible.push_back(layer.ranges);
    }
    sets.emplace_back();
    if (explorer.sweep) {
        const timeseries::RangeSet window = sweptRanges(explorer, step, explorer.play.tick);
        sets.back() = step.select(window);
        if (explorer.sweepLayer.visible) visible.push_back(window);
    }
    sets.push_back(step.select(timeseries::unionOf(visible)));

    std::vector<std::uint64_t> points;
    if (explorer.clip) {
        points = countsInside(
            step, render::indexBox(step.grid(), explorer.clip->lo, explorer.clip->hi), sets);
    } else {
        for (const std::vector<Run>& runs : sets) points.push_back(sum(runs));
    }
    const std::size_t layers = explorer.layers.size();
    return {.layers = {points.begin(), points.begin() + static_cast<std::ptrdiff_t>(layers)},
            .swept = points[layers],
            .selected = points[layers + 1],
            .kept = step.size(),
            .total = step.statistics().points,
            .inClipBox = explorer.clip.has_value()};
}

std::vector<Run> runsLookedAt(const Explorer& explorer, const timeseries::SortedStep& step) {
    std::vector<timeseries::RangeSet> all;
    for (const LayerChoice& layer : explorer.layers) all.push_back(layer.ranges);
    if (explorer.sweep) all.push_back(sweptRanges(explorer, step, explorer.play.tick));
    return step.select(timeseries::unionOf(all));
}

}  // namespace app
