#include "app/headset/readout.h"

#include <fmt/format.h>

#include <cmath>

#include "app/picture/error_text.h"
#include "app/picture/picture.h"
#include "app/picture/range_label.h"

namespace app::headset {
namespace {

// The first layer that is seen.
std::string valuesText(const Screen& screen) {
    const Explorer& e = screen.explorer;
    for (const LayerChoice& layer : e.layers)
        if (layer.visible)
            return screen.variable.name + " " +
                   rangeLabel(rangesAt(layer, *screen.sorted, e.play.tick), screen.variable.units);
    return screen.variable.name + ", nothing visible";
}

std::string pictureText(const Screen& screen) {
    const timeseries::TimeAxis& time = *screen.variable.time;
    return fmt::format("{}\n{}, step {} of 0\u2013{}", valuesText(screen),
                       timeText(time, screen.step), screen.step, time.points.size() - 1);
}

std::string tipText(const TipProbe::At& tip, const Shown& shown) {
    std::string text = shown.dataset.variable.name;
    if (tip.value == TipProbe::Value::Found)
        text += " " + valueText(tip.reading, shown);
    else
        text += tip.value == TipProbe::Value::None ? ": no value" : " \u2026";
    for (const auto& [name, place] : placeLines(tip.reading, shown))
        text += "\n" + name + " " + place;
    if (!tip.reading.cell.empty()) text += "\ncell " + tip.reading.cell;
    return text + "\n";
}

}  // namespace

std::string readoutText(const Exploration& exploration, const SeenPicture& seen,
                        const std::optional<TipProbe::At>& tip, double renderScale) {
    const auto shown = exploration.shown();
    if (!shown) {
        const auto opening = exploration.opening();
        return opening ? "opening " + *opening : "no file is open";
    }
    std::string text = tip ? tipText(*tip, *shown) : "";
    text += seen.screen ? pictureText(*seen.screen) : shown->dataset.variable.name + " \u2026";
    if (seen.counts)
        text += fmt::format("\n{} points{}", withCommas(seen.counts->selected),
                            seen.counts->inClipBox ? " in the clip box" : "");
    if (!seen.error.empty()) text += "\n" + seen.error;
    // The error says it where that costs light.
    if (seen.mixesColors && seen.error.find(kMixed) == std::string::npos)
        text += fmt::format("\n{}", kMixed);
    if (const std::string waiting = exploration.waiting(); !waiting.empty()) text += "\n" + waiting;
    if (exploration.playback().playing) text += "\nplaying";
    if (renderScale < 1) text += fmt::format("\nresolution {} %", std::lround(100 * renderScale));
    return text;
}

}  // namespace app::headset
