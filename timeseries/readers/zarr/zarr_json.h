// The JSON of a Zarr hierarchy's metadata.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "timeseries/index/number.h"
#include "timeseries/readers/zarr/zarr_store.h"

namespace timeseries {

using ZarrJson = nlohmann::json;

// Of a file of at most 16 MB that holds an object, nested at most 100 deep. NaN, Infinity and
// -Infinity, which Python writes as they are, become texts. Throws FileError.
ZarrJson readZarrJson(const ZarrStore& store, const std::string& name);

// Null when it is no object, or has none of that name.
const ZarrJson* jsonMember(const ZarrJson* object, const char* name);
std::string jsonText(const ZarrJson* json);  // "" when it is no text
std::optional<std::uint64_t> jsonCount(const ZarrJson& json);
// A number, or "NaN", "Infinity", "-Infinity".
std::optional<Number> jsonNumber(const ZarrJson& json);
// Nothing when it is no list of whole numbers.
std::optional<std::vector<std::uint64_t>> jsonCounts(const ZarrJson* json);
// On one line, of a long one the beginning; "none" for null.
std::string jsonBriefly(const ZarrJson* json);

}  // namespace timeseries
