#include "app/panels/time_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "app/choices/decimals.h"
#include "app/panels/number_field.h"

namespace app::panels {
namespace {

using timeseries::Ending;
using timeseries::SlotState;

void buttons(PanelContext& context, const TimeBarLayout& at) {
    Exploration& exploration = context.exploration;
    const bool playing = exploration.playback().playing;
    if (iconButton(context.theme, "##back", at.back, Icon::StepBack, "One step back   ,"))
        exploration.stepBy(-1);
    ImGui::GetWindowDrawList()->AddCircleFilled(im(at.play.centre()), 0.5f * at.play.size().x,
                                                playing ? faded(kAccent, 0.18f) : kField, 40);
    if (iconButton(context.theme, "##play", at.play, playing ? Icon::Pause : Icon::Play,
                   playing ? "Pause   Space" : "Play   Space", playing))
        exploration.togglePlay();
    if (iconButton(context.theme, "##forward", at.forward, Icon::StepForward,
                   "One step forward   ."))
        exploration.stepBy(1);
}

void now(PanelContext& context, const Rect& at, const Dataset& dataset, std::size_t step) {
    const float s = context.theme.scale, width = at.size().x;
    text(context.theme, {at.min.x, at.centre().y - 9 * s},
         fitting(*context.theme.strong, timeText(*dataset.variable.time, step), width), kText, 0,
         context.theme.strong);
    const bool counted = dataset.variable.time->counted;
    const std::string place =
        dataset.stepCount() == 1
            ? "the only one"
            : fmt::format("{}of 0–{}", counted ? "" : fmt::format("step {} ", step),
                          dataset.stepCount() - 1);
    text(context.theme, {at.min.x, at.centre().y + 10 * s}, place, kDim, 0, context.theme.small);
}

// A cell a step, or a cell a few pixels where steps are narrower: each tells its least ready step.
void cells(const timeseries::Series& series, const StepAxis& axis, const Rect& at, float scale,
           std::size_t first, std::size_t last) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const auto shown = [&](std::size_t step) {
        return step >= first && step <= last ? 1.0f : 0.45f;
    };
    const float gap = axis.cell(1) - axis.cell(0) > 6 * scale ? scale : 0;
    for (std::size_t i = 0; i < axis.steps;) {
        // Neighbours of one kind are one rectangle where no gap is drawn between them.
        std::size_t next = i + 1;
        const auto kind = [&](std::size_t step) {
            return std::tuple(series.state(step), series.summary(step) != nullptr, shown(step));
        };
        if (gap == 0)
            while (next < axis.steps && kind(next) == kind(i)) ++next;
        const Rect cell{{axis.cell(i), at.min.y}, {axis.cell(next) - gap, at.max.y}};
        const float strength = shown(i);
        switch (series.state(i)) {
            case SlotState::Loaded:
                list.AddRectFilled(im(cell.min), im(cell.max),
                                   faded(mixed(kRaised, kAccent, 0.55f), strength));
                break;
            case SlotState::Failed:
                list.AddRectFilled(im(cell.min), im(cell.max), faded(kError, 0.8f * strength));
                break;
            case SlotState::Loading:
                list.AddRectFilled(im(cell.min), im(cell.max),
                                   faded(mixed(kField, kAccent, 0.3f), strength));
                hatch(list, cell, scale, faded(kAccent, 0.5f));
                break;
            case SlotState::Empty:
                list.AddRectFilled(
                    im(cell.min), im(cell.max),
                    faded(series.summary(i) != nullptr ? kRaised : kField, strength));
                if (series.summary(i) == nullptr) hatch(list, cell, scale, kLine);
        }
        i = next;
    }
}

std::string stateText(const timeseries::Series& series, std::size_t step) {
    switch (series.state(step)) {
        case SlotState::Loaded:
            return "in memory";
        case SlotState::Loading:
            return "loading";
        case SlotState::Failed:
            return series.why(step);
        case SlotState::Empty:
            return series.summary(step) != nullptr ? "seen" : "not yet seen";
    }
    return {};
}

// A bracket whose stem stands at x and whose arms point inwards.
void bracket(float x, const Rect& at, float way, float scale, ImU32 color) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float top = at.min.y - 4 * scale, bottom = at.max.y + 4 * scale;
    list.AddRectFilled({x - scale, top}, {x + scale, bottom}, color);
    for (const float y : {top, bottom - 2 * scale})
        list.AddRectFilled({std::min(x, x + 5 * way * scale), y},
                           {std::max(x, x + 5 * way * scale), y + 2 * scale}, color);
}

