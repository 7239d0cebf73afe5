#include "timeseries/series/value_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace timeseries {

namespace {

using std::chrono::nanoseconds;
// Products of a nanosecond count and a tick number need more than 64 bits.
__extension__ using Wide = __int128;

constexpr std::int64_t kMostTimerSteps = std::int64_t{1} << 30;
constexpr std::int64_t kLongestSweep = std::int64_t{1} << 60;

std::int64_t ceilDiv(Wide a, Wide b) { return static_cast<std::int64_t>((a + b - 1) / b); }

void check(const SweepSettings& s) {
    if (!(s.delta >= 0) || std::isinf(s.delta))
        throw std::invalid_argument(
            fmt::format("the sweep's delta must be finite and not negative, not {}", s.delta));
    if (s.timerSteps < 1 || s.timerSteps > kMostTimerSteps)
        throw std::invalid_argument(fmt::format(
            "the sweep's timer steps must be in 1 .. {}, not {}", kMostTimerSteps, s.timerSteps));
    if (s.step < 1 || s.step > kMostTimerSteps)
        throw std::invalid_argument(
            fmt::format("the sweep's step must be in 1 .. {}, not {}", kMostTimerSteps, s.step));
    if (!(s.frequency >= 0) || std::isinf(s.frequency))
        throw std::invalid_argument(fmt::format(
            "the sweep's frequency must be finite and not negative, not {}", s.frequency));
}

std::vector<Interval<double>> finiteIntervals(const RangeSet& animation) {
    for (const Range& r : animation.ranges())
        if (std::isinf(toDouble(r.lo.value)) || std::isinf(toDouble(r.hi.value)))
            throw std::invalid_argument(
                fmt::format("the animation range \"{}\" has an infinite end", animation.text()));
    std::vector<Interval<double>> intervals = animation.toIntervals<double>();
    if (intervals.empty())
        throw std::invalid_argument(
            fmt::format("the animation range \"{}\" holds no value", animation.text()));
    return intervals;
}

double halfLength(const Interval<double>& r) { return r.hi / 2 - r.lo / 2; }

// What no type of 64 bits has is beyond all of them as a double, too.
Number numberOfWhole(Wide value) {
    if (value < std::numeric_limits<std::int64_t>::min()) return static_cast<double>(value);
    if (value <= std::numeric_limits<std::int64_t>::max()) return static_cast<std::int64_t>(value);
    if (value <= std::numeric_limits<std::uint64_t>::max())
        return static_cast<std::uint64_t>(value);
    return static_cast<double>(value);
}

}  // namespace

ValueSweep::ValueSweep(SweepSettings settings, SweepPosition position)
    : settings_(std::move(settings)) {
    check(settings_);
    ranges_ = finiteIntervals(settings_.animation);
    wholes_ = wholesOf(settings_.animation);
    for (const Interval<Wide>& r : wholes_)
        halfLengths_.push_back(0.5 * static_cast<double>(r.hi - r.lo));
    if (wholes_.empty())
        for (const Interval<double>& r : ranges_) halfLengths_.push_back(halfLength(r));
    for (const double each : halfLengths_) halfLength_ += each;
    ticks_ = ceilDiv(settings_.timerSteps, settings_.step);
    const double ns = 1e9 / settings_.frequency;  // +inf for 0
    if (ns <= static_cast<double>(kLongestSweep))
        cycle_ = std::max<std::int64_t>(std::llround(ns), ticks_);
    position_.tick = std::clamp<std::int64_t>(position.tick, 0, ticks_ - 1);
    position_.into = std::max(position.into, nanoseconds(0));
    if (cycle_ > 0)
        position_.into = std::min(position_.into, length(position_.tick) - nanoseconds(1));
}

std::optional<nanoseconds> ValueSweep::cycle() const {
    if (cycle_ == 0) return std::nullopt;
    return nanoseconds(cycle_);
}

nanoseconds ValueSweep::begin(std::int64_t tick) const {
    return nanoseconds(ceilDiv(Wide{tick} * cycle_, ticks_));
}

nanoseconds ValueSweep::length(std::int64_t tick) const { return begin(tick + 1) - begin(tick); }

void ValueSweep::set(SweepSettings settings) {
    const std::int64_t count = position_.tick * settings_.step;
    const std::int64_t oldSteps = settings_.timerSteps;
    const nanoseconds oldLength = cycle_ > 0 ? length(position_.tick) : nanoseconds(0);
    ValueSweep changed(std::move(settings));

    const Wide newCount = Wide{count} * changed.settings_.timerSteps / oldSteps;
    changed.position_.tick = static_cast<std::int64_t>(newCount / changed.settings_.step);
    if (oldLength.count() > 0 && changed.cycle_ > 0)
        changed.position_.into = nanoseconds(static_cast<std::int64_t>(
            Wide{position_.into.count()} * changed.length(changed.position_.tick).count() /
            oldLength.count()));
    *this = std::move(changed);
}

