#include "app/choices/options.h"

#include <fmt/format.h>

#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <map>

#include "app/choices/choice_text.h"
#include "app/choices/choices.h"
#include "app/choices/common_options.h"
#include "app/choices/explorer_options.h"
#include "app/choices/option_checks.h"
#include "app/choices/parse_error.h"
#include "render/image/picture_file.h"

namespace app {
namespace {

using timeseries::RangeSet;

constexpr std::array<std::string_view, 7> kCommands = {"view",  "render", "measure", "info",
                                                       "count", "index",  "cache"};

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
    app.add_option("--variable", into.variable, choiceOf("--variable").help)->check(notEmpty());
    app.add_option("--range", into.ranges, kRangeHelp)->required()->allow_extra_args(false);
    app.add_option("--keep", into.keep, choiceOf("--keep").help);
    app.add_option("--step", into.steps,
                   "A step counted from 0, A:B, A:B:S for every S-th, or all (the default)");
    app.add_flag("--json", into.json, "Machine-readable");
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

// Who draws, and on what.
struct DrawnByText {
    std::string device = "any", splatter = "any";
};

void addDrawnBy(CLI::App& app, DrawnByText& into, std::vector<std::string> splatters) {
    app.add_option("--device", into.device, "any (default), gpu or cpu")
        ->check(oneOf({"any", "gpu", "cpu"}));
    const bool exact = std::ranges::find(splatters, "exact") != splatters.end();
    app.add_option("--splatter", into.splatter,
                   fmt::format("Who sums splats: any (default: gl on a GPU, else cpu), {}",
                               exact ? "gl, cpu, or exact: the truth, slowly" : "gl or cpu"))
        ->check(oneOf(std::move(splatters)));
}

DrawnBy drawnBy(const DrawnByText& text) {
    using Choice = render::SplatterChoice;
    const std::map<std::string, Choice> choices{{"any", Choice::ByDevice},
                                                {"gl", Choice::Gl},
                                                {"cpu", Choice::Cpu},
                                                {"exact", Choice::Exact}};
    return {text.device, choices.at(text.splatter)};
}

// What `render` takes beside the choices of a picture.
struct OutputText {
    std::vector<std::string> channels;
    std::string output;
    DrawnByText by;
    bool portable = false, progress = false;
    std::optional<double> within = {};
    bool eachError = false;
};

void addOutput(CLI::App& app, OutputText& into) {
    app.add_option("--channel", into.channels, "A further EXR channel: opticalDepth, splatCount")
        ->allow_extra_args(false)
        ->check(oneOf({"opticalDepth", "splatCount"}));
    app.add_flag("--portable", into.portable,
                 "The picture's session keeps no absolute path: for pictures that are published");
    app.add_flag("--progress", into.progress, "Print 'picture I of N' after each picture");
    app.add_option(
        "--within", into.within,
        "Draw as little as keeps the error of optical depth within this (0.05: 5 %): all "
        "or some of the points, or cells, in the picture's pixels or in coarse ones. "
        "Without it all is drawn, as well as can be");
    app.add_flag("--each-error", into.eachError,
                 "Of several pictures each has its own error worked out, not the middle one's");
    addDrawnBy(app, into.by, {"any", "gl", "cpu", "exact"});
    app.add_option("-o,--output", into.output, "OUT.png or OUT.exr")->required();
}

void checkOutput(const RenderOptions& options) {
    const bool isExr = render::isExr(options.output);
    if (!isExr && !render::isPng(options.output))
        throw ChoiceError(
            fmt::format("output '{}' ends neither in .png nor in .exr", options.output.string()));
    if (options.explorer.stereo.mode == Stereo::MultiView && !isExr)
        throw ChoiceError("stereo multiview needs an output that ends in .exr");
    if ((options.opticalDepth || options.splatCount) && !isExr)
        throw ChoiceError("--channel needs an output that ends in .exr");
    const Stereo mode = options.explorer.stereo.mode;
    if ((options.opticalDepth || options.splatCount) &&
        (mode == Stereo::SideBySide || mode == Stereo::TopBottom))
        throw ChoiceError("--channel goes with stereo off, multiview or left-right");
}

RenderOptions renderOptions(Explorer explorer, const OutputText& text) {
    RenderOptions options;
    options.explorer = std::move(explorer);
    if (options.explorer.files.empty())
        throw ChoiceError("render needs a FILE or a --session that names one");
    for (const std::string& channel : text.channels)
        (channel == "opticalDepth" ? options.opticalDepth : options.splatCount) = true;
    options.output = text.output;
    options.by = drawnBy(text.by);
    options.portable = text.portable;
    options.progress = text.progress;
    options.within = text.within;
    options.errorOfEach = text.eachError;
    if (options.within && !(*options.within >= 1e-4 && *options.within <= 1))
        throw ChoiceError("--within takes an error of 0.0001 to 1");
    if (options.within && options.by.splatter == render::SplatterChoice::Exact)
        throw ChoiceError("--splatter exact draws all there is: leave --within out");
    if (options.by.splatter == render::SplatterChoice::Exact && mixesModels(options.explorer))
        throw ChoiceError("--splatter exact draws all layers by cells, or all by points");
    checkOutput(options);
    return options;
}

struct IndexText {
    std::vector<std::string> files, variables;
    std::string steps = "all";
    unsigned jobs = 1;
    bool beside = false, check = false;
};

void addIndex(CLI::App& app, IndexText& into) {
    app.add_option("FILE", into.files, kFileHelp)->check(notEmpty())->required();
    app.add_option("--variable", into.variables,
                   "Its name; repeated, several; without it the one that is shown first")
        ->allow_extra_args(false);
    app.add_option("--step", into.steps,
                   "A step counted from 0, A:B, A:B:S for every S-th, or all (the default)");
    app.add_option("--jobs", into.jobs, "Steps sorted at a time, 1 by default; not by mpirun")
        ->check(wholeBetween(1, 64));
    app.add_flag("--beside", into.beside,
                 "Into a folder beside the files, isochron-index, instead of the cache");
    app.add_flag("--check", into.check,
                 "FILE is an index: reads all of it, and tells what is damaged")
        ->excludes("--variable", "--step", "--beside");
}

IndexOptions indexOptions(const IndexText& text) {
    IndexOptions options;
    options.files.assign(text.files.begin(), text.files.end());
    options.variables = text.variables;
    options.steps = parseSteps(text.steps);
    options.jobs = text.jobs;
    options.beside = text.beside;
    options.check = text.check;
    return options;
}

// What `measure` takes beside the choices of a picture.
struct MeasureText {
    unsigned views = 3, frames = 5, rays = 5;
    std::vector<std::string> modes;
    DrawnByText by;
    bool json = false;
    std::string csv, svg, png;
};

void addMeasure(CLI::App& app, MeasureText& into) {
    app.add_option("--views", into.views,
                   "From how many sides: the view chosen, and others turned about it; 3 by default")
        ->check(wholeBetween(1, 64));
    app.add_option("--frames", into.frames, "Timed of each view; 5 by default")
        ->check(wholeBetween(3, 1000));
    app.add_option("--rays", into.rays,
                   "The truth is the mean of so many rays across and down a pixel; 5 by default")
        ->check(wholeBetween(1, 32));
    app.add_option("--modes", into.modes,
                   "Ways to draw, by the names that the table has, separated by commas; all by "
                   "default")
        ->delimiter(',')
        ->allow_extra_args(false);
    addDrawnBy(app, into.by, {"any", "gl", "cpu"});
    app.add_flag("--json", into.json, "Machine-readable");
    app.add_option("--csv", into.csv, "Writes the table into a file");
    app.add_option("--svg", into.svg, "Writes a plot of error against time into a file");
    app.add_option("--png", into.png, "Writes the same plot as a picture");
}

MeasureOptions measureOptions(Explorer explorer, const MeasureText& text) {
    MeasureOptions options;
    options.explorer = std::move(explorer);
    const Explorer& e = options.explorer;
    if (e.files.empty()) throw ChoiceError("measure needs a FILE or a --session that names one");
    if (e.stereo.mode != Stereo::Off)
        throw ChoiceError("measure looks with one eye: leave --stereo out");
    if (e.keep) throw ChoiceError("measure needs every value: leave --keep out");
    options.views = text.views;
    options.frames = text.frames;
    options.rays = text.rays;
    options.modes = text.modes;
    options.by = drawnBy(text.by);
    options.json = text.json;
    options.csv = text.csv;
    options.svg = text.svg;
    options.png = text.png;
    return options;
}

// What `view` takes beside the choices of a picture. Headless, it is `render`.
struct DisplayText {
    std::string display = "auto", output;
};

void addDisplay(CLI::App& app, DisplayText& into) {
    app.add_option("--display", into.display,
                   "auto (default: a headset where one answers, else a window), desktop, headset "
                   "(or nothing), or headless, which draws a picture into -o")
        ->check(oneOf({"auto", "desktop", "headset", "headless"}));
    app.add_option("-o,--output", into.output, "OUT.png or OUT.exr, with --display headless");
}

RenderOptions headlessOptions(Explorer explorer, const DisplayText& text) {
    if (text.output.empty()) throw ChoiceError("--display headless needs -o OUT.png beside it");
    return renderOptions(std::move(explorer), {.channels = {}, .output = text.output, .by = {}});
}

ViewOptions viewOptions(Explorer explorer, const DisplayText& text) {
    if (!text.output.empty()) throw ChoiceError("-o needs --display headless beside it");
    ViewOptions options;
    options.explorer = std::move(explorer);
    if (text.display == "desktop") options.display = Display::Desktop;
    if (text.display == "headset") options.display = Display::Headset;
    return options;
}

constexpr const char* kFooter = R"(
Ranges: 600:1600 (closed), [600,1600) (open end), 850~50 (800 to 900), min:300, 900:max.
Commas keep one layer together: 300:400,900:max. A repeated --range is a new layer.
Without a command, `isochron FILE` is `isochron view FILE`.
Exit codes: 0 done, 1 a file or the machine failed, 2 the arguments are wrong.)";

// The arguments with their command: without one, a file is viewed.
std::vector<std::string> withCommand(std::span<const char* const> arguments) {
    std::vector<std::string> all(arguments.begin(), arguments.end());
    const bool isFile = all.empty() || (!all.front().starts_with('-') && !isCommand(all.front()));
    if (isFile) all.insert(all.begin(), "view");
    return all;
}

std::string notACommand(std::string_view word) {
    return fmt::format("'{}' is neither a file nor a command: expected {} (see isochron --help)",
                       word, fmt::join(kCommands, ", "));
}

// A word that is no file, before others: a command that was mistyped.
bool isMistyped(std::span<const char* const> arguments) {
    if (arguments.size() < 2) return false;
    const std::string_view word = arguments.front();
    const auto isLetter = [](char c) { return c >= 'a' && c <= 'z'; };
    return std::ranges::all_of(word, isLetter) && !isCommand(word) &&
           !std::filesystem::exists(word);
}

}  // namespace

