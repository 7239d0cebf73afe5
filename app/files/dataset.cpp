#include "app/files/dataset.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "render/annotate/ticks.h"

namespace app {

using timeseries::FileError;

namespace {

OpenedSeries joinedOrAlone(timeseries::ExpandedSeries series) {
    try {
        auto reader = timeseries::openReader(series.files);
        if (series.here) reader->expectToFit(*series.here);
        return {std::move(reader), std::move(series)};
    } catch (const FileError& error) {
        if (!series.here) throw;
        const auto& file = series.files[*series.here];
        const std::string note = fmt::format("only this file is opened, not the {}: {}",
                                             series.recognised, error.what());
        auto reader = timeseries::openReader(std::span(&file, 1));
        return {std::move(reader), {{file}, {}, "", {note}}};
    }
}

}  // namespace

OpenedSeries openSeries(std::span<const std::filesystem::path> named) {
    OpenedSeries opened = joinedOrAlone(timeseries::expandSeries(named));
    for (const timeseries::DamagedVariable& each : opened.reader->damaged())
        opened.series.notes.push_back(fmt::format("'{}' is left out: {}", each.name, each.why));
    return opened;
}

std::size_t defaultVariable(std::span<const timeseries::Variable> variables) {
    const auto worth = [](const timeseries::Variable& v) {
        const auto [nx, ny, nz] = v.grid->size();
        // A section of one column or row has levels too, but is no volume.
        const bool isTimed = !v.time->counted, isNormal = v.name.starts_with("Normals");
        return std::tuple(nx > 1 && ny > 1 ? nz : 1, v.time->points.size(), !v.categories, isTimed,
                          !isNormal, v.grid->count());
    };
    return static_cast<std::size_t>(std::ranges::max_element(variables, {}, worth) -
                                    variables.begin());
}

OpenDataset openDataset(std::span<const std::filesystem::path> named, const std::string& variable) {
    auto [reader, series] = openSeries(named);
    OpenDataset dataset;
    dataset.reader = std::move(reader);
    dataset.series = std::move(series);
    dataset.name = named.front().string();
    for (const timeseries::DamagedVariable& each : dataset.reader->damaged())
        if (each.name == variable) throw FileError(each.why);
    const auto variables = dataset.reader->variables();
    dataset.variableIndex = defaultVariable(variables);
    std::string names;
    bool found = variable.empty();
    for (std::size_t i = 0; i < variables.size(); ++i) {
        names += (names.empty() ? "" : ", ") + variables[i].name;
        if (variables[i].name != variable) continue;
        dataset.variableIndex = i;
        found = true;
    }
    if (!found)
        throw FileError(
            fmt::format("{}: no variable '{}'; it has {}", dataset.name, variable, names));
    dataset.variable = variables[dataset.variableIndex];
    dataset.variables.assign(variables.begin(), variables.end());
    timeseries::StepSpan span{0, dataset.stepCount()};
    if (dataset.series.here)
        span = dataset.reader->stepsOf(dataset.variableIndex, *dataset.series.here).value_or(span);
    dataset.defaultStep = span.first + span.count / 2;
    return dataset;
}

std::vector<std::size_t> stepsOf(const Dataset& dataset, const StepChoice& choice) {
    const std::size_t count = dataset.stepCount(), last = choice.last.value_or(count - 1);
    if (last >= count || choice.first > last)
        throw FileError(fmt::format("{}: no step {}; variable {} has steps 0 to {}", dataset.name,
                                    std::max(last, choice.first), dataset.variable.name,
                                    count - 1));
    std::vector<std::size_t> steps((last - choice.first) / choice.stride + 1);
    for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = choice.first + i * choice.stride;
    return steps;
}

namespace {

// Digits behind the point; none of a number with an exponent.
std::size_t decimalsOf(std::string_view number) {
    const std::size_t point = number.find('.');
    return point == number.npos || number.find('e') != number.npos ? 0 : number.size() - point - 1;
}

// Ten digits, or as many more as tell a time from those beside it; a whole one beside whole ones
// has all of its own.
int digitsOf(const timeseries::TimeAxis& axis, std::size_t step) {
    constexpr int kUsual = 10, kMost = 15;
    const auto isWhole = [](double v) { return std::abs(v) < 1e15 && v == std::floor(v); };
    const double value = axis.points[step].value;
    double gap = std::abs(value);
    bool areWhole = isWhole(value);
    for (const std::size_t beside : {step - 1, step + 1}) {  // of the first, one is beyond all
        if (beside >= axis.points.size()) continue;
        const double other = axis.points[beside].value, far = std::abs(value - other);
        areWhole = areWhole && isWhole(other);
        if (far > 0) gap = std::min(gap, far);
    }
    if (areWhole) return kMost;
    if (!(gap > 0 && std::isfinite(value))) return kUsual;
    const double digits = std::ceil(std::log10(std::abs(value) / gap)) + 1;
    return static_cast<int>(std::clamp<double>(digits, kUsual, kMost));
}

// With as many decimals as the others of the axis, so that a movie's do not jump. Of even steps the
// first two have the most that any has; many come from rounding, and are as they are.
std::string numberText(const timeseries::TimeAxis& axis, std::size_t step) {
    constexpr std::size_t kMost = 6;
    const auto text = [&](std::size_t i) {
        return fmt::format("{:.{}g}", axis.points[i].value, digitsOf(axis, i));
    };
    std::string number = text(step);
    std::size_t decimals = 0;
    for (const std::size_t i : {std::size_t{0}, std::size_t{1}, axis.points.size() - 1})
        if (i < axis.points.size()) decimals = std::max(decimals, decimalsOf(text(i)));
    const std::size_t own = decimalsOf(number);
    if (own >= decimals || decimals > kMost ||
        number.find_first_not_of("-.0123456789") != number.npos)
        return number;
    if (own == 0) number += '.';
    return number + std::string(decimals - own, '0');
}

}  // namespace

std::string timeText(const timeseries::TimeAxis& axis, std::size_t step) {
    const timeseries::TimePoint& point = axis.points[step];
    if (!point.date.empty()) return point.date;
    if (axis.counted) return fmt::format("step {}", step);
    if (std::isnan(point.value)) return "no " + axis.name;
    const std::string number = numberText(axis, step);
    return render::shownUnit(axis.units).empty() ? axis.name + " " + number
                                                 : number + " " + axis.units;
}

std::string timeKept(const timeseries::TimeAxis& axis, std::size_t step) {
    const timeseries::TimePoint& point = axis.points[step];
    if (axis.counted) return "";
    return point.date.empty() ? fmt::format("{} {} {}", axis.name, point.value, axis.units)
                              : point.date;
}

std::size_t stepThen(Dataset& dataset, std::size_t step, const std::string& kept) {
    const timeseries::TimeAxis& axis = *dataset.variable.time;
    if (axis.counted || (step < axis.points.size() && timeKept(axis, step) == kept)) return step;
    std::vector<std::size_t> same;
    for (std::size_t i = 0; i < axis.points.size(); ++i)
        if (timeKept(axis, i) == kept) same.push_back(i);
    dataset.series.notes.push_back(
        same.size() == 1
            ? fmt::format("step {}, {}, is step {} now", step, kept, same[0])
            : fmt::format("step {} was {}, which no step of these is now", step, kept));
    return same.size() == 1 ? same[0] : step;
}

void findStepThen(Dataset& dataset, Explorer& session) {
    const std::string kept = std::exchange(session.stepTime, "");
    std::optional<StepChoice>& steps = session.steps;
    if (kept.empty() || !steps || steps->last != steps->first) return;
    const std::size_t then = steps->first, step = stepThen(dataset, then, kept);
    steps = StepChoice{step, step};
    const timeseries::CursorSettings all;
    timeseries::CursorSettings& play = session.play.time;
    const bool isPart = play.first != all.first || play.last != all.last;
    const bool isAnother = step != then || timeKept(*dataset.variable.time, step) != kept;
    if (!isPart || !isAnother) return;
    dataset.series.notes.push_back(fmt::format(
        "steps {} to {}, which played, were others: all play now", play.first, play.last));
    play.first = all.first;
    play.last = all.last;
}

std::string withCommas(std::uint64_t count) {
    std::string text = std::to_string(count);
    for (std::ptrdiff_t at = std::ssize(text) - 3; at > 0; at -= 3)
        text.insert(static_cast<std::size_t>(at), ",");
    return text;
}

}  // namespace app
