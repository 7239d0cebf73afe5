#include "app/point_counts.h"

#include "app/picture.h"

namespace app {

PointCounts pointCounts(const Explorer& explorer, const timeseries::SortedStep& step) {
    PointCounts counts{.layers = {},
                       .swept = 0,
                       .selected = 0,
                       .kept = step.size(),
                       .total = step.statistics().points};
    std::vector<timeseries::RangeSet> visible;
    if (explorer.sweep) {
        const timeseries::RangeSet window = sweptRanges(explorer, step, explorer.play.tick);
        counts.swept = step.count(window);
        if (explorer.sweepLayer.visible) visible.push_back(window);
    }
    for (const LayerChoice& layer : explorer.layers) {
        counts.layers.push_back(step.count(layer.ranges));
        if (layer.visible) visible.push_back(layer.ranges);
    }
    counts.selected = step.count(timeseries::unionOf(visible));
    return counts;
}

}  // namespace app
