#include "timeseries/readers/series_times.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "timeseries/readers/series_files.h"

namespace timeseries {
namespace {

struct TimesOf {
    double least, most;
    std::size_t file;
};

// "" when the files' own times are those of the series.
std::string ownTimesFail(const std::string& variable, const TimesOfFiles& axes,
                         std::span<const std::filesystem::path> paths) {
    const auto name = [&](std::size_t f) { return paths[f].filename().string(); };
    const bool several =
        std::ranges::any_of(axes, [](const auto& axis) { return axis->points.size() > 1; });
    for (std::size_t f = 0; f < axes.size(); ++f)
        if (axes[f]->counted) return fmt::format("{} has none", name(f));
    for (std::size_t f = 1; f < axes.size(); ++f)
        if (axes[f]->name != axes[0]->name)
            return fmt::format("those of {} are called '{}', those of {} '{}'", name(0),
                               axes[0]->name, name(f), axes[f]->name);
    for (std::size_t f = 1; f < axes.size(); ++f)
        if (axes[f]->units != axes[0]->units || axes[f]->calendar != axes[0]->calendar)
            return fmt::format("those of {} are in \"{}\", those of {} in \"{}\"", name(0),
                               axes[0]->units, name(f), axes[f]->units);
    std::vector<TimesOf> inOrder;
    for (std::size_t f = 0; f < axes.size(); ++f) {
        const auto& points = axes[f]->points;
        for (const TimePoint& point : points)
            if (std::isnan(point.value))
                return fmt::format("{} has one that is no number", name(f));
        inOrder.push_back({std::ranges::min(points, {}, &TimePoint::value).value,
                           std::ranges::max(points, {}, &TimePoint::value).value, f});
    }
    std::ranges::stable_sort(inOrder, {}, &TimesOf::least);
    for (std::size_t i = 1; i < inOrder.size(); ++i) {
        const TimesOf &a = inOrder[i - 1], &b = inOrder[i];
        if (a.most < b.least) continue;
        if (!several)
            return fmt::format("{} and {} both have {}", name(a.file), name(b.file), a.most);
        throw FileError(fmt::format(
            "{} and {}: variable '{}': expected times that do not overlap, found {} to {} and {} "
            "to {}",
            paths[a.file].string(), paths[b.file].string(), variable, a.least, a.most, b.least,
            b.most));
    }
    return "";
}

TimeAxis ownTimes(const TimesOfFiles& axes) {
    TimeAxis axis = *axes[0];
    axis.points.clear();
    for (const auto& each : axes)
        axis.points.insert(axis.points.end(), each->points.begin(), each->points.end());
    return axis;
}

}  // namespace

SeriesTimes seriesTimes(const std::string& variable, const TimesOfFiles& axes,
                        std::span<const std::filesystem::path> paths) {
    std::vector<std::size_t> begins{0};
    bool single = true;
    for (const auto& axis : axes) {
        begins.push_back(begins.back() + axis->points.size());
        single = single && axis->points.size() == 1;
    }
    const std::string why = ownTimesFail(variable, axes, paths);
    if (why.empty())
        return {std::make_shared<TimeAxis>(ownTimes(axes)), std::move(begins), true, ""};
    const auto numbers = single ? ascendingNumbers(paths) : std::nullopt;
    TimeAxis time{numbers ? "number" : "step", "", "", {}, !numbers};
    for (std::size_t i = 0; i < begins.back(); ++i)
        time.points.push_back({numbers ? (*numbers)[i] : static_cast<double>(i), ""});
    std::string note;
    if (!std::ranges::all_of(axes, [](const auto& axis) { return axis->counted; }))
        note = fmt::format("the files' own times are not used, steps are {}: {}",
                           numbers ? "numbered as the files are" : "counted", why);
    return {std::make_shared<TimeAxis>(std::move(time)), std::move(begins), false, std::move(note)};
}

}  // namespace timeseries
