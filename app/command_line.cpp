#include "app/command_line.h"

#include <fmt/format.h>

#include <cassert>

#include "app/choice_text.h"
#include "app/options.h"
#include "app/paths.h"
#include "timeseries/shell_word.h"

namespace app {
namespace {

namespace fs = std::filesystem;

// Arguments as they are put together. A value stands behind an '=', so that none is taken for an
// option.
class Arguments {
 public:
    explicit Arguments(std::vector<std::string> first) : all_(std::move(first)) {}

    void flag(const char* name, bool on) {
        if (on) all_.emplace_back(name);
    }
    void option(const char* name, std::string_view value) {
        all_.push_back(fmt::format("{}={}", name, value));
    }
    void number(const char* name, double value) { option(name, fmt::format("{}", value)); }
    // A name that looks like an option or a command is none with its folder before it.
    void file(const fs::path& path) {
        const std::string text = path.generic_string();
        const bool isMistaken = text.starts_with('-') || isCommand(text);
        all_.push_back(isMistaken ? "./" + text : text);
    }
    std::vector<std::string> take() { return std::move(all_); }

 private:
    std::vector<std::string> all_;
};

std::string triple(const glm::dvec3& v) { return fmt::format("{},{},{}", v.x, v.y, v.z); }

void addStyle(const LayerChoice& layer, Arguments& arguments) {
    if (const auto* rgb = std::get_if<glm::dvec3>(&*layer.color))
        arguments.option("--color", colorText(*rgb));
    else
        arguments.option("--colormap", mapText(std::get<MapChoice>(*layer.color)));
    arguments.number("--opacity", *layer.opacity);
}

// Styles go to the swept layer first, then to the others in their order.
void addLayers(const Explorer& e, Arguments& arguments) {
    std::size_t place = 1;
    const auto add = [&](const LayerChoice& layer) {
        addStyle(layer, arguments);
        if (!layer.visible) arguments.option("--hide", std::to_string(place));
        ++place;
    };
    if (e.sweep) {
        const timeseries::SweepSettings& s = *e.sweep;
        arguments.option("--sweep", s.animation.text());
        arguments.number("--delta", s.delta);
        arguments.option("--timer-steps", std::to_string(s.timerSteps));
        arguments.option("--timer-step", std::to_string(s.step));
        arguments.number("--frequency", s.frequency);
        arguments.flag("--swing", s.path == timeseries::SweepPath::Swing);
        add(e.sweepLayer);
    }
    for (const LayerChoice& layer : e.layers) {
        arguments.option("--range", layer.ranges.text());
        add(layer);
    }
}

void addView(const Explorer& e, Arguments& arguments) {
    const Explorer plain;
    const ViewChoice& view = e.view;
    std::string text = fmt::format("{},{}", view.azimuthDegrees, view.elevationDegrees);
    if (view.distance) text += fmt::format(",{}", *view.distance);
    arguments.option("--view", text);
    if (view.target != plain.view.target) arguments.option("--target", triple(view.target));
    arguments.flag("--orthographic", view.projection == Projection::Orthographic);
    if (e.stereo.mode != plain.stereo.mode) arguments.option("--stereo", stereoName(e.stereo.mode));
    if (e.stereo.eyeDistance) arguments.number("--eye-distance", *e.stereo.eyeDistance);
    if (e.stereo.convergence) arguments.number("--convergence", *e.stereo.convergence);
    arguments.option("--size", fmt::format("{}x{}", e.size.x, e.size.y));
}

void addSplats(const Explorer& e, Arguments& arguments) {
    const render::Footprint plain;
    if (e.footprint.kernel != plain.kernel)
        arguments.option("--splat", kernelName(e.footprint.kernel));
    if (e.footprint.size != plain.size) arguments.number("--splat-size", e.footprint.size);
    if (e.order != render::Order::None) arguments.option("--order", orderName(e.order));
    if (e.clip) arguments.option("--clip", clipText(*e.clip));
    if (e.scale) arguments.option("--scale", triple(*e.scale));
}

}  // namespace

std::vector<std::string> renderArguments(const Explorer& e, const fs::path& output,
                                         const fs::path& folder) {
    assert(!e.layers.empty() || e.sweep);
    Arguments arguments({"render"});
    for (const fs::path& file : e.files) arguments.file(relativeTo(folder, file));
    if (!e.variable.empty()) arguments.option("--variable", e.variable);
    if (e.steps) arguments.option("--step", stepsText(*e.steps));
    if (e.keep) arguments.option("--keep", e.keep->text());
    addLayers(e, arguments);
    addSplats(e, arguments);
    addView(e, arguments);
    arguments.option("--output", relativeTo(folder, output).generic_string());
    return arguments.take();
}

std::string shellText(const std::vector<std::string>& arguments) {
    std::string line;
    for (const std::string& argument : arguments)
        line += (line.empty() ? "" : " ") + timeseries::shellWord(argument);
    return line;
}

}  // namespace app
