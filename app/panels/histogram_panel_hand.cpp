// The histogram under the hand.
#include <cmath>

#include "app/choices/edits.h"
#include "app/panels/histogram_drawing.h"

namespace app::panels {
namespace {

using timeseries::Bound;
using timeseries::Range;
using timeseries::RangeSet;
using timeseries::toDouble;

Range closed(double a, double b) {
    return {Bound{std::min(a, b), false}, Bound{std::max(a, b), false}};
}

// The tick of a sweep whose contour comes nearest to a value: contours ascend over a whole Loop and
// over the first half of a Swing.
std::int64_t nearestTick(const timeseries::ValueSweep& sweep, double value) {
    const std::int64_t ticks = sweep.ticksPerCycle();
    std::int64_t lo = 0, hi = ticks - 1;
    if (sweep.settings().path == timeseries::SweepPath::Swing) hi = ticks / 2;
    while (lo < hi) {
        const std::int64_t middle = lo + (hi - lo) / 2;
        if (sweep.contour(middle) < value)
            lo = middle + 1;
        else
            hi = middle;
    }
    if (lo > 0 && std::abs(sweep.contour(lo - 1) - value) < std::abs(sweep.contour(lo) - value))
        --lo;
    return lo;
}

}  // namespace

HistogramPanel::Grab HistogramPanel::gripAt(const Drawing& f, glm::vec2 mouse) const {
    const float reach = 5 * f.s;
    Grab grab{.pressedAt = mouse,
              .valueAt = f.axis.valueAt(mouse.y),
              .newLayer = ImGui::GetIO().KeyShift};
    const auto& playback = f.context.exploration.playback();
    if (playback.sweep && f.at.axis.holds(mouse)) {
        const auto ranges = playback.sweep->settings().animation.ranges();
        const float lo = f.axis.y(toDouble(ranges.front().lo.value)),
                    hi = f.axis.y(toDouble(ranges.back().hi.value));
        grab.ranges = playback.sweep->settings().animation;
        if (std::abs(mouse.y - lo) < reach) return grab.grip = Grip::AnimationLo, grab;
        if (std::abs(mouse.y - hi) < reach) return grab.grip = Grip::AnimationHi, grab;
        const Range window = playback.sweep->window();
        if (mouse.y <= f.axis.y(toDouble(window.lo.value)) + reach &&
            mouse.y >= f.axis.y(toDouble(window.hi.value)) - reach)
            return grab.grip = Grip::Window, grab;
    }
    if (mouse.x < f.at.histogram.min.x) {
        forEachEnd(f, [&](std::size_t layer, std::size_t range, End end, double value) {
            // The selected layer's before others.
            if (!handleOf(f, value, end).holds(mouse) ||
                (grab.grip != Grip::None && layer != f.context.choices.layer))
                return;
            grab.grip = end == End::Lo ? Grip::Lo : Grip::Hi;
            grab.layer = layer;
            grab.range = range;
            grab.ranges = f.explorer().layers[layer].ranges;
            grab.off = mouse.y - std::clamp(f.axis.y(value), f.axis.top, f.axis.bottom);
        });
        if (grab.grip != Grip::None) return grab;
    }
    const auto& time = playback.time;
    if (f.hasMap() && time && mouse.x >= f.at.map.min.x &&
        std::abs(mouse.x - f.steps.centre(time->step())) < reach)
        return grab.grip = Grip::Scrub, grab;

    const bool onMap = f.hasMap() && mouse.x >= f.at.map.min.x;
    // The selected layer first, then the others from the last, which lies on top; ends before
    // bands.
    const std::vector<LayerChoice>& layers = f.explorer().layers;
    std::vector<std::size_t> order;
    if (f.context.choices.layer < layers.size()) order.push_back(f.context.choices.layer);
    for (std::size_t i = layers.size(); i-- > 0;)
        if (i != f.context.choices.layer) order.push_back(i);
    for (const bool ends : {true, false}) {
        for (const std::size_t layer : order) {
            if (!layers[layer].visible) continue;
            const auto ranges = layers[layer].ranges.ranges();
            for (std::size_t i = 0; i < ranges.size(); ++i) {
                const float lo = f.axis.y(toDouble(ranges[i].lo.value)),
                            hi = f.axis.y(toDouble(ranges[i].hi.value));
                grab.layer = layer;
                grab.range = i;
                grab.ranges = layers[layer].ranges;
                const float toLo = std::abs(mouse.y - lo), toHi = std::abs(mouse.y - hi);
                if (ends && std::min(toLo, toHi) < reach) {
                    grab.grip = toLo < toHi ? Grip::Lo : Grip::Hi;
                    grab.off = mouse.y - (toLo < toHi ? lo : hi);
                    return grab;
                }
                if (!ends && !grab.newLayer && mouse.y < lo && mouse.y > hi)
                    return grab.grip = onMap ? Grip::Undecided : Grip::Band, grab;
            }
        }
    }
    grab.grip = Grip::Background;
    return grab;
}

void HistogramPanel::drag(const Drawing& f, glm::vec2 mouse) {
    PanelContext& context = f.context;
    const double value = f.draggedTo(mouse.y);
    const glm::vec2 moved = glm::abs(mouse - grab_.pressedAt);
    const auto setRanges = [&](const RangeSet& ranges) {
        edit(context, "histogram", [&](Explorer& e) {
            if (grab_.layer < e.layers.size()) e.layers[grab_.layer].ranges = ranges;
        });
    };
    const auto setAnimation = [&](std::size_t range, End end) {
        edit(context, "histogram", [&](Explorer& e) {
            if (auto* const sweep = sweepOf(e))
                sweep->animation = withEnd(grab_.ranges, range, end, value, f.axis.perPixel());
        });
    };
    switch (grab_.grip) {
        case Grip::None:
            return;
        case Grip::Lo:
        case Grip::Hi:
            context.choices.layer = grab_.layer;
            if (moved.y < 1) return;
            return setRanges(withEnd(grab_.ranges, grab_.range,
                                     grab_.grip == Grip::Lo ? End::Lo : End::Hi,
                                     f.draggedTo(mouse.y - grab_.off), f.axis.perPixel()));
        case Grip::Band:
            context.choices.layer = grab_.layer;
            if (moved.y < 1) return;
            return setRanges(
                withMoved(grab_.ranges, grab_.range,
                          roundedTo(f.axis.valueAt(mouse.y) - grab_.valueAt, f.axis.perPixel()),
                          f.axis.perPixel()));
        case Grip::Undecided:
            if (std::max(moved.x, moved.y) < 4 * f.s) return;
            grab_.grip = moved.y >= moved.x ? Grip::Band : Grip::Scrub;
            return drag(f, mouse);
        case Grip::Background:
            if (f.hasMap() && grab_.pressedAt.x >= f.at.map.min.x && moved.y < 4 * f.s) {
                context.exploration.seek(f.steps.stepAt(mouse.x));
                if (moved.x >= 4 * f.s) grab_.grip = Grip::Scrub;
                return;
            }
            if (moved.y >= 4 * f.s) dragNew(f, mouse);
            return;
        case Grip::NewRange: {
            const double from = roundedTo(grab_.valueAt, f.axis.perPixel());
            const Range range = closed(from, value);
            return setRanges(grab_.newLayer ? RangeSet({range}) : with(grab_.ranges, range));
        }
        case Grip::Scrub:
            return context.exploration.seek(f.steps.stepAt(mouse.x));
        case Grip::AnimationLo:
            return setAnimation(0, End::Lo);
        case Grip::AnimationHi:
            return setAnimation(grab_.ranges.ranges().size() - 1, End::Hi);
        case Grip::Window:
            if (const auto& sweep = context.exploration.playback().sweep)
                context.exploration.seekTick(nearestTick(*sweep, f.axis.valueAt(mouse.y)));
            return;
        case Grip::Pan: {
            const double by = static_cast<double>(mouse.y - grab_.pressedAt.y) * f.axis.perPixel();
            zoomed_ = {grab_.values.first + by, grab_.values.second + by};
        }
    }
}

// From here on the drag makes a range: of the selected layer, or of a layer of its own.
void HistogramPanel::dragNew(const Drawing& f, glm::vec2 mouse) {
    const std::vector<LayerChoice>& layers = f.explorer().layers;
    const double from = roundedTo(grab_.valueAt, f.axis.perPixel()), value = f.draggedTo(mouse.y);
    grab_.grip = Grip::NewRange;
    const bool full = layers.size() >= render::kMaxLayers;
    const bool noneStands = layers.empty() || layers.back().motion;
    if (noneStands || (grab_.newLayer && !full)) {
        edit(f.context, "histogram", [&](Explorer& e) {
            grab_.layer = addLayer(e, RangeSet({closed(from, value)}), *f.shown.sorted);
        });
        grab_.newLayer = true;
    } else {
        grab_.newLayer = false;
        grab_.layer = std::min(f.context.choices.layer, layers.size() - 1);
        grab_.ranges = layers[grab_.layer].ranges;
    }
    f.context.choices.layer = grab_.layer;
    drag(f, mouse);
}

void HistogramPanel::zoom(const Drawing& f, glm::vec2 mouse) {
    const float wheel = ImGui::GetIO().MouseWheel;
    if (wheel != 0) {
        const double at = f.axis.valueAt(mouse.y),
                     factor = std::pow(0.85, static_cast<double>(wheel));
        const auto [least, most] = allValues(f.context.exploration);
        const double lo = at + (f.axis.lo - at) * factor, hi = at + (f.axis.hi - at) * factor;
        if (hi - lo >= most - least)
            zoomed_.reset();
        else if (hi - lo > 1e-9 * std::max(std::abs(lo), std::abs(hi)))
            zoomed_ = {lo, hi};
    }
    if (ImGui::IsMouseDoubleClicked(0)) zoomed_.reset();
}

}  // namespace app::panels
