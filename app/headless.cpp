// `isochron render`: steps in, picture files out; no window.
#include <fmt/format.h>

#include "app/choice_text.h"
#include "app/commands.h"
#include "app/dataset.h"
#include "app/picture.h"
#include "app/picture_files.h"
#include "app/progress.h"
#include "app/step_source.h"
#include "app/still.h"
#include "render/gl/headless_context.h"

namespace app {
namespace {

namespace fs = std::filesystem;
using timeseries::SortedStep;

struct FrameAt {
    std::size_t step;
    std::int64_t tick;
    fs::path file;
};

// A frame a step; with a sweep a frame a tick of one cycle, over which the steps pass once. Told
// one by one: a cycle may have 2^30 ticks.
class Frames {
 public:
    Frames(fs::path output, const Explorer& e, std::vector<std::size_t> steps)
        : output_(std::move(output)), steps_(std::move(steps)), swept_(e.sweep.has_value()) {
        count_ = swept_ ? static_cast<std::size_t>(timeseries::ValueSweep(*e.sweep).ticksPerCycle())
                        : steps_.size();
        digits_ = std::to_string(swept_ ? count_ - 1 : steps_.back()).size();
    }
    std::size_t size() const { return count_; }
    FrameAt operator[](std::size_t i) const {
        const std::size_t step = swept_ ? steps_[i * steps_.size() / count_] : steps_[i];
        fs::path file = output_;
        if (count_ > 1)
            file.replace_filename(fmt::format("{}_{:0{}}{}", file.stem().string(),
                                              swept_ ? i : step, digits_,
                                              file.extension().string()));
        return {step, swept_ ? static_cast<std::int64_t>(i) : 0, file};
    }
    FrameAt front() const { return (*this)[0]; }
    FrameAt back() const { return (*this)[count_ - 1]; }

 private:
    fs::path output_;
    std::vector<std::size_t> steps_;
    bool swept_;
    std::size_t count_ = 0, digits_ = 0;
};

// First, middle and last of the chosen steps.
Steps sample(StepSource& source, const std::vector<std::size_t>& steps) {
    Steps sampled;
    for (const std::size_t step : {steps.front(), steps[steps.size() / 2], steps.back()})
        sampled[step] = source.get(step, step);
    return sampled;
}

void tellStyle(const Explorer& e, const timeseries::Variable& about) {
    const auto tell = [&](const timeseries::RangeSet& ranges, const LayerChoice& layer) {
        if (!layer.visible) return;
        std::string color;
        if (const auto* rgb = std::get_if<glm::dvec3>(&*layer.color)) {
            color = colorText(*rgb);
        } else {
            const auto& map = std::get<MapChoice>(*layer.color);
            color = fmt::format("{} from {:g} to {:g}", map.map.name(), *map.lo, *map.hi);
        }
        fmt::print("  {}: {}, opacity {:.2g}\n", rangeLabel(ranges, about.units), color,
                   *layer.opacity);
    };
    if (e.sweep) tell(e.sweep->animation, e.sweepLayer);
    for (const LayerChoice& layer : e.layers) tell(layer.ranges, layer);
}

void tellFiles(const Frames& frames, Stereo stereo, const timeseries::Variable& about) {
    const fs::path first = filesOf(frames.front().file, stereo).front();
    const fs::path last = filesOf(frames.back().file, stereo).back();
    const std::string from = timeText(*about.time, frames.front().step);
    if (frames.size() == 1) {
        fmt::print("{}{}: {}, {}\n", first.string(),
                   first == last ? "" : " and " + last.filename().string(), about.name, from);
    } else {
        fmt::print("{} to {}: {}, {} to {}\n", first.string(), last.filename().string(), about.name,
                   from, timeText(*about.time, frames.back().step));
    }
}

// Draws and writes every frame. What stays from one frame to the next is the step and its place on
// the GPU.
void drawFrames(const RenderOptions& options, const Explorer& e, const timeseries::Variable& about,
                const Frames& frames, StepSource& source) {
    render::FrameRenderer renderer;
    std::shared_ptr<const SortedStep> shown;
    std::optional<render::Lattice> lattice;
    std::optional<render::GpuStep> onGpu;
    const Progress progress("picture", frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        progress.at(i);
        const FrameAt frame = frames[i];
        const auto step = source.get(frame.step, frames[std::min(i + 1, frames.size() - 1)].step);
        if (step != shown) {
            shown = step;
            lattice.emplace(step->grid(), e.scale);
            onGpu.emplace(*step, *lattice);
        }
        writeStill({e, about, frame.step, *step, *lattice, frame.tick}, renderer, *onGpu,
                   {.opticalDepth = options.opticalDepth, .splatCount = options.splatCount},
                   frame.file);
        if (!options.progress) continue;
        fmt::print("picture {} of {}\n", i + 1, frames.size());
        std::fflush(stdout);  // a pipe is not flushed by itself
    }
}

}  // namespace

int renderHeadless(const RenderOptions& options) {
    Explorer e = options.explorer;
    Dataset dataset = openDataset(e.files, e.variable);
    e.variable = dataset.about.name;
    if (!e.steps) e.steps = StepChoice{dataset.defaultStep, dataset.defaultStep};
    const auto steps = stepsOf(dataset, *e.steps);
    StepSource source(dataset, e.keep.value_or(timeseries::RangeSet::everything()));
    if (needsSamples(e)) e = resolved(e, sample(source, steps));
    const render::gl::HeadlessContext context(options.device);
    const Frames frames(options.output, e, steps);
    drawFrames(options, e, dataset.about, frames, source);
    tellFiles(frames, e.stereo.mode, dataset.about);
    if (!dataset.series.recognised.empty()) fmt::print("  {}\n", dataset.series.recognised);
    for (const std::string& note : dataset.series.notes) fmt::print("  note: {}\n", note);
    tellStyle(e, dataset.about);
    if (e.sweep && e.sweep->frequency > 0)
        fmt::print("  {:.4g} pictures a second show it at {:g} cycles a second\n",
                   static_cast<double>(frames.size()) * e.sweep->frequency, e.sweep->frequency);
    fmt::print("  drawn by {}\n", context.renderer());
    return 0;
}

}  // namespace app