CommonOptions commonOf(const Command& command) {
    return std::visit(
        []<typename Options>(const Options& options) -> CommonOptions {
            if constexpr (std::is_base_of_v<CommonOptions, Options>)
                return options;
            else
                return {};
        },
        command);
}

bool isCommand(std::string_view argument) {
    return std::ranges::find(kCommands, argument) != kCommands.end();
}

Command parse(std::span<const char* const> arguments) {
    CLI::App app{"isochron: explore time-varying 3D scalar fields by value and by time",
                 "isochron"};
    app.footer(kFooter);
    app.set_version_flag("--version", "isochron " ISOCHRON_VERSION);
    app.require_subcommand(1);
    InfoOptions info;
    CountText countText;
    ExplorerOptions renderText, viewText;
    OutputText outputText;
    ExplorerOptions measuredText;
    MeasureText measureText;
    DisplayText displayText;
    CLI::App* viewApp =
        app.add_subcommand("view", "A window or a headset in which a file is explored");
    CLI::App* renderApp =
        app.add_subcommand("render", "Pictures of value ranges, without a window");
    CLI::App* measureApp = app.add_subcommand(
        "measure", "What each way of drawing a picture costs, and how far it is from the truth");
    CLI::App* infoApp =
        app.add_subcommand("info", "What a file holds: grid, variables, time steps");
    CLI::App* countApp =
        app.add_subcommand("count", "How many points of each step lie in value ranges");
    viewText.addTo(*viewApp);
    addDisplay(*viewApp, displayText);
    renderText.addTo(*renderApp);
    addOutput(*renderApp, outputText);
    measuredText.addTo(*measureApp);
    addMeasure(*measureApp, measureText);
    addInfo(*infoApp, info);
    addCount(*countApp, countText);
    CLI::App* indexApp = app.add_subcommand(
        "index", "Sorts steps ahead into files, from which they are opened at once");
    CLI::App* cacheApp = app.add_subcommand("cache", "The sorted steps that are kept");
    IndexText indexText;
    addIndex(*indexApp, indexText);
    std::string cacheText = "list";
    cacheApp->add_option("ACTION", cacheText, "list (the default) or clear")
        ->check(oneOf({"list", "clear"}));
    CommonOptions common;
    for (CLI::App* each : {viewApp, renderApp, measureApp, infoApp, countApp, indexApp, cacheApp}) {
        addCommon(*each, common);
        each->footer(kFooter);
    }
    for (CLI::App* each : {viewApp, renderApp, measureApp}) addMemory(*each, common);
    const auto with = [&common](auto options) {
        static_cast<CommonOptions&>(options) = common;
        return options;
    };
    try {
        if (isMistyped(arguments)) return Exit{2, notACommand(arguments.front())};
        std::vector<std::string> all = withCommand(arguments);
        // CLI11 would give it the next argument.
        for (const std::string& each : all)
            if (each.starts_with("--") && each.find('=') == each.size() - 1)
                return Exit{2, fmt::format("{} has no value (see isochron --help)", each)};
        std::ranges::reverse(all);  // CLI11 takes them last first
        app.parse(std::move(all));
        if (*infoApp) return with(info);
        if (*countApp) return with(countOptions(*countApp, countText));
        if (*indexApp) return with(indexOptions(indexText));
        if (*cacheApp)
            return with(CacheOptions{
                {},
                cacheText == "clear" ? CacheOptions::Action::Clear : CacheOptions::Action::List});
        if (*renderApp) return with(renderOptions(renderText.explorer(*renderApp), outputText));
        if (*measureApp)
            return with(measureOptions(measuredText.explorer(*measureApp), measureText));
        if (displayText.display == "headless")
            return with(headlessOptions(viewText.explorer(*viewApp), displayText));
        return with(viewOptions(viewText.explorer(*viewApp), displayText));
    } catch (const CLI::CallForHelp&) {
        return Exit{0, app.help()};  // of the command, where one was given
    } catch (const CLI::CallForVersion& version) {
        return Exit{0, version.what()};
    } catch (const CLI::ParseError& error) {
        if (app.get_subcommands().empty()) return Exit{2, notACommand(arguments.front())};
        return Exit{2,
                    fmt::format("{} (see isochron --help)", parseErrorText(app, error, arguments))};
    } catch (const std::invalid_argument& error) {
        return Exit{2, error.what()};
    }
}

}  // namespace app
