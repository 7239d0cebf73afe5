#include "app/headset/sticks.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/choices/edits.h"

namespace app::headset {
namespace {

using timeseries::SweepPath;
using timeseries::ValueSweep;

constexpr double kRest = 0.15;
// A tap goes so far, and lasts no longer than this.
constexpr double kTapped = 0.5;
constexpr std::chrono::milliseconds kTapAtMost(250);

// Takes the whole part of what is still to be moved.
int whole(double& rest) {
    const double part = std::trunc(rest);
    rest -= part;
    return static_cast<int>(part);
}

// The ticks on which the value ascends: all of a loop's, the first half of a swing's.
std::int64_t lastAscending(const ValueSweep& sweep) {
    const std::int64_t ticks = sweep.ticksPerCycle();
    return sweep.settings().path == SweepPath::Swing ? ticks / 2 : ticks - 1;
}

struct Extent {
    double lo, hi;
};
std::optional<Extent> extentOf(const timeseries::SortedStep& step) {
    const double lo = timeseries::toDouble(step.statistics().finiteMin),
                 hi = timeseries::toDouble(step.statistics().finiteMax);
    if (!(lo < hi)) return std::nullopt;
    return Extent{lo, hi};
}

}  // namespace

double rateOf(double stick) {
    const double beyond = std::clamp((std::abs(stick) - kRest) / (1 - kRest), 0.0, 1.0);
    return std::copysign(beyond * beyond, stick);
}

Sticks::Ends Sticks::move(Exploration& exploration, double value, double time,
                          std::chrono::nanoseconds dt) {
    const auto shown = exploration.shown();
    const double seconds = std::chrono::duration<double>(dt).count();
    const double valueRate = rateOf(value), timeRate = rateOf(time);
    if (valueRate == 0) ticks_ = 0;
    const double side = timeRate == 0 ? 0 : std::copysign(1, timeRate);
    if (side != timeWay_.side) {
        timeWay_ = {.side = side};
        steps_ = 0;
    }
    if (dragging_ && (valueRate == 0 || !shown)) {
        exploration.endGesture();
        dragging_ = false;
    }
    if (!shown) return {};
    Ends ends;
    if (timeRate != 0) ends.time = moveTime(exploration, time, dt);
    if (valueRate != 0) {
        const double ways = valueRate * seconds / kValueSeconds;
        ends.value = exploration.playback().sweep ? moveWindow(exploration, ways)
                                                  : moveLayer(exploration, ways);
    }
    return ends;
}

bool Sticks::moveWindow(Exploration& exploration, double ways) {
    const ValueSweep& sweep = *exploration.playback().sweep;
    const std::int64_t last = lastAscending(sweep);
    ticks_ += ways * static_cast<double>(last);
    const int by = whole(ticks_);
    if (by == 0) return false;
    // On a swing's way back the same values are met in the other order.
    const std::int64_t now =
        sweep.tick() <= last ? sweep.tick() : sweep.ticksPerCycle() - sweep.tick();
    const std::int64_t next = std::clamp<std::int64_t>(now + by, 0, last);
    if (next != sweep.tick()) exploration.seekTick(next);
    return next != now + by;
}

bool Sticks::moveLayer(Exploration& exploration, double ways) {
    Explorer next = exploration.explorer();
    const auto layer = std::ranges::find_if(
        next.layers, [](const LayerChoice& l) { return l.visible && !l.ranges.ranges().empty(); });
    const auto extent = extentOf(*exploration.shown()->sorted);
    if (layer == next.layers.end() || !extent) return false;
    const timeseries::Range& range = layer->ranges.ranges().front();
    const double lo = timeseries::toDouble(range.lo.value),
                 hi = timeseries::toDouble(range.hi.value);
    const double wanted = ways * (extent->hi - extent->lo);
    // As far as one of its ends still lies among the values.
    const double by = std::clamp(wanted, std::min(0.0, extent->lo - (std::isfinite(hi) ? hi : lo)),
                                 std::max(0.0, extent->hi - (std::isfinite(lo) ? lo : hi)));
    if (!std::isfinite(lo) && !std::isfinite(hi)) return false;
    if (by != 0) {
        layer->ranges = withMoved(layer->ranges, 0, by);
        exploration.edit(std::move(next), "stick");
        dragging_ = true;
    }
    return by != wanted;
}

bool Sticks::moveTime(Exploration& exploration, double time, std::chrono::nanoseconds dt) {
    timeWay_.held += dt;
    if (timeWay_.held > kTapAtMost) {
        const auto steps = static_cast<double>(exploration.series()->stepCount());
        steps_ += rateOf(time) * std::chrono::duration<double>(dt).count() *
                  std::clamp(steps / 4, 2.0, 60.0);
    } else if (std::abs(time) >= kTapped && !std::exchange(timeWay_.tapped, true)) {
        steps_ = timeWay_.side;
    }
    const int by = whole(steps_);
    if (by == 0) return false;
    const auto before = exploration.explorer().steps;
    exploration.stepBy(by);
    return exploration.explorer().steps == before;
}

void toggleSwing(Exploration& exploration) {
    Explorer next = exploration.explorer();
    timeseries::SweepSettings* const sweep = sweepOf(next);
    if (sweep == nullptr) return;
    sweep->path = sweep->path == SweepPath::Swing ? SweepPath::Loop : SweepPath::Swing;
    exploration.edit(std::move(next));
}

}  // namespace app::headset
