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
#include "render/reference/exact_cells.h"

namespace app {
namespace {

using timeseries::SortedStep;

// Of what is drawn as the truth itself.
const std::string& truthText() {
    static const std::string text =
        fmt::format("drawn as the field is between its points, along {} rays a pixel",
                    render::kExactRays * render::kExactRays);
    return text;
}

bool drawsTruth(const RenderOptions& options, const Explorer& explorer) {
    return options.by.splatter == render::SplatterChoice::Exact &&
           modelOf(explorer) == Model::Cells;
}

std::string errorText(const RungError& error, Ordering ordering) {
    const std::string depth = depthErrorText(error.depth);
    if (depth.empty()) return "";
    return depth + " of optical depth" + lightErrorText(error, ordering);
}

// Of what draws least of these and keeps to `within`, or the truest; without a text and a reason
// where there is nothing to say.
FrameError errorOf(const Explorer& e, const FrameAt& frame, const SortedStep& step,
                   std::span<const Rung> rungs, double within, bool isTruth) {
    FrameError error{.of = frame.file, .rung = rungs.front()};
    if (!hasDepthError(step)) {
        error.whyNone = step.whyNoCells();
        return error;
    }
    if (isTruth) {
        error.text = truthText();
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
                         std::span<const Rung> rungs, double within, bool isTruth) {
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
            FrameError error = errorOf(e, frame, *step, rungs, within, isTruth);
            if (error.depth || isTruth || !hasDepthError(*step)) return error;
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
        return errorOfMiddle(explorer, frames, source, rungs, within,
                             drawsTruth(options, explorer));
    }));
}

const FrameError& FrameErrors::of(const FrameAt& frame, const SortedStep& step) {
    if (!options_.errorOfEach) return errors_.front();
    errors_.push_back(chosenError(options_, explorer_, [&](auto rungs, double within) {
        return errorOf(explorer_, frame, step, rungs, within, drawsTruth(options_, explorer_));
    }));
    return errors_.back();
}

void FrameErrors::tell(bool saysNothing) const {
    if (std::ranges::any_of(errors_, [](const FrameError& e) { return e.text == truthText(); }))
        return say("  {}\n", truthText());
    if (errors_.size() > 1) return tellEach(saysNothing);
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
    say("  {} in {}; {}\n", error.text, fileOf(error.of, explorer_),
        others == 1
            ? "the other picture's is not known: --each-error works it out"
            : fmt::format("those of the other {} pictures are not known: --each-error works "
                          "them out",
                          others));
}

void FrameErrors::tellEach(bool saysNothing) const {
    std::vector<const FrameError*> known;
    std::string why;  // of those that are not
    for (const FrameError& error : errors_) {
        if (error.depth) known.push_back(&error);
        if (!error.depth && why.empty()) why = error.whyNone;
    }
    const std::size_t unknown = errors_.size() - known.size();
    if (known.empty()) {
        if (!why.empty() && !saysNothing) say("  error not known in any: {}\n", why);
    } else {
        const auto [least, most] = std::ranges::minmax_element(
            known, {}, [](const FrameError* error) { return *error->depth; });
        say("  {} in {}, the most of {} pictures; {} in {}, the least{}\n", (*most)->text,
            fileOf((*most)->of, explorer_), errors_.size(), depthErrorText(*(*least)->depth),
            fileOf((*least)->of, explorer_),
            unknown == 0 ? ""
                         : fmt::format("; not known in {}{}", unknown,
                                       why.empty() ? "" : fmt::format(" ({})", why)));
    }
    if (options_.within) tellRungs();
}

// How many pictures are drawn on each rung, in the order of their first; where nobody knows their
// errors, whole.
void FrameErrors::tellRungs() const {
    std::vector<std::pair<std::string, std::size_t>> rungs;
    std::size_t truest = 0;
    for (const FrameError& error : errors_) {
        const std::string text = error.whyNone.empty() ? rungText(error.rung) : "all";
        const auto found =
            std::ranges::find(rungs, text, &std::pair<std::string, std::size_t>::first);
        if (found == rungs.end())
            rungs.emplace_back(text, 1);
        else
            ++found->second;
        truest += error.depth && *error.depth > *options_.within;
    }
    std::string text;
    for (const auto& [rung, count] : rungs)
        text += fmt::format("{}{} in {}", text.empty() ? "" : "; ", rung, count);
    say("  drawn: {} of the pictures{}\n", text,
        truest == 0 ? "" : fmt::format("; of {} the truest there is", truest));
}

}  // namespace app
