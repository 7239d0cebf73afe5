// `isochron render`: steps in, picture files out; no window.
#include <fmt/format.h>

#include <functional>
#include <future>

#include "app/choices/camera.h"
#include "app/choices/choice_text.h"
#include "app/choices/clip_flaw.h"
#include "app/choices/decimals.h"
#include "app/choices/idle_choices.h"
#include "app/choices/map_flaw.h"
#include "app/choices/user_files.h"
#include "app/command/commands.h"
#include "app/command/drawing_device.h"
#include "app/exploration/chosen_data.h"
#include "app/files/dataset.h"
#include "app/files/frame_files.h"
#include "app/files/picture_files.h"
#include "app/files/progress.h"
#include "app/picture/depth_error.h"
#include "app/picture/error_text.h"
#include "app/picture/picture.h"
#include "app/picture/range_label.h"
#include "app/picture/still.h"
#include "app/say.h"
#include "render/frame/mean_depth.h"
#include "render/image/picture_file.h"

namespace app {
namespace {

using timeseries::SortedStep;

void tellStyle(const Explorer& e, const timeseries::Variable& variable) {
    const auto ends = [&](const MapChoice& map) {
        const timeseries::RangeSet between({timeseries::Range{{*map.lo}, {*map.hi}}});
        return rangeLabel(shortestIn(variable.type, between), "");
    };
    for (const LayerChoice& layer : e.layers) {
        if (!layer.visible) continue;
        std::string color;
        if (const auto* rgb = std::get_if<glm::dvec3>(&*layer.color)) {
            color = colorText(*rgb);
        } else {
            const auto& map = std::get<MapChoice>(*layer.color);
            color = *map.lo == *map.hi ? fmt::format("the middle of {}", map.map.name())
                                       : fmt::format("{} from {}", map.map.name(), ends(map));
        }
        const auto& ranges = layer.motion ? layer.motion->animation : layer.ranges;
        say("  {}: {}, opacity {:.2g}\n", rangeLabel(ranges, variable.units), color,
            *layer.opacity);
    }
}

void tellFiles(const FrameFiles& frames, const timeseries::Variable& variable) {
    std::string times = timeText(*variable.time, frames.front().step);
    if (frames.size() > 1) times += " to " + timeText(*variable.time, frames.back().step);
    say("{}: {}, {}\n", frames.names(), variable.name, times);
}

// What is said of the pictures once they are made.
struct Told {
    std::size_t mixed = 0;  // how many say that their colours are mixed
    std::size_t empty = 0;  // of how many no layer has a point
    std::size_t byGl = 0;   // how many GL has drawn
    std::size_t flat = 0;   // how many lie flat that were to lie on a globe,
    std::string whyFlat{};  // and why
};

std::string whyFlat(const Explorer& e, const timeseries::Grid& grid,
                    const render::PlacedPoints& placed) {
    if (e.map == render::Map::Flat || placed.globe()) return "";
    const std::string flaw = globeFlaw(grid);
    return flaw.empty() ? kNoVolumeOnGlobe : flaw;
}

DepthErrors errorsOf(const Explorer& e, const FrameAt& frame, const SortedStep& step,
                     std::span<const Rung> rungs) {
    const auto outline = render::PlacedPoints::outlineOf(step.grid(), e.scale, e.map);
    return depthErrorsOf(onlyThis(e, frame.step, frame.tick), step, eyes(e, outline).front(),
                         rungs);
}

std::string errorText(const RungError& error, Ordering ordering) {
    const std::string depth = depthErrorText(error.depth);
    if (depth.empty()) return "";
    return depth + " of optical depth" + lightErrorText(error, ordering);
}

// What all pictures have said of their error: that of the one in the middle, or of the nearest to
// it that shows something, since working it out takes longer than drawing a picture.
struct MiddleError {
    std::optional<double> depth;
    std::string text;          // as it is said
    std::string whyNone;       // where nobody knows it
    std::filesystem::path of;  // that picture
    Rung rung;                 // and what is drawn of it
};
// Of what draws least of these and keeps to `within`, or the truest.
MiddleError errorOfMiddle(const Explorer& e, const FrameFiles& frames, StepSource& source,
                          std::span<const Rung> rungs, double within) {
    constexpr std::size_t kAsked = 9;
    const std::size_t middle = frames.size() / 2;
    MiddleError error{{}, {}, {}, frames[middle].file, rungs.front()};
    bool isNothing = false;
    // Those before it and behind it in turn.
    for (std::size_t k = 0, asked = 0; k <= 2 * middle + 1 && asked < kAsked; ++k) {
        const std::size_t i = k % 2 == 1 ? middle - (k + 1) / 2 : middle + k / 2;
        if (i >= frames.size()) continue;
        ++asked;
        const FrameAt frame = frames[i];
        try {
            const auto step = source.get(frame.step, frames.front().step);
            if (!hasDepthError(*step)) {
                error.whyNone = step->whyNoCells();
                return error;
            }
            const DepthErrors errors = errorsOf(e, frame, *step, rungs);
            const RungError* const drawn =
                errors.rungs.empty() ? nullptr : errors.find(*errors.cheapest(within));
            if (!drawn || std::isnan(drawn->depth)) {
                isNothing = isNothing || drawn;
                continue;
            }
            return {drawn->depth, errorText(*drawn, errors.ordering), {}, frame.file, drawn->rung};
        } catch (const timeseries::FileError&) {
            // What cannot be read is told when its turn comes, after the pictures before it.
        }
    }
    const Model drawn = modelOf(e);
    if (isNothing) error.whyNone = nothingSeenText(drawn);
    if (isNothing && drawn == Model::Cells) error.whyNone += "; --model points draws the points";
    return error;
}

// What is to be drawn, and its error: all by the chosen model, unless an error is asked for. Points
// first: of a step whose cells are not wanted they are not made.
MiddleError chosenError(const RenderOptions& options, const Explorer& e, const FrameFiles& frames,
                        StepSource& source) {
    const Rung all{modelOf(e)};
    if (!options.within) return errorOfMiddle(e, frames, source, std::span(&all, 1), 1);
    const bool coarsePoints = mayBeCoarse(e.footprint);
    const auto by = [&](bool cells) {
        const auto rungs = ladder({.cells = cells, .points = !cells, .coarsePoints = coarsePoints});
        return errorOfMiddle(e, frames, source, rungs, *options.within);
    };
    MiddleError points = by(false);
    if (!points.whyNone.empty()) points.rung = all;
    const bool isEnough = points.depth && *points.depth <= *options.within;
    if (isEnough || all.model == Model::Points || !points.whyNone.empty()) return points;
    return by(true);
}

// One picture's is no other's: those of a series may differ by any factor.
void tellError(const MiddleError& error, const FrameFiles& frames, Stereo stereo) {
    const std::size_t others = frames.size() - 1;
    if (!error.whyNone.empty()) return say("  error not known: {}\n", error.whyNone);
    if (others == 0) return say("  {}\n", error.text);
    say("  {} in {}; {} not known\n", error.text, filesOf(error.of, stereo).front().string(),
        others == 1 ? "the other picture's is"
                    : fmt::format("those of the other {} pictures are", others));
}

// Writes a picture while the next one is drawn.
class WritingBeside {
 public:
    // `tell`: when the picture is in its file, on another thread. Throws what the one before threw.
    void write(DrawnStill drawn, std::function<void()> tell) {
        wait();
        written_ = std::async(std::launch::async,
                              [drawn = std::move(drawn), tell = std::move(tell)]() mutable {
                                  app::write(std::move(drawn));
                                  tell();
                              });
    }
    void wait() {
        if (written_.valid()) written_.get();
    }

