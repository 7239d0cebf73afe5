#include "timeseries/series/time_cursor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>

namespace timeseries {

namespace {

using std::chrono::nanoseconds;
__extension__ using Wide = __int128;

constexpr std::int64_t kLongestPlay = std::int64_t{1} << 60;

bool isSpeed(double v) { return v >= 0 && std::isfinite(v); }

CursorSettings checked(CursorSettings s, std::size_t steps) {
    if (steps == 0) throw std::invalid_argument("a series without time steps cannot be played");
    s.last = std::min(s.last, steps - 1);
    if (s.first > s.last)
        throw std::invalid_argument(
            fmt::format("the in point {} lies after the out point {}", s.first, s.last));
    if (s.stride == 0) throw std::invalid_argument("the stride must be at least 1");
    if (!isSpeed(s.stepsPerSecond))
        throw std::invalid_argument(fmt::format(
            "the steps per second must be finite and not negative, not {}", s.stepsPerSecond));
    if (!isSpeed(s.timeUnitsPerSecond))
        throw std::invalid_argument(
            fmt::format("the time units per second must be finite and not negative, not {}",
                        s.timeUnitsPerSecond));
    return s;
}

// Why the times of steps first .. last give no durations; none when they do.
std::optional<std::string> whyUnusable(const std::vector<double>& times, std::size_t first,
                                       std::size_t last) {
    if (first == last)
        return fmt::format("step {} has no other beside it to give it a duration", first);
    for (std::size_t i = first; i <= last; ++i) {
        if (!std::isfinite(times[i])) return fmt::format("the time of step {} is {}", i, times[i]);
        if (i > first && !(times[i] > times[i - 1]))
            return fmt::format("the time of step {}, {}, is not later than that of step {}, {}", i,
                               times[i], i - 1, times[i - 1]);
    }
    // A cycle is at most four spans: the last step's time again, and all of it back in PingPong.
    if (!std::isfinite(4 * (times[last] - times[first])))
        return fmt::format("the times from {} to {} span more than a double holds", times[first],
                           times[last]);
    return std::nullopt;
}

// offsets[k]: when shown step k begins, in any unit, from 0; the last one is the end of the way.
// Scaled to nanoseconds, each step at least one.
std::vector<std::int64_t> toNanoseconds(const std::vector<double>& offsets, double perSecond) {
    // A speed of 0 stands still: its places are those of the slowest, so that a step keeps how much
    // of it has gone.
    const double slowest = static_cast<double>(kLongestPlay) / offsets.back();
    const double nsPerUnit = std::min(1e9 / std::abs(perSecond), slowest);  // 0 may be negative
    std::vector<std::int64_t> begins{0};
    for (std::size_t k = 1; k < offsets.size(); ++k) {
        const double ns = std::min(offsets[k] * nsPerUnit, static_cast<double>(kLongestPlay));
        begins.push_back(std::max<std::int64_t>(std::llround(ns), begins.back() + 1));
    }
    return begins;
}

}  // namespace

TimeCursor::TimeCursor(std::size_t steps, std::shared_ptr<const std::vector<double>> times,
                       CursorSettings settings, CursorPosition position)
    : steps_(steps), times_(std::move(times)), settings_(checked(settings, steps)) {
    layOut();
    position_.place = std::min(position.place, placesPerCycle() - 1);
    const std::int64_t most =
        duration(position_.place) -
        (settings_.ending == Ending::Once && position_.place + 1 == placesPerCycle() ? 0 : 1);
    position_.into = std::clamp(position.into, nanoseconds(0), nanoseconds(most));
}

TimeCursor::TimeCursor(std::size_t steps, CursorSettings settings, CursorPosition position)
    : TimeCursor(steps, nullptr, settings, position) {}

TimeCursor::TimeCursor(const std::vector<double>& times, CursorSettings settings,
                       CursorPosition position)
    : TimeCursor(times.size(), std::make_shared<const std::vector<double>>(times), settings,
                 position) {}

void TimeCursor::layOut() {
    const auto& [first, last, stride, ending, direction, pace, stepsPerSecond, unitsPerSecond] =
        settings_;
    const std::size_t shown = shownCount();
    const std::size_t lastShown = first + (shown - 1) * stride;
    const bool knowsNext = stride < steps_ - lastShown;  // the step that ends the last shown one
    whyEven_.reset();
    if (pace == Pace::RealTimes)
        whyEven_ = times_ ? whyUnusable(*times_, first, knowsNext ? lastShown + stride : lastShown)
                          : "the series has no times";
    const bool even = pace == Pace::Even || whyEven_;

    std::vector<double> durations(shown, 1.0);
    for (std::size_t k = 0; k < shown && !even; ++k) {
        const std::size_t step = first + k * stride;
        durations[k] = k + 1 < shown || knowsNext ? (*times_)[step + stride] - (*times_)[step]
                                                  : durations[k - 1];
    }
    if (direction == Direction::Backward) std::reverse(durations.begin(), durations.end());
    if (ending == Ending::PingPong)
        for (std::size_t back = shown; back > 2; --back) durations.push_back(durations[back - 2]);

    std::vector<double> offsets{0.0};
    for (const double d : durations) offsets.push_back(offsets.back() + d);
    begins_ = std::make_shared<const std::vector<std::int64_t>>(
        toNanoseconds(offsets, even ? stepsPerSecond : unitsPerSecond));
}

std::size_t TimeCursor::shownOfPlace(std::size_t place) const {
    const std::size_t shown = shownCount();
    const std::size_t out = place < shown ? place : 2 * shown - 2 - place;
    return settings_.direction == Direction::Forward ? out : shown - 1 - out;
}

std::size_t TimeCursor::placeOf(std::size_t shownStep, bool onWayBack) const {
    const std::size_t shown = shownCount();
    const std::size_t out =
        settings_.direction == Direction::Forward ? shownStep : shown - 1 - shownStep;
    // The first place of the way out is none of the way back, and the last of both is one.
    const bool back = onWayBack && settings_.ending == Ending::PingPong && out > 0;
    return back ? 2 * shown - 2 - out : out;
}

std::size_t TimeCursor::stepOfPlace(std::size_t place) const {
    assert(place < placesPerCycle());
    return settings_.first + shownOfPlace(place) * settings_.stride;
}

bool TimeCursor::standsStill() const {
    const bool even = settings_.pace == Pace::Even || whyEven_;
    return (even ? settings_.stepsPerSecond : settings_.timeUnitsPerSecond) == 0;
}

bool TimeCursor::finished() const {
    return !aside_ && settings_.ending == Ending::Once &&
           position_.into.count() == duration(position_.place);
}

bool TimeCursor::atLast() const {
    return !aside_ && settings_.ending == Ending::Once && placesPerCycle() > 1 &&
           position_.place + 1 == placesPerCycle();
}

void TimeCursor::set(CursorSettings settings) {
    TimeCursor changed(steps_, times_, settings, {});
    const std::size_t stepBefore = step();
    const Wide into = finished() ? 0 : position_.into.count();

    changed.seek(stepBefore);
    std::size_t& place = changed.position_.place;
    place = changed.placeOf(changed.shownOfPlace(place), returning());
    if (!changed.aside_)  // aside, nothing of a step has gone
        changed.position_.into = nanoseconds(
            static_cast<std::int64_t>(into * changed.duration(place) / duration(position_.place)));
    *this = std::move(changed);
}

void TimeCursor::goTo(CursorPosition position) {
    position_ = position;
    aside_.reset();
}

void TimeCursor::seek(std::size_t step) {
    step = std::min(step, steps_ - 1);
    const std::size_t inPlay = std::clamp(step, settings_.first, settings_.last) - settings_.first;
    std::size_t shown = inPlay / settings_.stride;
    const std::size_t past = inPlay % settings_.stride;
    if (past > settings_.stride - past && shown + 1 < shownCount()) ++shown;
    goTo({placeOf(shown, returning()), nanoseconds(0)});
    if (this->step() != step) aside_ = step;
}

void TimeCursor::stepTo(Side side) {
    const std::size_t from = step();
    if (from < settings_.first || from > settings_.last) {
        if (side == Side::Earlier && from == 0) return;
        return seek(side == Side::Earlier ? from - 1 : from + 1);
    }
    const std::size_t shown = shownCount();
    const std::size_t now = shownOfPlace(position_.place);
    // From between two shown steps, the nearest may be the next.
    const std::size_t nearest = stepOfPlace(position_.place);
    if (aside_ && (nearest > from) == (side == Side::Later))
        return goTo({position_.place, nanoseconds(0)});
    const bool wraps = settings_.ending == Ending::Loop;
    const std::size_t end = side == Side::Later ? shown - 1 : 0, other = shown - 1 - end;
    const std::size_t next = now != end ? (side == Side::Later ? now + 1 : now - 1)
                             : wraps    ? other
                                        : now;
    if (aside_ && next == now && !wraps) return;
    goTo({placeOf(next, returning()), nanoseconds(0)});
}

CursorPosition TimeCursor::positionAt(std::int64_t phase) const {
    const auto after = std::upper_bound(begins_->begin(), begins_->end() - 1, phase);
    const auto place = static_cast<std::size_t>(after - begins_->begin()) - 1;
    return {place, nanoseconds(phase - (*begins_)[place])};
}

void TimeCursor::advance(nanoseconds dt) {
    if (standsStill() || dt.count() <= 0) return;
    const Wide phase = Wide{(*begins_)[position_.place]} + position_.into.count() + dt.count();
    const std::int64_t cycle = begins_->back();
    const Wide inCycle =
        settings_.ending == Ending::Once ? std::min<Wide>(phase, cycle) : phase % cycle;
    goTo(positionAt(static_cast<std::int64_t>(inCycle)));
}

std::size_t TimeCursor::stepAt(nanoseconds elapsed) const {
    TimeCursor played = *this;
    played.restart();
    played.advance(elapsed);
    return played.step();
}

std::optional<nanoseconds> TimeCursor::cycle() const {
    if (standsStill()) return std::nullopt;
    return nanoseconds(begins_->back());
}

std::optional<nanoseconds> TimeCursor::untilNextStep() const {
    const bool never = settings_.ending == Ending::Once ? finished() : placesPerCycle() == 1;
    if (standsStill()) return std::nullopt;
    if (aside_) return nanoseconds(1);
    if (never) return std::nullopt;
    return nanoseconds(duration(position_.place)) - position_.into;
}

std::vector<std::size_t> TimeCursor::upcoming(std::size_t count) const {
    const std::size_t places = placesPerCycle();
    std::vector<std::size_t> steps;
    if (aside_ && count > 0) steps.push_back(*aside_);
    const std::size_t end = settings_.ending == Ending::Once ? places - position_.place : places;
    for (std::size_t i = 0; i < end && steps.size() < count; ++i) {
        const std::size_t s = stepOfPlace((position_.place + i) % places);
        // Only PingPong passes a step twice, and then soon again: near the turn.
        if (std::find(steps.begin(), steps.end(), s) == steps.end()) steps.push_back(s);
    }
    return steps;
}

bool operator==(const TimeCursor& a, const TimeCursor& b) {
    // As stored, bit for bit: a NaN time is the same as itself.
    const auto sameTimes = [](const auto& x, const auto& y) {
        if (x == y) return true;
        return x && y &&
               std::equal(x->begin(), x->end(), y->begin(), y->end(), [](double p, double q) {
                   return p == q || (std::isnan(p) && std::isnan(q));
               });
    };
    return a.steps_ == b.steps_ && a.settings_ == b.settings_ && a.position_ == b.position_ &&
           a.aside_ == b.aside_ && sameTimes(a.times_, b.times_);
}

}  // namespace timeseries
