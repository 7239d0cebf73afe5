#include "app/options.h"

#include <fmt/format.h>

#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <limits>

#include "app/choice_text.h"
#include "app/session.h"

namespace app {
namespace {

using timeseries::RangeSet;

constexpr const char* kRangeHelp =
    "lo:hi, [lo,hi) with open ends, c~d for c plus or minus d, min, max; commas in one layer, "
    "repeat the option for a new layer";

constexpr const char* kFileHelp =
    "A file, any file of a numbered series, a folder, a pattern, or several files that make one "
    "series";

constexpr double kMost = std::numeric_limits<double>::max();

// CLI11's own checks let NaN pass.
CLI::Validator between(double lo, double hi) {
    return CLI::Validator(
        [=](std::string& text) -> std::string {
            double value = 0;
            const bool isNumber = CLI::detail::lexical_cast(text, value);
            if (isNumber && value >= lo && value <= hi) return {};
            return hi == kMost ? fmt::format("'{}' is not a finite number of at least {}", text, lo)
                               : fmt::format("'{}' is not a number from {} to {}", text, lo, hi);
        },
        hi == kMost ? fmt::format("at least {}", lo) : fmt::format("{} to {}", lo, hi));
}

CLI::Validator notEmpty() {
    return CLI::Validator(
        [](std::string& text) { return std::string(text.empty() ? "is an empty text" : ""); }, "");
}

// What CLI11 collects for `render`, as text, before it becomes an Explorer.
struct RenderText {
    std::vector<std::string> files, ranges, colors, colormaps, channels;
    std::vector<double> opacities;
    std::string session, variable, steps, keep, splat, order, sweep, clip, scale, view, size,
        stereo;
    std::string output, device = "any";
    double splatSize = 1, delta = 0, frequency = 0.1, eyeDistance = 0, convergence = 0;
    std::int64_t timerSteps = 256, timerStep = 1;
    bool swing = false;
};

void addInfo(CLI::App& app, InfoOptions& into) {
    app.add_option("FILE", into.files, kFileHelp)->check(notEmpty())->required();
    app.add_flag("--json", into.json, "Machine-readable");
}

struct CountText {
    std::vector<std::string> files, ranges;
    std::string variable, keep, steps = "all";
    bool json = false;
};

void addCount(CLI::App& app, CountText& into) {
    app.add_option("FILE", into.files, kFileHelp)->check(notEmpty())->required();
    app.add_option("--variable", into.variable, "Which variable; the file's first without it");
    app.add_option("--range", into.ranges, kRangeHelp)->required()->allow_extra_args(false);
    app.add_option("--keep", into.keep, "Values to keep when the sorted list is built");
    app.add_option("--step", into.steps, "A step counted from 0, A:B, or all (the default)");
    app.add_flag("--json", into.json, "Machine-readable");
}

void addRender(CLI::App& app, RenderText& into) {
    app.add_option("FILE", into.files, kFileHelp)->check(notEmpty());
    app.add_option("--session", into.session, "A session file; options given beside it win");
    app.add_option("--variable", into.variable, "Which variable; the file's first without it");
    app.add_option("--step", into.steps,
                   "A step counted from 0, A:B, or all; the middle one without it");
    app.add_option("--range", into.ranges, kRangeHelp)->allow_extra_args(false);
    app.add_option("--keep", into.keep, "Values to keep when the sorted list is built");
    app.add_option("--color", into.colors, "#rrggbb of the next layer")->allow_extra_args(false);
    app.add_option("--colormap", into.colormaps,
                   "Colour by value of the next layer: " +
                       fmt::format("{}", fmt::join(render::colorMapNames(), ", ")))
        ->allow_extra_args(false);
    app.add_option("--opacity", into.opacities,
                   "Of one cell of fully selected points, per layer, 0 to 1")
        ->allow_extra_args(false)
        ->check(between(0, 1));
    app.add_option("--splat", into.splat, "kernel (default) or point");
    app.add_option("--splat-size", into.splatSize,
                   "kernel: times the radius that suits the spacing; point: pixels")
        ->check(between(1e-3, 1e3));
    app.add_option("--order", into.order,
                   "none (default), or depth: back to front, true occlusion");
    app.add_option("--sweep", into.sweep, "Animate a window of values through these ranges");
    app.add_option("--delta", into.delta, "Half the swept window's width")
        ->check(between(0, kMost));
    app.add_option("--timer-steps", into.timerSteps, "Timer counts in a cycle (256)")
        ->check(CLI::Range(1, 1 << 30));
    app.add_option("--timer-step", into.timerStep, "The timer counts by this many (1)")
        ->check(CLI::Range(1, 1 << 30));
    app.add_option("--frequency", into.frequency, "Cycles a second (0.1)")
        ->check(between(0, kMost));
    app.add_flag("--swing", into.swing, "There and back on a cosine, instead of a loop");
    app.add_option("--clip", into.clip, "x0:x1,y0:y1,z0:z1 in the file's coordinates");
    app.add_option("--scale", into.scale, "x,y,z: stretch of the axes");
    app.add_option("--view", into.view,
                   "AZIMUTH,ELEVATION[,DISTANCE]: degrees, and half diagonals");
    app.add_option("--size", into.size, "WxH in pixels (1200x900)");
    app.add_option("--stereo", into.stereo,
                   "off, side-by-side, top-bottom, multiview (one EXR), left-right (two files)");
    app.add_option("--eye-distance", into.eyeDistance, "In half diagonals of the box")
        ->check(between(0, kFarthest));
    app.add_option("--convergence", into.convergence, "Distance of zero parallax, likewise")
        ->check(between(kNearest, kFarthest));
    app.add_option("--channel", into.channels, "A further EXR channel: opticalDepth, splatCount")
        ->allow_extra_args(false)
        ->check(CLI::IsMember({"opticalDepth", "splatCount"}));
    app.add_option("--device", into.device, "any (default), gpu or cpu")
        ->check(CLI::IsMember({"any", "gpu", "cpu"}));
    app.add_option("-o,--output", into.output, "OUT.png or OUT.exr")->required();
}

bool given(const CLI::App& app, const char* option) { return app.count(option) > 0; }

// Colours and maps share one row of layers, in the order in which they were written.
std::vector<std::variant<glm::dvec3, MapChoice>> colorsInOrder(const CLI::App& app,
                                                               const RenderText& text) {
    std::vector<std::variant<glm::dvec3, MapChoice>> colors;
    std::size_t color = 0, map = 0;
    for (const CLI::Option* option : app.parse_order()) {
        if (option == app.get_option("--color"))
            colors.emplace_back(parseColor(text.colors[color++]));
        if (option == app.get_option("--colormap"))
            colors.emplace_back(MapChoice{parseColorMap(text.colormaps[map++]), {}, {}});
    }
    return colors;
}

// The layers that have a style of their own: the swept one first, then the ranges'.
void applyLayers(const CLI::App& app, const RenderText& text, Explorer& e) {
    if (given(app, "--range")) {
        e.layers.clear();
        for (const std::string& range : text.ranges)
            e.layers.push_back({RangeSet::parse(range), {}, {}});
    }
    std::vector<LayerChoice*> layers;
    if (e.sweep) layers.push_back(&e.sweepLayer);
    for (LayerChoice& layer : e.layers) layers.push_back(&layer);
    const auto colors = colorsInOrder(app, text);
    const std::size_t styles = std::max(colors.size(), text.opacities.size());
    if (layers.empty() && styles == 1) {
        // A style for the first choice, whose range is not known yet.
        e.layers.push_back({RangeSet(), {}, {}});
        layers.push_back(&e.layers.back());
    }
    if (styles > layers.size())
        throw ChoiceError(
            fmt::format("{} colours or opacities for {} layers: give a --range for each", styles,
                        layers.size()));
    for (std::size_t i = 0; i < colors.size(); ++i) layers[i]->color = colors[i];
    for (std::size_t i = 0; i < text.opacities.size(); ++i) layers[i]->opacity = text.opacities[i];
    if (layers.size() > render::kMaxLayers)
        throw ChoiceError(fmt::format("{} layers are more than the {} that are drawn at once",
                                      layers.size(), render::kMaxLayers));
}

void applySweep(const CLI::App& app, const RenderText& text, Explorer& e) {
    if (given(app, "--sweep")) {
        e.sweep.emplace();
        e.sweep->path = timeseries::SweepPath::Loop;
        e.sweep->animation = RangeSet::parse(text.sweep);
    }
    for (const char* option :
         {"--delta", "--timer-steps", "--timer-step", "--frequency", "--swing"})
        if (given(app, option) && !e.sweep)
            throw ChoiceError(fmt::format("{} needs --sweep beside it", option));
    if (given(app, "--delta")) e.sweep->delta = text.delta;
    if (given(app, "--timer-steps")) e.sweep->timerSteps = text.timerSteps;
    if (given(app, "--timer-step")) e.sweep->step = text.timerStep;
    if (given(app, "--frequency")) e.sweep->frequency = text.frequency;
    if (text.swing) e.sweep->path = timeseries::SweepPath::Swing;
}

bool isExr(const std::filesystem::path& file) { return file.extension() == ".exr"; }

void checkOutput(const RenderOptions& options) {
    const auto extension = options.output.extension();
    if (extension != ".png" && extension != ".exr")
        throw ChoiceError(
            fmt::format("output '{}' ends neither in .png nor in .exr", options.output.string()));
    if (options.explorer.stereo.mode == Stereo::MultiView && !isExr(options.output))
        throw ChoiceError("stereo multiview needs an output that ends in .exr");
    if ((options.opticalDepth || options.splatCount) && !isExr(options.output))
        throw ChoiceError("--channel needs an output that ends in .exr");
    const Stereo mode = options.explorer.stereo.mode;
    if ((options.opticalDepth || options.splatCount) &&
        (mode == Stereo::SideBySide || mode == Stereo::TopBottom))
        throw ChoiceError("--channel goes with stereo off, multiview or left-right");
}

RenderOptions renderOptions(const CLI::App& app, const RenderText& text) {
    RenderOptions options;
    Explorer& e = options.explorer;
    if (!text.session.empty()) e = readSession(text.session);
    if (!text.files.empty()) e.files.assign(text.files.begin(), text.files.end());
    if (e.files.empty()) throw ChoiceError("render needs a FILE or a --session that names one");
    if (given(app, "--variable")) e.variable = text.variable;
    if (given(app, "--step")) e.steps = parseSteps(text.steps);
    if (given(app, "--keep")) e.keep = RangeSet::parse(text.keep);
    applySweep(app, text, e);
    applyLayers(app, text, e);
    if (given(app, "--splat")) e.footprint.kernel = parseKernel(text.splat);
    if (given(app, "--splat-size")) e.footprint.size = text.splatSize;
    if (given(app, "--order")) e.order = parseOrder(text.order);
    if (given(app, "--clip")) e.clip = parseClip(text.clip);
    if (given(app, "--scale")) e.scale = parseScale(text.scale);
    if (given(app, "--view")) e.view = parseView(text.view);
    if (given(app, "--size")) e.size = parseSize(text.size);
    if (given(app, "--stereo")) e.stereo.mode = parseStereo(text.stereo);
    if (given(app, "--eye-distance")) e.stereo.eyeDistance = text.eyeDistance;
    if (given(app, "--convergence")) e.stereo.convergence = text.convergence;
    for (const std::string& channel : text.channels)
        (channel == "opticalDepth" ? options.opticalDepth : options.splatCount) = true;
    options.output = text.output;
    options.device = text.device;
    checkOutput(options);
    return options;
}

CountOptions countOptions(const CLI::App& app, const CountText& text) {
    CountOptions options;
    options.files.assign(text.files.begin(), text.files.end());
    options.variable = text.variable;
    for (const std::string& range : text.ranges) options.ranges.push_back(RangeSet::parse(range));
    if (given(app, "--keep")) options.keep = RangeSet::parse(text.keep);
    options.steps = parseSteps(text.steps);
    options.json = text.json;
    return options;
}

constexpr const char* kFooter = R"(
Ranges: 600:1600 (closed), [600,1600) (open end), 850~50 (800 to 900), min:300, 900:max.
Commas keep one layer together: 300:400,900:max. A repeated --range is a new layer.
Exit codes: 0 done, 1 a file or the machine failed, 2 the arguments are wrong.)";

}  // namespace

