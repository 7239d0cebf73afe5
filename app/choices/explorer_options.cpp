#include "app/choices/explorer_options.h"

#include <fmt/format.h>

#include <fmt/ranges.h>

#include <CLI/CLI.hpp>

#include "app/choices/choice_text.h"
#include "app/choices/option_checks.h"
#include "app/choices/session.h"
#include "timeseries/readers/reader.h"

namespace app {

using timeseries::RangeSet;

void ExplorerOptions::addTo(CLI::App& app) {
    app.add_option("FILE", files_, kFileHelp)->check(notEmpty());
    app.add_option("--session", session_,
                   "A session file, or a picture that carries one; options given beside it win");
    app.add_option("--variable", variable_,
                   "Which variable; without it the one of the most levels, then steps");
    app.add_option("--step", steps_,
                   "A step counted from 0, A:B, A:B:S for every S-th, or all; the middle one "
                   "without it");
    app.add_option("--range", ranges_, kRangeHelp)->allow_extra_args(false);
    app.add_option("--keep", keep_, "Values to keep when the sorted list is built");
    app.add_option("--flip", flips_,
                   "Axes drawn the other way round, for files that do not say which way is down: "
                   "x, y, z, several with commas, or none");
    app.add_option("--name-axis", axisNames_, "x=NAME, y=NAME or z=NAME: what an axis is called")
        ->allow_extra_args(false);
    app.add_option("--color", colors_, "#rrggbb of the next layer")->allow_extra_args(false);
    app.add_option("--colormap", colormaps_,
                   fmt::format("Colour by value of the next layer, NAME or NAME=LO:HI for the "
                               "values of its ends: {}",
                               fmt::join(render::colorMapNames(), ", ")))
        ->allow_extra_args(false);
    app.add_option("--opacity", opacities_,
                   "Of one cell of fully selected points, per layer, 0 to 1")
        ->allow_extra_args(false)
        ->check(between(0, 1));
    app.add_option("--hide", hidden_, "A layer that is not drawn; 1 is the first")
        ->allow_extra_args(false)
        ->check(CLI::Range(std::size_t{1}, render::kMaxLayers));
    app.add_option("--splat", splat_, "kernel (default) or point");
    app.add_option("--splat-size", splatSize_,
                   "kernel: times the radius that suits the spacing; point: pixels")
        ->check(between(1e-3, 1e3));
    app.add_option("--order", order_,
                   "depth (default): what is in front hides what is behind; none is faster, and "
                   "mixes colours");
    app.add_option("--sweep", sweep_,
                   "Animate a window of values through these ranges; a layer before the others");
    app.add_option("--delta", delta_, "Half the swept window's width")->check(between(0, kMost));
    app.add_option("--timer-steps", timerSteps_, "Timer counts in a cycle (256)")
        ->check(CLI::Range(1, 1 << 30));
    app.add_option("--timer-step", timerStep_, "The timer counts by this many (1)")
        ->check(CLI::Range(1, 1 << 30));
    app.add_option("--frequency", frequency_, "Cycles a second (0.1)")->check(between(0, kMost));
    app.add_option("--tick", tick_, "Only this picture of the sweep, counted from 0")
        ->check(CLI::Range(0, 1 << 30));
    app.add_flag("--swing", swing_, "There and back on a cosine, instead of a loop");
    app.add_option("--clip", clip_, "x0:x1,y0:y1,z0:z1 in the file's coordinates");
    app.add_option("--scale", scale_, "x,y,z: stretch of the axes");
    app.add_option("--view", view_, "AZIMUTH,ELEVATION[,DISTANCE]: degrees, and half diagonals");
    app.add_option("--target", target_,
                   "x,y,z: what is looked at, in half diagonals from the box's centre");
    app.add_flag("--orthographic", orthographic_, "Parallel projection, without perspective");
    app.add_option("--size", size_, "WxH in pixels (1200x900)");
    app.add_option("--stereo", stereo_,
                   "off, side-by-side, top-bottom, multiview (one EXR), left-right (two files)");
    app.add_option("--eye-distance", eyeDistance_, "In half diagonals of the box")
        ->check(between(0, kFarthest));
    app.add_option("--convergence", convergence_, "Distance of zero parallax, likewise")
        ->check(between(kNearest, kFarthest));
}

// Colours and maps share one row of layers, in the order in which they were written.
std::vector<std::variant<glm::dvec3, MapChoice>> ExplorerOptions::colorsInOrder(
    const CLI::App& app) const {
    std::vector<std::variant<glm::dvec3, MapChoice>> colors;
    std::size_t color = 0, map = 0;
    for (const CLI::Option* option : app.parse_order()) {
        if (option == app.get_option("--color")) colors.emplace_back(parseColor(colors_[color++]));
        if (option == app.get_option("--colormap"))
            colors.emplace_back(parseMap(colormaps_[map++]));
    }
    return colors;
}

// The layers that have a style of their own: the swept one first, then the ranges'.
void ExplorerOptions::applyLayers(const CLI::App& app, Explorer& e) const {
    if (given(app, "--range")) {
        e.layers.clear();
        e.noLayers = false;
        for (const std::string& range : ranges_)
            e.layers.push_back({RangeSet::parse(range), {}, {}});
    }
    std::vector<LayerChoice*> layers;
    if (e.sweep) layers.push_back(&e.sweepLayer);
    for (LayerChoice& layer : e.layers) layers.push_back(&layer);
    const auto colors = colorsInOrder(app);
    const std::size_t styles = std::max(colors.size(), opacities_.size());
    if (layers.empty() && (styles == 1 || !hidden_.empty())) {
        // A style for the first choice, whose range is not known yet.
        e.layers.push_back({RangeSet(), {}, {}});
        e.noLayers = false;
        layers.push_back(&e.layers.back());
    }
    if (styles > layers.size())
        throw ChoiceError(
            fmt::format("{} colours or opacities for {} layers: give a --range for each", styles,
                        layers.size()));
    for (std::size_t i = 0; i < colors.size(); ++i) layers[i]->color = colors[i];
    for (std::size_t i = 0; i < opacities_.size(); ++i)
        layers[i]->opacity = parseNumber("opacity", opacities_[i]);
    for (const std::size_t number : hidden_) {
        if (number > layers.size())
            throw ChoiceError(
                fmt::format("--hide {} of {} layers: 1 is the first", number, layers.size()));
        layers[number - 1]->visible = false;
    }
    if (layers.size() > render::kMaxLayers)
        throw ChoiceError(fmt::format("{} layers are more than the {} that are drawn at once",
                                      layers.size(), render::kMaxLayers));
}

void ExplorerOptions::applySweep(const CLI::App& app, Explorer& e) const {
    if (given(app, "--sweep")) {
        e.sweep.emplace();
        e.sweep->path = timeseries::SweepPath::Loop;
        e.sweep->animation = RangeSet::parse(sweep_);
        e.oneTick = false;
    }
    for (const char* option :
         {"--delta", "--timer-steps", "--timer-step", "--frequency", "--swing", "--tick"})
        if (given(app, option) && !e.sweep)
            throw ChoiceError(fmt::format("{} needs --sweep beside it", option));
    if (given(app, "--delta")) e.sweep->delta = parseNumber("delta", delta_);
    if (given(app, "--timer-steps")) e.sweep->timerSteps = timerSteps_;
    if (given(app, "--timer-step")) e.sweep->step = timerStep_;
    if (given(app, "--frequency")) e.sweep->frequency = parseNumber("frequency", frequency_);
    if (swing_) e.sweep->path = timeseries::SweepPath::Swing;
    if (given(app, "--tick")) {
        e.oneTick = true;
        e.play.tick = tick_;
    }
    if (!e.oneTick) return;
    const std::int64_t ticks = ticksOf(*e.sweep);
    if (e.play.tick >= ticks)
        throw ChoiceError(
            fmt::format("--tick {}: the sweep has ticks 0 to {}", e.play.tick, ticks - 1));
}

void ExplorerOptions::applyAxes(const CLI::App& app, Explorer& e) const {
    if (given(app, "--flip")) {
        const auto flips = parseFlips(flips_);
        for (std::size_t a = 0; a < 3; ++a) e.axes[a].flip = flips[a];
    }
    for (const std::string& each : axisNames_) {
        auto [a, name] = parseAxisName(each);
        e.axes[a].name = std::move(name);
    }
}

void ExplorerOptions::applyView(const CLI::App& app, Explorer& e) const {
    if (given(app, "--view")) {
        const ViewChoice view = parseView(view_);
        e.view.azimuthDegrees = view.azimuthDegrees;
        e.view.elevationDegrees = view.elevationDegrees;
        e.view.distance = view.distance;
    }
    if (given(app, "--target")) e.view.target = parseTarget(target_);
    if (orthographic_) e.view.projection = Projection::Orthographic;
    if (given(app, "--size")) e.size = parseSize(size_);
    if (given(app, "--stereo")) e.stereo.mode = parseStereo(stereo_);
    if (given(app, "--eye-distance"))
        e.stereo.eyeDistance = parseNumber("eye distance", eyeDistance_);
    if (given(app, "--convergence"))
        e.stereo.convergence = parseNumber("convergence", convergence_);
}

Explorer ExplorerOptions::explorer(const CLI::App& app) const {
    Explorer e;
    const bool named = given(app, "--session");
    const bool inPlace = !named && files_.size() == 1 && holdsSession(files_.front());
    if (named || inPlace) e = readSession(named ? session_ : files_.front());
    if (!inPlace && !files_.empty())
        e.files.assign(files_.begin(), files_.end());
    else if (const auto missing = missingFile(e))
        throw timeseries::FileError(fmt::format(
            "{0}: its data are not there any more: expected {1}; name them beside --session {0}",
            inPlace ? files_.front() : session_, missing->string()));
    if (given(app, "--variable")) e.variable = variable_;
    if (given(app, "--step")) e.steps = parseSteps(steps_);
    if (given(app, "--keep")) e.keep = RangeSet::parse(keep_);
    applyAxes(app, e);
    applySweep(app, e);
    applyLayers(app, e);
    if (given(app, "--splat")) e.footprint.kernel = parseKernel(splat_);
    if (given(app, "--splat-size")) e.footprint.size = parseNumber("splat size", splatSize_);
    if (given(app, "--order")) e.order = parseOrder(order_);
    if (given(app, "--clip")) e.clip = parseClip(clip_);
    if (given(app, "--scale")) e.scale = parseScale(scale_);
    applyView(app, e);
    return e;
}

}  // namespace app
