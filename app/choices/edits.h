// What a user does to ranges, layers and the clip box, as functions of plain values: a panel, a key
// and a script call the same. Exact numbers that were typed stay as typed; dragged ones are
// doubles. What is typed into a layer's field is read by parseSelection, what is dragged rounded by
// roundedTo.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "app/choices/decimals.h"
#include "app/choices/explorer.h"
#include "app/choices/selection_text.h"
#include "timeseries/index/sorted_step.h"

namespace app {

enum class End { Lo, Hi };

// REQUIRES of what follows: range < ranges.ranges().size().
// The end of a range dragged to a value: no farther than its other end, and it stops short of its
// neighbours, so that ranges never merge or vanish under the hand: at the value next to their ends,
// as roundedTo() has it of `resolution` (0: the nearest double), or where it is nearer already. An
// open end stays open; an infinite value makes an end unbounded. REQUIRES: not NaN.
timeseries::RangeSet withEnd(const timeseries::RangeSet& ranges, std::size_t range, End end,
                             double value, double resolution = 0);
// Where an end at `from` comes to by so many steps of `resolution`, down where `by` < 0: past one
// of the step's values at least, so that another set of points is selected, however narrow or wide
// values lie; `from` where there is none. REQUIRES: from is finite, by != 0, resolution > 0.
double steppedEnd(const timeseries::SortedStep& step, double from, End end, int by,
                  double resolution);
// The whole range dragged by `by` (finite), stopped likewise by its neighbours; its width stays, to
// rounding. Unbounded ends stay.
timeseries::RangeSet withMoved(const timeseries::RangeSet& ranges, std::size_t range, double by,
                               double resolution = 0);
timeseries::RangeSet without(const timeseries::RangeSet& ranges, std::size_t range);
timeseries::RangeSet with(const timeseries::RangeSet& ranges, const timeseries::Range& added);

// One end of the clip box along an axis of the grid dragged to a coordinate: no farther than its
// other end, so that the box never turns inside out. Where the axis ends, or beyond, it is
// unbounded; no box is left where all ends are. REQUIRES: not NaN.
std::optional<ClipBox> withClipEnd(const std::optional<ClipBox>& clip, const timeseries::Grid& grid,
                                   std::size_t axis, End end, double coordinate);

// One side of the clip box as it is typed: "2:5.5", "min:3", "" for all of the axis; a value alone
// is a slice: the plane nearest to it, of a grid that it lies in. An end that reads as the axis's
// own does is that end, whatever digits it was told with; one that reads as it was shown, with so
// many digits, stays as it is. Throws ChoiceError where that is none of these or holds no point of
// the grid.
constexpr int kClipDigits = 7;
std::optional<ClipBox> withClipSide(const std::optional<ClipBox>& clip,
                                    const timeseries::Grid& grid, std::size_t axis,
                                    std::string_view text, int digits = kClipDigits);
// What stands for that side in a field, unbounded ends as the axis's.
std::string clipSideText(const std::optional<ClipBox>& clip, const timeseries::Grid& grid,
                         std::size_t axis, int digits = kClipDigits);
// As many digits as that text has room for, but no fewer than tell its ends apart, nor than three.
int clipDigits(const std::optional<ClipBox>& clip, const timeseries::Grid& grid, std::size_t axis,
               const std::function<bool(std::string_view text)>& fits);

// The layer at this place taken away. The last one leaves none: no first choice takes its place.
void removeLayer(Explorer& explorer, std::size_t layer);
// What a layer that is added to these is to show: values at the end of the data, or else among
// them, but for those of a layer, hidden ones included; other ranges than the layers' where every
// point is in one.
timeseries::RangeSet newRanges(const Explorer& explorer, const timeseries::SortedStep& step);
// A new layer, last; its colour is the next that no layer has (constant colours by place, as for
// several --range), its opacity that of a lump of so many points (opacityFor). Layers that were
// coloured by value stay so. Returns its place. REQUIRES: fewer than render::kMaxLayers layers.
std::size_t addLayer(Explorer& explorer, timeseries::RangeSet ranges,
                     const timeseries::SortedStep& step);

}  // namespace app
