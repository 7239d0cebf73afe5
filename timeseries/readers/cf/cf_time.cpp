#include "timeseries/readers/cf/cf_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "timeseries/readers/cf/cf_date_texts.h"
#include "timeseries/readers/cf/cf_values.h"
#include "timeseries/readers/series_files.h"
#include "timeseries/readers/text/calendar.h"
#include "timeseries/readers/text/time_units.h"
#include "timeseries/readers/text/units.h"

namespace timeseries {
namespace {

constexpr std::uint64_t kMaxTimes = 10'000'000;  // a date each; no series is near

const NcVariable* scalarTime(const NcHeader& header, const NcVariable& variable) {
    for (const std::string& name : words(variable.text("coordinates"))) {
        const NcVariable* found = header.find(name, variable.group);
        if (!found || !found->type) continue;
        bool scalar = true;
        for (std::size_t i = 0; i < found->dimensions.size(); ++i)
            scalar = scalar && header.dimension(*found, i).length == 1;
        if (scalar && kindByAttributes(*found) == AxisKind::T) return found;
    }
    return nullptr;
}

// Of 20981118.25: the day and its fraction; none where there is no such day.
std::optional<std::pair<std::int64_t, double>> dayOfDigits(double digits, Calendar calendar) {
    constexpr double kMost = 1e13;  // all years that have dates, and no more
    if (!(std::abs(digits) < kMost)) return std::nullopt;
    const double whole = std::floor(std::abs(digits));
    const auto day = static_cast<std::int64_t>(whole);
    const std::int64_t year = day / 10'000;
    const CivilDate date{yearAsWritten(calendar, digits < 0 ? -year : year),
                         static_cast<int>(day / 100 % 100), static_cast<int>(day % 100)};
    if (!exists(calendar, date)) return std::nullopt;
    return std::pair{dayNumber(calendar, date), std::abs(digits) - whole};
}

// The absolute times that CDO writes, of which the digits are a date, as days since the first one.
// They stay as they are where one of them is no date.
void countDays(StoredTimes& times) {
    const auto calendar = calendarFromName(times.calendar);
    if (lower(times.units) != "day as %y%m%d.%f" || !calendar || times.values.empty()) return;
    std::vector<std::pair<std::int64_t, double>> days;
    for (const Number& value : times.values) {
        const auto day = dayOfDigits(toDouble(value), *calendar);
        if (!day) return;
        days.push_back(*day);
    }
    const std::int64_t first = days.front().first;
    const CivilDate date = civilDate(*calendar, first);
    times.units = fmt::format("days since {}-{:02}-{:02}", writtenYear(*calendar, date.year),
                              date.month, date.day);
    for (std::size_t i = 0; i < days.size(); ++i)
        times.values[i] = static_cast<double>(days[i].first - first) + days[i].second;
}

void readCoordinate(const CfFile& file, const NcVariable& time, StoredTimes& times) {
    times.name = time.baseName();
    times.units = time.text("units");
    times.calendar = time.text("calendar");
    times.counted = false;
    times.values = numbersOf(file, time);
    countDays(times);
}

// A part's times in the units of the first; nothing when they do not belong together.
std::optional<std::vector<Number>> inUnitsOf(const StoredTimes& first, const StoredTimes& part) {
    if (first.counted != part.counted) return std::nullopt;
    if (first.units == part.units && first.calendar == part.calendar) return part.values;
    const auto calendar = calendarFromName(first.calendar);
    std::vector<Number> values = part.values;
    if (looksLikeTimeUnits(first.units)) {
        if (!calendar || calendar != calendarFromName(part.calendar)) return std::nullopt;
        const auto to = TimeUnits::parse(first.units, *calendar);
        const auto from = TimeUnits::parse(part.units, *calendar);
        if (!to || !from) return std::nullopt;
        for (Number& value : values) value = to->convert(value, *from);
        return values;
    }
    if (first.units == part.units) return values;
    const auto ratio = unitRatio(part.units, first.units);
    if (!ratio) return std::nullopt;
    for (Number& value : values) value = toDouble(value) * *ratio;
    return values;
}

struct Part {
    std::size_t file;
    std::vector<Number> values;
    Number lo, hi;
};

bool before(const Number& a, const Number& b) { return compare(a, b) < 0; }

// Why the dates that some of the files have in text are not taken; "" where none has any.
std::string whyCounted(const std::vector<StoredTimes>& parts,
                       const std::vector<std::filesystem::path>& paths) {
    const auto name = [&](auto part) {
        return paths[static_cast<std::size_t>(part - parts.begin())].filename().string();
    };
    const auto flawed =
        std::ranges::find_if(parts, [](const StoredTimes& part) { return !part.note.empty(); });
    if (flawed != parts.end()) return fmt::format("{}: {}", name(flawed), flawed->note);
    const auto dated = std::ranges::find_if(parts, &StoredTimes::inText);
    if (dated == parts.end()) return "";
    return fmt::format("{} of {} is not read, steps are counted: {} has no such dates", dated->name,
                       name(dated), name(std::ranges::find_if(parts, &StoredTimes::counted)));
}

// By the numbers in the files' names, where each is one step.
JoinedTimes count(const std::vector<StoredTimes>& parts,
                  const std::vector<std::filesystem::path>& paths) {
    JoinedTimes joined;
    std::size_t steps = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        joined.segments.push_back({i, parts[i].values.size()});
        steps += parts[i].values.size();
    }
    joined.times.note = whyCounted(parts, paths);
    joined.times.values.clear();
    for (std::size_t i = 0; i < steps; ++i)
        joined.times.values.emplace_back(static_cast<double>(i));
    if (!std::ranges::all_of(parts, &StoredTimes::single)) return joined;
    if (const auto numbers = ascendingNumbers(paths)) {
        joined.times.name = "number";
        joined.times.counted = false;
        joined.times.values.assign(numbers->begin(), numbers->end());
    }
    return joined;
}

// With as few digits as tell each from the next, where their numbers do.
void addDates(const TimeUnits& units, const std::vector<Number>& values,
              std::vector<TimePoint>& points) {
    for (const int decimals : {3, 6, 9}) {
        bool areAlike = false;
        for (std::size_t i = 0; i < values.size(); ++i) {
            points[i].date = units.date(values[i], decimals);
            areAlike = areAlike || (i > 0 && points[i].date == points[i - 1].date &&
                                    compare(values[i], values[i - 1]) != 0);
        }
        if (!areAlike) return;
    }
}

}  // namespace

