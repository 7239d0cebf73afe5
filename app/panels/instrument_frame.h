// What one frame of the instrument is worked out from, once, for its drawing and for the hand.
#pragma once

#include <string>

#include "app/panels/instrument.h"
#include "render/annotate/ticks.h"

namespace app::panels {

struct Instrument::Frame {
    Desk& desk;
    Shown shown;
    const timeseries::Series& series;
    InstrumentLayout at;
    ValueAxis axis;
    StepAxis steps;
    ImDrawList& list;
    float s;

    const Explorer& explorer() const { return desk.exploration.explorer(); }
    bool hasMap() const { return at.map.size().x > 0; }
    Rect across() const { return {at.histogram.min, {at.map.max.x, at.map.max.y}}; }
    std::string withUnit(const std::string& number) const {
        const std::string unit = render::shownUnit(shown.dataset.about.units);
        return unit.empty() ? number : number + " " + unit;
    }
};

// What stands at the ends of the axis where values are infinite.
constexpr const char *kBelowAll = "\u2212\u221e", *kAboveAll = "+\u221e";

// The finite values of all steps seen, with a little room.
std::pair<double, double> allValues(const Exploration& exploration);

}  // namespace app::panels
