#include "timeseries/sorted_step.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "timeseries/run_search.h"
#include "timeseries/value_sort.h"

namespace timeseries {
namespace {

template <typename T>
Number numberOf(T value) {
    if constexpr (std::is_floating_point_v<T>) {
        return static_cast<double>(value);
    } else if constexpr (std::is_same_v<T, std::uint64_t>) {
        return value;
    } else {
        return static_cast<std::int64_t>(value);
    }
}

template <typename T>
bool isNan(T value) {
    return value != value;
}

// Whether a value lies in one of a few intervals; the whole type is the common case.
template <typename T>
class KeptTest {
 public:
    explicit KeptTest(const RangeSet& kept) : intervals_(kept.toIntervals<T>()) {}
    bool operator()(T value) const {
        for (const Interval<T>& i : intervals_)
            if (i.lo <= value && value <= i.hi) return true;
        return false;  // NaN too
    }

 private:
    std::vector<Interval<T>> intervals_;
};

// The least and the greatest of those that count.
template <typename T, typename Counts>
std::pair<Number, Number> extentOf(std::span<const T> values, const Counts& counts) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    bool any = false;
    T lo{}, hi{};
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!counts(i)) continue;
        lo = any ? std::min(lo, values[i]) : values[i];
        hi = any ? std::max(hi, values[i]) : values[i];
        any = true;
    }
    return any ? std::pair{numberOf(lo), numberOf(hi)} : std::pair<Number, Number>{kNan, kNan};
}

// Adds to `kept` how many of the points that count are in what is kept.
template <typename T, typename Valid, typename InKept>
StepStatistics measure(std::span<const T> values, const Valid& valid, const InKept& inKept,
                       std::size_t& kept) {
    StepStatistics s;
    T lo{}, hi{};
    for (std::size_t i = 0; i < values.size(); ++i) {
        const T v = values[i];
        if (!valid(i) || isNan(v)) continue;
        if (s.points == 0) lo = hi = v;
        lo = std::min(lo, v);
        hi = std::max(hi, v);
        ++s.points;
        kept += inKept(v);
    }
    s.missing = values.size() - s.points;
    s.min = s.max = std::numeric_limits<double>::quiet_NaN();
    if (s.points > 0) {
        s.min = numberOf(lo);
        s.max = numberOf(hi);
    }
    s.finiteMin = s.min;
    s.finiteMax = s.max;
    if (std::isinf(lo) || std::isinf(hi))  // rare: the others are spared the look
        std::tie(s.finiteMin, s.finiteMax) =
            extentOf(values, [&](std::size_t i) { return valid(i) && std::isfinite(values[i]); });
    return s;
}

// REQUIRES: both as RangeSet::toIntervals gives them.
template <typename T>
bool inside(const Interval<T>& query, const std::vector<Interval<T>>& kept) {
    for (const Interval<T>& k : kept)
        if (k.lo <= query.lo && query.hi <= k.hi) return true;
    return false;
}

template <typename T, typename Visit>
void forEachRun(std::span<const T> ascending, const RangeSet& ranges, const RangeSet& kept,
                const Visit& visit) {
    const auto keptIntervals = kept.toIntervals<T>();
    for (const Interval<T>& query : ranges.toIntervals<T>()) {
        if (!inside(query, keptIntervals))
            throw OutsideKeptError(fmt::format(
                "range {} reaches outside what was kept, {}: keep more, or ask inside it",
                ranges.text(), kept.empty() ? "nothing" : kept.text()));
        const Run run = findRun(ascending, query);
        if (run.count > 0) visit(run);
    }
}

// The values of T that both ranges hold, by the bounds as they are written where these say it. A
// range that holds nothing, or none, where there are no such values.
template <typename T>
std::optional<Range> commonPart(const Range& a, const Range& b) {
    Interval<T> x, y, both;
    if (!toInterval(a, x) || !toInterval(b, y)) return std::nullopt;
    const Interval<T> common{std::max(x.lo, y.lo), std::min(x.hi, y.hi)};
    const Range written{x.lo < y.lo ? b.lo : a.lo, y.hi < x.hi ? b.hi : a.hi};
    if (toInterval(written, both)) return written;  // no, if its bounds cross though T joins them
    return Range{{numberOf(common.lo)}, {numberOf(common.hi)}};
}

}  // namespace

