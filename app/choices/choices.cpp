#include "app/choices/choices.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>

#include "app/choices/choice_text.h"
#include "app/choices/sweep_edits.h"

namespace app {
namespace {

using timeseries::CursorSettings;
using timeseries::RangeSet;
using Form = Choice::Form;
using Text = std::optional<std::string>;

constexpr std::int64_t kMostWhole = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kMostTicks = std::int64_t{1} << 30;

double number(std::string_view text, double lo = -kMostFinite, double hi = kMostFinite) {
    const double value = parseNumber("", text);
    if (value >= lo && value <= hi) return value;
    throw ChoiceError(hi == kMostFinite
                          ? fmt::format("'{}' is not a number of at least {}", text, lo)
                          : fmt::format("'{}' is not a number from {} to {}", text, lo, hi));
}

std::int64_t whole(std::string_view text, std::int64_t lo, std::int64_t hi = kMostWhole) {
    std::int64_t value = 0;
    const char* past = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), past, value);
    if (error == std::errc{} && end == past && value >= lo && value <= hi) return value;
    throw ChoiceError(hi == kMostWhole
                          ? fmt::format("'{}' is not a whole number of at least {}", text, lo)
                          : fmt::format("'{}' is not a whole number from {} to {}", text, lo, hi));
}

Text flag(bool on) { return on ? "true" : "false"; }
bool isOn(std::string_view text) { return text == "true"; }
Text numberText(double value) { return fmt::format("{}", value); }
Text numberText(const std::optional<double>& value) {
    return value ? numberText(*value) : std::nullopt;
}
Text wholeText(auto value) { return fmt::format("{}", value); }
std::string triple(const glm::dvec3& v) { return fmt::format("{},{},{}", v.x, v.y, v.z); }
// What stands there without a word is not written.
Text unless(bool untouched, Text text) { return untouched ? std::nullopt : std::move(text); }

timeseries::SweepSettings& swept(Explorer& e) {
    if (auto* const sweep = sweepOf(e)) return *sweep;
    throw ChoiceError("there is no sweep that it could be of");
}
template <typename Of>
Text ofSweep(const Explorer& e, const Of& text) {
    const auto* const sweep = sweepOf(e);
    return sweep != nullptr ? text(*sweep) : Text();
}

const CursorSettings kTime;
const PlayChoice kPlay;

// A session says of each axis what the command line says of several at once.
template <std::size_t axis>
Text flipOf(const Explorer& e) {
    return unless(!e.axes[axis].flip, flag(true));
}
template <std::size_t axis>
void takeFlip(Explorer& e, std::string_view t) {
    e.axes[axis].flip = isOn(t);
}
template <std::size_t axis>
Text nameOf(const Explorer& e) {
    return unless(e.axes[axis].name.empty(), e.axes[axis].name);
}
template <std::size_t axis>
void takeName(Explorer& e, std::string_view t) {
    e.axes[axis].name = t;
}

