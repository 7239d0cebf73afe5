#include "app/session.h"

#include <fmt/format.h>

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "app/choice_text.h"
#include "timeseries/reader.h"

namespace app {
namespace {

using nlohmann::json;
using timeseries::FileError;
using timeseries::RangeSet;

constexpr int kVersion = 1;

// One JSON object being read: every key must be asked for, and be of the type asked for.
class Object {
 public:
    Object(const json& object, std::string where) : object_(object), where_(std::move(where)) {
        if (!object.is_object()) throw ChoiceError(fmt::format("{} is not a JSON object", where_));
    }
    // Calls use(value) when the key is there.
    template <typename T, typename Use>
    void read(const char* key, const Use& use) {
        known_.insert(key);
        const auto found = object_.find(key);
        if (found == object_.end()) return;
        if (!is<T>(*found))
            throw ChoiceError(fmt::format("{}.{} is not {}", where_, key, expected<T>()));
        try {
            // No copy of what is read further on: copies of deep nesting overflow the stack.
            if constexpr (std::is_same_v<T, json>)
                use(*found);
            else
                use(found->get<T>());
        } catch (const std::invalid_argument& error) {
            throw ChoiceError(fmt::format("{}.{}: {}", where_, key, error.what()));
        }
    }
    std::string place(const char* key) const { return fmt::format("{}.{}", where_, key); }
    void refuseOthers() const {
        for (const auto& [key, value] : object_.items())
            if (!known_.contains(key))
                throw ChoiceError(fmt::format("{} has an unknown key '{}'", where_, key));
    }

