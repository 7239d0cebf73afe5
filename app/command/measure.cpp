// `isochron measure`: one step drawn in every way; times and errors out.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/choices/choice_text.h"
#include "app/choices/user_files.h"
#include "app/command/commands.h"
#include "app/command/drawing_device.h"
#include "app/exploration/chosen_data.h"
#include "app/files/progress.h"
#include "app/json_text.h"
#include "app/measure/measurement.h"
#include "app/measure/plot_picture.h"
#include "app/measure/plot_svg.h"
#include "app/measure/report.h"
#include "app/measure/trade_plot.h"
#include "app/picture/picture.h"
#include "app/picture/range_label.h"
#include "app/say.h"
#include "render/image/png.h"
#include "render/together.h"

namespace app {
namespace {

using nlohmann::ordered_json;

// The ranges drawn, with their unit: "600 to 1000 K; 320 to 400 K".
std::string rangesText(const ChosenData& data, const timeseries::SortedStep& step) {
    const Explorer& e = data.explorer;
    std::string text;
    for (const LayerChoice& layer : e.layers)
        if (layer.visible)
            text += (text.empty() ? "" : "; ") +
                    rangeLabel(rangesAt(layer, step, e.play.tick), data.dataset.variable.units);
    return text;
}

// What the figures are of.
struct Subject {
    const MeasureOptions& options;
    const ChosenData& data;
    const timeseries::SortedStep& step;
    std::size_t stepIndex;
    std::string drawnBy;
    std::uint64_t selected;

    std::string title() const {
        const timeseries::Variable& variable = data.dataset.variable;
        const std::string time = variable.time->points.size() > 1
                                     ? fmt::format(", {}", timeText(*variable.time, stepIndex))
                                     : "";
        return fmt::format("{}: {}{}, {}", data.explorer.files.front().filename().string(),
                           variable.name, time, rangesText(data, step));
    }
};

std::string truthText(const MeasureOptions& options) {
    return fmt::format(
        "the {1} of the field interpolated between its points, exactly, mean of {0} x {0} rays a "
        "pixel{2}",
        options.rays,
        options.explorer.opacityPer == render::OpacityPer::Length ? "lengths" : "crossings",
        options.explorer.light == render::Light::Off ? "" : "; of lit cells lit as they are");
}

constexpr const char* kNothing =
    "no point is in a range that is shown: there was nothing to measure";

ordered_json json(const Subject& subject, const std::vector<Measured>& modes) {
    const MeasureOptions& options = subject.options;
    const Explorer& e = subject.data.explorer;
    ordered_json out{
        {"file", subject.data.dataset.name},
        {"variable", subject.data.dataset.variable.name},
        {"units", subject.data.dataset.variable.units},
        {"step", subject.stepIndex},
        {"ranges", rangesText(subject.data, subject.step)},
        {"points", subject.step.statistics().points},
        {"size", {e.size.x, e.size.y}},
        {"frames", options.frames},
        {"rays", options.rays},
        {"drawnBy", subject.drawnBy},
        {"threads", render::sharingThreads()},
        {"truth", truthText(options)},
        {"notes", subject.selected == 0 ? ordered_json{kNothing} : ordered_json::array()},
        {"views", ordered_json::array()},
        {"modes", ordered_json::array()}};
    for (const ViewChoice& view : viewsAbout(e.view, options.views))
        out["views"].push_back(
            {{"azimuth", view.azimuthDegrees}, {"elevation", view.elevationDegrees}});
    for (const Measured& m : modes) out["modes"].push_back(json(m));
    out["best"] = bestJson(modes);
    return out;
}

void print(const Subject& subject, const std::vector<Measured>& modes) {
    const MeasureOptions& options = subject.options;
    const Explorer& e = subject.data.explorer;
    say("{}\n{} x {} pixels, {} view{}, {} frames of each, drawn by {}\ntruth: {}\n\n{}{}",
        subject.title(), e.size.x, e.size.y, options.views, options.views == 1 ? "" : "s",
        options.frames, subject.drawnBy, truthText(options), table(modes), bestTable(modes));
    if (subject.selected == 0) say("note: {}\n", kNothing);
}

// Throws ChoiceError where what is measured would be written over.
void keepData(const MeasureOptions& options) {
    for (const std::filesystem::path& out : {options.csv, options.svg, options.png})
        for (const std::filesystem::path& file : options.explorer.files) {
            std::error_code none;
            if (std::filesystem::equivalent(out, file, none))
                throw ChoiceError(
                    fmt::format("{}: expected another file to write to, for this one is measured",
                                out.string()));
        }
}

// Before anything is measured, so that what cannot be made is told at once.
void makeFolders(const MeasureOptions& options) {
    for (const std::filesystem::path& out : {options.csv, options.svg, options.png})
        makeFoldersOf(out);
}

void writeFiles(const MeasureOptions& options, const std::vector<Measured>& modes,
                const std::string& title) {
    if (!options.csv.empty()) writeWhole(options.csv, csv(modes));
    if (options.svg.empty() && options.png.empty()) return;
    const Plot plot = tradePlot(modes, title);
    if (!options.svg.empty()) writeWhole(options.svg, plotSvg(plot));
    if (options.png.empty()) return;
    render::writePng(options.png, plotPicture(plot));
}

}  // namespace

int measureModes(const MeasureOptions& options) {
    keepData(options);
    // An unknown one is refused before a file is read.
    modesNamed(options.modes,
               {true, mayBeCoarse(options.explorer.footprint), options.explorer.light});
    ChosenData data = openChosen(options.explorer);
    if (data.steps.size() != 1)
        throw ChoiceError(fmt::format("measure draws one step, not {}: name it, --step {}",
                                      data.steps.size(), data.steps.front()));
    const std::size_t index = data.steps.front();
    const auto step = data.source->get(index, index);
    if (!step->canHaveCells())
        throw ChoiceError(
            fmt::format("measure needs the cells between the points: {}", step->whyNoCells()));
    makeFolders(options);
    std::uint64_t selected = 0;
    for (const LayerChoice& layer : data.explorer.layers)
        if (layer.visible)
            selected +=
                step->count(step->keptPart(layer.motion ? layer.motion->animation : layer.ranges));
    const DrawingDevice device(options.by);
    const Subject subject{options, data, *step, index, device.name(), selected};
    const render::PlacedPoints placed(step->grid(), data.explorer.scale, data.explorer.map);
    std::vector<Measured> modes;
    {
        const Progress progress("mode", 1);
        modes = measure(data.explorer, *step, placed,
                        {.views = options.views,
                         .frames = options.frames,
                         .raysAcross = options.rays,
                         .modes = options.modes,
                         .splatter = device.splatter()},
                        [&](double share) { progress.drawn(share); });
    }
    if (options.json)
        say("{}\n", jsonText(json(subject, modes), 2));
    else
        print(subject, modes);
    writeFiles(options, modes, subject.title());
    return 0;
}

}  // namespace app
