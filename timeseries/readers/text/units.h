// What a unit text measures, as udunits2 understands it. udunits is not thread-safe and needs its
// unit database; both stay behind this file.
#pragma once

#include <optional>
#include <string>

namespace timeseries {

// How many of `to` one of `from` is: ("hour", "s") gives 3600. Nothing when either text is no unit,
// when they measure different things, or when the conversion has an offset (degC to K).
std::optional<double> unitRatio(const std::string& from, const std::string& to);

// Both measure the same kind of thing: ("hPa", "Pa"), ("degC", "K").
bool sameDimension(const std::string& a, const std::string& b);

}  // namespace timeseries
