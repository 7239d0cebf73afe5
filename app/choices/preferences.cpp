#include "app/choices/preferences.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>

#include "app/choices/choice_text.h"
#include "app/choices/path_text.h"
#include "app/choices/paths.h"
#include "app/choices/user_files.h"
#include "app/json_text.h"
#include "timeseries/readers/ordinary_file.h"

namespace app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

double number(const json& object, const char* key, double lo, double hi) {
    const json& value = object.at(key);
    if (!value.is_number() || !(value.get<double>() >= lo && value.get<double>() <= hi))
        throw std::invalid_argument(fmt::format("{} is not a number from {} to {}", key, lo, hi));
    return value.get<double>();
}

// Whether recentFiles are escaped() texts.
constexpr const char* kEscaped = "recentFilesEscaped";

bool areUtf8(const Named& named) {
    return std::ranges::all_of(named, [](const fs::path& path) { return isUtf8(path.string()); });
}

// One is a text, several are a list of texts.
std::optional<Named> namedIn(const json& entry, bool areEscaped) {
    const json list = entry.is_array() ? entry : json::array({entry});
    Named named;
    for (const json& path : list) {
        if (!path.is_string()) return std::nullopt;
        const auto text = path.get<std::string>();
        named.emplace_back(areEscaped ? unescaped(text) : text);
    }
    if (named.empty()) return std::nullopt;
    return named;
}

std::vector<Named> recentIn(const json& list, bool areEscaped) {
    const std::invalid_argument refusal("recentFiles is not a list of texts and lists of texts");
    if (!list.is_array()) throw refusal;
    std::vector<Named> recent;
    for (const json& entry : list) {
        auto named = namedIn(entry, areEscaped);
        if (!named) throw refusal;
        if (recent.size() < Preferences::kRecent && std::ranges::all_of(*named, isThere))
            recent.push_back(std::move(*named));
    }
    return recent;
}

constexpr std::array kMoving = {"pace", "error", "fixed", "all"};  // as Moving

Moving movingIn(const json& name) {
    const auto found = std::ranges::find(kMoving, name);
    if (found == kMoving.end())
        throw std::invalid_argument("moving is none of pace, error, fixed and all");
    return static_cast<Moving>(found - kMoving.begin());
}

Rung rungIn(const json& rung) {
    if (!rung.is_object() || !rung.contains("model") || !rung["model"].is_string())
        throw std::invalid_argument("movingRung has no model");
    const Rung read{parseModel(rung["model"].get<std::string>()),
                    static_cast<std::uint32_t>(number(rung, "stride", 1, kFewestMoving)),
                    static_cast<int>(number(rung, "across", 1, kCoarse))};
    // Others are only reached by hand.
    return {read.model, read.model == Model::Cells ? 1 : std::bit_floor(read.stride), read.across};
}

json rungJson(const Rung& rung) {
    return {{"model", std::string(modelName(rung.model))},
            {"stride", rung.stride},
            {"across", rung.across}};
}

// Beyond them nothing that was measured lies: a frame of a minute, a splat of a millisecond.
constexpr render::FramePace::Cost kMostCost{6e10, 1e6, double{render::FramePace::kMost}};

// None where it cannot be: nobody wrote it by hand, and it is soon learnt anew.
std::optional<render::FramePace::Cost> costIn(const json& costs, const char* of) {
    if (!costs.is_object() || !costs.contains(of) || !costs[of].is_object()) return std::nullopt;
    const auto in = [&](const char* key, double most) {
        const json value = costs[of].value(key, json());
        const double number = value.is_number() ? value.get<double>() : -1;
        return number <= most ? number : -1;
    };
    const render::FramePace::Cost cost{in("fixedNanoseconds", kMostCost.fixedNs),
                                       in("perSplatNanoseconds", kMostCost.perSplatNs),
                                       in("splats", kMostCost.splats)};
    const bool isPossible = cost.fixedNs >= 0 && cost.perSplatNs > 0 && cost.splats > 0;
    return isPossible ? std::optional(cost) : std::nullopt;
}

