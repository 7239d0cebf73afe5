// What a user left open, chosen from the data: from an explorer's choices to choices that draw the
// same picture again.
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "app/choices/explorer.h"
#include "app/choices/first_choice.h"
#include "timeseries/index/sorted_step.h"

namespace app {

using Steps = std::map<std::size_t, std::shared_ptr<const timeseries::SortedStep>>;

// Whether something is left to choose from the data: a range, a colour map's ends, an opacity, an
// unbounded sweep.
bool needsSamples(const Explorer& explorer);
// All that these choices, resolved or not, ask of a step's points: the ranges of all layers, hidden
// ones' too; everything where some are left to choose, or move.
timeseries::RangeSet rangesNeeded(const Explorer& explorer);
// Whether sweeps go on as far as the data do; and where that is: from the least to the greatest of
// the finite values of these steps that may be shown, as the data have them. None where there are
// none.
bool sweepsOn(const Explorer& explorer);
std::optional<timeseries::Range> endsOf(const Explorer& explorer,
                                        const timeseries::SortedStep& step);
std::optional<timeseries::Range> around(const std::optional<timeseries::Range>& a,
                                        const std::optional<timeseries::Range>& b);
std::optional<Extent> extentOf(const Explorer& explorer, const timeseries::SortedStep& step);
// Throws ChoiceError where sweeps reach none of these.
void endSweeps(Explorer& explorer, const timeseries::Range& data);
// The choices with nothing left open, hidden layers' too (showing one later changes no other's
// colour), from a few steps of the series. A resolved Explorer draws the
// same picture again whatever is sampled. Throws ChoiceError when an unbounded sweep does not reach
// the data.
Explorer resolved(const Explorer& explorer, const Steps& sampled);

// Ends of a layer in doubles, in order; infinite ones are those of `data`, or, where the layer lies
// beyond these, its other end.
Extent finiteEnds(const timeseries::RangeSet& ranges, const Extent& data);

}  // namespace app
