// Numbers and units as axes and legends write them. Pure.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace render {

// "°E" for degrees_east, "m s⁻¹" for m s-1, else the unit as it stands.
std::string shownUnit(const std::string& unit);

// Multiples of 1, 2 or 5 times a power of ten inside [lo, hi], about `wanted` of them (at least one
// where lo == hi); free of rounding noise, so that 0.3 prints as 0.3. REQUIRES: lo <= hi, both
// finite, wanted >= 1.
std::vector<double> niceTicks(double lo, double hi, int wanted);

// Numbers written alike, as the labels of one axis: as many decimals as the one that needs most,
// powers of ten where plain digits would be long: "0.5", "1.0", "−2×10⁻⁹".
std::vector<std::string> tickTexts(std::span<const double> ticks);

// A number's text with the minus sign that tickTexts() writes.
std::string withMinusSigns(std::string_view number);

}  // namespace render
