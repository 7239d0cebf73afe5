#include "app/choices/session.h"

#include <fmt/format.h>

#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/choices/choice_text.h"
#include "app/choices/choices.h"
#include "app/choices/json_object.h"
#include "app/choices/path_text.h"
#include "app/choices/paths.h"
#include "render/image/exr.h"
#include "render/image/picture_file.h"
#include "render/image/png.h"
#include "timeseries/readers/reader.h"
#include "timeseries/readers/text/words.h"

namespace app {
namespace {

using nlohmann::json;
using timeseries::FileError;
using timeseries::RangeSet;

constexpr int kVersion = 1;

void writeStyle(json& out, const LayerChoice& layer) {
    if (!layer.visible) out["visible"] = false;
    if (layer.opacity) out["opacity"] = *layer.opacity;
    if (layer.model) out["model"] = modelName(*layer.model);
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
    object.read<std::string>("model",
                             [&](const std::string& m) { layer.model = parseLayerModel(m); });
    object.read<bool>("visible", [&](bool b) { layer.visible = b; });
    return layer;
}

// The value that a session has for a choice's text.
json valueOf(Choice::Form form, const std::string& text) {
    switch (form) {
        case Choice::Form::Text:
            return text;
        case Choice::Form::Flag:
            return text == "true";
        case Choice::Form::Numbers:
            return json::parse("[" + text + "]");
        default:
            return json::parse(text);
    }
}

// And back: gives the text of the value at that key, if there is one, to `take`.
template <typename Take>
void readValue(JsonObject& object, Choice::Form form, const char* key, const Take& take) {
    const auto number = [&](auto value) { take(fmt::format("{}", value)); };
    switch (form) {
        case Choice::Form::Text:
            return object.read<std::string>(key, take);
        case Choice::Form::Flag:
            return object.read<bool>(key, number);
        case Choice::Form::Numbers:
            return object.read<std::vector<double>>(key, [&](const std::vector<double>& list) {
                take(fmt::format("{}", fmt::join(list, ",")));
            });
        case Choice::Form::Whole:
            return object.read<std::int64_t>(key, number);
        case Choice::Form::Number:
            return object.read<double>(key, number);
    }
}

// "axes.x" and "flip" of "axes.x.flip"; "" and all of it where there is no dot.
std::pair<std::string, const char*> splitKey(const char* key) {
    const std::string_view text = key;
    const std::size_t dot = text.rfind('.');
    if (dot == std::string_view::npos) return {"", key};
    return {std::string(text.substr(0, dot)), key + dot + 1};
}

void writeChoices(const Explorer& e, json& out) {
    for (const Choice& choice : choices()) {
        const auto text = choice.text(e);
        if (!text || *choice.key == '\0') continue;
        std::string path = fmt::format("/{}", choice.key);
        std::ranges::replace(path, '.', '/');
        out[json::json_pointer(path)] = valueOf(choice.form, *text);
    }
    if (sweepOf(e) != nullptr) writeStyle(out["sweep"], e.layers.front());
}

// The objects in a session that choices are in, by their keys.
class Objects {
 public:
    explicit Objects(JsonObject& session) : session_(session) {}
    // Null where there is none.
    JsonObject* of(const std::string& key) {
        if (key.empty()) return &session_;
        const bool isNew = !objects_.contains(key);
        std::optional<JsonObject>& object = objects_[key];
        if (isNew) {
            const auto [outer, last] = splitKey(key.c_str());
            if (JsonObject* const in = of(outer)) {
                const std::string place = in->place(last);
                in->read<json>(last, [&](const json& value) { object.emplace(value, place); });
            }
        }
        return object ? &*object : nullptr;
    }
    void refuseOthers() const {
        for (const auto& [key, object] : objects_)
            if (object) object->refuseOthers();
    }

