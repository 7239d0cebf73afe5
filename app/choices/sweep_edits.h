// The swept window begun, as functions of plain values.
#pragma once

#include "app/choices/explorer.h"
#include "app/choices/first_choice.h"
#include "timeseries/index/sorted_step.h"

namespace app {

// The layer that moves does so; where none does, one without a style is put before the others.
void setSweep(Explorer& explorer, timeseries::SweepSettings settings);

// The share of a step's points that a window holds at most when a sweep begins.
constexpr double kFirstShare = 0.15;

// A layer before the others: a window that swings through all `values`, coloured by value. It
// begins at a tick at which the step shows something in it, and no more than kFirstShare of its
// points where the data have such values: near what the visible layers show if it can. What plays
// (PlayChoice) stays as it was chosen: of time alone the window does not move yet. `timePlays`:
// there is more than one step.
void startSweep(Explorer& explorer, const Extent& values, const timeseries::SortedStep& step,
                bool timePlays);

}  // namespace app
