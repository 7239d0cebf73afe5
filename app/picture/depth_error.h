// How far a picture is from the interval volume of the field between its points, and how that is
// told.
#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "app/choices/explorer.h"
#include "render/points/view.h"
#include "render/together.h"
#include "timeseries/index/sorted_step.h"

namespace app {

// Of kept values and of categories nobody knows what lies between.
inline bool hasDepthError(const timeseries::SortedStep& step) { return step.canHaveCells(); }
// Of a picture that is drawn whole: of lengths in its ranges, whatever its opacity is of, the
// relative L2 of optical depth, from a sample of its pixels (render/reference/sampled_error.h). NaN
// where nothing is visible, and once it is not wanted any more. On any thread. REQUIRES: a resolved
// explorer; hasDepthError(step).
double depthErrorOf(const Explorer& explorer, const timeseries::SortedStep& step,
                    const render::View& view, unsigned threads = render::sharingThreads(),
                    const std::atomic<bool>& wanted = true);

// "error about 0.4 %"; "" where it is not known.
std::string depthErrorText(const std::optional<double>& error);
// What a picture file has it under, as a number.
inline constexpr const char* kErrorKey = "isochronOpticalDepthError";

}  // namespace app