void ValueSweep::seek(std::int64_t tick) {
    assert(tick >= 0 && tick < ticks_);
    position_ = {tick, nanoseconds(0)};
}

void ValueSweep::advance(nanoseconds dt) {
    if (cycle_ == 0 || dt.count() <= 0) return;
    const Wide phase = Wide{begin(position_.tick).count()} + position_.into.count() + dt.count();
    const auto inCycle = static_cast<std::int64_t>(phase % cycle_);
    position_.tick = static_cast<std::int64_t>(Wide{inCycle} * ticks_ / cycle_);
    position_.into = nanoseconds(inCycle) - begin(position_.tick);
}

std::optional<nanoseconds> ValueSweep::untilNextTick() const {
    if (cycle_ == 0 || ticks_ == 1) return std::nullopt;
    return length(position_.tick) - position_.into;
}

double ValueSweep::tablePosition(std::int64_t tick) const {
    assert(tick >= 0 && tick < ticks_);
    const std::int64_t steps = settings_.timerSteps;
    const std::int64_t count = tick * settings_.step;
    if (steps == 1) return 0;
    if (settings_.path == SweepPath::Loop)
        return static_cast<double>(count) / static_cast<double>(steps - 1);
    // (1 - cos 2a) / 2 = sin^2 a, which does not cancel near 0; folded, so that the two halves of
    // the swing agree bit for bit.
    const std::int64_t folded = std::min(count, steps - count);
    const double s =
        std::sin(std::numbers::pi * static_cast<double>(folded) / static_cast<double>(steps));
    return s * s;
}

ValueSweep::Place ValueSweep::placeOf(std::int64_t tick) const {
    const double fraction = tablePosition(tick);
    if (!(halfLength_ > 0)) {
        const auto count = static_cast<double>(halfLengths_.size());
        const auto which = static_cast<std::size_t>(fraction * count);
        return {std::min(which, halfLengths_.size() - 1), 0};
    }
    double left = fraction * halfLength_;
    std::size_t last = 0;  // where a rest that rounding leaves beyond the last range belongs
    for (std::size_t k = 0; k < halfLengths_.size(); ++k) {
        if (!(halfLengths_[k] > 0)) continue;
        if (left <= halfLengths_[k]) return {k, left / halfLengths_[k]};
        left -= halfLengths_[k];
        last = k;
    }
    return {last, 1};
}

std::vector<Interval<ValueSweep::Wide>> ValueSweep::wholesOf(const RangeSet& animation) {
    constexpr double kAllThere = 9007199254740992;  // 2^53: from there on some are no doubles
    const auto isBeyond = [](const Bound& bound) {
        return !std::holds_alternative<double>(bound.value) &&
               std::abs(toDouble(bound.value)) >= kAllThere;
    };
    if (std::ranges::none_of(animation.ranges(),
                             [&](const Range& r) { return isBeyond(r.lo) || isBeyond(r.hi); }))
        return {};
    // Of the type that has them all.
    std::vector<Interval<Wide>> wholes;
    const auto take = [&](const auto& intervals) {
        for (const auto& each : intervals) wholes.push_back({each.lo, each.hi});
    };
    if (toDouble(animation.ranges().front().lo.value) < 0)
        take(animation.toIntervals<std::int64_t>());
    else
        take(animation.toIntervals<std::uint64_t>());
    return wholes;
}

ValueSweep::Wide ValueSweep::wholeContour(std::int64_t tick) const {
    const auto [range, along] = placeOf(tick);
    const Interval<Wide>& r = wholes_[range];
    const auto way = static_cast<Wide>(std::round(along * static_cast<double>(r.hi - r.lo)));
    return std::min(r.lo + way, r.hi);
}

Number ValueSweep::exactContour(std::int64_t tick) const {
    if (!wholes_.empty()) return numberOfWhole(wholeContour(tick));
    const auto [range, along] = placeOf(tick);
    const Interval<double>& r = ranges_[range];
    return std::clamp(r.lo * (1 - along) + r.hi * along, r.lo, r.hi);
}

Range ValueSweep::window(std::int64_t tick) const {
    if (!wholes_.empty()) {
        // No whole number lies between.
        const auto delta = static_cast<Wide>(std::floor(std::min(settings_.delta, 0x1p64)));
        const Wide c = wholeContour(tick);
        return {{numberOfWhole(c - delta)}, {numberOfWhole(c + delta)}};
    }
    constexpr double kMost = std::numeric_limits<double>::max();
    const double c = contour(tick);
    return {{std::max(c - settings_.delta, -kMost)}, {std::min(c + settings_.delta, kMost)}};
}

}  // namespace timeseries
