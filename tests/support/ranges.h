// Ranges written briefly.
#pragma once

#include "timeseries/index/range_set.h"

namespace tests::ranges {

// What doubles between it and its double have steps of.
inline constexpr std::int64_t kTwo60 = std::int64_t{1} << 60;

using timeseries::Number;
using timeseries::Range;

inline Range closed(Number lo, Number hi) { return {{lo, false}, {hi, false}}; }
inline Range open(Number lo, Number hi) { return {{lo, true}, {hi, true}}; }
inline Range halfOpen(Number lo, Number hi) { return {{lo, false}, {hi, true}}; }
inline Range openLow(Number lo, Number hi) { return {{lo, true}, {hi, false}}; }

inline std::int64_t operator""_i(unsigned long long i) { return static_cast<std::int64_t>(i); }

}  // namespace tests::ranges
