// Text forms of a user's choices, shared by the command line and session files. Each parser throws
// ChoiceError: one sentence that quotes the text and says what was expected.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "app/choices/explorer.h"

namespace app {

struct ChoiceError : std::invalid_argument {
    using std::invalid_argument::invalid_argument;
};

// "12", "0:30", "3:" to the last, "0:30:5" and "3::5" every fifth of these, "all".
StepChoice parseSteps(std::string_view text);
std::string stepsText(const StepChoice& steps);

glm::dvec3 parseColor(std::string_view text);  // "#rrggbb" -> [0, 1], sRGB
std::string colorText(const glm::dvec3& srgb);

ClipBox parseClip(std::string_view text);  // "x0:x1,y0:y1,z0:z1", min and max allowed
std::string clipText(const ClipBox& clip);

// How much an axis may be stretched: units differ by as much, and beyond it no picture has room.
inline constexpr double kLeastStretch = 1e-12, kMostStretch = 1e12;
// "z", "x,z", "none": which axes are drawn the other way round.
std::array<bool, 3> parseFlips(std::string_view text);
std::string flipsText(const std::array<AxisChoice, 3>& axes);
// "z=depth".
std::pair<std::size_t, std::string> parseAxisName(std::string_view text);

glm::dvec3 parseScale(std::string_view text);  // "1,1,20", each within these
// A view that is asked for stands in the middle of the picture, unless its shift is asked for, too.
void choose(ViewChoice& view);
// "30,20" or "30,20,4.5": from where, and how far away; what is looked at stays.
void takeView(ViewChoice& view, std::string_view text);
std::string viewText(const ViewChoice& view);
// What an eye's distance may be, to the centre and to zero parallax, in half diagonals: beyond, the
// box has no depth left.
inline constexpr double kNearest = 1e-6, kFarthest = 1e6;
glm::dvec3 parseTarget(std::string_view text);  // "0.1,0,-0.2", each within +-kFarthest
inline constexpr double kMostShift = 1;         // to the picture's sides
inline constexpr std::string_view kAuto = "auto";
// "0.1,-0.05", each within +-kMostShift; none of kAuto.
std::optional<glm::dvec2> parseShift(std::string_view text);
std::string shiftText(const std::optional<glm::dvec2>& shift);
glm::ivec2 parseSize(std::string_view text);  // "1200x900"
render::ColorMap parseColorMap(std::string_view name);

// "viridis", or with the values of its ends, "viridis=300:1600", either of which may be left out.
MapChoice parseMap(std::string_view text);
std::string mapText(const MapChoice& map);

inline constexpr double kMostFinite = std::numeric_limits<double>::max();

// One finite number, read as the nearest double. `what` names it in the error.
double parseNumber(std::string_view what, std::string_view text);

Projection parseProjection(std::string_view name);  // perspective orthographic
std::string_view projectionName(Projection projection);
bool parseLegend(std::string_view name);  // shown hidden
std::string_view legendName(bool shown);
timeseries::Ending parseEnding(std::string_view name);  // once loop ping-pong
std::string_view endingName(timeseries::Ending ending);
Stereo parseStereo(std::string_view name);  // off side-by-side top-bottom multiview left-right
std::string_view stereoName(Stereo stereo);
Model parseModel(std::string_view name);                      // points cells
std::optional<Model> parseLayerModel(std::string_view name);  // auto: as all layers are
std::string_view modelName(Model model);
render::Light parseLight(std::string_view name);  // off soft full
std::string_view lightName(render::Light light);
std::optional<LampChoice> parseLamp(std::string_view text);  // head, or "10,50" degrees
std::string lampText(const std::optional<LampChoice>& lamp);
render::OpacityPer parseOpacityPer(std::string_view name);  // length crossing
std::string_view opacityPerName(render::OpacityPer per);
render::Kernel parseKernel(std::string_view name);  // kernel point
std::string_view kernelName(render::Kernel kernel);
render::Order parseOrder(std::string_view name);  // none depth
std::string_view orderName(render::Order order);
render::Map parseMapKind(std::string_view name);  // flat globe
std::string_view mapKindName(render::Map map);

}  // namespace app