 private:
    // Stricter than nlohmann's conversions, which take true for 1 and 2.7 for 2.
    template <typename T>
    static bool is(const json& value) {
        if constexpr (std::is_same_v<T, std::string>) return value.is_string();
        if constexpr (std::is_same_v<T, bool>) return value.is_boolean();
        if constexpr (std::is_same_v<T, double>) return value.is_number();
        if constexpr (std::is_same_v<T, std::int64_t>)
            return value.is_number_integer() &&
                   (!value.is_number_unsigned() ||
                    value.get<std::uint64_t>() <= std::numeric_limits<std::int64_t>::max());
        if constexpr (std::is_same_v<T, std::vector<std::string>>)
            return value.is_array() && std::ranges::all_of(value, is<std::string>);
        if constexpr (std::is_same_v<T, std::vector<double>>)
            return value.is_array() && std::ranges::all_of(value, is<double>);
        return true;
    }
    template <typename T>
    static const char* expected() {
        if constexpr (std::is_same_v<T, std::string>) return "a text";
        if constexpr (std::is_same_v<T, bool>) return "true or false";
        if constexpr (std::is_same_v<T, std::int64_t>) return "a whole number";
        if constexpr (std::is_same_v<T, double>) return "a number";
        if constexpr (std::is_same_v<T, std::vector<double>>) return "a list of numbers";
        return "a list of texts";
    }
    const json& object_;
    std::string where_;
    std::set<std::string> known_;
};

double within(double value, const char* what, double lo, double hi) {
    if (!(value >= lo && value <= hi))
        throw ChoiceError(fmt::format("{} {} is not a number from {} to {}", what, value, lo, hi));
    return value;
}

void writeStyle(json& out, const LayerChoice& layer) {
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

LayerChoice readStyle(Object& object) {
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
    return layer;
}

json sweepJson(const Explorer& explorer) {
    const timeseries::SweepSettings& s = *explorer.sweep;
    json out{{"animation", s.animation.text()}, {"delta", s.delta},
             {"timerSteps", s.timerSteps},      {"timerStep", s.step},
             {"frequency", s.frequency},        {"swing", s.path == timeseries::SweepPath::Swing}};
    writeStyle(out, explorer.sweepLayer);
    return out;
}

void readSweep(const json& value, const std::string& where, Explorer& explorer) {
    Object object(value, where);
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
    explorer.sweepLayer = readStyle(object);
    object.refuseOthers();
    if (s.animation.empty()) throw ChoiceError("has no animation");
    // The settings as the sweep itself checks them; unbounded ends become finite later.
    timeseries::SweepSettings finite = s;
    finite.animation = RangeSet::parse("0");
    timeseries::ValueSweep{finite};
    explorer.sweep = s;
}

}  // namespace

json toJson(const Explorer& e, const std::filesystem::path& folder) {
    json out{{"isochron", kVersion}};
    const auto normal = [](const std::filesystem::path& path) {
        return std::filesystem::absolute(path.empty() ? "." : path).lexically_normal();
    };
    for (const auto& file : e.files) {
        const auto near = normal(file).lexically_relative(normal(folder));
        out["files"].push_back((near.empty() ? file : near).generic_string());
    }
    if (!e.variable.empty()) out["variable"] = e.variable;
    if (e.steps) out["steps"] = stepsText(*e.steps);
    if (e.keep) out["keep"] = e.keep->text();
    for (const LayerChoice& layer : e.layers) {
        json each = json::object();
        if (!layer.ranges.empty()) each["range"] = layer.ranges.text();
        writeStyle(each, layer);
        out["layers"].push_back(each);
    }
    if (e.sweep) out["sweep"] = sweepJson(e);
    out["splat"] = kernelName(e.footprint.kernel);
    out["splatSize"] = e.footprint.size;
    out["order"] = orderName(e.order);
    if (e.clip) out["clip"] = clipText(*e.clip);
    if (e.scale) out["scale"] = {e.scale->x, e.scale->y, e.scale->z};
    out["view"] = {{"azimuth", e.view.azimuthDegrees}, {"elevation", e.view.elevationDegrees}};
    if (e.view.distance) out["view"]["distance"] = *e.view.distance;
    out["stereo"] = {{"mode", stereoName(e.stereo.mode)}};
    if (e.stereo.eyeDistance) out["stereo"]["eyeDistance"] = *e.stereo.eyeDistance;
    if (e.stereo.convergence) out["stereo"]["convergence"] = *e.stereo.convergence;
    out["size"] = fmt::format("{}x{}", e.size.x, e.size.y);
    return out;
}

Explorer fromJson(const json& value, const std::filesystem::path& folder) {
    Explorer e;
    Object object(value, "session");
    std::int64_t version = 0;
    object.read<std::int64_t>("isochron", [&](std::int64_t v) { version = v; });
    if (version != kVersion)
        throw ChoiceError(
            fmt::format("session.isochron is not {}, the version read here", kVersion));
    object.read<std::vector<std::string>>("files", [&](const auto& files) {
        for (const std::string& file : files) e.files.push_back((folder / file).lexically_normal());
    });
    object.read<std::string>("variable", [&](const std::string& v) { e.variable = v; });
    object.read<std::string>("steps", [&](const std::string& s) { e.steps = parseSteps(s); });
    object.read<std::string>("keep", [&](const std::string& k) { e.keep = RangeSet::parse(k); });
    object.read<json>("layers", [&](const json& layers) {
        if (!layers.is_array()) throw ChoiceError("is not a list");
        for (std::size_t i = 0; i < layers.size(); ++i) {
            Object each(layers[i], fmt::format("session.layers[{}]", i));
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
    object.read<json>("view", [&](const json& v) {
        Object view(v, object.place("view"));
        view.read<double>("azimuth", [&](double d) { e.view.azimuthDegrees = d; });
        view.read<double>("elevation", [&](double d) { e.view.elevationDegrees = d; });
        view.read<double>("distance", [&](double d) {
            e.view.distance = within(d, "distance", kNearest, kFarthest);
        });
        view.refuseOthers();
    });
    object.read<json>("stereo", [&](const json& v) {
        Object stereo(v, object.place("stereo"));
        stereo.read<std::string>("mode",
                                 [&](const std::string& m) { e.stereo.mode = parseStereo(m); });
        stereo.read<double>("eyeDistance", [&](double d) {
            e.stereo.eyeDistance = within(d, "eye distance", 0, kFarthest);
        });
        stereo.read<double>("convergence", [&](double d) {
            e.stereo.convergence = within(d, "convergence", kNearest, kFarthest);
        });
        stereo.refuseOthers();
    });
    object.read<std::string>("size", [&](const std::string& s) { e.size = parseSize(s); });
    object.refuseOthers();
    return e;
}

Explorer readSession(const std::filesystem::path& file) {
    std::ifstream in(file);
    if (!in || std::filesystem::is_directory(file))
        throw FileError(fmt::format("{}: the session file cannot be opened", file.string()));
    try {
        return fromJson(json::parse(in), file.parent_path());
    } catch (const json::parse_error& error) {
        throw FileError(fmt::format("{}: not JSON at byte {}", file.string(), error.byte));
    } catch (const json::out_of_range&) {
        throw FileError(fmt::format("{}: holds a number beyond all doubles", file.string()));
    } catch (const ChoiceError& error) {
        throw FileError(fmt::format("{}: {}", file.string(), error.what()));
    }
}

}  // namespace app
