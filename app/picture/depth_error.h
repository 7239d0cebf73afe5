// How far a picture is from the interval volume of the field between its points, and how that is
// told.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/choices/explorer.h"
#include "render/points/view.h"
#include "render/together.h"
#include "timeseries/index/sorted_step.h"

namespace app {

// Of kept values and of categories nobody knows what lies between.
inline bool hasDepthError(const timeseries::SortedStep& step) { return step.canHaveCells(); }
// A way to draw: cells, or one of so many points.
struct Rung {
    Model model = Model::Cells;
    std::uint32_t stride = 1;
    friend bool operator==(const Rung&, const Rung&) = default;
};
// "cells", "points", "1 of 8 points".
std::string rungText(const Rung& rung);

// Of one selection, however it is drawn: the relative L2 of optical depth, of lengths in its ranges
// whatever its opacity is of, from a sample of the pixels (render/reference/sampled_error.h).
struct DepthErrors {
    std::vector<std::pair<Rung, double>> rungs;
    // Of a coarser subset than was looked at, the coarsest's. None of cells where none were.
    std::optional<double> of(const Rung& rung) const;
    // The one that draws least of those within this error: the coarsest points, then cells. Where
    // none is, the truest. None where nothing is known.
    std::optional<Rung> cheapest(double error) const;
};
// Of each of these, the first of which chooses the pixels. None where nothing is visible, and once
// they are not wanted any more. On any thread. REQUIRES: a resolved explorer;
// hasDepthError(step).
DepthErrors depthErrorsOf(const Explorer& explorer, const timeseries::SortedStep& step,
                          const render::View& view, std::span<const Rung> rungs,
                          unsigned threads = render::sharingThreads(),
                          const std::atomic<bool>& wanted = true);
// What a window draws while the picture moves and when it rests. Cells only where they are made.
std::vector<Rung> rungsOf(const Explorer& explorer, const timeseries::SortedStep& step);

// "0.4 %", "12 %", "below 0.1 %".
std::string shareText(double error);
// "error about 0.4 %"; "" where it is not known.
std::string depthErrorText(const std::optional<double>& error);
// What a picture file has it under, as a number.
inline constexpr const char* kErrorKey = "isochronOpticalDepthError";

}  // namespace app
