#include "app/choices/choice_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <utility>

namespace app {
namespace {

constexpr std::string_view kAxes = "xyz";

template <typename T>
std::optional<T> numberIn(std::string_view text) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (std::size_t begin = 0;;) {
        const std::size_t end = text.find(separator, begin);
        parts.push_back(text.substr(begin, end - begin));
        if (end == std::string_view::npos) return parts;
        begin = end + 1;
    }
}

std::optional<std::vector<double>> numbers(std::string_view text) {
    std::vector<double> out;
    for (const std::string_view part : split(text, ',')) {
        const auto number = numberIn<double>(part);
        if (!number || !std::isfinite(*number)) return std::nullopt;
        out.push_back(*number);
    }
    return out;
}

timeseries::RangeSet rangeOf(std::string_view clip, std::string_view side) {
    try {
        return timeseries::RangeSet::parse(side);
    } catch (const timeseries::RangeSyntaxError& error) {
        throw ChoiceError(fmt::format("clip '{}': {}", clip, error.what()));
    }
}

// A name of a short list, both ways.
template <typename T>
using Names = std::span<const std::pair<std::string_view, T>>;

template <typename T>
T named(std::string_view what, std::string_view name, Names<T> names) {
    std::vector<std::string_view> known;
    for (const auto& [each, value] : names) {
        if (each == name) return value;
        known.push_back(each);
    }
    throw ChoiceError(fmt::format("{} '{}' is not one of {}", what, name, fmt::join(known, ", ")));
}

template <typename T>
std::string_view nameOf(T value, Names<T> names) {
    for (const auto& [name, each] : names)
        if (each == value) return name;
    return {};
}

constexpr std::array<std::pair<std::string_view, Stereo>, 5> kStereo = {
    {{"off", Stereo::Off},
     {"side-by-side", Stereo::SideBySide},
     {"top-bottom", Stereo::TopBottom},
     {"multiview", Stereo::MultiView},
     {"left-right", Stereo::LeftRight}}};
constexpr std::array<std::pair<std::string_view, Model>, 3> kModels = {
    {{"points", Model::Points}, {"cells", Model::Cells}, {"auto", Model::Cells}}};
constexpr std::array<std::pair<std::string_view, render::Light>, 3> kLights = {
    {{"off", render::Light::Off}, {"soft", render::Light::Soft}, {"full", render::Light::Full}}};
constexpr std::array<std::pair<std::string_view, render::OpacityPer>, 2> kOpacityPers = {
    {{"length", render::OpacityPer::Length}, {"crossing", render::OpacityPer::Crossing}}};
constexpr std::array<std::pair<std::string_view, render::Kernel>, 2> kKernels = {
    {{"kernel", render::Kernel::Quartic}, {"point", render::Kernel::Point}}};
constexpr std::array<std::pair<std::string_view, render::Order>, 2> kOrders = {
    {{"none", render::Order::None}, {"depth", render::Order::BackToFront}}};
constexpr std::array<std::pair<std::string_view, render::Map>, 2> kMaps = {
    {{"flat", render::Map::Flat}, {"globe", render::Map::Globe}}};

constexpr std::array<std::pair<std::string_view, Projection>, 2> kProjections = {
    {{"perspective", Projection::Perspective}, {"orthographic", Projection::Orthographic}}};
constexpr std::array<std::pair<std::string_view, bool>, 2> kLegends = {
    {{"shown", true}, {"hidden", false}}};
constexpr std::array<std::pair<std::string_view, timeseries::Ending>, 3> kEndings = {
    {{"once", timeseries::Ending::Once},
     {"loop", timeseries::Ending::Loop},
     {"ping-pong", timeseries::Ending::PingPong}}};

}  // namespace

