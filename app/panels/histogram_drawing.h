// What one drawing of the histogram panel is worked out from, once, for its drawing and for the
// hand.
#pragma once

#include <algorithm>
#include <string>

#include "app/choices/decimals.h"
#include "app/panels/histogram_panel.h"
#include "render/annotate/ticks.h"

namespace app::panels {

struct HistogramPanel::Drawing {
    PanelContext& context;
    Shown shown;
    const timeseries::Series& series;
    HistogramLayout at;
    ValueAxis axis;
    StepAxis steps;
    ImDrawList& list;
    float s;

    const Explorer& explorer() const { return context.exploration.explorer(); }
    bool hasMap() const { return at.map.size().x > 0; }
    Rect across() const { return {at.histogram.min, {at.map.max.x, at.map.max.y}}; }
    // What is dragged to a height: no farther than the axis shown, to a pixel's digits.
    double draggedTo(float y) const {
        return roundedTo(std::clamp(axis.valueAt(y), axis.lo, axis.hi), axis.perPixel());
    }
    std::string withUnit(const std::string& number) const {
        const std::string unit = render::shownUnit(shown.dataset.variable.units);
        return unit.empty() ? number : number + " " + unit;
    }
};

// What stands at the ends of the axis where values are infinite.
constexpr const char *kBelowAll = "\u2212\u221e", *kAboveAll = "+\u221e";

// The finite values of all steps seen, with a little room.
std::pair<double, double> allValues(const Exploration& exploration);

}  // namespace app::panels
