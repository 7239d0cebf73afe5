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
    std::vector<std::vector<Run>> sets;  // of the layers, and of all that is visible
    for (const LayerChoice& layer : explorer.layers) {
        timeseries::RangeSet ranges = rangesAt(layer, step, explorer.play.tick);
        sets.push_back(step.select(ranges));
        if (layer.visible) visible.push_back(std::move(ranges));
    }
    sets.push_back(step.select(timeseries::unionOf(visible)));

    std::vector<std::uint64_t> points;
    if (explorer.clip) {
        points = countsInside(
            step, render::indexBox(step.grid(), explorer.clip->lo, explorer.clip->hi), sets);
    } else {
        for (const std::vector<Run>& runs : sets) points.push_back(sum(runs));
    }
    const std::uint64_t selected = points.back();
    points.pop_back();
    return {.layers = std::move(points),
            .selected = selected,
            .kept = step.size(),
            .total = step.statistics().points,
            .inClipBox = explorer.clip.has_value()};
}

timeseries::RangeSet rangesLookedAt(const Explorer& explorer) {
    std::vector<timeseries::RangeSet> all;
    for (const LayerChoice& layer : explorer.layers) {
        all.push_back(layer.ranges);
        if (layer.motion)
            all.back() = timeseries::RangeSet(
                std::vector{timeseries::ValueSweep(*layer.motion).window(explorer.play.tick)});
    }
    return timeseries::unionOf(all);
}

}  // namespace app
