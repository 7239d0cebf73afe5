#include "timeseries/readers/zarr/zarr_json.h"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <stdexcept>

#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

constexpr std::uint64_t kMostJsonBytes = 16 << 20;
// The longer first.
constexpr std::array<std::string_view, 3> kNoJson{"-Infinity", "Infinity", "NaN"};

// Of lists within lists: they are copied and written by functions that call themselves.
constexpr int kMostJsonDepth = 100;

// With the words of Python's that are no JSON as texts; "" when it is nested too deeply.
std::string asJson(std::string_view text) {
    std::string json;
    bool quoted = false;
    int depth = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"') quoted = !quoted;
        if (!quoted && (c == '[' || c == '{') && ++depth > kMostJsonDepth) return "";
        if (!quoted && (c == ']' || c == '}')) --depth;
        if (quoted && c == '\\' && i + 1 < text.size()) json += text[i++];
        std::string_view word;
        if (!quoted && (c == '-' || c == 'I' || c == 'N'))
            for (const std::string_view each : kNoJson)
                if (text.substr(i).starts_with(each)) word = each;
        if (word.empty()) {
            json += text[i];
        } else {
            json += fmt::format("\"{}\"", word);
            i += word.size() - 1;
        }
    }
    return json;
}

}  // namespace

ZarrJson readZarrJson(const ZarrStore& store, const std::string& name) {
    std::string text;
    try {
        const auto file = store.open(name);
        if (!file) throw std::invalid_argument("expected a file, but there is none");
        if (file->bytes() > kMostJsonBytes)
            throw std::invalid_argument(fmt::format(
                "expected metadata of at most {} bytes, found {}", kMostJsonBytes, file->bytes()));
        const ZarrBytes bytes = file->read(0, file->bytes());
        text.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    } catch (const std::invalid_argument& flaw) {
        throw FileError(fmt::format("{}: {}", store.told(name), flaw.what()));
    }
    ZarrJson json = ZarrJson::parse(asJson(text), nullptr, false);
    if (!json.is_object())
        throw FileError(fmt::format("{}: expected a JSON object, nested at most {} deep",
                                    store.told(name), kMostJsonDepth));
    return json;
}

const ZarrJson* jsonMember(const ZarrJson* object, const char* name) {
    if (!object || !object->is_object()) return nullptr;
    const auto found = object->find(name);
    return found == object->end() ? nullptr : &*found;
}

std::string jsonText(const ZarrJson* json) {
    return json && json->is_string() ? json->get<std::string>() : "";
}

std::optional<std::uint64_t> jsonCount(const ZarrJson& json) {
    return json.is_number_unsigned() ? std::optional(json.get<std::uint64_t>()) : std::nullopt;
}

std::optional<Number> jsonNumber(const ZarrJson& json) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    if (json.is_number_unsigned()) {
        const auto number = json.get<std::uint64_t>();
        if (std::in_range<std::int64_t>(number)) return static_cast<std::int64_t>(number);
        return number;
    }
    if (json.is_number_integer()) return json.get<std::int64_t>();
    if (json.is_number()) return json.get<double>();
    const std::string text = jsonText(&json);
    if (text == "NaN") return std::numeric_limits<double>::quiet_NaN();
    if (text == "Infinity") return kInfinity;
    if (text == "-Infinity") return -kInfinity;
    return std::nullopt;
}

std::optional<std::vector<std::uint64_t>> jsonCounts(const ZarrJson* json) {
    if (!json || !json->is_array()) return std::nullopt;
    std::vector<std::uint64_t> counts;
    for (const ZarrJson& each : *json) {
        const auto count = jsonCount(each);
        if (!count) return std::nullopt;
        counts.push_back(*count);
    }
    return counts;
}

std::string jsonBriefly(const ZarrJson* json) {
    constexpr std::size_t kMostShown = 60;
    if (!json || json->is_null()) return "none";
    std::string text = json->is_string() ? json->get<std::string>() : json->dump();
    for (char& c : text)
        if (c >= '\0' && c < ' ') c = ' ';
    if (text.size() <= kMostShown) return text;
    std::size_t end = kMostShown;
    while (end > 0 && (text[end] & 0xC0) == 0x80) --end;  // not within a character
    return text.substr(0, end) + "...";
}

}  // namespace timeseries
