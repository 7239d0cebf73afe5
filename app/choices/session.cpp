#include "app/choices/session.h"

#include <fmt/format.h>

#include <fmt/ranges.h>

#include <array>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/choices/choice_text.h"
#include "app/choices/json_object.h"
#include "app/choices/paths.h"
#include "render/image/exr.h"
#include "render/image/png.h"
#include "timeseries/readers/reader.h"

namespace app {
namespace {

using nlohmann::json;
using timeseries::FileError;
using timeseries::RangeSet;

constexpr int kVersion = 1;
constexpr std::array kAxes = {"x", "y", "z"};

double within(double value, const char* what, double lo, double hi) {
    if (!(value >= lo && value <= hi))
        throw ChoiceError(fmt::format("{} {} is not a number from {} to {}", what, value, lo, hi));
    return value;
}

void writeStyle(json& out, const LayerChoice& layer) {
    if (!layer.visible) out["visible"] = false;
    if (layer.opacity) out["opacity"] = *layer.opacity;
    if (!layer.color) return;
    if (const auto* rgb = std::get_if<glm::dvec3>(&*layer.color)) {
        out["color"] = colorText(*rgb);
        return;
    }
    const auto& map = std::get<MapChoice>(*layer.color);
    out["colormap"] = map.map.name();
    if (map.lo) out["mapLow"] = *map.lo;
    if (map.hi) out["mapHigh"] = *map.hi;
}

LayerChoice readStyle(JsonObject& object) {
    LayerChoice layer;
    object.read<std::string>("color", [&](const std::string& c) { layer.color = parseColor(c); });
    object.read<std::string>("colormap", [&](const std::string& m) {
        layer.color = MapChoice{parseColorMap(m), {}, {}};
    });
    const auto end = [&](const char* key, auto member) {
        object.read<double>(key, [&](double v) {
            auto* map = layer.color ? std::get_if<MapChoice>(&*layer.color) : nullptr;
            if (map == nullptr) throw ChoiceError("needs a colormap beside it");
            map->*member = v;
        });
    };
    end("mapLow", &MapChoice::lo);
    end("mapHigh", &MapChoice::hi);
    object.read<double>("opacity", [&](double a) {
        if (!(a >= 0 && a <= 1)) throw ChoiceError("is not between 0 and 1");
        layer.opacity = a;
    });
    object.read<bool>("visible", [&](bool b) { layer.visible = b; });
    return layer;
}

json sweepJson(const Explorer& explorer) {
    const timeseries::SweepSettings& s = *explorer.sweep;
    json out{{"animation", s.animation.text()}, {"delta", s.delta},
             {"timerSteps", s.timerSteps},      {"timerStep", s.step},
             {"frequency", s.frequency},        {"swing", s.path == timeseries::SweepPath::Swing}};
    if (explorer.oneTick) out["tick"] = explorer.play.tick;
    writeStyle(out, explorer.sweepLayer);
    return out;
}

void readSweep(const json& value, const std::string& where, Explorer& explorer) {
    JsonObject object(value, where);
    timeseries::SweepSettings s;
    s.path = timeseries::SweepPath::Loop;
    object.read<std::string>("animation",
                             [&](const std::string& t) { s.animation = RangeSet::parse(t); });
    object.read<double>("delta", [&](double d) { s.delta = d; });
    object.read<std::int64_t>("timerSteps", [&](std::int64_t n) { s.timerSteps = n; });
    object.read<std::int64_t>("timerStep", [&](std::int64_t n) { s.step = n; });
    object.read<double>("frequency", [&](double f) { s.frequency = f; });
    object.read<bool>("swing", [&](bool b) {
        s.path = b ? timeseries::SweepPath::Swing : timeseries::SweepPath::Loop;
    });
    object.read<std::int64_t>("tick", [&](std::int64_t n) {
        explorer.oneTick = true;
        explorer.play.tick = n;
    });
    explorer.sweepLayer = readStyle(object);
    object.refuseOthers();
    if (s.animation.empty()) throw ChoiceError("has no animation");
    const std::int64_t ticks = ticksOf(s);
    if (explorer.oneTick && !(explorer.play.tick >= 0 && explorer.play.tick < ticks))
        throw ChoiceError(fmt::format("tick {} is none of 0 to {}", explorer.play.tick, ticks - 1));
    explorer.sweep = s;
}

void readAxes(const json& value, const std::string& where, Explorer& explorer) {
    JsonObject object(value, where);
    for (std::size_t a = 0; a < 3; ++a)
        object.read<json>(kAxes[a], [&](const json& axis) {
            JsonObject each(axis, object.place(kAxes[a]));
            each.read<bool>("flip", [&](bool b) { explorer.axes[a].flip = b; });
            each.read<std::string>("name",
                                   [&](const std::string& n) { explorer.axes[a].name = n; });
            each.refuseOthers();
        });
    object.refuseOthers();
}

json viewJson(const ViewChoice& view) {
    json out{{"azimuth", view.azimuthDegrees}, {"elevation", view.elevationDegrees}};
    if (view.distance) out["distance"] = *view.distance;
    if (view.target != glm::dvec3(0)) out["target"] = {view.target.x, view.target.y, view.target.z};
    if (view.projection != Projection::Perspective)
        out["projection"] = projectionName(view.projection);
    return out;
}

ViewChoice readView(const json& value, const std::string& where) {
    JsonObject object(value, where);
    ViewChoice view;
    object.read<double>("azimuth", [&](double d) { view.azimuthDegrees = d; });
    object.read<double>("elevation", [&](double d) { view.elevationDegrees = d; });
    object.read<double>(
        "distance", [&](double d) { view.distance = within(d, "distance", kNearest, kFarthest); });
    object.read<std::vector<double>>("target", [&](const std::vector<double>& t) {
        view.target = parseTarget(fmt::format("{}", fmt::join(t, ",")));
    });
    object.read<std::string>("projection",
                             [&](const std::string& p) { view.projection = parseProjection(p); });
    object.refuseOthers();
    return view;
}

// Only what differs from a play that nobody has touched; nothing at all, if so. The tick of a sweep
// that stands is the sweep's.
json playJson(const PlayChoice& play, bool oneTick) {
    json out = json::object();
    const auto put = [&out](const char* key, const auto& value, const auto& untouched) {
        if (value != untouched) out[key] = value;
    };
    const PlayChoice untouched;
    const timeseries::CursorSettings &time = play.time, &plain = untouched.time;
    put("first", time.first, plain.first);
    put("last", time.last, plain.last);
    put("stride", time.stride, plain.stride);
    put("ending", endingName(time.ending), endingName(plain.ending));
    put("backward", time.direction == timeseries::Direction::Backward, false);
    put("realTimes", time.pace == timeseries::Pace::RealTimes, false);
    put("stepsPerSecond", time.stepsPerSecond, plain.stepsPerSecond);
    put("timeUnitsPerSecond", time.timeUnitsPerSecond, plain.timeUnitsPerSecond);
    put("timeMoves", play.timeMoves, untouched.timeMoves);
    put("sweepMoves", play.sweepMoves, untouched.sweepMoves);
    if (!oneTick) put("tick", play.tick, untouched.tick);
    return out;
}

PlayChoice readPlay(const json& value, const std::string& where) {
    JsonObject object(value, where);
    PlayChoice play;
    timeseries::CursorSettings& time = play.time;
    const auto count = [&](const char* key, std::int64_t least, auto& into) {
        object.read<std::int64_t>(key, [&, least](std::int64_t n) {
            if (n < least) throw ChoiceError(fmt::format("{} is less than {}", n, least));
            into = static_cast<std::decay_t<decltype(into)>>(n);
        });
    };
    const auto speed = [&](const char* key, double& into) {
        object.read<double>(key, [&](double d) {
            into = within(d, "speed", 0, std::numeric_limits<double>::max());
        });
    };
    count("first", 0, time.first);
    count("last", 0, time.last);
    if (time.first > time.last)
        throw ChoiceError(
            fmt::format("the first step {} lies after the last {}", time.first, time.last));
    count("stride", 1, time.stride);
    object.read<std::string>("ending",
                             [&](const std::string& name) { time.ending = parseEnding(name); });
    object.read<bool>("backward", [&](bool b) {
        time.direction = b ? timeseries::Direction::Backward : timeseries::Direction::Forward;
    });
    object.read<bool>("realTimes", [&](bool b) {
        time.pace = b ? timeseries::Pace::RealTimes : timeseries::Pace::Even;
    });
    speed("stepsPerSecond", time.stepsPerSecond);
    speed("timeUnitsPerSecond", time.timeUnitsPerSecond);
    object.read<bool>("timeMoves", [&](bool b) { play.timeMoves = b; });
    object.read<bool>("sweepMoves", [&](bool b) { play.sweepMoves = b; });
    count("tick", 0, play.tick);
    object.refuseOthers();
    return play;
}

json stereoJson(const StereoChoice& stereo) {
    json out{{"mode", stereoName(stereo.mode)}};
    if (stereo.eyeDistance) out["eyeDistance"] = *stereo.eyeDistance;
    if (stereo.convergence) out["convergence"] = *stereo.convergence;
    return out;
}

StereoChoice readStereo(const json& value, const std::string& where) {
    JsonObject object(value, where);
    StereoChoice stereo;
    object.read<std::string>("mode", [&](const std::string& m) { stereo.mode = parseStereo(m); });
    object.read<double>("eyeDistance", [&](double d) {
        stereo.eyeDistance = within(d, "eye distance", 0, kFarthest);
    });
    object.read<double>("convergence", [&](double d) {
        stereo.convergence = within(d, "convergence", kNearest, kFarthest);
    });
    object.refuseOthers();
    return stereo;
}

}  // namespace

json toJson(const Explorer& e, const std::filesystem::path& folder, Paths paths) {
    json out{{"isochron", kVersion}};
    for (const auto& file : e.files) {
        out["files"].push_back(relativeTo(folder, file).generic_string());
        if (paths == Paths::Both)
            out["filesWere"].push_back(
                std::filesystem::absolute(file).lexically_normal().generic_string());
    }
    if (!e.variable.empty()) out["variable"] = e.variable;
    if (e.steps) out["steps"] = stepsText(*e.steps);
    if (e.keep) out["keep"] = e.keep->text();
    for (std::size_t a = 0; a < 3; ++a) {
        if (e.axes[a].flip) out["axes"][kAxes[a]]["flip"] = true;
        if (!e.axes[a].name.empty()) out["axes"][kAxes[a]]["name"] = e.axes[a].name;
    }
    for (const LayerChoice& layer : e.layers) {
        json each = json::object();
        if (!layer.ranges.empty()) each["range"] = layer.ranges.text();
        writeStyle(each, layer);
        out["layers"].push_back(each);
    }
    if (e.layers.empty() && e.noLayers) out["layers"] = json::array();
    if (e.sweep) out["sweep"] = sweepJson(e);
    out["splat"] = kernelName(e.footprint.kernel);
    out["splatSize"] = e.footprint.size;
    out["order"] = orderName(e.order);
    if (e.clip) out["clip"] = clipText(*e.clip);
    if (e.scale) out["scale"] = {e.scale->x, e.scale->y, e.scale->z};
    out["view"] = viewJson(e.view);
    out["stereo"] = stereoJson(e.stereo);
    out["size"] = fmt::format("{}x{}", e.size.x, e.size.y);
    if (json play = playJson(e.play, e.oneTick); !play.empty()) out["play"] = std::move(play);
    return out;
}

Explorer fromJson(const json& value, const std::filesystem::path& folder) {
    Explorer e;
    JsonObject object(value, "session");
    std::int64_t version = 0;
    object.read<std::int64_t>("isochron", [&](std::int64_t v) { version = v; });
    if (version != kVersion)
        throw ChoiceError(
            fmt::format("session.isochron is not {}, the version read here", kVersion));
    object.read<std::vector<std::string>>("files", [&](const auto& files) {
        for (const std::string& file : files) e.files.push_back((folder / file).lexically_normal());
    });
    object.read<std::vector<std::string>>("filesWere", [&](const auto& were) {
        if (were.size() != e.files.size())
            throw ChoiceError(
                fmt::format("has {} paths for {} files", were.size(), e.files.size()));
        for (std::size_t i = 0; i < were.size(); ++i)
            if (isThere(were[i]) || !isThere(e.files[i])) e.files[i] = were[i];
    });
    object.read<std::string>("variable", [&](const std::string& v) { e.variable = v; });
    object.read<std::string>("steps", [&](const std::string& s) { e.steps = parseSteps(s); });
    object.read<std::string>("keep", [&](const std::string& k) { e.keep = RangeSet::parse(k); });
    object.read<json>("axes", [&](const json& a) { readAxes(a, object.place("axes"), e); });
    object.read<json>("layers", [&](const json& layers) {
        if (!layers.is_array()) throw ChoiceError("is not a list");
        e.noLayers = layers.empty();
        for (std::size_t i = 0; i < layers.size(); ++i) {
            JsonObject each(layers[i], fmt::format("session.layers[{}]", i));
            LayerChoice layer = readStyle(each);
            each.read<std::string>(
                "range", [&](const std::string& r) { layer.ranges = RangeSet::parse(r); });
            each.refuseOthers();
            e.layers.push_back(layer);
        }
    });
    object.read<json>("sweep", [&](const json& s) { readSweep(s, object.place("sweep"), e); });
    if (e.layers.size() + (e.sweep ? 1 : 0) > render::kMaxLayers)
        throw ChoiceError(fmt::format("session.layers has more than the {} that are drawn at once",
                                      render::kMaxLayers));
    object.read<std::string>("splat",
                             [&](const std::string& s) { e.footprint.kernel = parseKernel(s); });
    object.read<double>("splatSize",
                        [&](double s) { e.footprint.size = within(s, "size", 1e-3, 1e3); });
    object.read<std::string>("order", [&](const std::string& o) { e.order = parseOrder(o); });
    object.read<std::string>("clip", [&](const std::string& c) { e.clip = parseClip(c); });
    object.read<std::vector<double>>("scale", [&](const std::vector<double>& s) {
        e.scale = parseScale(fmt::format("{}", fmt::join(s, ",")));
    });
    object.read<json>("view", [&](const json& v) { e.view = readView(v, object.place("view")); });
    object.read<json>("stereo",
                      [&](const json& v) { e.stereo = readStereo(v, object.place("stereo")); });
    object.read<json>("play", [&](const json& p) {
        const std::int64_t standing = e.play.tick;
        e.play = readPlay(p, object.place("play"));
        if (e.oneTick) e.play.tick = standing;
    });
    object.read<std::string>("size", [&](const std::string& s) { e.size = parseSize(s); });
    object.refuseOthers();
    return e;
}

std::int64_t ticksOf(timeseries::SweepSettings settings) {
    settings.animation = RangeSet::parse("0");  // unbounded ends become finite later
    return timeseries::ValueSweep(settings).ticksPerCycle();
}

std::optional<std::filesystem::path> missingFile(const Explorer& session) {
    const auto missing = std::ranges::find_if_not(session.files, isThere);
    return missing == session.files.end() ? std::nullopt : std::optional(*missing);
}

namespace {

// The session that a picture carries; none where the file is no picture.
std::optional<std::string> embedded(const std::filesystem::path& file) {
    const auto ending = file.extension();
    if (ending != ".png" && ending != ".exr") return std::nullopt;
    const render::Metadata texts =
        ending == ".png" ? render::readPng(file).metadata : render::readExr(file).metadata;
    const auto found = texts.find(kSessionKey);
    if (found == texts.end())
        throw FileError(
            fmt::format("{}: the picture carries no session ({})", file.string(), kSessionKey));
    return found->second;
}

json jsonOf(const std::filesystem::path& file) {
    if (const auto text = embedded(file)) return json::parse(*text);
    std::ifstream in(file);
    if (!in || std::filesystem::is_directory(file))
        throw FileError(fmt::format("{}: the session file cannot be opened", file.string()));
    return json::parse(in);
}

}  // namespace

bool holdsSession(const std::filesystem::path& file) {
    const auto ending = file.extension();
    return ending == ".json" || ending == ".png" || ending == ".exr";
}

Explorer readSession(const std::filesystem::path& file) {
    try {
        return fromJson(jsonOf(file), file.parent_path());
    } catch (const json::parse_error& error) {
        throw FileError(fmt::format("{}: not JSON at byte {}", file.string(), error.byte));
    } catch (const json::out_of_range&) {
        throw FileError(fmt::format("{}: holds a number beyond all doubles", file.string()));
    } catch (const ChoiceError& error) {
        throw FileError(fmt::format("{}: {}", file.string(), error.what()));
    } catch (const render::ImageError& error) {
        throw FileError(error.what());
    }
}

}  // namespace app
