#include "app/exploration/value_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace app {
namespace {

// The lower end of part i; the end of the last is just beyond hi, so that hi counts.
double edge(double lo, double hi, std::size_t bins, std::size_t i) {
    if (i == bins) return std::nextafter(hi, std::numeric_limits<double>::infinity());
    return lo + (hi - lo) * (static_cast<double>(i) / static_cast<double>(bins));
}

// The share of the points below `value`, times the number of gaps between quantiles.
double below(const std::vector<double>& quantiles, double value) {
    const auto next = std::lower_bound(quantiles.begin(), quantiles.end(), value);
    if (next == quantiles.begin()) return 0;
    const auto gap = static_cast<double>(next - quantiles.begin() - 1);
    if (next == quantiles.end()) return gap;
    const double from = *(next - 1), width = *next - from;
    return gap + (width > 0 && std::isfinite(width) ? (value - from) / width : 0);
}

// Of points of which the finite ones span from `least` to `greatest`.
AtInfinity atInfinity(const timeseries::Run& finite, std::uint64_t points, double least,
                      double greatest, double lo, double hi) {
    const bool none = finite.count == 0;
    return {none || least >= lo ? finite.first : 0,
            none || greatest <= hi ? points - finite.first - finite.count : 0};
}

}  // namespace

AtInfinity atInfinity(const timeseries::SortedStep& step, double lo, double hi) {
    const timeseries::Run finite = step.finite();
    const auto valueOf = [&](std::uint64_t point) {
        return finite.count == 0 ? 0 : timeseries::toDouble(step.value(point));
    };
    return atInfinity(finite, step.size(), valueOf(finite.first),
                      valueOf(finite.first + finite.count - 1), lo, hi);
}

AtInfinity atInfinity(const timeseries::StepSummary& summary, double lo, double hi) {
    const auto& quantiles = summary.quantiles;
    const bool none = quantiles.empty();
    return atInfinity(summary.finite, summary.points, none ? 0 : quantiles.front(),
                      none ? 0 : quantiles.back(), lo, hi);
}

std::vector<std::uint64_t> histogram(const timeseries::SortedStep& step, double lo, double hi,
                                     std::size_t bins) {
    assert(lo < hi && bins >= 1);
    std::vector<std::uint64_t> counts(bins);
    std::uint64_t from = step.countBelow(lo);
    for (std::size_t i = 0; i < bins; ++i) {
        const std::uint64_t to = step.countBelow(edge(lo, hi, bins, i + 1));
        counts[i] = to - from;
        from = to;
    }
    const AtInfinity infinite = atInfinity(step, lo, hi);
    counts.front() += infinite.below;
    counts.back() += infinite.above;
    return counts;
}

std::vector<double> density(const timeseries::StepSummary& summary, double lo, double hi,
                            std::size_t bins) {
    assert(lo < hi && bins >= 1);
    std::vector<double> counts(bins);
    const std::vector<double>& quantiles = summary.quantiles;
    const AtInfinity infinite = atInfinity(summary, lo, hi);
    counts.front() += static_cast<double>(infinite.below);
    counts.back() += static_cast<double>(infinite.above);
    if (quantiles.size() < 2) return counts;
    const double points =
        static_cast<double>(summary.finite.count) / static_cast<double>(quantiles.size() - 1);
    double from = below(quantiles, lo);
    for (std::size_t i = 0; i < bins; ++i) {
        const double to = below(quantiles, edge(lo, hi, bins, i + 1));
        counts[i] += points * (to - from);
        from = to;
    }
    return counts;
}

std::vector<double> countTicks(double most, bool linear) {
    if (linear) {
        // At most three steps of 1, 2 or 5 times a power of ten, each of whole points.
        double step = 1;
        for (std::size_t i = 0; 3 * step < most; ++i) step *= i % 3 == 1 ? 2.5 : 2;
        std::vector<double> ticks;
        for (double tick = 0; tick <= most; tick += step) ticks.push_back(tick);
        return ticks;
    }
    std::vector<double> ticks{0};
    for (double tick = 1; tick <= most; tick *= 10) ticks.push_back(tick);
    return ticks;
}

std::string shortCount(double count) {
    for (const auto& [unit, letter] :
         {std::pair(1e9, "G"), std::pair(1e6, "M"), std::pair(1e3, "k")})
        if (count >= unit) return fmt::format("{:g}{}", count / unit, letter);
    return fmt::format("{:g}", count);
}

}  // namespace app
