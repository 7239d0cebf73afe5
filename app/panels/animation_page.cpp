#include "app/panels/animation_page.h"

#include <fmt/format.h>

#include <cmath>

#include "app/choices/edits.h"
#include "app/choices/first_choice.h"
#include "app/choices/sweep_edits.h"
#include "app/panels/number_field.h"
#include "app/panels/time_bar.h"

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
void editSweep(PanelContext& context, TextField& field, const Change& change) {
    Explorer next = context.exploration.explorer();
    try {
        change(*sweepOf(next));
        timeseries::ValueSweep{*sweepOf(next)};
        context.exploration.edit(std::move(next));
    } catch (const std::invalid_argument& error) {
        field.refuse(error.what());
    }
}

bool timePlays(const PanelContext& context) {
    return context.exploration.series()->stepCount() > 1;
}

void sweepNow(const PanelContext& context, Explorer& e) {
    startSweep(e, seen(*context.exploration.series()), *context.exploration.shown()->sorted,
               timePlays(context));
}

enum What : std::size_t { Time, Values, Both, Nothing };

// What plays: of one step, values alone, and those only while they are swept.
What playing(const PanelContext& context, const Explorer& e) {
    const bool time = timePlays(context) && e.play.timeMoves;
    const bool values = sweepOf(e) != nullptr && e.play.sweepMoves;
    if (time) return values ? Both : Time;
    return values ? Values : Nothing;
}

}  // namespace

void AnimationPage::draw(PanelContext& context, const Rect& at) {
    if (!context.exploration.shown()) return;
    Form form(context.theme, "##animation", at);
    constexpr std::array kWhat = {"Time", "Values", "Both"};
    const What now = playing(context, context.exploration.explorer());
    if (const auto what = segmented(context.theme, "what", form.row("Play"), kWhat, now))
        edit(context, {}, [&](Explorer& next) {
            if (*what != Time && sweepOf(next) == nullptr) sweepNow(context, next);
            next.play.timeMoves = *what != Values;
            next.play.sweepMoves = *what != Time || !timePlays(context);
        });
    time(context, form);
    form.space(6);
    sweep(context, form);
}

void AnimationPage::time(PanelContext& context, Form& form) {
    constexpr std::array kPaces = {"Even", "Real times"};
    constexpr std::array kEndings = {"Once", "Loop", "Ping-pong"};
    constexpr std::array kDirections = {"Forward", "Backward"};
    const Theme& theme = context.theme;
    const float s = theme.scale;
    const timeseries::CursorSettings now = context.exploration.explorer().play.time;
    const timeseries::TimeAxis& axis = *context.exploration.shown()->dataset.variable.time;
    const auto change = [&](const auto& set) {
        edit(context, {}, [&](Explorer& e) { set(e.play.time); });
    };
    // A choice, and a number with its meaning, in one row, or in two where that is too narrow.
    const auto split = [&](const char* label, std::span<const char* const> labels) {
        Rect choice = form.row(label), number = choice;
        if (choice.size().x - 118 * s < segmentsWidth(theme, labels))
            number = form.row(" ");
        else
            choice.max.x -= 118 * s;
        return std::pair{choice, Rect{{number.max.x - 56 * s, number.min.y}, number.max}};
    };
    auto [pace, speed] = split("Pace", kPaces);
    if (const auto chosen =
            segmented(theme, "pace", pace, kPaces, static_cast<std::size_t>(now.pace)))
        change([&](auto& t) { setPace(t, static_cast<timeseries::Pace>(*chosen), axis); });
    const bool even = now.pace == timeseries::Pace::Even;
    const std::string unit = speedUnit(now, axis);
    const float more = even ? 0 : 16;  // of seconds a second there are many
    speed.min.x -= more * s;
    text(theme, {speed.min.x - 8 * s, speed.centre().y},
         fitting(*theme.small, unit, (52 - more) * s), kDim, 1, theme.small);
    if (const auto value = numberField(context, speed_, "##speed", speed, unit,
                                       even ? now.stepsPerSecond : now.timeUnitsPerSecond))
        change([&](auto& t) {
            (even ? t.stepsPerSecond : t.timeUnitsPerSecond) = std::max(0.0, *value);
        });
    const auto& time = context.exploration.playback().time;
    if (time && time->whyEven()) form.note(*time->whyEven());
    const auto [way, stride] = split("Steps", kDirections);
    if (const auto chosen =
            segmented(theme, "way", way, kDirections, static_cast<std::size_t>(now.direction)))
        change([&](auto& t) { t.direction = static_cast<timeseries::Direction>(*chosen); });
    text(theme, {stride.min.x - 8 * s, stride.centre().y}, "every", kDim, 1, theme.small);
    if (const auto count = countField(context, stride_, "##stride", stride, "the number of steps",
                                      static_cast<std::int64_t>(now.stride)))
        change([&](auto& t) { t.stride = static_cast<std::size_t>(*count); });
    if (const auto ending = segmented(theme, "ending", form.row("At the end"), kEndings,
                                      static_cast<std::size_t>(now.ending)))
        change([&](auto& t) { t.ending = static_cast<timeseries::Ending>(*ending); });
}

void AnimationPage::sweep(PanelContext& context, Form& form) {
    constexpr std::array kOnOff = {"Off", "On"};
    constexpr std::array kPaths = {"Loop", "Swing"};
    const bool on = sweepOf(context.exploration.explorer()) != nullptr;
    if (segmented(context.theme, "sweep", form.row("Sweep values"), kOnOff, on ? 1 : 0)) {
        edit(context, {}, [&](Explorer& e) { on ? removeLayer(e, 0) : sweepNow(context, e); });
        return;
    }
    if (!on) return;
    const timeseries::SweepSettings now = *sweepOf(context.exploration.explorer());
    const Theme& theme = context.theme;
    const float s = theme.scale;
    if (const auto entered =
            range_.draw(theme, "##range", form.row("From, to"), rangesText(context, now.animation)))
        editSweep(context, range_,
                  [&](auto& sweep) { sweep.animation = timeseries::RangeSet::parse(*entered); });
    const Rect window = form.row("Half width ±");
    if (const auto value = numberField(context, delta_, "##delta", part(window, 0, 2, s),
                                       "the half width", now.delta))
        editSweep(context, delta_, [&](auto& sweep) { sweep.delta = *value; });
    if (const auto path = segmented(theme, "path", part(window, 1, 2, s), kPaths,
                                    static_cast<std::size_t>(now.path)))
        edit(context, {},
             [&](Explorer& e) { sweepOf(e)->path = static_cast<timeseries::SweepPath>(*path); });
    const Rect timer = form.row("Steps a cycle");
    if (const auto count = countField(context, timerSteps_, "##timer", part(timer, 0, 3, s),
                                      "the number of steps", now.timerSteps))
        editSweep(context, timerSteps_, [&](auto& sweep) { sweep.timerSteps = *count; });
    const Rect by = part(timer, 2, 3, s);
    text(theme, {by.min.x - 12 * s, by.centre().y}, "by", kDim, 1);
    if (const auto count = countField(context, step_, "##step", by, "the step", now.step))
        editSweep(context, step_, [&](auto& sweep) { sweep.step = *count; });
    const Rect frequency = form.row("Cycles / s");
    if (const auto value = numberField(context, frequency_, "##frequency", part(frequency, 0, 3, s),
                                       "the number of cycles a second", now.frequency))
        editSweep(context, frequency_, [&](auto& sweep) { sweep.frequency = *value; });
}

}  // namespace app::panels