constexpr std::array kChoices = {
    Choice{"--variable", "variable", Form::Text,
           [](const Explorer& e) { return unless(e.variable.empty(), e.variable); },
           [](Explorer& e, std::string_view t) { e.variable = t; }, "Data",
           "Which variable; without it the one of the most levels, then steps"},
    Choice{"--step", "steps", Form::Text,
           [](const Explorer& e) { return e.steps ? stepsText(*e.steps) : Text(); },
           [](Explorer& e, std::string_view t) {
               e.steps = parseSteps(t);
               e.stepTime.clear();
           },
           "Data",
           "A step counted from 0, A:B, A:B:S for every S-th, or all; the middle one without it"},
    Choice{"--keep", "keep", Form::Text,
           [](const Explorer& e) { return e.keep ? e.keep->text() : Text(); },
           [](Explorer& e, std::string_view t) { e.keep = RangeSet::parse(t); }, "Data",
           "Values to keep when the sorted list is built"},
    Choice{"--flip", "", Form::Text,
           [](const Explorer& e) {
               const std::string flips = flipsText(e.axes);
               return unless(flips == "none", flips);
           },
           [](Explorer& e, std::string_view t) {
               const auto flips = parseFlips(t);
               for (std::size_t a = 0; a < 3; ++a) e.axes[a].flip = flips[a];
           },
           "Data",
           "Axes drawn the other way round, for files that do not say which way is down: "
           "x, y, z, several with commas, or none"},
    Choice{"", "axes.x.flip", Form::Flag, flipOf<0>, takeFlip<0>},
    Choice{"", "axes.y.flip", Form::Flag, flipOf<1>, takeFlip<1>},
    Choice{"", "axes.z.flip", Form::Flag, flipOf<2>, takeFlip<2>},
    Choice{"", "axes.x.name", Form::Text, nameOf<0>, takeName<0>},
    Choice{"", "axes.y.name", Form::Text, nameOf<1>, takeName<1>},
    Choice{"", "axes.z.name", Form::Text, nameOf<2>, takeName<2>},

    Choice{"--sweep", "sweep.animation", Form::Text,
           [](const Explorer& e) {
               return ofSweep(e, [](const auto& s) { return s.animation.text(); });
           },
           [](Explorer& e, std::string_view t) {
               setSweep(e, {.animation = RangeSet::parse(t), .path = timeseries::SweepPath::Loop});
               e.oneTick = false;
           },
           "Sweep", "Animate a window of values through these ranges; a layer before the others"},
    Choice{"--delta", "sweep.delta", Form::Number,
           [](const Explorer& e) {
               return ofSweep(e, [](const auto& s) { return numberText(s.delta); });
           },
           [](Explorer& e, std::string_view t) { swept(e).delta = number(t, 0, kMostFinite); },
           "Sweep",
           "Half the swept window's width (0: a value alone, which cells show and points hardly "
           "ever have)"},
    Choice{"--timer-steps", "sweep.timerSteps", Form::Whole,
           [](const Explorer& e) {
               return ofSweep(e, [](const auto& s) { return wholeText(s.timerSteps); });
           },
           [](Explorer& e, std::string_view t) { swept(e).timerSteps = whole(t, 1, kMostTicks); },
           "Sweep", "Timer counts in a cycle (256)"},
    Choice{"--timer-step", "sweep.timerStep", Form::Whole,
           [](const Explorer& e) {
               return ofSweep(e, [](const auto& s) { return wholeText(s.step); });
           },
           [](Explorer& e, std::string_view t) { swept(e).step = whole(t, 1, kMostTicks); },
           "Sweep", "The timer counts by this many (1)"},
    Choice{"--frequency", "sweep.frequency", Form::Number,
           [](const Explorer& e) {
               return ofSweep(e, [](const auto& s) { return numberText(s.frequency); });
           },
           [](Explorer& e, std::string_view t) { swept(e).frequency = number(t, 0, kMostFinite); },
           "Sweep", "Cycles a second (0.1)"},
    Choice{"--swing", "sweep.swing", Form::Flag,
           [](const Explorer& e) {
               return ofSweep(
                   e, [](const auto& s) { return flag(s.path == timeseries::SweepPath::Swing); });
           },
           [](Explorer& e, std::string_view t) {
               swept(e).path = isOn(t) ? timeseries::SweepPath::Swing : timeseries::SweepPath::Loop;
           },
           "Sweep", "There and back on a cosine, instead of a loop", "true"},
    Choice{"--tick", "sweep.tick", Form::Whole,
           [](const Explorer& e) { return unless(!e.oneTick, wholeText(e.play.tick)); },
           [](Explorer& e, std::string_view t) {
               swept(e);
               e.oneTick = true;
               e.play.tick = whole(t, 0, kMostTicks);
           },
           "Sweep", "Only this picture of the sweep, counted from 0"},

    Choice{"--splat", "splat", Form::Text,
           [](const Explorer& e) { return Text(kernelName(e.footprint.kernel)); },
           [](Explorer& e, std::string_view t) { e.footprint.kernel = parseKernel(t); }, "Splats",
           "of points, which it chooses where --model does not: kernel (default), or point"},
    Choice{"--splat-size", "splatSize", Form::Number,
           [](const Explorer& e) { return numberText(e.footprint.size); },
           [](Explorer& e, std::string_view t) { e.footprint.size = number(t, 1e-3, 1e3); },
           "Splats",
           "likewise; of kernel: times the radius that suits the spacing, of point: pixels"},
    Choice{
        "--model", "model", Form::Text, [](const Explorer& e) { return Text(modelName(e.model)); },
        [](Explorer& e, std::string_view t) { e.model = parseModel(t); }, "Splats",
        "of all layers: auto or cells (default): what lies in the ranges between points, too, so "
        "that thin ranges are closed shells; points: those in the ranges, each a splat, as "
        "categories and kept values always are. Repeated: then of each layer in turn, auto as all"},
    Choice{"--light", "light", Form::Text,
           [](const Explorer& e) { return Text(lightName(e.light)); },
           [](Explorer& e, std::string_view t) { e.light = parseLight(t); }, "Splats",
           "on cells in depth order: off, soft (default), or full with highlights"},
    Choice{
        "--light-from", "lightFrom", Form::Text,
        [](const Explorer& e) { return unless(!e.lamp, lampText(e.lamp)); },
        [](Explorer& e, std::string_view t) { e.lamp = parseLamp(t); }, "Splats",
        "head (default): from the eye; AZIMUTH,ELEVATION, as --view: from a lamp far away there, "
        "which stands still in the data's world"},
    Choice{"--opacity-per", "opacityPer", Form::Text,
           [](const Explorer& e) { return Text(opacityPerName(e.opacityPer)); },
           [](Explorer& e, std::string_view t) { e.opacityPer = parseOpacityPer(t); }, "Splats",
           "of cells: length, of one cell's length of a ray in the ranges, or crossing (default), "
           "of a passage through a whole range too, so that a thin one does not fade"},
    Choice{"--order", "order", Form::Text,
           [](const Explorer& e) { return Text(orderName(e.order)); },
           [](Explorer& e, std::string_view t) { e.order = parseOrder(t); }, "Splats",
           "depth (default): what is in front hides what is behind; none is faster, and mixes "
           "colours"},

    Choice{"--clip", "clip", Form::Text,
           [](const Explorer& e) { return e.clip ? clipText(*e.clip) : Text(); },
           [](Explorer& e, std::string_view t) { e.clip = parseClip(t); }, "View",
           "x0:x1,y0:y1,z0:z1 in the file's coordinates"},
    Choice{"--scale", "scale", Form::Numbers,
           [](const Explorer& e) { return e.scale ? triple(*e.scale) : Text(); },
           [](Explorer& e, std::string_view t) { e.scale = parseScale(t); }, "View",
           "x,y,z: stretch of the axes"},
    Choice{"--map", "map", Form::Text,
           [](const Explorer& e) {
               return unless(e.map == render::Map::Flat, std::string(mapKindName(e.map)));
           },
           [](Explorer& e, std::string_view t) { e.map = parseMapKind(t); }, "View",
           "of longitudes and latitudes: flat (default), or globe, on which heights and depths are "
           "exaggerated"},
    Choice{"--view", "", Form::Text, [](const Explorer& e) { return Text(viewText(e.view)); },
           [](Explorer& e, std::string_view t) { takeView(e.view, t); }, "View",
           "AZIMUTH,ELEVATION[,DISTANCE]: degrees, and half diagonals"},
    Choice{"", "view.azimuth", Form::Number,
           [](const Explorer& e) { return numberText(e.view.azimuthDegrees); },
           [](Explorer& e, std::string_view t) {
               e.view.azimuthDegrees = number(t);
               choose(e.view);
           }},
    Choice{"", "view.elevation", Form::Number,
           [](const Explorer& e) { return numberText(e.view.elevationDegrees); },
           [](Explorer& e, std::string_view t) {
               e.view.elevationDegrees = number(t);
               choose(e.view);
           }},
    Choice{
        "", "view.distance", Form::Number,
        [](const Explorer& e) { return numberText(e.view.distance); },
        [](Explorer& e, std::string_view t) { e.view.distance = number(t, kNearest, kFarthest); }},
    Choice{"--target", "view.target", Form::Numbers,
           [](const Explorer& e) {
               return unless(e.view.target == glm::dvec3(0), triple(e.view.target));
           },
           [](Explorer& e, std::string_view t) { e.view.target = parseTarget(t); }, "View",
           "x,y,z: what is looked at, in half diagonals from the box's centre"},
    Choice{"--shift", "view.shift", Form::Text,
           [](const Explorer& e) {
               return unless(e.view.shift == glm::dvec2(0), shiftText(e.view.shift));
           },
           [](Explorer& e, std::string_view t) { e.view.shift = parseShift(t); }, "View",
           "X,Y: where the target stands, in halves of the picture's sides from the middle (0,0 "
           "with --view); auto: so that the legend covers none of the box"},
    Choice{"--orthographic", "view.projection", Form::Text,
           [](const Explorer& e) {
               return unless(e.view.projection == Projection::Perspective,
                             std::string(projectionName(e.view.projection)));
           },
           [](Explorer& e, std::string_view t) { e.view.projection = parseProjection(t); }, "View",
           "Parallel projection, without perspective", "orthographic"},
    Choice{"--no-legend", "legend", Form::Text,
           [](const Explorer& e) { return unless(e.legend, std::string(legendName(e.legend))); },
           [](Explorer& e, std::string_view t) { e.legend = parseLegend(t); }, "View",
           "A picture without variable, time, layers and notes, whose caption says them", "hidden"},
    Choice{"--size", "size", Form::Text,
           [](const Explorer& e) { return Text(fmt::format("{}x{}", e.size.x, e.size.y)); },
           [](Explorer& e, std::string_view t) { e.size = parseSize(t); }, "View",
           "WxH in pixels (1200x900)"},
    Choice{"--stereo", "stereo.mode", Form::Text,
           [](const Explorer& e) { return Text(stereoName(e.stereo.mode)); },
           [](Explorer& e, std::string_view t) { e.stereo.mode = parseStereo(t); }, "View",
           "off, side-by-side, top-bottom, multiview (one EXR), left-right (two files)"},
    Choice{"--eye-distance", "stereo.eyeDistance", Form::Number,
           [](const Explorer& e) { return numberText(e.stereo.eyeDistance); },
           [](Explorer& e, std::string_view t) { e.stereo.eyeDistance = number(t, 0, kFarthest); },
           "View", "In half diagonals of the box"},
    Choice{"--convergence", "stereo.convergence", Form::Number,
           [](const Explorer& e) { return numberText(e.stereo.convergence); },
           [](Explorer& e, std::string_view t) {
               e.stereo.convergence = number(t, kNearest, kFarthest);
           },
           "View", "Distance of zero parallax, likewise"},

    // Play: only what somebody has touched.
    Choice{"", "play.first", Form::Whole,
           [](const Explorer& e) {
               return unless(e.play.time.first == kTime.first, wholeText(e.play.time.first));
           },
           [](Explorer& e, std::string_view t) {
               e.play.time.first = static_cast<std::size_t>(whole(t, 0));
           }},
    Choice{"", "play.last", Form::Whole,
           [](const Explorer& e) {
               return unless(e.play.time.last == kTime.last, wholeText(e.play.time.last));
           },
           [](Explorer& e, std::string_view t) {
               e.play.time.last = static_cast<std::size_t>(whole(t, 0));
           }},
    Choice{"", "play.stride", Form::Whole,
           [](const Explorer& e) {
               return unless(e.play.time.stride == kTime.stride, wholeText(e.play.time.stride));
           },
           [](Explorer& e, std::string_view t) {
               e.play.time.stride = static_cast<decltype(e.play.time.stride)>(whole(t, 1));
           }},
    Choice{"", "play.ending", Form::Text,
           [](const Explorer& e) {
               return unless(e.play.time.ending == kTime.ending,
                             std::string(endingName(e.play.time.ending)));
           },
           [](Explorer& e, std::string_view t) { e.play.time.ending = parseEnding(t); }},
    Choice{"", "play.backward", Form::Flag,
           [](const Explorer& e) {
               return unless(e.play.time.direction == timeseries::Direction::Forward, flag(true));
           },
           [](Explorer& e, std::string_view t) {
               e.play.time.direction =
                   isOn(t) ? timeseries::Direction::Backward : timeseries::Direction::Forward;
           }},
    Choice{"", "play.realTimes", Form::Flag,
           [](const Explorer& e) {
               return unless(e.play.time.pace == timeseries::Pace::Even, flag(true));
           },
           [](Explorer& e, std::string_view t) {
               e.play.time.pace = isOn(t) ? timeseries::Pace::RealTimes : timeseries::Pace::Even;
           }},
    Choice{"", "play.stepsPerSecond", Form::Number,
           [](const Explorer& e) {
               return unless(e.play.time.stepsPerSecond == kTime.stepsPerSecond,
                             numberText(e.play.time.stepsPerSecond));
           },
           [](Explorer& e, std::string_view t) {
               e.play.time.stepsPerSecond = number(t, 0, kMostFinite);
           }},
    Choice{"", "play.timeUnitsPerSecond", Form::Number,
           [](const Explorer& e) {
               return unless(e.play.time.timeUnitsPerSecond == kTime.timeUnitsPerSecond,
                             numberText(e.play.time.timeUnitsPerSecond));
           },
           [](Explorer& e, std::string_view t) {
               e.play.time.timeUnitsPerSecond = number(t, 0, kMostFinite);
           }},
    Choice{"", "play.timeMoves", Form::Flag,
           [](const Explorer& e) { return unless(e.play.timeMoves, flag(false)); },
           [](Explorer& e, std::string_view t) { e.play.timeMoves = isOn(t); }},
    Choice{"", "play.sweepMoves", Form::Flag,
           [](const Explorer& e) { return unless(e.play.sweepMoves, flag(false)); },
           [](Explorer& e, std::string_view t) { e.play.sweepMoves = isOn(t); }},
    // Of a sweep that stands it is the sweep's.
    Choice{"", "play.tick", Form::Whole,
           [](const Explorer& e) {
               return unless(e.oneTick || e.play.tick == kPlay.tick, wholeText(e.play.tick));
           },
           [](Explorer& e, std::string_view t) {
               const std::int64_t tick = whole(t, 0);
               if (!e.oneTick) e.play.tick = tick;
           }},
};

}  // namespace

std::span<const Choice> choices() { return kChoices; }

const Choice& choiceOf(std::string_view option) {
    return *std::ranges::find(kChoices, option, [](const Choice& c) { return c.option; });
}

std::optional<Flaw> flawOf(const Explorer& e) {
    if (e.layers.size() > render::kMaxLayers)
        return Flaw{"layers", fmt::format("{} layers are more than the {} that are drawn at once",
                                          e.layers.size(), render::kMaxLayers)};
    if (e.play.time.first > e.play.time.last)
        return Flaw{"play.last", fmt::format("the last step {} lies before the first {}",
                                             e.play.time.last, e.play.time.first)};
    const auto* const sweep = sweepOf(e);
    if (sweep == nullptr) return std::nullopt;
    const std::int64_t ticks = ticksOf(*sweep);
    if (e.oneTick && e.play.tick >= ticks)
        return Flaw{"sweep.tick",
                    fmt::format("{} is none of the sweep's, 0 to {}", e.play.tick, ticks - 1)};
    return std::nullopt;
}

std::int64_t ticksOf(timeseries::SweepSettings settings) {
    settings.animation = RangeSet::parse("0");  // unbounded ends become finite later
    return timeseries::ValueSweep(settings).ticksPerCycle();
}

}  // namespace app