 private:
    std::future<void> written_;
};

// Draws and writes every frame. What stays from one frame to the next is the step and its place on
// the GPU.
Told drawFrames(const RenderOptions& options, const Explorer& e,
                const timeseries::Variable& variable, const FrameFiles& frames,
                const MiddleError& error, StepSource& source, render::FrameRenderer& renderer) {
    std::shared_ptr<const SortedStep> shown;
    std::optional<render::PlacedPoints> placed;
    std::optional<render::GlStep> onGpu;
    Progress progress("picture", frames.size());
    Told told;
    WritingBeside files;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        progress.at(i);
        const FrameAt frame = frames[i];
        const auto step = [&] {
            try {
                return source.get(frame.step, frames[std::min(i + 1, frames.size() - 1)].step);
            } catch (const timeseries::FileError& why) {
                if (i == 0) throw;
                files.wait();
                throw timeseries::FileError(fmt::format("{}; {} of {} pictures were written before",
                                                        why.what(), i, frames.size()));
            }
        }();
        if (step != shown) {
            shown = step;
            if (i > 0) source.drop(frames[i - 1].step);
            placed.emplace(step->grid(), e.scale, e.map);
            onGpu.emplace(*step, *placed, onGpu ? onGpu->mesh() : nullptr);
        }
        const bool isOfAnother = frame.file != error.of;
        const auto nameOfFirst = [&](const std::filesystem::path& picture) {
            return filesOf(picture, e.stereo.mode).front().filename().string();
        };
        DrawnStill drawn =
            drawStill({.explorer = e,
                       .variable = variable,
                       .stepIndex = frame.step,
                       .step = *step,
                       .placed = *placed,
                       .tick = frame.tick,
                       .paths = options.portable ? Paths::Relative : Paths::Both,
                       .error = error.depth,
                       .errorOf = isOfAnother ? nameOfFirst(error.of) : "",
                       .rung = options.within ? std::optional(error.rung) : std::nullopt},
                      renderer, *onGpu,
                      {.opticalDepth = options.opticalDepth,
                       .splatCount = options.splatCount,
                       .progress = [&](double share) { progress.drawn(share); }},
                      frame.file);
        if (drawn.mixed) ++told.mixed;
        const bool isBesideClip = e.clip && !clipFlaw(*e.clip, step->grid()).empty();
        if (drawn.points == 0 || isBesideClip) ++told.empty;
        if (drawn.byGl) ++told.byGl;
        if (std::string why = whyFlat(e, step->grid(), *placed); !why.empty()) {
            ++told.flat;
            told.whyFlat = std::move(why);
        }
        files.write(std::move(drawn), [&options, i, count = frames.size()] {
            if (!options.progress) return;
            say("picture {} of {}\n", i + 1, count);
            std::fflush(stdout);  // a pipe is not flushed by itself
        });
    }
    files.wait();
    return told;
}

std::string whoDrew(const DrawingDevice& device, std::size_t byGl, std::size_t all) {
    if (byGl == all) return device.name();
    if (byGl == 0) return device.program();
    return fmt::format("{}, {} of {} pictures by {}", device.name(), all - byGl, all,
                       device.program());
}

}  // namespace

