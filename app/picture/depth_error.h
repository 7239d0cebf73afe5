// How far a picture is from the interval volume of the field between its points, and which part of
// that comes from what.
//
// With T the truth at some of the picture's pixels, each the mean of 8 x 8 rays, M the model drawn
// whole with as many rays in a pixel, P the same with the rays that are drawn, one or a few, and D
// what is drawn, all of optical depth, of lengths in the ranges or of crossings, as opacity is
// (render::OpacityPer); of points, which have lengths alone, where they were chosen:
//   whole  |D - T| / |T|   T of fewer rays if these tell it as well
//   model  |M - T| / |T|   cells or points instead of the interval volume
//   pixels |P - M| / |T|   few rays a pixel, or one for several pixels, instead of its mean
//   subset |D - P| / |T|   what is left out while a picture moves
// The differences add up to the whole one, their sizes do not: they may cancel, so that the whole
// is at most the sum of the three, and less where they do. Order changes no depth; what it costs is
// told of light, of exact parts in the order in which the picture puts them together
// (render/reference/order_error.h).
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/choices/explorer.h"
#include "app/choices/rung.h"
#include "render/points/view.h"
#include "render/together.h"
#include "timeseries/index/sorted_step.h"

namespace app {

// Of kept values and of categories nobody knows what lies between.
inline bool hasDepthError(const timeseries::SortedStep& step) { return step.canHaveCells(); }
struct ErrorParts {
    double model = 0, subset = 0, pixels = 0;
    friend bool operator==(const ErrorParts&, const ErrorParts&) = default;
};
struct RungError {
    Rung rung;
    double depth = 0;  // the whole
    double order = 0;  // of light; not a number of points among cells, whose order nobody tells
    std::optional<ErrorParts> parts = {};
};
// How a picture puts together what a ray passes: OneColor is the same in any order.
enum class Ordering { OneColor, Mixed, ByDepth };

// Of one selection, however it is drawn, from a sample of the pixels
// (render/reference/sampled_error.h).
struct DepthErrors {
    std::vector<RungError> rungs;
    Ordering ordering = Ordering::OneColor;
    std::string whyNone = {};  // where they could not be worked out
    // Of a coarser subset than was looked at, the coarsest's; null of cells where none were.
    const RungError* find(const Rung& rung) const;
    std::optional<double> of(const Rung& rung) const;  // the whole
    // The one that draws least of those within this error. Where none is, the truest. None where
    // nothing is known.
    std::optional<Rung> cheapest(double error) const;
};
enum class Parts { None, All };
struct ErrorQuestion {
    Parts parts = Parts::None;  // All takes about twice as long
    unsigned threads = render::sharingThreads();
};
// Of each of these, the first of which chooses the pixels. None where nothing is visible, and once
// they are not wanted any more. On any thread. REQUIRES: a resolved explorer; hasDepthError(step).
DepthErrors depthErrorsOf(const Explorer& explorer, const timeseries::SortedStep& step,
                          const render::View& view, std::span<const Rung> rungs,
                          const ErrorQuestion& question = {},
                          const std::atomic<bool>& wanted = true);
// What a window draws while the picture moves and when it rests. Cells only where they are made.
std::vector<Rung> rungsOf(const Explorer& explorer, const timeseries::SortedStep& step);

// What a picture file has the whole of it under, as a number (or "inf"); and, where it is that of
// another picture of the same series, which stands for all of them, that one's name.
inline constexpr const char* kErrorKey = "isochronOpticalDepthError";
inline constexpr const char* kErrorOfKey = "isochronOpticalDepthErrorOf";

}  // namespace app