json costJson(const render::FramePace::Cost& cost) {
    return {{"fixedNanoseconds", cost.fixedNs},
            {"perSplatNanoseconds", cost.perSplatNs},
            {"splats", cost.splats}};
}

// Unknown keys may be a later version's.
Preferences fromJson(const json& object) {
    if (!object.is_object()) throw std::invalid_argument("it is not a JSON object");
    Preferences preferences;
    const bool areEscaped = object.contains(kEscaped) && object[kEscaped] == true;
    if (object.contains("recentFiles"))
        preferences.recent = recentIn(object["recentFiles"], areEscaped);
    if (object.contains("uiScale")) preferences.uiScale = number(object, "uiScale", 0.5, 4);
    if (object.contains("frameMilliseconds"))
        preferences.frameMilliseconds = number(object, "frameMilliseconds", 1, 1000);
    if (object.contains("moving")) preferences.moving = movingIn(object["moving"]);
    if (object.contains("movingError"))
        preferences.movingError = number(object, "movingError", 1e-4, 1);
    if (object.contains("movingRung")) preferences.movingRung = rungIn(object["movingRung"]);
    if (object.contains("drawingCosts"))
        preferences.costs = {.points = costIn(object["drawingCosts"], "points"),
                             .cells = costIn(object["drawingCosts"], "cells")};
    return preferences;
}

}  // namespace

std::string shortName(const Named& named) {
    const std::string first = named.front().filename().string();
    return named.size() == 1 ? first : fmt::format("{} and {} more", first, named.size() - 1);
}

void remember(Preferences& preferences, Named named) {
    for (fs::path& path : named) {
        path = fs::absolute(path).lexically_normal();
        if (!path.has_filename()) path = path.parent_path();  // a folder, written with its slash
    }
    auto& recent = preferences.recent;
    std::erase(recent, named);
    recent.insert(recent.begin(), std::move(named));
    if (recent.size() > Preferences::kRecent) recent.resize(Preferences::kRecent);
}

fs::path preferencesFile() { return configFolder() / "preferences.json"; }

ReadPreferences readPreferences(const fs::path& file) {
    std::error_code unknown;
    if (fs::status(file, unknown).type() == fs::file_type::not_found) return {};
    std::string why = timeseries::flawOfFile(file);
    try {
        if (why.empty()) {
            std::ifstream in(file);
            return {fromJson(json::parse(in)), ""};
        }
    } catch (const json::parse_error& error) {
        why = fmt::format("not JSON at byte {}", error.byte);
    } catch (const json::out_of_range&) {
        why = "it holds a number beyond all doubles";
    } catch (const std::invalid_argument& error) {
        why = error.what();
    } catch (const std::ios_base::failure&) {
        why = "it cannot be read";
    }
    return {{}, fmt::format("{}: the preferences are not used: {}", file.string(), why)};
}

void writePreferences(const Preferences& preferences, const fs::path& file) {
    json out{{"recentFiles", json::array()},
             {"frameMilliseconds", preferences.frameMilliseconds},
             {"moving", kMoving[static_cast<std::size_t>(preferences.moving)]},
             {"movingError", preferences.movingError},
             {"movingRung", rungJson(preferences.movingRung)}};
    const bool areEscaped = !std::ranges::all_of(preferences.recent, areUtf8);
    if (areEscaped) out[kEscaped] = true;
    for (const Named& named : preferences.recent) {
        json entry = json::array();
        for (const fs::path& path : named)
            entry.push_back(areEscaped ? escaped(path.string()) : path.string());
        out["recentFiles"].push_back(named.size() == 1 ? entry.front() : entry);
    }
    if (preferences.uiScale) out["uiScale"] = *preferences.uiScale;
    if (preferences.costs.points)
        out["drawingCosts"]["points"] = costJson(*preferences.costs.points);
    if (preferences.costs.cells) out["drawingCosts"]["cells"] = costJson(*preferences.costs.cells);
    writeWhole(file, jsonText(out, 2) + "\n");
}

}  // namespace app
