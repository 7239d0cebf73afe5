#include "app/value_map.h"

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
    return gap + (width > 0 && width < std::numeric_limits<double>::infinity()
                      ? (value - from) / width
                      : 0);
}

}  // namespace

std::vector<std::uint64_t> histogram(const timeseries::SortedStep& step, double lo, double hi,
                                     std::size_t bins) {
    assert(lo < hi && bins >= 1);
    return std::visit(
        [&](const auto& values) {
            std::vector<std::uint64_t> counts(bins);
            auto from = values.begin();
            for (std::size_t i = 0; i <= bins; ++i) {
                const auto to =
                    std::lower_bound(from, values.end(), edge(lo, hi, bins, i),
                                     [](auto v, double e) { return static_cast<double>(v) < e; });
                if (i > 0) counts[i - 1] = static_cast<std::uint64_t>(to - from);
                from = to;
            }
            return counts;
        },
        step.values());
}

std::vector<double> density(const timeseries::StepSummary& summary, double lo, double hi,
                            std::size_t bins) {
    assert(lo < hi && bins >= 1);
    std::vector<double> counts(bins);
    const std::vector<double>& quantiles = summary.quantiles;
    if (quantiles.size() < 2) return counts;
    const double points =
        static_cast<double>(summary.points) / static_cast<double>(quantiles.size() - 1);
    double from = below(quantiles, lo);
    for (std::size_t i = 0; i < bins; ++i) {
        const double to = below(quantiles, edge(lo, hi, bins, i + 1));
        counts[i] = points * (to - from);
        from = to;
    }
    return counts;
}

}  // namespace app
