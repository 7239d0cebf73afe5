// Decimal numbers in files' names: "0.5" of "t_0.5.vti" is one number where nothing speaks for two.
// Names alone; no file is touched.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "timeseries/readers/text/cut_name.h"

namespace timeseries {

// Where a name may hold decimal numbers: the places in Name::digits of what stands before the dots,
// ascending. No part of "1.2.3", which is a version or a date, nor of "1.5e3".
std::vector<std::size_t> decimalPlaces(const Name& name);

// Each number that may be decimal made one without a dot.
Name withoutFractions(Name name);

// How the numbers at a dot are to be read in several names.
enum class Dotted {
    Decimal,
    Whole,   // as two: "run1.001" to "run1.099", then "run2.001"
    Unclear  // as one they would be in another order than as two: "1.9" and "1.10"
};

// Decimal where one of them has a sign or is a power of ten, else where both readings give the same
// order, and
// - the fractions are of one length, or none ends in a needless 0, as "1.50" does beside "0.5";
// - what stands before the dot varies, or is 0. After any other number they are counted, as
//   "Re100.0001" to "Re100.0050" are; where their lengths differ it is unclear;
// - the numbers after the dot do not begin anew at each before it, as the steps of several runs do
//   and the months of years.
// REQUIRES: files not empty; their names have the decimal place `at`, and differ there alone.
Dotted readingOf(std::span<const std::filesystem::path> files, std::size_t at);

}  // namespace timeseries