SortedStep SortedStep::build(const Field& field, const RangeSet& kept) {
    SortedStep step;
    step.grid_ = field.grid;
    step.kept_ = kept;
    std::visit(
        [&]<typename T>(const std::vector<T>& all) {
            if (all.size() > (std::uint64_t{1} << 32))
                throw std::length_error(fmt::format(
                    "a step of {} points is more than the 2^32 that one list holds", all.size()));
            const std::span<const T> values(all);
            const KeptTest<T> inKept(kept);
            std::size_t count = 0;
            SortedPairs<T> sorted;
            if (field.missing.empty()) {
                step.statistics_ = measure(
                    values, [](std::size_t) { return true; }, inKept, count);
                sorted =
                    sortByValue(values, count, [&](std::size_t i) { return inKept(values[i]); });
            } else {
                const auto valid = [&](std::size_t i) { return !field.missing[i]; };
                step.statistics_ = measure(values, valid, inKept, count);
                sorted = sortByValue(values, count,
                                     [&](std::size_t i) { return valid(i) && inKept(values[i]); });
            }
            step.values_ = std::move(sorted.values);
            step.index_ = std::move(sorted.index);
        },
        field.values);
    return step;
}

std::vector<Run> SortedStep::select(const RangeSet& ranges) const {
    std::vector<Run> runs;
    std::visit(
        [&]<typename T>(const std::vector<T>& values) {
            forEachRun<T>(values, ranges, kept_, [&](const Run& run) { runs.push_back(run); });
        },
        values_);
    return runs;
}

std::uint64_t SortedStep::count(const RangeSet& ranges) const {
    std::uint64_t count = 0;
    std::visit(
        [&]<typename T>(const std::vector<T>& values) {
            forEachRun<T>(values, ranges, kept_, [&](const Run& run) { count += run.count; });
        },
        values_);
    return count;
}

RangeSet SortedStep::keptPart(const RangeSet& ranges) const {
    std::vector<Range> parts;
    std::visit(
        [&]<typename T>(const std::vector<T>&) {
            for (const Range& range : ranges.ranges())
                for (const Range& kept : kept_.ranges())
                    if (const auto part = commonPart<T>(range, kept)) parts.push_back(*part);
        },
        values_);
    return RangeSet(std::move(parts));
}

Columns SortedStep::columns() const {
    return {std::visit([](const auto& values) { return ValueSpan(std::span(values)); }, values_),
            index_};
}

Columns SortedStep::columns(std::span<const Run>) const { return columns(); }

Number SortedStep::value(std::uint64_t point) const {
    return std::visit([&](const auto& values) { return numberOf(values[point]); }, values_);
}

std::uint64_t SortedStep::bytes() const {
    const auto valueBytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
    return std::visit(valueBytes, values_) + index_.capacity() * sizeof(index_[0]);
}

Run SortedStep::finite() const {
    return std::visit(
        [&]<typename T>(const std::vector<T>& values) {
            if constexpr (std::is_floating_point_v<T>) {
                constexpr T kMost = std::numeric_limits<T>::max();
                return findRun(std::span<const T>(values), Interval<T>{-kMost, kMost});
            } else {
                return Run{0, values.size()};
            }
        },
        values_);
}

std::vector<double> SortedStep::quantiles(std::size_t n) const {
    std::vector<double> out;
    const Run among = finite();
    if (among.count == 0) return out;
    out.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double fraction = n == 1 ? 0.5 : static_cast<double>(i) / static_cast<double>(n - 1);
        const double rank = fraction * static_cast<double>(among.count - 1);
        out.push_back(
            toDouble(value(among.first + static_cast<std::uint64_t>(std::llround(rank)))));
    }
    return out;
}

}  // namespace timeseries
