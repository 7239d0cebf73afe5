// A first picture that shows something in nearly every file: which values, and how coloured.
#pragma once

#include <span>
#include <vector>

#include "app/choices/explorer.h"

namespace app {

// What a few sampled steps say of the series: value quantiles at even fractions, a row a step.
using Quantiles = std::vector<std::vector<double>>;

// Most fields are mostly background: one value, or a narrow band, that fills the volume. The choice
// is the tenth of the points that lies farthest beyond it: above, below, or on both sides where the
// values reach about as far to either. Bounds are rounded to three digits; the outer end is open. A
// value far from all others that a fifth of the points have, and that is not the background, is
// left out: land, say. A constant field selects everything, and so does one whose values doubles
// hardly tell apart; no points, nothing but the whole range.
LayerChoice firstChoice(const Quantiles& sampled);

// Opacity at which a lump of so many cells, as thick as wide, is seen through but plainly there:
// an optical depth of about 4 through its middle.
double opacityFor(std::uint64_t selectedPoints);
// Of a grid of one layer it is a sheet, one cell thick however many they are.
double opacityFor(std::uint64_t selectedPoints, const timeseries::Grid& grid);

// The finite extent of the sampled values; {0, 0} without any.
struct Extent {
    double lo = 0, hi = 0;
    friend bool operator==(const Extent&, const Extent&) = default;
};
Extent extentOf(const Quantiles& sampled);
// But for the value that firstChoice() leaves out.
Extent extentAsideFill(const Quantiles& sampled);

// The share of a range by which a map that was not asked for begins below it, and the ends of such
// a map: its dark end would not be seen on a dark ground.
constexpr double kDarkEnd = 0.3;
inline Extent darkEnds(const Extent& range) {
    return {range.lo - kDarkEnd * (range.hi - range.lo), range.hi};
}

}  // namespace app