StoredTimes timesOf(const CfFile& file, const FileAxes& fileAxes, const NcVariable& variable,
                    const Roles& roles) {
    const NcHeader& header = file.header();
    StoredTimes times;
    times.single = !roles.t;
    if (!roles.t) {
        if (const NcVariable* time = scalarTime(header, variable)) {
            readCoordinate(file, *time, times);
        }
        return times;
    }
    const NcDimension& dimension = header.dimension(variable, *roles.t);
    if (dimension.length > kMaxTimes)
        file.fail("dimension '" + dimension.name + "'",
                  fmt::format("expected at most {} steps, found {}", kMaxTimes, dimension.length));
    if (const NcVariable* time = fileAxes.coordinateOf(variable, *roles.t)) {
        readCoordinate(file, *time, times);
    } else {
        times.values.clear();
        for (std::uint64_t i = 0; i < dimension.length; ++i)
            times.values.emplace_back(static_cast<double>(i));
        if (const NcVariable* texts = fileAxes.textsAlong(variable, *roles.t))
            readDateTexts(file, *texts, times);
    }
    return times;
}

TimeAxis timeAxisOf(const StoredTimes& times, std::vector<std::string>& notes) {
    TimeAxis axis{times.name, times.units, "", {}, times.counted};
    if (!times.note.empty()) notes.push_back(times.note);
    std::optional<TimeUnits> units;
    if (looksLikeTimeUnits(times.units) && lower(times.calendar) != "none") {
        const auto calendar = calendarFromName(times.calendar);
        if (calendar) units = TimeUnits::parse(times.units, *calendar);
        if (units)
            axis.calendar = calendarName(*calendar);
        else
            notes.push_back(calendar ? fmt::format("times are shown as numbers: \"{}\" is no date "
                                                   "of the calendar {}",
                                                   times.units, calendarName(*calendar))
                                     : fmt::format("times are shown as numbers: the calendar "
                                                   "\"{}\" is not known",
                                                   times.calendar));
    }
    axis.points.reserve(times.values.size());
    for (const Number& value : times.values) axis.points.push_back({toDouble(value), ""});
    if (units) addDates(*units, times.values, axis.points);
    return axis;
}

JoinedTimes join(const std::vector<StoredTimes>& parts,
                 const std::vector<std::filesystem::path>& paths, const std::string& variable) {
    const auto refuse = [&](std::size_t a, std::size_t b, const std::string& what) {
        throw FileError(fmt::format("{} and {}: variable '{}': {}", paths[a].string(),
                                    paths[b].string(), variable, what));
    };
    if (parts.size() == 1) return {parts[0], {{0, parts[0].values.size()}}};
    const auto mayBeCounted = [](const StoredTimes& part) { return part.counted || part.inText; };
    if (std::ranges::any_of(parts, &StoredTimes::counted) &&
        std::ranges::all_of(parts, mayBeCounted))
        return count(parts, paths);

    std::vector<Part> sorted;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        auto values = inUnitsOf(parts[0], parts[i]);
        if (!values)
            refuse(
                0, i,
                fmt::format("expected times in units that agree, found \"{}\" ({}) and \"{}\" "
                            "({})",
                            parts[0].units, parts[0].calendar, parts[i].units, parts[i].calendar));
        for (const Number& value : *values)
            if (!std::isfinite(toDouble(value))) refuse(0, i, "expected finite times");
        const auto [lo, hi] = std::ranges::minmax_element(*values, before);
        const Number least = *lo, most = *hi;
        sorted.push_back({i, std::move(*values), least, most});
    }
    std::ranges::stable_sort(sorted,
                             [](const Part& a, const Part& b) { return before(a.lo, b.lo); });
    JoinedTimes joined{parts[0], {}};
    joined.times.values.clear();
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        if (i > 0 && !before(sorted[i - 1].hi, sorted[i].lo))
            refuse(sorted[i - 1].file, sorted[i].file,
                   fmt::format("expected times that do not overlap, found {} to {} and {} to {} "
                               "({})",
                               toText(sorted[i - 1].lo), toText(sorted[i - 1].hi),
                               toText(sorted[i].lo), toText(sorted[i].hi), parts[0].units));
        joined.segments.push_back({sorted[i].file, sorted[i].values.size()});
        joined.times.values.insert(joined.times.values.end(), sorted[i].values.begin(),
                                   sorted[i].values.end());
    }
    return joined;
}

}  // namespace timeseries
