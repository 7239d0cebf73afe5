// Arrays of Zarr, version 2 (specification 2, "Arrays").
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <stdexcept>

#include "timeseries/readers/zarr/zarr_array.h"

namespace timeseries {
namespace {

struct V2Type {
    std::string_view code;
    ValueType type;
};
constexpr std::array kV2Types{
    V2Type{"i1", ValueType::I8},  V2Type{"i2", ValueType::I16}, V2Type{"i4", ValueType::I32},
    V2Type{"i8", ValueType::I64}, V2Type{"u1", ValueType::U8},  V2Type{"u2", ValueType::U16},
    V2Type{"u4", ValueType::U32}, V2Type{"u8", ValueType::U64}, V2Type{"f4", ValueType::F32},
    V2Type{"f8", ValueType::F64},
};

// Of dates and durations, "M8[25s]", a letter for the kind and the unit; whether it is such a code.
bool takeV2Times(std::string_view code, ZarrArray& array) {
    if (!(code.starts_with("M8[") || code.starts_with("m8[")) || !code.ends_with(']')) return false;
    std::string_view unit = code.substr(3, code.size() - 4);
    std::uint64_t each = 1;
    const auto count = std::from_chars(unit.data(), unit.data() + unit.size(), each);
    unit.remove_prefix(static_cast<std::size_t>(count.ptr - unit.data()));
    takeZarrTimes(code[0] == 'M', unit, each, array);
    return true;
}

// NumPy's codes: the byte order, a letter for the kind, the bytes.
void takeV2Type(const ZarrJson& metadata, ZarrArray& array) {
    const ZarrJson* const json = jsonMember(&metadata, "dtype");
    const std::string code = jsonText(json);
    const auto found =
        code.empty() ? kV2Types.end()
                     : std::ranges::find(kV2Types, std::string_view(code).substr(1), &V2Type::code);
    const char order = code.empty() ? '\0' : code[0];
    const bool areTimes =
        (order == '<' || order == '>') && takeV2Times(std::string_view(code).substr(1), array);
    if ((found == kV2Types.end() && !areTimes) || (order != '<' && order != '>' && order != '|'))
        throw std::invalid_argument(
            fmt::format("dtype: expected integers of 8 to 64 bits, float32 or float64, found {}",
                        jsonBriefly(json)));
    if (!areTimes) array.type = found->type;
    constexpr char kOwn = std::endian::native == std::endian::little ? '<' : '>';
    array.swapped = order != '|' && order != kOwn;
}

void takeV2Codecs(const ZarrJson& metadata, ZarrArray& array) {
    if (const ZarrJson* const filters = jsonMember(&metadata, "filters");
        filters && !filters->is_null() && !filters->empty()) {
        const ZarrJson* const first = filters->is_array() ? &filters->front() : filters;
        throw std::invalid_argument(
            fmt::format("filters: expected none, found {}", jsonBriefly(jsonMember(first, "id"))));
    }
    const ZarrJson* const compressor = jsonMember(&metadata, "compressor");
    if (!compressor || compressor->is_null()) return;
    const ZarrJson* const id = jsonMember(compressor, "id");
    const auto codec = zarrCodecOf(jsonText(id));
    if (!codec)
        throw std::invalid_argument(
            fmt::format("compressor: expected none, zlib, gzip, bz2, zstd, lz4 or blosc, found {}",
                        jsonBriefly(id)));
    array.codecs = {*codec};
}

void takeV2Order(const ZarrJson& metadata, ZarrArray& array) {
    const ZarrJson* const json = jsonMember(&metadata, "order");
    const std::string order = jsonText(json);
    if (order != "C" && order != "F")
        throw std::invalid_argument(
            fmt::format("order: expected C or F, found {}", jsonBriefly(json)));
    if (order == "F") std::ranges::reverse(array.order);
}

}  // namespace

ZarrArray zarrArrayOfV2(const ZarrJson& metadata, ZarrJson attributes) {
    ZarrArray array;
    array.attributes = std::move(attributes);
    takeZarrShape(metadata, array);
    try {
        const ZarrJson* const names = jsonMember(&array.attributes, "_ARRAY_DIMENSIONS");
        takeZarrDimensions(names, "_ARRAY_DIMENSIONS", array);
        takeV2Type(metadata, array);
        takeZarrChunk(jsonMember(&metadata, "chunks"), "chunks", array);
        takeV2Order(metadata, array);
        takeV2Codecs(metadata, array);
        takeZarrFill(jsonMember(&metadata, "fill_value"), array);
        array.fillIsMissing = names != nullptr;
        const ZarrJson* const separator = jsonMember(&metadata, "dimension_separator");
        if (separator) array.separator = jsonText(separator);
        if (array.separator != "." && array.separator != "/")
            throw std::invalid_argument(fmt::format(
                "dimension_separator: expected . or /, found {}", jsonBriefly(separator)));
    } catch (const std::invalid_argument& flaw) {
        array.flaw = flaw.what();
    }
    return array;
}

}  // namespace timeseries