Command parse(std::span<const char* const> arguments) {
    CLI::App app{"isochron: explore time-varying 3D scalar fields by value and by time",
                 "isochron"};
    app.footer(kFooter);
    app.require_subcommand(1);
    InfoOptions info;
    CountText countText;
    RenderText renderText;
    CLI::App* infoApp =
        app.add_subcommand("info", "What a file holds: grid, variables, time steps");
    CLI::App* countApp =
        app.add_subcommand("count", "How many points of each step lie in value ranges");
    CLI::App* renderApp =
        app.add_subcommand("render", "Pictures of value ranges, without a window");
    addInfo(*infoApp, info);
    addCount(*countApp, countText);
    addRender(*renderApp, renderText);
    for (CLI::App* each : {infoApp, countApp, renderApp}) each->footer(kFooter);
    try {
        // CLI11 takes them last first.
        app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
        if (*infoApp) return info;
        if (*countApp) return countOptions(*countApp, countText);
        return renderOptions(*renderApp, renderText);
    } catch (const CLI::CallForHelp&) {
        return Exit{0, app.help()};  // of the command, where one was given
    } catch (const CLI::ParseError& error) {
        if (arguments.empty())
            return Exit{2, "expected a command: info, count or render (see isochron --help)"};
        if (app.get_subcommands().empty())
            return Exit{2, fmt::format("'{}' is no command: expected info, count or render (see "
                                       "isochron --help)",
                                       arguments.front())};
        return Exit{2, fmt::format("{} (see isochron --help)", error.what())};
    } catch (const std::invalid_argument& error) {
        return Exit{2, error.what()};
    }
}

}  // namespace app