StepChoice parseSteps(std::string_view text) {
    if (text == "all") return {};
    const auto refusal = [&] {
        return ChoiceError(
            fmt::format("step '{}' is not a step counted from 0, a range A:B with A <= B, every "
                        "S-th step of it A:B:S, or all",
                        text));
    };
    const auto number = [&](std::string_view part) {
        const auto n = numberIn<std::size_t>(part);
        if (!n) throw refusal();
        return *n;
    };
    const auto parts = split(text, ':');
    StepChoice steps{number(parts.front()), {}};
    if (parts.size() == 1) steps.last = steps.first;
    if (parts.size() > 1 && !parts[1].empty()) steps.last = number(parts[1]);
    if (parts.size() > 2) steps.stride = number(parts[2]);
    if (parts.size() > 3 || steps.stride == 0 || (steps.last && *steps.last < steps.first))
        throw refusal();
    return steps;
}

std::string stepsText(const StepChoice& steps) {
    if (!steps.last && steps.first == 0 && steps.stride == 1) return "all";
    if (steps.last == steps.first && steps.stride == 1) return fmt::format("{}", steps.first);
    std::string text = fmt::format("{}:", steps.first);
    if (steps.last) text += fmt::format("{}", *steps.last);
    if (steps.stride != 1) text += fmt::format(":{}", steps.stride);
    return text;
}

glm::dvec3 parseColor(std::string_view text) {
    std::uint32_t rgb = 0;
    const auto [end, error] =
        std::from_chars(text.data() + (text.empty() ? 0 : 1), text.data() + text.size(), rgb, 16);
    if (text.size() != 7 || text[0] != '#' || error != std::errc{} || end != text.data() + 7)
        throw ChoiceError(fmt::format("color '{}' is not of the form #rrggbb", text));
    return glm::dvec3(rgb >> 16, rgb >> 8 & 255, rgb & 255) / 255.0;
}

std::string colorText(const glm::dvec3& srgb) {
    const auto byte = [](double c) { return static_cast<int>(std::lround(c * 255)); };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(srgb.r), byte(srgb.g), byte(srgb.b));
}

ClipBox parseClip(std::string_view text) {
    const auto parts = split(text, ',');
    if (parts.size() != 3)
        throw ChoiceError(fmt::format(
            "clip '{}' is not of the form x0:x1,y0:y1,z0:z1 (min and max allowed)", text));
    ClipBox box{};
    for (int a = 0; a < 3; ++a) {
        const auto set = rangeOf(text, parts[a]);
        const timeseries::Range& range = set.ranges().front();
        if (range.lo.open || range.hi.open)
            throw ChoiceError(
                fmt::format("clip '{}': a box has closed ends, without brackets", text));
        box.lo[a] = timeseries::toDouble(range.lo.value);
        box.hi[a] = timeseries::toDouble(range.hi.value);
    }
    return box;
}

std::string clipText(const ClipBox& clip) {
    const auto side = [&](int a) {
        return timeseries::RangeSet(std::vector{timeseries::Range{{clip.lo[a]}, {clip.hi[a]}}})
            .text();
    };
    return fmt::format("{},{},{}", side(0), side(1), side(2));
}

std::array<bool, 3> parseFlips(std::string_view text) {
    std::array<bool, 3> flips{};
    if (text == "none") return flips;
    for (const std::string_view part : split(text, ',')) {
        const std::size_t a = part.size() == 1 ? kAxes.find(part) : std::string_view::npos;
        if (a == std::string_view::npos || flips[a])
            throw ChoiceError(fmt::format(
                "flip '{}' is none of x, y, z, several of them with commas, or none", text));
        flips[a] = true;
    }
    return flips;
}

std::string flipsText(const std::array<AxisChoice, 3>& axes) {
    std::string text;
    for (std::size_t a = 0; a < 3; ++a)
        if (axes[a].flip) text += fmt::format("{}{}", text.empty() ? "" : ",", kAxes[a]);
    return text.empty() ? "none" : text;
}