int renderHeadless(const RenderOptions& options) {
    render::PartialFile::leaveNoneWhenEnded();
    ChosenData chosen = openChosen(options.explorer);
    const Explorer& e = chosen.explorer;
    const Dataset& dataset = chosen.dataset;
    const DrawingDevice device(options.by);
    render::FrameRenderer renderer(device.splatter());
    const FrameFiles frames(options.output, e, chosen.steps, dataset.stepCount());
    makeFoldersOf(frames.output());  // before the work: what cannot be made is told at once
    const MiddleError error = chosenError(options, e, frames, *chosen.source);
    const auto [mixed, empty, byGl, flat, why] =
        drawFrames(options, e, dataset.variable, frames, error, *chosen.source, renderer);
    tellFiles(frames, dataset.variable);
    if (!dataset.series.recognised.empty()) say("  {}\n", dataset.series.recognised);
    for (const std::string& note : dataset.series.notes) say("  note: {}\n", note);
    const auto inSome = [&](std::size_t count) {
        return count == frames.size() ? ""
                                      : fmt::format(" in {} of {} pictures", count, frames.size());
    };
    if (mixed > 0)
        say("  note: colours are mixed{}: the mean optical depth is more than {}; --order depth "
            "draws what is in front over what is behind\n",
            inSome(mixed), render::kMixedDepth);
    if (const std::string hidden = whyNothing(e); !hidden.empty())
        say("  note: {}\n", hidden);
    else if (empty > 0)
        say("  note: 0 points are selected{}{}\n", e.clip ? " in the clip box" : "", inSome(empty));
    if (const std::string leftOut = frames.leftOut(); !leftOut.empty())
        say("  note: {}; --timer-steps says how many\n", leftOut);
    if (flat > 0) say("  note: what is drawn lies flat{}: {}\n", inSome(flat), why);
    for (const std::string& idle : idleChoices(options.explorer)) say("  note: {}\n", idle);
    if (options.byPointsAlone)
        say("  note: drawn by points, for --splatter exact draws no cells\n");
    tellStyle(e, dataset.variable);
    const bool isSaid = empty > 0 || !whyNothing(e).empty();
    if (!error.text.empty() || (!error.whyNone.empty() && !isSaid))
        tellError(error, frames, e.stereo.mode);
    if (options.within)
        say("  drawn: {}{}\n", error.whyNone.empty() ? rungText(error.rung) : "all",
            error.depth && *error.depth > *options.within ? ", the truest there is" : "");
    if (const auto* const sweep = sweepOf(e); sweep && !e.oneTick && sweep->frequency > 0)
        say("  {:.4g} pictures a second show it at {:g} cycles a second\n",
            static_cast<double>(frames.size()) * sweep->frequency, sweep->frequency);
    say("  drawn by {}\n", whoDrew(device, byGl, frames.size()));
    return 0;
}

}  // namespace app
