// Rounding to decimal digits: the double nearest to the decimal number, so that it prints as such.
#pragma once

#include "timeseries/grid/field.h"
#include "timeseries/index/range_set.h"

namespace app {

// To so many decimals (negative: to tens, hundreds, ...). REQUIRES: a finite value.
double toDecimals(double value, int decimals);

// A value rounded to as few decimals as tell apart neighbours `resolution` (> 0) apart: what a drag
// across one pixel means.
double roundedTo(double value, double resolution);
// The next such value that is greater, less; the next double where the resolution is 0 or finer.
double roundedAbove(double value, double resolution);
double roundedBelow(double value, double resolution);

// So many significant digits, no fewer than `least`, that numbers up to this size and so far apart
// differ in them.
int digitsApart(double size, double apart, int least);

// As decimal digits add up, not as doubles do: 0.1 + 0.2 is 0.3.
double decimalSum(double a, double b);

// As a field of this type is told it: of all numbers that are one value there, the one with the
// fewest digits. Of a float32 34.17789840698242 is 34.1779.
double shortestIn(timeseries::ValueType type, double value);
// Its ends likewise, where all that tells them apart stays.
timeseries::RangeSet shortestIn(timeseries::ValueType type, const timeseries::RangeSet& ranges);

}  // namespace app