void endingButton(PanelContext& context, const Rect& at) {
    const timeseries::CursorSettings& time = context.exploration.explorer().play.time;
    const Icon icon = time.ending == Ending::Once   ? Icon::Once
                      : time.ending == Ending::Loop ? Icon::Loop
                                                    : Icon::PingPong;
    const char* what = time.ending == Ending::Once   ? "Stops at the end   L"
                       : time.ending == Ending::Loop ? "Starts again at the end   L"
                                                     : "Turns round at the ends   L";
    if (iconButton(context.theme, "##ending", at, icon, what))
        context.requests.commands.push_back(Command::NextEnding);
}

void speedField(PanelContext& context, TextField& field, const Rect& at, const Dataset& dataset) {
    const timeseries::CursorSettings& time = context.exploration.explorer().play.time;
    const float s = context.theme.scale;
    const bool even = time.pace == timeseries::Pace::Even;
    const double shown = even ? time.stepsPerSecond : time.timeUnitsPerSecond;
    const float wide = even ? 46 : 68;  // of seconds a second there are many
    const Rect box{at.min, {at.min.x + wide * s, at.max.y}};
    const std::string unit = speedUnit(time, *dataset.variable.time);
    if (const auto value = numberField(context, field, "##speed", box, unit, shown))
        edit(context, {}, [&](Explorer& e) {
            (even ? e.play.time.stepsPerSecond : e.play.time.timeUnitsPerSecond) =
                std::max(0.0, *value);
        });
    text(context.theme, {box.max.x + 7 * s, at.centre().y},
         fitting(*context.theme.small, unit, (even ? 42 : 28) * s), kDim, 0, context.theme.small);
}

}  // namespace

void setPace(timeseries::CursorSettings& time, timeseries::Pace pace,
             const timeseries::TimeAxis& axis) {
    time.pace = pace;
    const bool isChosen =
        time.timeUnitsPerSecond != timeseries::CursorSettings().timeUnitsPerSecond;
    if (pace != timeseries::Pace::RealTimes || isChosen || axis.points.size() < 2) return;
    const double whole = axis.points.back().value - axis.points.front().value,
                 speed = whole / static_cast<double>(axis.points.size() - 1) * time.stepsPerSecond;
    if (speed > 0 && std::isfinite(speed)) time.timeUnitsPerSecond = roundedTo(speed, speed / 50);
}

std::string speedUnit(const timeseries::CursorSettings& time, const timeseries::TimeAxis& axis) {
    if (time.pace == timeseries::Pace::Even) return "steps/s";
    // Since a date the words are often longer than their room.
    static constexpr std::array kShort{std::pair{"second", "s"}, std::pair{"minute", "min"},
                                       std::pair{"hour", "h"}, std::pair{"day", "d"}};
    const std::string unit = axis.units.substr(0, axis.units.find(' '));
    const auto* const found = std::ranges::find_if(kShort, [&](const auto& each) {
        return unit == each.first || unit == each.first + std::string("s");
    });
    if (unit.empty()) return "units/s";
    return (found != kShort.end() ? found->second : unit) + "/s";
}

void setPoint(timeseries::CursorSettings& time, Point point, std::size_t step) {
    if (point == Point::In) {
        time.first = step;
        time.last = std::max(time.last, step);
    } else {
        time.last = step;
        time.first = std::min(time.first, step);
    }
}

