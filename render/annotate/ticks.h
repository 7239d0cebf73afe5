// Numbers and units as axes and legends write them. Pure.
#pragma once

#include <functional>
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

// Texts with their common beginning left out as far as they need it to fit, the sign kept:
// "…6846500", "…6847000".
std::vector<std::string> withoutCommonStart(std::vector<std::string> texts,
                                            const std::function<bool(const std::string&)>& fits);

// Ticks with their labels, "" where one is left out.
struct LabelledTicks {
    std::vector<double> ticks;
    std::vector<std::string> texts;
};
// niceTicks(), about `wanted` or as many fewer, down to two, as it takes for their texts to fit,
// beginnings that they have in common left out. A label that does not fit even so is left out
// whole: what is left of a number cut otherwise is another number. REQUIRES: as niceTicks().
LabelledTicks fittingTicks(double lo, double hi, int wanted,
                           const std::function<bool(const std::string&)>& fits);

// A number's text with the minus sign that tickTexts() writes.
std::string withMinusSigns(std::string_view number);

}  // namespace render
