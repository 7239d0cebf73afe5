#include "app/choices/sweep_edits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "app/choices/decimals.h"

namespace app {
namespace {

using timeseries::RangeSet;
using timeseries::SortedStep;

struct Beginning {
    std::int64_t tick = 0;
    std::uint64_t points = 0;  // in the window
    bool isSeen = false;       // points, but no more than the share
};

// Where one window of these settings is best begun: at most of the points that are allowed, inside
// `wanted` first; else at the fewest points that there are.
Beginning beginningOf(const timeseries::SweepSettings& settings, const SortedStep& step,
                      const RangeSet& wanted) {
    const auto most =
        static_cast<std::uint64_t>(kFirstShare * static_cast<double>(step.statistics().points));
    const timeseries::ValueSweep sweep(settings);
    Beginning inside, anywhere, fewest;
    // The way back of a swing shows the same windows again.
    for (std::int64_t tick = 0; tick <= sweep.ticksPerCycle() / 2; ++tick) {
        const RangeSet window(std::vector{sweep.window(tick)});
        const std::uint64_t points = step.count(step.keptPart(window));
        if (points == 0) continue;
        if (fewest.points == 0 || points < fewest.points) fewest = {tick, points, false};
        if (points > most) continue;
        if (points > anywhere.points) anywhere = {tick, points, true};
        const auto holds = [contour = sweep.contour(tick)](const auto& interval) {
            return interval.lo <= contour && contour <= interval.hi;
        };
        if (points > inside.points && std::ranges::any_of(wanted.toIntervals<double>(), holds))
            inside = {tick, points, true};
    }
    return inside.isSeen ? inside : anywhere.isSeen ? anywhere : fewest;
}

// Of 64-bit integers as one of them, so that what is swept is exact.
timeseries::Number wholeOf(double value, timeseries::ValueType type) {
    const bool isSigned = type == timeseries::ValueType::I64;
    if (!isSigned && type != timeseries::ValueType::U64) return value;
    const auto as = [&]<typename T>(T) -> timeseries::Number {
        constexpr T least = std::numeric_limits<T>::min(), most = std::numeric_limits<T>::max();
        if (!(value > static_cast<double>(least))) return least;
        return value < static_cast<double>(most) ? static_cast<T>(value) : most;
    };
    return isSigned ? as(std::int64_t{}) : as(std::uint64_t{});
}

RangeSet visibleRanges(const Explorer& e) {
    std::vector<RangeSet> visible;
    for (const LayerChoice& layer : e.layers)
        if (layer.visible) visible.push_back(layer.ranges);
    return timeseries::unionOf(visible);
}

}  // namespace

void setSweep(Explorer& e, timeseries::SweepSettings settings) {
    if (sweepOf(e) == nullptr) e.layers.emplace(e.layers.begin());
    e.layers.front().motion = std::move(settings);
    e.noLayers = false;
}

void startSweep(Explorer& e, const Extent& values, const SortedStep& step, bool timePlays) {
    const double width = values.hi - values.lo;
    timeseries::SweepSettings sweep;
    sweep.animation = RangeSet(std::vector{
        timeseries::Range{{wholeOf(values.lo, step.type())}, {wholeOf(values.hi, step.type())}}});
    const RangeSet wanted = visibleRanges(e);
    Beginning begin;
    // Half as wide where a window always holds too many points, as between far outliers.
    constexpr int kHalvings = 12;
    for (int i = 0; i <= kHalvings; ++i) {
        const double delta = std::ldexp(0.04 * width, -i);
        sweep.delta = delta > 0 ? roundedTo(delta, delta / 40) : 0;
        begin = beginningOf(sweep, step, wanted);
        if (begin.isSeen || !(delta > 0)) break;
    }
    setSweep(e, std::move(sweep));
    e.layers.front().color = MapChoice{.map = {}, .lo = values.lo, .hi = values.hi};
    e.layers.front().opacity = opacityFor(begin.points, step.grid());
    if (timePlays && e.play.timeMoves) e.play.sweepMoves = false;
    e.play.tick = begin.tick;
}

}  // namespace app