std::pair<std::size_t, std::string> parseAxisName(std::string_view text) {
    const std::size_t a = text.empty() ? std::string_view::npos : kAxes.find(text.front());
    if (a == std::string_view::npos || text.size() < 3 || text[1] != '=')
        throw ChoiceError(
            fmt::format("name-axis '{}' is not of the form x=NAME, y=NAME or z=NAME", text));
    return {a, std::string(text.substr(2))};
}

glm::dvec3 parseScale(std::string_view text) {
    const auto n = numbers(text);
    const auto isStretch = [](double x) { return x >= kLeastStretch && x <= kMostStretch; };
    if (!n || n->size() != 3 || !std::ranges::all_of(*n, isStretch))
        throw ChoiceError(fmt::format("scale '{}' is not three numbers x,y,z, each from {} to {}",
                                      text, kLeastStretch, kMostStretch));
    return {(*n)[0], (*n)[1], (*n)[2]};
}

void choose(ViewChoice& view) {
    view.chosen = true;
    view.shift = glm::dvec2(0);
}
void takeView(ViewChoice& view, std::string_view text) {
    const auto n = numbers(text);
    if (!n || n->size() < 2 || n->size() > 3 ||
        (n->size() == 3 && !((*n)[2] >= kNearest && (*n)[2] <= kFarthest)))
        throw ChoiceError(fmt::format(
            "view '{}' is not azimuth,elevation in degrees, with a distance of {} to {} if wanted",
            text, kNearest, kFarthest));
    view.azimuthDegrees = (*n)[0];
    view.elevationDegrees = (*n)[1];
    choose(view);
    view.distance = n->size() == 3 ? std::optional((*n)[2]) : std::nullopt;
}
std::string viewText(const ViewChoice& view) {
    std::string text = fmt::format("{},{}", view.azimuthDegrees, view.elevationDegrees);
    if (view.distance) text += fmt::format(",{}", *view.distance);
    return text;
}

glm::dvec3 parseTarget(std::string_view text) {
    const auto n = numbers(text);
    const auto isNear = [](double x) { return std::abs(x) <= kFarthest; };
    if (!n || n->size() != 3 || !std::ranges::all_of(*n, isNear))
        throw ChoiceError(
            fmt::format("target '{}' is not x,y,z in half diagonals of the box, each from {} to {}",
                        text, -kFarthest, kFarthest));
    return {(*n)[0], (*n)[1], (*n)[2]};
}

std::optional<glm::dvec2> parseShift(std::string_view text) {
    if (text == kAuto) return std::nullopt;
    const auto n = numbers(text);
    const auto isNear = [](double x) { return std::abs(x) <= kMostShift; };
    if (!n || n->size() != 2 || !std::ranges::all_of(*n, isNear))
        throw ChoiceError(
            fmt::format("shift '{}' is not {}, nor x,y in halves of the picture's sides, each from "
                        "{} to {}",
                        text, kAuto, -kMostShift, kMostShift));
    return glm::dvec2((*n)[0], (*n)[1]);
}
std::string shiftText(const std::optional<glm::dvec2>& shift) {
    return shift ? fmt::format("{},{}", shift->x, shift->y) : std::string(kAuto);
}

glm::ivec2 parseSize(std::string_view text) {
    const auto parts = split(text, 'x');
    const auto width = numberIn<int>(parts.front()), height = numberIn<int>(parts.back());
    constexpr int kMost = 16384;
    if (parts.size() != 2 || !width || !height || *width < 1 || *height < 1 || *width > kMost ||
        *height > kMost)
        throw ChoiceError(
            fmt::format("size '{}' is not WxH with 1 to {} pixels a side", text, kMost));
    return {*width, *height};
}

render::ColorMap parseColorMap(std::string_view name) {
    if (const auto map = render::colorMapNamed(name)) return *map;
    throw ChoiceError(fmt::format("colormap '{}' is not one of {}", name,
                                  fmt::join(render::colorMapNames(), ", ")));
}

