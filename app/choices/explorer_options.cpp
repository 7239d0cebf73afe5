#include "app/choices/explorer_options.h"

#include <fmt/format.h>

#include <fmt/ranges.h>

#include <CLI/CLI.hpp>

#include "app/choices/choice_text.h"
#include "app/choices/choices.h"
#include "app/choices/option_checks.h"
#include "app/choices/session.h"
#include "timeseries/readers/reader.h"

namespace app {

using timeseries::RangeSet;

namespace {

// Of all layers, and then of each.
bool isModel(const Choice& choice) { return choice.option == std::string_view("--model"); }

}  // namespace

void ExplorerOptions::addTo(CLI::App& app) {
    app.add_option("FILE", files_, kFileHelp)->check(notEmpty());
    app.add_option("--session", session_,
                   "A session file, or a picture that carries one; options given beside it win");
    app.add_option("--range", ranges_, kRangeHelp)->allow_extra_args(false)->group("Layers");
    app.add_option("--color", colors_, "#rrggbb of the next layer")
        ->allow_extra_args(false)
        ->group("Layers");
    app.add_option("--colormap", colormaps_,
                   fmt::format("Colour by value of the next layer, NAME or NAME=LO:HI for the "
                               "values of its ends: {}",
                               fmt::join(render::colorMapNames(), ", ")))
        ->allow_extra_args(false)
        ->group("Layers");
    app.add_option("--opacity", opacities_,
                   "Of one cell of fully selected points, per layer, 0 to 1")
        ->allow_extra_args(false)
        ->check(between(0, 1))
        ->group("Layers");
    app.add_option("--hide", hidden_, "A layer that is not drawn; 1 is the first")
        ->allow_extra_args(false)
        ->check(wholeBetween(1, render::kMaxLayers))
        ->group("Layers");
    app.add_option("--name-axis", axisNames_, "x=NAME, y=NAME or z=NAME: what an axis is called")
        ->allow_extra_args(false)
        ->group("Data");
    texts_.resize(choices().size());
    for (std::size_t i = 0; i < choices().size(); ++i) {
        const Choice& choice = choices()[i];
        if (*choice.option == '\0') continue;
        auto* option =
            choice.flag ? app.add_flag(choice.option, choice.help)
            : isModel(choice)
                ? app.add_option(choice.option, models_, choice.help)->allow_extra_args(false)
                : app.add_option(choice.option, texts_[i], choice.help);
        option->group(choice.group);
    }
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

// Styles go to the swept layer first, then to the ranges'.
void ExplorerOptions::applyLayers(const CLI::App& app, Explorer& e) const {
    if (given(app, "--range")) {
        std::erase_if(e.layers, [](const LayerChoice& layer) { return !layer.motion; });
        e.noLayers = false;
        for (const std::string& range : ranges_)
            e.layers.push_back({RangeSet::parse(range), {}, {}});
    }
    const auto colors = colorsInOrder(app);
    const std::size_t models = models_.empty() ? 0 : models_.size() - 1;
    const std::size_t styles = std::max({colors.size(), opacities_.size(), models});
    if (e.layers.empty() && (styles == 1 || !hidden_.empty())) {
        // A style for the first choice, whose range is not known yet.
        e.layers.emplace_back();
        e.noLayers = false;
    }
    if (styles > e.layers.size())
        throw ChoiceError(
            fmt::format("{} colours, opacities or models for {} layer{}: give a --range for each",
                        styles, e.layers.size(), e.layers.size() == 1 ? "" : "s"));
    for (std::size_t i = 0; i < colors.size(); ++i) e.layers[i].color = colors[i];
    for (std::size_t i = 0; i < opacities_.size(); ++i)
        e.layers[i].opacity = parseNumber("opacity", opacities_[i]);
    if (!models_.empty())
        for (LayerChoice& layer : e.layers) layer.model.reset();
    for (std::size_t i = 0; i < models; ++i) e.layers[i].model = parseLayerModel(models_[i + 1]);
    for (const std::size_t number : hidden_) {
        if (number > e.layers.size())
            throw ChoiceError(fmt::format("--hide {} of {} layer{}: 1 is the first", number,
                                          e.layers.size(), e.layers.size() == 1 ? "" : "s"));
        e.layers[number - 1].visible = false;
    }
}

namespace {

// What is read as a number does not say of what; other texts do.
void take(const Choice& choice, std::string_view text, Explorer& e) {
    if (choice.form != Choice::Form::Number && choice.form != Choice::Form::Whole)
        return choice.take(e, choice.flag ? choice.flag : text);
    try {
        choice.take(e, text);
    } catch (const ChoiceError& error) {
        throw ChoiceError(fmt::format("{}: {}", choice.option, error.what()));
    }
}

std::string optionOf(std::string_view key) {
    for (const Choice& choice : choices())
        if (choice.key == key && *choice.option != '\0') return choice.option;
    return std::string(key);
}

}  // namespace

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
    for (const std::string& each : axisNames_) {
        auto [a, name] = parseAxisName(each);
        e.axes[a].name = std::move(name);
    }
    for (std::size_t i = 0; i < choices().size(); ++i) {
        const Choice& choice = choices()[i];
        if (*choice.option == '\0' || !given(app, choice.option)) continue;
        if (choice.group == std::string_view("Sweep") && sweepOf(e) == nullptr &&
            !given(app, "--sweep"))
            throw ChoiceError(fmt::format("{} needs --sweep beside it", choice.option));
        take(choice, isModel(choice) ? models_.front() : texts_[i], e);
    }
    // Who chooses splats chooses points.
    if ((given(app, "--splat") || given(app, "--splat-size")) && !given(app, "--model"))
        e.model = Model::Points;
    applyLayers(app, e);
    if (const auto flaw = flawOf(e))
        throw ChoiceError(fmt::format("{}: {}", optionOf(flaw->key), flaw->why));
    return e;
}

}  // namespace app