 private:
    JsonObject& session_;
    std::map<std::string, std::optional<JsonObject>> objects_;
};

void readChoices(JsonObject& session, Explorer& e) {
    Objects objects(session);
    for (const Choice& choice : choices()) {
        if (*choice.key == '\0') continue;
        const auto [in, key] = splitKey(choice.key);
        if (JsonObject* const object = objects.of(in))
            readValue(*object, choice.form, key,
                      [&](const std::string& text) { choice.take(e, text); });
    }
    if (JsonObject* const sweep = objects.of("sweep")) {
        const auto* const settings = sweepOf(e);
        if (settings == nullptr) throw ChoiceError("session.sweep has no animation");
        LayerChoice swept = readStyle(*sweep);
        swept.motion = *settings;
        e.layers.front() = std::move(swept);
    }
    objects.refuseOthers();
}

}  // namespace

json toJson(const Explorer& e, const std::filesystem::path& folder, Paths paths) {
    json out{{"isochron", kVersion}};
    std::vector<std::string> files, were;
    for (const auto& file : e.files) {
        files.push_back(relativeTo(folder, file).generic_string());
        if (paths == Paths::Both)
            were.push_back(std::filesystem::absolute(file).lexically_normal().generic_string());
    }
    if (!std::ranges::all_of(files, isUtf8) || !std::ranges::all_of(were, isUtf8)) {
        out["filesEscaped"] = true;
        std::ranges::transform(files, files.begin(), escaped);
        std::ranges::transform(were, were.begin(), escaped);
    }
    if (!files.empty()) out["files"] = files;
    if (!were.empty()) out["filesWere"] = were;
    writeChoices(e, out);
    if (!e.stepTime.empty()) out["stepTime"] = e.stepTime;
    for (const LayerChoice& layer : e.layers) {
        if (layer.motion) continue;  // in "sweep"
        json each = json::object();
        if (!layer.ranges.empty()) each["range"] = layer.ranges.text();
        writeStyle(each, layer);
        out["layers"].push_back(each);
    }
    if (e.layers.empty() && e.noLayers) out["layers"] = json::array();
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
    bool areEscaped = false;
    object.read<bool>("filesEscaped", [&](bool are) { areEscaped = are; });
    const auto pathOf = [&](const std::string& text) {
        std::string path = areEscaped ? unescaped(text) : text;
        if (path.find('\0') != std::string::npos) throw ChoiceError("has a path with a NUL in it");
        return std::filesystem::path(std::move(path));
    };
    object.read<std::vector<std::string>>("files", [&](const auto& files) {
        for (const std::string& file : files)
            e.files.push_back((folder / pathOf(file)).lexically_normal());
    });
    object.read<std::vector<std::string>>("filesWere", [&](const auto& texts) {
        std::vector<std::filesystem::path> were;
        for (const std::string& text : texts) were.push_back(pathOf(text));
        if (were.size() != e.files.size())
            throw ChoiceError(
                fmt::format("has {} paths for {} files", were.size(), e.files.size()));
        for (std::size_t i = 0; i < were.size(); ++i)
            if (isThere(were[i]) || !isThere(e.files[i])) e.files[i] = were[i];
    });
    object.read<json>(kSessionErrorKey, [](const json&) {});
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
    readChoices(object, e);
    object.read<std::string>("stepTime", [&](const std::string& time) { e.stepTime = time; });
    if (const auto flaw = flawOf(e))
        throw ChoiceError(fmt::format("session.{}: {}", flaw->key, flaw->why));
    object.refuseOthers();
    return e;
}

std::optional<std::filesystem::path> missingFile(const Explorer& session) {
    const auto missing = std::ranges::find_if_not(session.files, isThere);
    return missing == session.files.end() ? std::nullopt : std::optional(*missing);
}

namespace {

// The session that a picture carries; none where the file is no picture.
std::optional<std::string> embedded(const std::filesystem::path& file) {
    const bool isPng = render::isPng(file);
    if (!isPng && !render::isExr(file)) return std::nullopt;
    const render::Metadata texts =
        isPng ? render::readPng(file).metadata : render::readExr(file).metadata;
    const auto found = texts.find(kSessionKey);
    if (found == texts.end())
        throw FileError(
            fmt::format("{}: the picture carries no session ({})", file.string(), kSessionKey));
    return found->second;
}

json jsonOf(const std::filesystem::path& file) {
    if (const auto text = embedded(file)) return parseStrictly(*text);
    std::ifstream in(file);
    if (!in || std::filesystem::is_directory(file))
        throw FileError(fmt::format("{}: the session file cannot be opened", file.string()));
    return parseStrictly(in);
}

}  // namespace

bool holdsSession(const std::filesystem::path& file) {
    return timeseries::lower(file.extension().string()) == ".json" || render::isPng(file) ||
           render::isExr(file);
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
