// Rounding to decimal digits: the double nearest to the decimal number, so that it prints as such.
#pragma once

namespace app {

// To so many decimals (negative: to tens, hundreds, ...). REQUIRES: a finite value.
double toDecimals(double value, int decimals);

// A value rounded to as few decimals as tell apart neighbours `resolution` (> 0) apart: what a drag
// across one pixel means.
double roundedTo(double value, double resolution);

}  // namespace app
