#include "app/choices/command_line.h"

#include <fmt/format.h>

#include <cassert>
#include <cstdlib>
#include <sstream>

#include "app/choices/choice_text.h"
#include "app/choices/choices.h"
#include "app/choices/options.h"
#include "app/choices/paths.h"
#include "timeseries/readers/text/shell_word.h"

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

void addAxisNames(const Explorer& e, Arguments& arguments) {
    for (std::size_t a = 0; a < 3; ++a)
        if (!e.axes[a].name.empty())
            arguments.option("--name-axis", fmt::format("{}={}", "xyz"[a], e.axes[a].name));
}

void addStyle(const LayerChoice& layer, Arguments& arguments) {
    if (const auto* rgb = std::get_if<glm::dvec3>(&*layer.color))
        arguments.option("--color", colorText(*rgb));
    else
        arguments.option("--colormap", mapText(std::get<MapChoice>(*layer.color)));
    arguments.number("--opacity", *layer.opacity);
}

bool hasModel(const LayerChoice& layer) { return layer.model.has_value(); }

void addLayers(const Explorer& e, Arguments& arguments) {
    if (std::ranges::any_of(e.layers, hasModel))  // after that of all
        for (const LayerChoice& layer : e.layers)
            arguments.option("--model", layer.model ? modelName(*layer.model) : "auto");
    for (std::size_t i = 0; i < e.layers.size(); ++i) {
        const LayerChoice& layer = e.layers[i];
        if (!layer.motion) arguments.option("--range", layer.ranges.text());
        addStyle(layer, arguments);
        if (!layer.visible) arguments.option("--hide", std::to_string(i + 1));
    }
    if (e.layers.empty()) {  // no layer, or a hidden one: the same picture
        arguments.option("--range", "min:max");
        arguments.option("--hide", "1");
    }
}

// What differs from a picture that nobody has chosen anything of, and the view.
void addChoices(const Explorer& e, Arguments& arguments) {
    const Explorer plain;
    for (const Choice& choice : choices()) {
        const auto text = choice.text(e);
        // Splats alone would choose points; and from where it is seen is told of every picture.
        const std::string_view option = choice.option;
        const bool isTold = option == "--view" || option == "--shift" ||
                            (option == "--model" && (e.footprint != plain.footprint ||
                                                     std::ranges::any_of(e.layers, hasModel)));
        if (*choice.option == '\0' || !text || (text == choice.text(plain) && !isTold)) continue;
        if (choice.flag)
            arguments.flag(choice.option, *text == choice.flag);
        else
            arguments.option(choice.option, *text);
    }
}

// Linux says so of a file that is gone or has another in its place, whose name is what is called.
fs::path programAt(const fs::path& running) {
    constexpr std::string_view kGone = " (deleted)";
    std::error_code none;
    const std::string told = fs::read_symlink(running, none).string();
    if (!told.ends_with(kGone) || fs::exists(told, none)) return told;
    return told.substr(0, told.size() - kGone.size());
}

}  // namespace

std::vector<std::string> renderArguments(const Explorer& e, const fs::path& output,
                                         const fs::path& folder) {
    assert(!e.layers.empty() || e.noLayers);
    Arguments arguments({"render"});
    for (const fs::path& file : e.files) arguments.file(namedFrom(folder, file));
    addChoices(e, arguments);
    addAxisNames(e, arguments);
    addLayers(e, arguments);
    arguments.option("--output", namedFrom(folder, output).generic_string());
    return arguments.take();
}

// Whether a shell finds what runs under a bare name is PATH's.
std::string callOfProgram(const fs::path& running) {
    // ./run sets it to its own name, as the user's shell sees it.
    if (const char* run = std::getenv("ISOCHRON_RUN"); run != nullptr && *run != '\0')
        return timeseries::shellWord(run);
    std::error_code gone;
    const fs::path program = programAt(running);
    const std::string name = program.filename().string();
    const char* const path = std::getenv("PATH");
    std::istringstream folders(path == nullptr ? "" : path);
    for (std::string folder; std::getline(folders, folder, ':');) {
        const fs::path found = fs::path(folder) / name;
        // What is relative to where the shell stands now is elsewhere after its next cd.
        if (found.is_absolute() && fs::exists(found, gone))
            // The first is the one that a shell takes.
            return timeseries::shellWord(fs::equivalent(found, program, gone) ? name
                                                                              : program.string());
    }
    return timeseries::shellWord(program.string());
}

std::string shellText(const std::vector<std::string>& arguments) {
    std::string line;
    for (const std::string& argument : arguments)
        line += (line.empty() ? "" : " ") + timeseries::shellWord(argument);
    return line;
}

}  // namespace app
