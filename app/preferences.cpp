#include "app/preferences.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>

#include "app/json_text.h"
#include "app/user_files.h"

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

// Unknown keys may be a later version's.
Preferences fromJson(const json& object) {
    if (!object.is_object()) throw std::invalid_argument("it is not a JSON object");
    Preferences preferences;
    if (object.contains("recentFiles")) {
        const json& files = object["recentFiles"];
        const auto isText = [](const json& file) { return file.is_string(); };
        if (!files.is_array() || !std::ranges::all_of(files, isText))
            throw std::invalid_argument("recentFiles is not a list of texts");
        for (const json& file : files) {
            std::error_code ignored;
            const fs::path path = file.get<std::string>();
            if (preferences.recentFiles.size() < Preferences::kRecent && fs::exists(path, ignored))
                preferences.recentFiles.push_back(path);
        }
    }
    if (object.contains("uiScale")) preferences.uiScale = number(object, "uiScale", 0.5, 4);
    if (object.contains("frameMilliseconds"))
        preferences.frameMilliseconds = number(object, "frameMilliseconds", 1, 1000);
    return preferences;
}

}  // namespace

void rememberFile(Preferences& preferences, const fs::path& file) {
    const fs::path path = fs::absolute(file).lexically_normal();
    auto& recent = preferences.recentFiles;
    std::erase(recent, path);
    recent.insert(recent.begin(), path);
    if (recent.size() > Preferences::kRecent) recent.resize(Preferences::kRecent);
}

fs::path preferencesFile() { return configFolder() / "preferences.json"; }

ReadPreferences readPreferences(const fs::path& file) {
    std::ifstream in(file);
    if (!in) return {};
    std::string why;
    try {
        return {fromJson(json::parse(in)), ""};
    } catch (const json::parse_error& error) {
        why = fmt::format("not JSON at byte {}", error.byte);
    } catch (const json::out_of_range&) {
        why = "it holds a number beyond all doubles";
    } catch (const std::invalid_argument& error) {
        why = error.what();
    }
    return {{}, fmt::format("{}: the preferences are not used: {}", file.string(), why)};
}

void writePreferences(const Preferences& preferences, const fs::path& file) {
    json out{{"recentFiles", json::array()}, {"frameMilliseconds", preferences.frameMilliseconds}};
    for (const fs::path& recent : preferences.recentFiles)
        out["recentFiles"].push_back(recent.string());
    if (preferences.uiScale) out["uiScale"] = *preferences.uiScale;
    writeWhole(file, jsonText(out, 2) + "\n");
}

}  // namespace app