void TimeBar::draw(PanelContext& context, const Rect& at) {
    beginRegion("##time", at, kPanel);
    hairline(at.min.x, at.max.x, at.min.y);
    if (const auto shown = context.exploration.shown()) {
        const TimeBarLayout parts = timeBarLayout(at, context.theme.scale);
        const auto& time = context.exploration.playback().time;
        buttons(context, parts);
        now(context, parts.now, shown->dataset, time ? time->step() : shown->step);
        rail(context, parts.rail);
        endingButton(context, parts.ending);
        speedField(context, speed_, parts.speed, shown->dataset);
    }
    endRegion();
}

void TimeBar::rail(PanelContext& context, const Rect& at) {
    Exploration& exploration = context.exploration;
    const auto shown = exploration.shown();
    const timeseries::Series& series = *exploration.series();
    const auto& time = exploration.playback().time;
    const float s = context.theme.scale;
    const StepAxis axis{series.stepCount(), at.min.x, at.max.x};
    const Rect bar{{at.min.x, at.centre().y - 6 * s}, {at.max.x, at.centre().y + 6 * s}};
    const std::size_t first = time ? time->settings().first : 0,
                      last = time ? time->settings().last : axis.steps - 1;
    const float in = axis.cell(first), out = axis.cell(last + 1);

    const Pressing p = area("##rail", {at.min - glm::vec2(6 * s, 0), at.max + glm::vec2(6 * s, 0)});
    const Focus::Turn turn = focus().control(ImGui::GetID("##rail"), at, Focus::Takes::LeftRight);
    if (p.pressed) focus().touch(ImGui::GetID("##rail"));
    if (turn.by != 0) exploration.stepBy(turn.by);
    if (turn.toEnd != 0) exploration.seek(turn.toEnd > 0 ? axis.steps - 1 : 0);
    const glm::vec2 mouse = vec(ImGui::GetIO().MousePos);
    const auto near = [&](float x) { return std::abs(mouse.x - x) < 6 * s; };
    const std::size_t step = axis.stepAt(mouse.x);
    const bool onIn = near(in) && std::abs(mouse.y - at.centre().y) > 5 * s,
               onOut = near(out) && std::abs(mouse.y - at.centre().y) > 5 * s;
    if (p.pressed) grip_ = onIn ? Grip::In : onOut ? Grip::Out : Grip::Cursor;
    if (p.held) {
        if (grip_ == Grip::Cursor && time && step != time->step()) exploration.seek(step);
        if (grip_ == Grip::In || grip_ == Grip::Out)
            edit(context, "in and out points", [&](Explorer& e) {
                setPoint(e.play.time, grip_ == Grip::In ? Point::In : Point::Out, step);
            });
    }
    if (p.released) grip_ = Grip::None;

    cells(series, axis, bar, s, first, last);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    bracket(in, bar, 1, s, onIn && p.hovered ? kText : kDim);
    bracket(out, bar, -1, s, onOut && p.hovered ? kText : kDim);
    if (shown && time && shown->step != time->step()) {
        const float x = axis.centre(shown->step);
        list.AddRectFilled({x - s, bar.min.y - 3 * s}, {x + s, bar.max.y + 3 * s}, kDim);
    }
    if (time) {
        const float x = axis.centre(time->step());
        list.AddRectFilled({x - 1.5f * s, bar.min.y - 8 * s}, {x + 1.5f * s, bar.max.y + 8 * s},
                           kText, 1.5f * s);
        list.AddCircleFilled({x, bar.min.y - 8 * s}, 4.5f * s, kText, 20);
    }
    if (p.hovered && !p.held && shown)
        tip(context.theme, fmt::format("{}  ·  {}", timeText(*shown->dataset.variable.time, step),
                                       stateText(series, step)));
    if (p.hovered && (onIn || onOut)) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
}

}  // namespace app::panels
