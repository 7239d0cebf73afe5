#include "app/command/frame_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "app/choices/camera.h"
#include "app/files/picture_files.h"
#include "app/picture/error_text.h"
#include "app/picture/picture.h"
#include "app/say.h"

namespace app {
namespace {

using timeseries::SortedStep;

std::string errorText(const RungError& error, Ordering ordering) {
    const std::string depth = depthErrorText(error.depth);
    if (depth.empty()) return "";
    return depth + " of optical depth" + lightErrorText(error, ordering);
}

// Of what draws least of these and keeps to `within`, or the truest; without a text and a reason
// where there is nothing to say.
FrameError errorOf(const Explorer& e, const FrameAt& frame, const SortedStep& step,
                   std::span<const Rung> rungs, double within) {
    FrameError error{.of = frame.file, .rung = rungs.front()};
    if (!hasDepthError(step)) {
        error.whyNone = step.whyNoCells();
        return error;
    }
    const auto outline = render::PlacedPoints::outlineOf(step.grid(), e.scale, e.map);
    const DepthErrors errors =
        depthErrorsOf(onlyThis(e, frame.step, frame.tick), step, eyes(e, outline).front(), rungs);
    if (errors.rungs.empty()) return error;
    const RungError& drawn = *errors.find(*errors.cheapest(within));
    if (std::isnan(drawn.depth)) {
        const Model model = modelOf(e);
        error.whyNone = nothingSeenText(model);
        if (model == Model::Cells) error.whyNone += "; --model points draws the points";
        return error;
    }
    error.depth = drawn.depth;
    error.text = errorText(drawn, errors.ordering);
    error.rung = drawn.rung;
    return error;
}

using ErrorOf = std::function<FrameError(std::span<const Rung>, double within)>;

FrameError errorOfMiddle(const Explorer& e, const FrameFiles& frames, StepSource& source,
                         std::span<const Rung> rungs, double within) {
    constexpr std::size_t kAsked = 9;
    const std::size_t middle = frames.size() / 2;
    FrameError none{.of = frames[middle].file, .rung = rungs.front()};
    // Those before it and behind it in turn.
    for (std::size_t k = 0, asked = 0; k <= 2 * middle + 1 && asked < kAsked; ++k) {
        const std::size_t i = k % 2 == 1 ? middle - (k + 1) / 2 : middle + k / 2;
        if (i >= frames.size()) continue;
        ++asked;
        const FrameAt frame = frames[i];
        try {
            const auto step = source.get(frame.step, frames.front().step);
            FrameError error = errorOf(e, frame, *step, rungs, within);
            if (error.depth || !hasDepthError(*step)) return error;
            if (!error.whyNone.empty()) none.whyNone = std::move(error.whyNone);
        } catch (const timeseries::FileError&) {
            // What cannot be read is told when its turn comes, after the pictures before it.
        }
    }
    return none;
}

// What is to be drawn, and its error: all by the chosen model, unless an error is asked for. Points
// first: of a step whose cells are not wanted they are not made.
FrameError chosenError(const RenderOptions& options, const Explorer& e, const ErrorOf& errorOf) {
    const Rung all{modelOf(e)};
    if (!options.within) return errorOf(std::span(&all, 1), 1);
    const bool coarsePoints = mayBeCoarse(e.footprint);
    const auto by = [&](bool cells) {
        return errorOf(ladder({.cells = cells, .points = !cells, .coarsePoints = coarsePoints}),
                       *options.within);
    };
    FrameError points = by(false);
    if (!points.whyNone.empty()) points.rung = all;
    const bool isEnough = points.depth && *points.depth <= *options.within;
    if (isEnough || all.model == Model::Points || !points.whyNone.empty()) return points;
    return by(true);
}

std::string fileOf(const std::filesystem::path& picture, const Explorer& e) {
    return filesOf(picture, e.stereo.mode).front().string();
}

}  // namespace

FrameErrors::FrameErrors(const RenderOptions& options, const Explorer& explorer,
                         const FrameFiles& frames, StepSource& source)
    : options_(options), explorer_(explorer), frames_(frames) {
    if (options.errorOfEach) return;
    errors_.push_back(chosenError(options, explorer, [&](auto rungs, double within) {
        return errorOfMiddle(explorer, frames, source, rungs, within);
    }));
}

const FrameError& FrameErrors::of(const FrameAt& frame, const SortedStep& step) {
    if (!options_.errorOfEach) return errors_.front();
    errors_.push_back(chosenError(options_, explorer_, [&](auto rungs, double within) {
        return errorOf(explorer_, frame, step, rungs, within);
    }));
    return errors_.back();
}

void FrameErrors::tell(bool saysNothing) const {
    if (errors_.size() > 1) return tellEach();
    const FrameError& error = errors_.front();
    if (!error.text.empty() || (!error.whyNone.empty() && !saysNothing)) tellMiddle();
    if (options_.within)
        say("  drawn: {}{}\n", error.whyNone.empty() ? rungText(error.rung) : "all",
            error.depth && *error.depth > *options_.within ? ", the truest there is" : "");
}

// One picture's is no other's: those of a series may differ by any factor.
void FrameErrors::tellMiddle() const {
    const FrameError& error = errors_.front();
    const std::size_t others = frames_.size() - 1;
    if (!error.whyNone.empty()) return say("  error not known: {}\n", error.whyNone);
    if (others == 0) return say("  {}\n", error.text);
    say("  {} in {}; {} not known: --each-error works them out\n", error.text,
        fileOf(error.of, explorer_),
        others == 1 ? "the other picture's is"
                    : fmt::format("those of the other {} pictures are", others));
}

void FrameErrors::tellEach() const {
    const auto less = [](const FrameError& a, const FrameError& b) { return a.depth < b.depth; };
    const auto [least, most] = std::ranges::minmax_element(errors_, less);  // without one first
    if (!most->depth) return say("  error not known in any: {}\n", most->whyNone);
    const auto known =
        std::ranges::count_if(errors_, [](const auto& e) { return e.depth.has_value(); });
    say("  {} in {}, the most of {} pictures", most->text, fileOf(most->of, explorer_),
        errors_.size());
    if (known == std::ssize(errors_))
        say("; {} in {}, the least\n", depthErrorText(*least->depth), fileOf(least->of, explorer_));
    else
        say("; not known in {}\n", std::ssize(errors_) - known);
    if (!options_.within) return;
    std::vector<Rung> told;
    for (const FrameError& error : errors_) {
        if (std::ranges::count(told, error.rung) > 0) continue;
        told.push_back(error.rung);
        say("  drawn: {} in {} of them\n", rungText(error.rung),
            std::ranges::count(errors_, error.rung, &FrameError::rung));
    }
    if (*most->depth > *options_.within)
        say("  of {} the truest there is has more than {:g}\n",
            std::ranges::count_if(
                errors_, [&](const auto& e) { return e.depth && *e.depth > *options_.within; }),
            *options_.within);
}

}  // namespace app
