// What is said of a picture's error (depth_error.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/picture/depth_error.h"

namespace app {

// "cells", "points", "1 of 8 points".
std::string rungText(const Rung& rung);
// Of what draws fewer points than anything whose error is known, that error is the least.
enum class Bound { About, Least };
Bound boundOf(const RungError& known, const Rung& drawn);
// "0.4 %", "12 %", "below 0.1 %", "above 1000 %"; "above 12 %".
std::string shareText(double error, Bound bound = Bound::About);
// "error about 0.4 %"; "" where it is none that can be told.
std::string depthErrorText(double error, Bound bound = Bound::About);
// "error not known yet", or "error not known" where nobody will; "" where it is known, or there is
// nothing. `errors`: of the selection that is drawn so, none while they are worked out.
std::string unknownErrorText(const std::optional<DepthErrors>& errors, const Rung& drawn);
// Of what is drawn so and has no error, for there is nothing: as of the one point that has a
// field's greatest value, or from where one looks elsewhere.
std::string nothingSeenText(Model drawn);
// Of a picture whose colours meet in no order.
inline constexpr const char* kMixed = "colours mixed";
// ", light 8 % (colours mixed)" where order costs light that shows, else "".
std::string lightErrorText(const RungError& error, Ordering ordering);

// One part of it, for a person: "model", "2.9 %", "cells instead of the field between points".
struct PartLine {
    std::string name, size, what;
};
// Model, subset, pixels, then order: "none" of what is nothing, with the reason. REQUIRES:
// error.parts. `drawn`: what draws fewer points than that, where something does.
std::vector<PartLine> partLines(const RungError& error, Ordering ordering,
                                const std::optional<Rung>& drawn = {});

}  // namespace app
