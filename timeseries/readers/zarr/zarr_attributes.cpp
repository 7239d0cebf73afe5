#include "timeseries/readers/zarr/zarr_attributes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <string_view>

namespace timeseries {
namespace {

// Those that are numbers, of which Python writes some as words (zarr_json.h).
bool isOfNumbers(std::string_view name) {
    static constexpr std::array kOfNumbers{"_FillValue", "missing_value", "valid_min", "valid_max",
                                           "valid_range"};
    return std::ranges::find(kOfNumbers, name) != kOfNumbers.end();
}

// The 8 bytes of a double, little-endian, in base64 (RFC 4648): what xarray writes as _FillValue of
// floats in version 3.
std::optional<double> doubleOfBase64(std::string_view text) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    if (text.size() != 12 || text[11] != '=') return std::nullopt;
    std::uint64_t bits = 0;
    int bytes = 0;
    for (std::size_t i = 0; i < 12; i += 4) {
        std::uint32_t group = 0;
        for (std::size_t k = i; k < i + 4; ++k) {
            const std::size_t digit = k == 11 ? 0 : kDigits.find(text[k]);
            if (digit == kDigits.npos) return std::nullopt;
            group = group << 6 | static_cast<std::uint32_t>(digit);
        }
        for (int shift = 16; shift >= 0 && bytes < 8; shift -= 8, ++bytes)
            bits |= std::uint64_t{group >> shift & 0xFF} << 8 * bytes;
    }
    return std::bit_cast<double>(bits);
}

std::optional<Number> numberOfAttribute(const std::string& name, const ZarrJson& json,
                                        const ZarrArray& array) {
    if (!json.is_string()) return jsonNumber(json);
    if (!isOfNumbers(name)) return std::nullopt;
    const bool isFloat = array.type == ValueType::F32 || array.type == ValueType::F64;
    if (name == "_FillValue" && isFloat)
        if (const auto number = doubleOfBase64(jsonText(&json))) return *number;
    return jsonNumber(json);
}

std::optional<NcAttribute> ofNumbers(const std::string& name, const ZarrJson& json,
                                     const ZarrArray& array) {
    std::vector<Number> numbers;
    ValueType type = ValueType::I64;
    for (const ZarrJson& each : json.is_array() ? json : ZarrJson::array({json})) {
        const auto number = numberOfAttribute(name, each, array);
        if (!number) return std::nullopt;
        if (std::holds_alternative<std::uint64_t>(*number) && type == ValueType::I64)
            type = ValueType::U64;
        if (std::holds_alternative<double>(*number)) type = ValueType::F64;
        numbers.push_back(*number);
    }
    if (numbers.empty()) return std::nullopt;
    return NcAttribute{name, std::move(numbers), type};
}

std::optional<NcAttribute> ofTexts(const std::string& name, const ZarrJson& json) {
    std::string text;
    for (const ZarrJson& each : json.is_array() ? json : ZarrJson::array({json})) {
        if (!each.is_string()) return std::nullopt;
        text += (text.empty() ? "" : " ") + jsonText(&each);
    }
    return NcAttribute{name, std::move(text), std::nullopt};
}

}  // namespace

std::vector<NcAttribute> zarrAttributesOf(const ZarrArray& array) {
    std::vector<NcAttribute> attributes;
    if (array.attributes.is_object())
        for (const auto& [name, json] : array.attributes.items()) {
            auto attribute = ofNumbers(name, json, array);
            if (!attribute) attribute = ofTexts(name, json);
            if (attribute) attributes.push_back(std::move(*attribute));
        }
    const bool tells =
        std::ranges::find(attributes, "_FillValue", &NcAttribute::name) != attributes.end();
    if (array.fillIsMissing && array.fill && !tells)
        attributes.push_back({"_FillValue", std::vector<Number>{*array.fill}, array.type});
    return attributes;
}

}  // namespace timeseries
