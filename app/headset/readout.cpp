#include "app/headset/readout.h"

#include <fmt/format.h>

#include <cmath>

#include "app/picture/picture.h"

namespace app::headset {
namespace {

// The swept window, or else the first layer that is seen.
std::string valuesText(const Explorer& e, const Shown& shown) {
    const timeseries::Variable& about = shown.dataset.about;
    if (e.sweep && e.sweepLayer.visible)
        return about.name + " " +
               rangeLabel(sweptRanges(e, *shown.sorted, e.play.tick), about.units);
    for (const LayerChoice& layer : e.layers)
        if (layer.visible) return about.name + " " + rangeLabel(layer.ranges, about.units);
    return about.name + ", nothing visible";
}

std::string tipText(const TipProbe::At& tip, const Shown& shown) {
    std::string text = shown.dataset.about.name;
    if (tip.value == TipProbe::Value::Found)
        text += " " + valueText(tip.reading, shown);
    else
        text += tip.value == TipProbe::Value::None ? ": no value" : " \u2026";
    for (std::size_t a = 0; a < 3; ++a)
        text +=
            "\n" + shown.sorted->grid().axes()[a].name + " " + positionText(tip.reading, shown, a);
    return text + "\n";
}

}  // namespace

std::string readoutText(const Exploration& exploration, const std::optional<TipProbe::At>& tip,
                        double renderScale) {
    const auto shown = exploration.shown();
    if (!shown) {
        const auto opening = exploration.opening();
        return opening ? "opening " + *opening : "no file is open";
    }
    std::string text = tip ? tipText(*tip, *shown) : "";
    text += valuesText(exploration.explorer(), *shown);
    text +=
        fmt::format("\n{}, step {} of 0\u2013{}", timeText(*shown->dataset.about.time, shown->step),
                    shown->step, shown->dataset.stepCount() - 1);
    if (const PointCounts* counts = exploration.counts())
        text += fmt::format("\n{} points{}", withCommas(counts->selected),
                            counts->inClipBox ? " in the clip box" : "");
    if (const std::string waiting = exploration.waiting(); !waiting.empty()) text += "\n" + waiting;
    if (exploration.playback().playing) text += "\nplaying";
    if (renderScale < 1) text += fmt::format("\nresolution {} %", std::lround(100 * renderScale));
    return text;
}

}  // namespace app::headset