MapChoice parseMap(std::string_view text) {
    const std::size_t equals = text.find('=');
    MapChoice map{parseColorMap(text.substr(0, equals)), {}, {}};
    if (equals == std::string_view::npos) return map;
    const auto ends = split(text.substr(equals + 1), ':');
    const auto read = [&](std::string_view end, std::optional<double>& into) {
        if (!end.empty()) into = parseNumber("an end of colormap", end);
    };
    if (ends.size() != 2)
        throw ChoiceError(fmt::format("colormap '{}' is not of the form NAME or NAME=LO:HI", text));
    read(ends[0], map.lo);
    read(ends[1], map.hi);
    return map;
}

std::string mapText(const MapChoice& map) {
    const auto end = [](const std::optional<double>& value) {
        return value ? fmt::format("{}", *value) : std::string();
    };
    if (!map.lo && !map.hi) return std::string(map.map.name());
    return fmt::format("{}={}:{}", map.map.name(), end(map.lo), end(map.hi));
}

double parseNumber(std::string_view what, std::string_view text) {
    const auto number = numberIn<double>(text);
    if (!number || !std::isfinite(*number))
        throw ChoiceError(
            fmt::format("{}{}'{}' is not a finite number", what, what.empty() ? "" : " ", text));
    return *number;
}

Projection parseProjection(std::string_view name) {
    return named<Projection>("projection", name, kProjections);
}
std::string_view projectionName(Projection projection) {
    return nameOf<Projection>(projection, kProjections);
}
bool parseLegend(std::string_view name) { return named<bool>("legend", name, kLegends); }
std::string_view legendName(bool shown) { return nameOf(shown, Names<bool>(kLegends)); }
timeseries::Ending parseEnding(std::string_view name) {
    return named<timeseries::Ending>("ending", name, kEndings);
}
std::string_view endingName(timeseries::Ending ending) {
    return nameOf<timeseries::Ending>(ending, kEndings);
}
Stereo parseStereo(std::string_view name) { return named<Stereo>("stereo", name, kStereo); }
std::string_view stereoName(Stereo stereo) { return nameOf<Stereo>(stereo, kStereo); }
render::Map parseMapKind(std::string_view name) { return named<render::Map>("map", name, kMaps); }
std::string_view mapKindName(render::Map map) { return nameOf<render::Map>(map, kMaps); }
Model parseModel(std::string_view name) { return named<Model>("model", name, kModels); }
std::optional<Model> parseLayerModel(std::string_view name) {
    return name == "auto" ? std::nullopt : std::optional(parseModel(name));
}
std::string_view modelName(Model model) { return nameOf<Model>(model, kModels); }

render::Light parseLight(std::string_view name) {
    return named<render::Light>("light", name, kLights);
}

std::string_view lightName(render::Light light) { return nameOf<render::Light>(light, kLights); }
std::optional<LampChoice> parseLamp(std::string_view text) {
    if (text == "head") return std::nullopt;
    const auto n = numbers(text);
    if (!n || n->size() != 2)
        throw ChoiceError(
            fmt::format("light from '{}' is neither head nor azimuth,elevation in degrees", text));
    return LampChoice{(*n)[0], (*n)[1]};
}
std::string lampText(const std::optional<LampChoice>& lamp) {
    return lamp ? fmt::format("{},{}", lamp->azimuthDegrees, lamp->elevationDegrees) : "head";
}
render::OpacityPer parseOpacityPer(std::string_view name) {
    return named<render::OpacityPer>("opacity per", name, kOpacityPers);
}
std::string_view opacityPerName(render::OpacityPer per) {
    return nameOf<render::OpacityPer>(per, kOpacityPers);
}
render::Kernel parseKernel(std::string_view name) {
    return named<render::Kernel>("splat", name, kKernels);
}
std::string_view kernelName(render::Kernel kernel) {
    return nameOf<render::Kernel>(kernel, kKernels);
}
render::Order parseOrder(std::string_view name) {
    return named<render::Order>("order", name, kOrders);
}
std::string_view orderName(render::Order order) { return nameOf<render::Order>(order, kOrders); }

}  // namespace app
