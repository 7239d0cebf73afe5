#include "timeseries/readers/arrays/array_times.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "timeseries/readers/cf/cf_time.h"
#include "timeseries/readers/text/units.h"
#include "timeseries/readers/text/words.h"

namespace timeseries {
namespace {

using Times = std::vector<double>;

// Exactly n finite numbers, apart by blanks or commas; nothing else.
std::optional<Times> numbers(std::string_view text, std::uint64_t n) {
    std::string spaced(text);
    std::ranges::replace(spaced, ',', ' ');
    const std::vector<std::string> list = words(spaced);
    if (list.size() != n) return std::nullopt;
    Times times;
    for (const std::string& word : list) {
        double number = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
        if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(number))
            return std::nullopt;
        times.push_back(number);
    }
    return times;
}

// The key names the axis or what it is measured in: its label, its unit, each with an s, or time.
bool namesTimes(const std::string& key, const ArrayAxis& axis) {
    const auto plural = [&](const std::string& word) {
        return !word.empty() && (key == lower(word) || key == lower(word) + "s");
    };
    static constexpr std::array kWords{"time", "timestep", "timepoint", "timestamp"};
    return plural(axis.label) || plural(axis.units) || std::ranges::any_of(kWords, plural);
}

// "hours" for a key `hours`; "" when the key is no unit of time.
std::string unitIn(const std::string& key) { return sameDimension(key, "s") ? key : ""; }

struct Found {
    std::string key, units;
    Times times;
};

// Keys of which all software that writes them means times: Slicer's sequences and multi-volumes.
std::optional<Found> bySlicer(const ArrayHeader& header, std::size_t time, std::uint64_t n) {
    const ArrayAxis& axis = header.axes[time];
    const std::string sequence = fmt::format("axis {} index values", time);
    if (auto times = numbers(header.keyValue(sequence), n))
        return Found{sequence, axis.units, *times};
    const std::string labels = "MultiVolume.FrameLabels";
    if (auto times = numbers(header.keyValue(labels), n))
        return Found{labels,
                     std::string(header.keyValue("MultiVolume.FrameIdentifyingDICOMTagUnits")),
                     *times};
    return std::nullopt;
}

std::optional<Found> byKey(const ArrayHeader& header, std::size_t time, std::uint64_t n,
                           std::vector<std::string>& notes) {
    if (n < 2) return std::nullopt;
    if (auto found = bySlicer(header, time, n)) return found;
    const ArrayAxis& axis = header.axes[time];
    std::optional<Found> found;
    for (const auto& [name, value] : header.keyValues) {
        const std::string key = lower(name);
        if (!namesTimes(key, axis)) continue;
        auto times = numbers(value, n);
        if (!times) continue;
        if (found && found->times != *times) {
            notes.push_back(fmt::format("times are not taken from the keys {} and {}: they differ",
                                        found->key, name));
            return std::nullopt;
        }
        if (!found)
            found = Found{name, axis.units.empty() ? unitIn(key) : axis.units, std::move(*times)};
    }
    return found;
}

// Evenly, by spacing and minimum; node-centred unless the file says otherwise.
std::optional<Times> even(const ArrayHeader& header, const ArrayAxis& axis) {
    double spacing = axis.spacing, first = axis.min;
    if (axis.direction && header.timeInSpace) {
        const std::size_t component = header.spaceDimension - 1;
        spacing = (*axis.direction)[component];
        first = header.origin ? (*header.origin)[component] : 0;
    }
    const bool cell = axis.cell.value_or(false);
    if (std::isnan(spacing) && !std::isnan(axis.min) && !std::isnan(axis.max) && axis.size > 1)
        spacing = (axis.max - axis.min) / static_cast<double>(axis.size - (cell ? 0 : 1));
    if (!std::isfinite(spacing) || spacing == 0) return std::nullopt;
    first = std::isnan(first) ? 0 : first + (cell && !axis.direction ? spacing / 2 : 0);
    Times times;
    for (std::uint64_t i = 0; i < axis.size; ++i)
        times.push_back(first + spacing * static_cast<double>(i));
    if (!std::ranges::all_of(times, [](double t) { return std::isfinite(t); })) return std::nullopt;
    return times;
}

}  // namespace

TimeAxis arrayTimes(const ArrayHeader& header, const ArrayRoles& roles,
                    std::vector<std::string>& notes) {
    StoredTimes stored;
    if (roles.time) {
        const ArrayAxis& axis = header.axes[*roles.time];
        Times times;
        if (auto found = byKey(header, *roles.time, axis.size, notes)) {
            times = std::move(found->times);
            stored.units = found->units;
            stored.counted = false;
        } else if (auto evenly = even(header, axis)) {
            times = std::move(*evenly);
            stored.units = header.timeInSpace && axis.direction && axis.units.empty()
                               ? header.spaceUnits[header.spaceDimension - 1]
                               : axis.units;
            stored.counted = false;
        } else {
            for (std::uint64_t i = 0; i < axis.size; ++i) times.push_back(static_cast<double>(i));
        }
        if (!stored.counted) stored.name = axis.label.empty() ? "time" : axis.label;
        stored.single = false;
        stored.values.assign(times.begin(), times.end());
    }
    return timeAxisOf(stored, notes);
}

}  // namespace timeseries
