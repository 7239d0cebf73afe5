#include "app/panels/animation_page.h"

#include <fmt/format.h>

#include <cmath>

#include "app/choices/edits.h"
#include "app/choices/first_choice.h"
#include "app/choices/sweep_edits.h"
#include "app/panels/number_field.h"

namespace app::panels {
namespace {

using timeseries::toDouble;

// The finite values of the kept points of all steps seen.
Extent seen(const timeseries::Series& series) {
    Quantiles rows;
    for (std::size_t i = 0; i < series.stepCount(); ++i)
        if (const timeseries::StepSummary* summary = series.summary(i))
            rows.push_back(summary->quantiles);
    return extentOf(rows);
}

// Applies a change of the sweep, which the field that it was entered in may have to refuse.
template <typename Change>
void editSweep(Desk& desk, TextField& field, const Change& change) {
    Explorer next = desk.exploration.explorer();
    try {
        change(*next.sweep);
        timeseries::ValueSweep{*next.sweep};
        desk.exploration.edit(std::move(next));
    } catch (const std::invalid_argument& error) {
        field.refuse(error.what());
    }
}

bool timePlays(const Desk& desk) { return desk.exploration.series()->stepCount() > 1; }

void sweepNow(const Desk& desk, Explorer& e) {
    startSweep(e, seen(*desk.exploration.series()), *desk.exploration.shown()->sorted,
               timePlays(desk));
}

enum What : std::size_t { Time, Values, Both, Nothing };

// What plays: of one step, values alone, and those only while they are swept.
What playing(const Desk& desk, const Explorer& e) {
    const bool time = timePlays(desk) && e.play.timeMoves;
    const bool values = e.sweep && e.play.sweepMoves;
    if (time) return values ? Both : Time;
    return values ? Values : Nothing;
}

}  // namespace

void AnimationPage::draw(Desk& desk, const Rect& at) {
    if (!desk.exploration.shown()) return;
    Form form(desk.theme, "##animation", at);
    constexpr std::array kWhat = {"Time", "Values", "Both"};
    const What now = playing(desk, desk.exploration.explorer());
    if (const auto what = segmented(desk.theme, "what", form.row("Play"), kWhat, now))
        edit(desk, {}, [&](Explorer& next) {
            if (*what != Time && !next.sweep) sweepNow(desk, next);
            next.play.timeMoves = *what != Values;
            next.play.sweepMoves = *what != Time || !timePlays(desk);
        });
    time(desk, form);
    form.space(6);
    sweep(desk, form);
}

void AnimationPage::time(Desk& desk, Form& form) {
    constexpr std::array kPaces = {"Even", "Real times"};
    constexpr std::array kEndings = {"Once", "Loop", "Ping-pong"};
    constexpr std::array kDirections = {"Forward", "Backward"};
    const Theme& theme = desk.theme;
    const float s = theme.scale;
    const timeseries::CursorSettings now = desk.exploration.explorer().play.time;
    const auto change = [&](const auto& set) {
        edit(desk, {}, [&](Explorer& e) { set(e.play.time); });
    };
    // A choice, and a number with its meaning, in one row.
    const auto split = [&](const Rect& row) {
        return std::pair{Rect{row.min, {row.max.x - 118 * s, row.max.y}},
                         Rect{{row.max.x - 56 * s, row.min.y}, row.max}};
    };
    const auto [pace, speed] = split(form.row("Pace"));
    if (const auto chosen =
            segmented(theme, "pace", pace, kPaces, static_cast<std::size_t>(now.pace)))
        change([&](auto& t) { t.pace = static_cast<timeseries::Pace>(*chosen); });
    const bool even = now.pace == timeseries::Pace::Even;
    text(theme, {speed.min.x - 8 * s, speed.centre().y}, even ? "steps/s" : "units/s", kDim, 1,
         theme.small);
    if (const auto value = numberField(desk, speed_, "##speed", speed, even ? "steps/s" : "units/s",
                                       even ? now.stepsPerSecond : now.timeUnitsPerSecond))
        change([&](auto& t) {
            (even ? t.stepsPerSecond : t.timeUnitsPerSecond) = std::max(0.0, *value);
        });
    const auto& time = desk.exploration.playback().time;
    if (time && time->whyEven()) form.note(*time->whyEven());
    const auto [way, stride] = split(form.row("Steps"));
    if (const auto chosen =
            segmented(theme, "way", way, kDirections, static_cast<std::size_t>(now.direction)))
        change([&](auto& t) { t.direction = static_cast<timeseries::Direction>(*chosen); });
    text(theme, {stride.min.x - 8 * s, stride.centre().y}, "every", kDim, 1, theme.small);
    if (const auto value = numberField(desk, stride_, "##stride", stride, "the number of steps",
                                       static_cast<double>(now.stride)))
        change([&](auto& t) {
            t.stride = static_cast<std::size_t>(std::clamp(std::round(*value), 1.0, 1e9));
        });
    if (const auto ending = segmented(theme, "ending", form.row("At the end"), kEndings,
                                      static_cast<std::size_t>(now.ending)))
        change([&](auto& t) { t.ending = static_cast<timeseries::Ending>(*ending); });
}

void AnimationPage::sweep(Desk& desk, Form& form) {
    constexpr std::array kOnOff = {"Off", "On"};
    constexpr std::array kPaths = {"Loop", "Swing"};
    const bool on = desk.exploration.explorer().sweep.has_value();
    if (segmented(desk.theme, "sweep", form.row("Sweep values"), kOnOff, on ? 1 : 0)) {
        edit(desk, {}, [&](Explorer& e) { on ? stopSweep(e) : sweepNow(desk, e); });
        return;
    }
    if (!on) return;
    const timeseries::SweepSettings now = *desk.exploration.explorer().sweep;
    const Theme& theme = desk.theme;
    const float s = theme.scale;
    if (const auto entered =
            range_.draw(theme, "##range", form.row("From, to"), rangesText(desk, now.animation)))
        editSweep(desk, range_,
                  [&](auto& sweep) { sweep.animation = timeseries::RangeSet::parse(*entered); });
    const Rect window = form.row("Half width ±");
    if (const auto value = numberField(desk, delta_, "##delta", part(window, 0, 2, s),
                                       "the half width", now.delta))
        editSweep(desk, delta_, [&](auto& sweep) { sweep.delta = *value; });
    if (const auto path = segmented(theme, "path", part(window, 1, 2, s), kPaths,
                                    static_cast<std::size_t>(now.path)))
        edit(desk, {},
             [&](Explorer& e) { e.sweep->path = static_cast<timeseries::SweepPath>(*path); });
    const auto whole = [&](TextField& field, const char* id, const Rect& at, std::string_view what,
                           std::int64_t& value) {
        const auto entered = numberField(desk, field, id, at, what, static_cast<double>(value));
        if (!entered) return false;
        value = static_cast<std::int64_t>(std::clamp(std::round(*entered), 0.0, 2e9));
        return true;
    };
    std::int64_t timerSteps = now.timerSteps, step = now.step;
    const Rect timer = form.row("Steps a cycle");
    if (whole(timerSteps_, "##timer", part(timer, 0, 3, s), "the number of steps", timerSteps))
        editSweep(desk, timerSteps_, [&](auto& sweep) { sweep.timerSteps = timerSteps; });
    const Rect by = part(timer, 2, 3, s);
    text(theme, {by.min.x - 12 * s, by.centre().y}, "by", kDim, 1);
    if (whole(step_, "##step", by, "the step", step))
        editSweep(desk, step_, [&](auto& sweep) { sweep.step = step; });
    const Rect frequency = form.row("Cycles / s");
    if (const auto value = numberField(desk, frequency_, "##frequency", part(frequency, 0, 3, s),
                                       "the number of cycles a second", now.frequency))
        editSweep(desk, frequency_, [&](auto& sweep) { sweep.frequency = *value; });
}

}  // namespace app::panels
