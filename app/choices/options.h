// The command line, parsed once into types.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/choices/explorer.h"
#include "render/splat/splatter.h"

namespace app {

// What every command takes.
struct CommonOptions {
    unsigned threads = 0;  // at most; 0: as many as the machine has
    std::string cache;     // a folder of sorted steps, "off", or "": the user's own
    std::optional<std::uint64_t> cacheSize;  // bytes that it may take; none: by its disk
    std::uint64_t memory = 0;  // bytes that loaded steps may take; 0: by the machine's
};

struct InfoOptions : CommonOptions {
    std::vector<std::filesystem::path> files;
    bool json = false;
};

struct CountOptions : CommonOptions {
    std::vector<std::filesystem::path> files;
    std::string variable;
    std::vector<timeseries::RangeSet> ranges;  // a layer each
    std::optional<timeseries::RangeSet> keep;
    StepChoice steps;
    bool json = false;
};

// Who draws pictures, and where GL draws: "any" device, "gpu" or "cpu".
struct DrawnBy {
    std::string device = "any";
    render::SplatterChoice splatter = render::SplatterChoice::ByDevice;
};
struct RenderOptions : CommonOptions {
    Explorer explorer;
    std::filesystem::path output;
    bool opticalDepth = false, splatCount = false;  // further EXR channels
    DrawnBy by;
    bool portable = false;  // pictures keep no absolute path
    bool progress = false;  // "picture 3 of 31" on stdout after each
    // Of optical depth, relative: what draws least of what keeps to it. None: all, the best.
    std::optional<double> within = {};
    // Of several pictures each has its own error worked out, and what keeps to `within`; else the
    // one in the middle's is that of all.
    bool errorOfEach = false;
};

// One step, drawn in every way, or some, and held against the truth.
struct MeasureOptions : CommonOptions {
    Explorer explorer;
    unsigned views = 3;
    unsigned frames = 5;             // timed, of each view
    unsigned rays = 5;               // of the truth, across a pixel
    std::vector<std::string> modes;  // as Mode::name() has them; none: all
    DrawnBy by;
    bool json = false;
    std::filesystem::path csv, svg, png;  // empty: not wanted
};

// Where a file is explored. Auto: in a headset where one answers, else in a window. From a headset
// that is lost, both go on in a window.
enum class Display { Auto, Desktop, Headset };

// A window or a headset on these choices; without files, on nothing yet.
struct ViewOptions : CommonOptions {
    Explorer explorer;
    Display display = Display::Auto;
};

// Sorts steps ahead, into files that are opened instead.
struct IndexOptions : CommonOptions {
    std::vector<std::filesystem::path> files;
    std::vector<std::string> variables;  // none: the one shown first
    StepChoice steps;
    unsigned jobs = 1;    // steps at a time
    bool beside = false;  // in a folder beside the data, not in the cache
    bool check = false;   // the files are indices: they are read whole
};

// What sorted steps are kept.
struct CacheOptions : CommonOptions {
    enum class Action { List, Clear } action = Action::List;
};

// Nothing to run: help was asked for (0), or the arguments are wrong (2). The text goes to stdout
// or stderr accordingly.
struct Exit {
    int code = 0;
    std::string text;
};

using Command = std::variant<InfoOptions, CountOptions, RenderOptions, MeasureOptions, ViewOptions,
                             IndexOptions, CacheOptions, Exit>;
CommonOptions commonOf(const Command& command);

// Whether a first argument is a command's name, and not a file's.
bool isCommand(std::string_view argument);

// `arguments`: without the program's name. Throws timeseries::FileError when a session file cannot
// be read.
Command parse(std::span<const char* const> arguments);

}  // namespace app
