// The ends of ranges: a line across, but for the column of numbers, and a handle left of the
// histogram, for the mouse and for the keyboard.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "app/panels/histogram_drawing.h"
#include "app/panels/layer_style.h"

namespace app::panels {
namespace {

const timeseries::Bound& boundOf(const timeseries::Range& range, End end) {
    return end == End::Lo ? range.lo : range.hi;
}

// A tab at the line's end with a grip to take it by.
void drawHandle(ImDrawList& list, const Rect& at, End end, ImU32 color, float s) {
    list.AddRectFilled(
        im(at.min), im(at.max), color, 4 * s,
        end == End::Hi ? ImDrawFlags_RoundCornersTop : ImDrawFlags_RoundCornersBottom);
    const glm::vec2 middle = glm::floor(at.centre());
    for (const float y : {-2.0f, 1.0f})
        list.AddRectFilled({middle.x - 4 * s, middle.y + y * s},
                           {middle.x + 4 * s, middle.y + (y + 1) * s}, faded(kGround, 0.8f));
}

}  // namespace

Rect HistogramPanel::reach(const Drawing& f) {
    Rect across = f.across();
    across.min.x = endHandle(f.at, f.s, 0, true).min.x;
    return across;
}

Rect HistogramPanel::handleOf(const Drawing& f, double value, End end) {
    return endHandle(f.at, f.s, f.axis.y(value), end == End::Hi);
}

void HistogramPanel::forEachEnd(
    const Drawing& f,
    const std::function<void(std::size_t, std::size_t, End, double)>& visit) const {
    const std::vector<LayerChoice>& layers = f.explorer().layers;
    for (std::size_t l = 0; l < layers.size(); ++l) {
        if (!layers[l].visible) continue;
        const auto ranges = layers[l].ranges.ranges();
        for (std::size_t i = 0; i < ranges.size(); ++i)
            for (const End end : {End::Lo, End::Hi})
                visit(l, i, end, timeseries::toDouble(boundOf(ranges[i], end).value));
    }
}

void HistogramPanel::drawEnds(const Drawing& f, const Grab& hovered) const {
    forEachEnd(f, [&](std::size_t layer, std::size_t range, End end, double value) {
        const bool grabbed = hovered.layer == layer && hovered.range == range &&
                             hovered.grip == (end == End::Hi ? Grip::Hi : Grip::Lo);
        // Lighter than the layer: a map's dark end is as dark as the ground.
        const ImU32 color = grabbed ? kText
                                    : mixed(colorAt(f.explorer().layers[layer],
                                                    std::clamp(value, f.axis.lo, f.axis.hi)),
                                            kText, 0.35f);
        const bool inView = value >= f.axis.lo && value <= f.axis.hi;
        if (inView) {
            const float y = f.axis.y(value), half = (grabbed ? 1.5f : 0.75f) * f.s;
            f.list.AddRectFilled({f.at.histogram.min.x - 2 * f.s, y - half},
                                 {f.at.histogram.max.x, y + half}, color);
            if (f.hasMap())
                f.list.AddRectFilled({f.at.map.min.x, y - half}, {f.at.map.max.x, y + half}, color);
        }
        drawHandle(f.list, handleOf(f, value, end), end,
                   inView ? color : mixed(kPanel, color, 0.4f), f.s);
    });
}

void HistogramPanel::moveEndsByKeys(const Drawing& f) {
    PanelContext& context = f.context;
    // By value: a turn edits the layers.
    struct Moved {
        std::size_t layer, range;
        End end;
        double to;
    };
    std::optional<Moved> moved;
    forEachEnd(f, [&](std::size_t layer, std::size_t range, End end, double value) {
        const std::array<int, 3> place = {static_cast<int>(layer), static_cast<int>(range),
                                          static_cast<int>(end)};
        for (const int part : place) ImGui::PushID(part);
        const ImGuiID own = ImGui::GetID("##end");
        for (std::size_t i = 0; i < place.size(); ++i) ImGui::PopID();
        const Focus::Turn turn =
            focus().control(own, handleOf(f, value, end), Focus::Takes::UpDown);
        if (grab_.grip == (end == End::Lo ? Grip::Lo : Grip::Hi) && grab_.layer == layer &&
            grab_.range == range)
            focus().touch(own);
        if (turn.has) {
            context.choices.layer = layer;
            readout_ = f.withUnit(std::isfinite(value) ? timeseries::toText(value)
                                  : end == End::Lo     ? "min"
                                                       : "max");
        }
        if (turn.by == 0) return;
        const double from = std::isfinite(value) ? value : end == End::Lo ? f.axis.lo : f.axis.hi;
        moved = {layer, range, end,
                 steppedEnd(*f.shown.sorted, from, end, turn.by, f.axis.perPixel())};
    });
    if (!moved) return;
    edit(context, "histogram", [&](Explorer& e) {
        timeseries::RangeSet& ranges = e.layers[moved->layer].ranges;
        ranges = withEnd(ranges, moved->range, moved->end, moved->to, f.axis.perPixel());
    });
}

}  // namespace app::panels
