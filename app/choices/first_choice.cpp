#include "app/choices/first_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "app/choices/choice_text.h"
#include "app/choices/decimals.h"

namespace app {
namespace {

using timeseries::Bound;
using timeseries::Range;
using timeseries::RangeSet;

constexpr double kShare = 0.10;    // of the points, to be selected
constexpr double kTwoSided = 0.4;  // the shorter reach over the longer, from where both count

std::vector<double> finiteSorted(const Quantiles& sampled) {
    std::vector<double> all;
    for (const auto& step : sampled)
        std::ranges::copy_if(step, std::back_inserter(all),
                             [](double v) { return std::isfinite(v); });
    std::ranges::sort(all);
    return all;
}

Extent endsOf(const std::vector<double>& sorted) {
    if (sorted.empty()) return {};
    return {sorted.front(), sorted.back()};
}

// The middle of the shortest interval that holds half of the values (the half-sample mode's first
// step, Robertson and Cryer 1974): the background value, tied or not.
double background(const std::vector<double>& sorted) {
    const std::size_t half = sorted.size() / 2;
    std::size_t best = 0;
    for (std::size_t i = 0; i + half < sorted.size(); ++i)
        if (sorted[i + half] - sorted[i] < sorted[best + half] - sorted[best]) best = i;
    return 0.5 * sorted[best] + 0.5 * sorted[best + half];
}

double quantile(const std::vector<double>& sorted, double fraction) {
    return sorted[static_cast<std::size_t>(fraction * static_cast<double>(sorted.size() - 1) +
                                           0.5)];
}

// A value at either end that many points have and that lies farther from the others than those
// reach, unless it is the background: what a model's land looks like whose file names no fill
// value.
std::optional<double> fillOf(const std::vector<double>& sorted) {
    constexpr double kMany = 0.2;
    const double middle = background(sorted);
    for (const double end : {sorted.front(), sorted.back()}) {
        std::vector<double> others;
        std::ranges::copy_if(sorted, std::back_inserter(others),
                             [&](double v) { return v != end; });
        const auto points = static_cast<double>(sorted.size() - others.size());
        if (end == middle || others.empty() || points < kMany * static_cast<double>(sorted.size()))
            continue;
        const double gap = std::min(std::abs(others.front() - end), std::abs(others.back() - end));
        const double reach = quantile(others, 0.99) - quantile(others, 0.01);
        if (reach > 0 && gap > reach) return end;
    }
    return std::nullopt;
}

// Rounded towards `middle`, so that what lies beyond the value stays selected: to three significant
// digits of `scale`, or to two of the distance from `middle` where that is much less (the value is
// inside, the scale far out in a heavy tail).
double rounded(double value, double middle, double scale) {
    const double size = std::min(scale, 10 * std::abs(value - middle));
    if (!(size > 0) || !std::isfinite(size)) return value;
    const int decimals = 2 - static_cast<int>(std::floor(std::log10(size)));
    if (decimals > 300) return value;
    const auto isInside = [&](double v) { return value > middle ? v <= value : v >= value; };
    const double nearest = toDecimals(value, decimals);
    if (isInside(nearest)) return nearest;
    const double unit = std::pow(10, -decimals);
    const double next = toDecimals(value > middle ? value - unit : value + unit, decimals);
    return isInside(next) ? next : value;
}

// The tenth that lies farthest from the middle to either side; of fewer, all but the middle.
RangeSet farFrom(const std::vector<double>& sorted, double middle, double scale) {
    std::vector<double> distances;
    for (const double value : sorted) distances.push_back(std::abs(value - middle));
    std::ranges::sort(distances);
    const double least = quantile(distances, 1 - kShare);
    const double low = rounded(middle - least, middle, scale),
                 high = rounded(middle + least, middle, scale);
    const bool tied = !(low < middle && middle < high);
    std::vector<Range> sides;
    if (tied || sorted.front() <= low) sides.push_back({{-kInfinity}, {tied ? middle : low, tied}});
    if (tied || sorted.back() >= high) sides.push_back({{tied ? middle : high, tied}, {kInfinity}});
    return RangeSet(std::move(sides));
}

LayerChoice choiceOf(const std::vector<double>& sorted) {
    LayerChoice layer{.ranges = RangeSet::everything(), .color = {}, .opacity = {}};
    if (sorted.empty() || sorted.front() == sorted.back()) return layer;
    const double lo = sorted.front(), hi = sorted.back();
    // Doubles tell 64-bit integers so little apart that a bound may lie beyond all of them.
    constexpr double kLeastApart = 1e-3;
    const double most = std::max(std::abs(lo), std::abs(hi));
    if (std::nextafter(most, timeseries::kInfinity) - most > kLeastApart * (hi - lo)) return layer;
    const double middle = background(sorted);
    // How far the values reach, the outermost thousandth aside.
    double above = quantile(sorted, 0.999) - middle, below = middle - quantile(sorted, 0.001);
    if (std::max(above, below) <= 0) {  // nothing but the outermost thousandth differs
        above = hi - middle;
        below = middle - lo;
    }
    const double scale = std::max(above, below);
    const auto mapped = [&](const char* name, double from, double to) {
        layer.color =
            MapChoice{*render::colorMapNamed(name), std::clamp(from, -kMostFinite, kMostFinite),
                      std::clamp(to, -kMostFinite, kMostFinite)};
    };
    const auto mappedFrom = [&](double low) { mapped("inferno", darkEnds({low, hi}).lo, hi); };
    const auto mappedTo = [&](double high) { mapped("viridis", darkEnds({lo, high}).lo, high); };
    if (std::min(above, below) > kTwoSided * scale) {
        layer.ranges = farFrom(sorted, middle, scale);
        const auto sides = layer.ranges.ranges();
        if (sides.size() != 1)
            mapped("cool-warm", middle - scale, middle + scale);
        else if (timeseries::toDouble(sides[0].hi.value) == kInfinity)
            mappedFrom(timeseries::toDouble(sides[0].lo.value));
        else
            mappedTo(timeseries::toDouble(sides[0].hi.value));
        return layer;
    }
    if (above >= below) {
        const double from = rounded(quantile(sorted, 1 - kShare), middle, scale);
        // Few points beyond a tied background: all of them, not the background too.
        const bool tied = !(from > middle);
        layer.ranges = RangeSet(std::vector{Range{{tied ? middle : from, tied}, {kInfinity}}});
        mappedFrom(tied ? middle : from);
    } else {
        const double to = rounded(quantile(sorted, kShare), middle, scale);
        const bool tied = !(to < middle);
        layer.ranges = RangeSet(std::vector{Range{{-kInfinity}, {tied ? middle : to, tied}}});
        mappedTo(tied ? middle : to);
    }
    return layer;
}

}  // namespace

LayerChoice firstChoice(const Quantiles& sampled) {
    std::vector<double> sorted = finiteSorted(sampled);
    const auto fill = sorted.empty() ? std::nullopt : fillOf(sorted);
    if (!fill) return choiceOf(sorted);
    std::erase(sorted, *fill);
    LayerChoice layer = choiceOf(sorted);
    // A tenth of how far the others reach towards it: rarer ones are there, and what lies between
    // for no reason is not.
    const double reach = sorted.back() - sorted.front();
    const bool isBelow = *fill < sorted.front();
    const double near = isBelow ? sorted.front() - 0.1 * reach : sorted.back() + 0.1 * reach;
    std::vector<Range> beside(layer.ranges.ranges().begin(), layer.ranges.ranges().end());
    for (Range& range : beside) {
        Bound& outer = isBelow ? range.lo : range.hi;
        if (std::isinf(timeseries::toDouble(outer.value))) outer = {rounded(near, *fill, reach)};
    }
    layer.ranges = RangeSet(std::move(beside));
    return layer;
}

double opacityFor(std::uint64_t selectedPoints) {
    constexpr double kOpticalDepth = 4;
    const double thickness =
        std::cbrt(static_cast<double>(std::max<std::uint64_t>(selectedPoints, 1)));
    return std::clamp(-std::expm1(-kOpticalDepth / thickness), 0.01, 0.9);
}

double opacityFor(std::uint64_t selectedPoints, const timeseries::Grid& grid) {
    bool isSheet = std::ranges::any_of(grid.axes(), [](const timeseries::Axis& axis) {
        return axis.coordinates.front() == axis.coordinates.back();
    });
    // One layer of solid cells has the extent of these, their middles what rounding leaves.
    const auto& mesh = grid.mesh();
    for (int a = 0; a < 3 && mesh && mesh->corners() > mesh->count(); ++a)
        isSheet = isSheet || mesh->hi()[a] - mesh->lo()[a] <= 1e-6 * mesh->widest()[a];
    return opacityFor(isSheet ? 1 : selectedPoints);
}

Extent extentOf(const Quantiles& sampled) { return endsOf(finiteSorted(sampled)); }

Extent extentAsideFill(const Quantiles& sampled) {
    std::vector<double> sorted = finiteSorted(sampled);
    if (const auto fill = sorted.empty() ? std::nullopt : fillOf(sorted)) std::erase(sorted, *fill);
    return endsOf(sorted);
}

}  // namespace app
