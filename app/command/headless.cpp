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
#include "app/command/frame_errors.h"
#include "app/exploration/chosen_data.h"
#include "app/files/dataset.h"
#include "app/files/frame_files.h"
#include "app/files/picture_files.h"
#include "app/files/progress.h"
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
                const timeseries::Variable& variable, const FrameFiles& frames, FrameErrors& errors,
                StepSource& source, render::FrameRenderer& renderer) {
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
        const FrameError& error = errors.of(frame, *step);
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
    FrameErrors errors(options, e, frames, *chosen.source);
    const auto [mixed, empty, byGl, flat, why] =
        drawFrames(options, e, dataset.variable, frames, errors, *chosen.source, renderer);
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
    tellStyle(e, dataset.variable);
    errors.tell(empty > 0 || !whyNothing(e).empty());
    if (const auto* const sweep = sweepOf(e); sweep && !e.oneTick && sweep->frequency > 0)
        say("  {:.4g} pictures a second show it at {:g} cycles a second\n",
            static_cast<double>(frames.size()) * sweep->frequency, sweep->frequency);
    say("  drawn by {}\n", whoDrew(device, byGl, frames.size()));
    return 0;
}

}  // namespace app
