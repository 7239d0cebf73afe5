#include "timeseries/readers/zarr/zarr_array.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <utility>

#include "timeseries/grid/with_type.h"

namespace timeseries {
namespace {

// A number of the metadata as a value of the array's type. Nothing when none is.
template <typename T>
std::optional<T> storedFill(const Number& number) {
    if constexpr (std::is_floating_point_v<T>) {
        const T nearest = nearestFloat<T>(toDouble(number));
        const bool isBeyond = std::isinf(nearest) && std::isfinite(toDouble(number));
        return isBeyond ? std::nullopt : std::optional(nearest);
    } else {
        if (const double* d = std::get_if<double>(&number)) {
            // Whole numbers with a point, as some write them: exact up to 2^53.
            if (!(std::abs(*d) <= 9007199254740992.0) || *d != std::floor(*d)) return std::nullopt;
            return storedFill<T>(Number(static_cast<std::int64_t>(*d)));
        }
        const auto as = [](auto value) {
            return std::in_range<T>(value) ? std::optional(static_cast<T>(value)) : std::nullopt;
        };
        if (const auto* i = std::get_if<std::int64_t>(&number)) return as(*i);
        return as(std::get<std::uint64_t>(number));
    }
}

}  // namespace

std::size_t ZarrArray::valueBytes() const {
    return withType(type.value_or(ValueType::U8), [](auto t) { return sizeof t; });
}

std::uint64_t ZarrArray::chunkBytes() const {
    std::uint64_t bytes = valueBytes();
    for (const std::uint64_t length : chunk) bytes *= length;
    return bytes;
}

std::array<std::byte, 8> ZarrArray::fillBytes() const {
    std::array<std::byte, 8> bytes{};
    if (fill && type)
        withType(*type, [&](auto t) {
            const auto value = storedFill<decltype(t)>(*fill).value_or(0);
            std::memcpy(bytes.data(), &value, sizeof value);
        });
    return bytes;
}

void takeZarrShape(const ZarrJson& metadata, ZarrArray& array) {
    const ZarrJson* const json = jsonMember(&metadata, "shape");
    const auto shape = jsonCounts(json);
    if (!shape)
        throw std::invalid_argument(
            fmt::format("shape: expected a list of whole numbers, found {}", jsonBriefly(json)));
    if (shape->size() > kMaxZarrRank)
        throw std::invalid_argument(fmt::format("shape: expected at most {} dimensions, found {}",
                                                kMaxZarrRank, shape->size()));
    constexpr std::uint64_t kMostLength = std::uint64_t{1}
                                          << 62;  // sums of two of them are numbers still
    for (const std::uint64_t length : *shape)
        if (length > kMostLength)
            throw std::invalid_argument(
                fmt::format("shape: expected lengths of at most 2^62, found {}", length));
    array.shape = *shape;
}

void takeZarrChunk(const ZarrJson* shape, const char* place, ZarrArray& array) {
    const auto chunk = jsonCounts(shape);
    if (!chunk || chunk->size() != array.shape.size() || std::ranges::count(*chunk, 0u) > 0)
        throw std::invalid_argument(fmt::format("{}: expected {} lengths greater than 0, found {}",
                                                place, array.shape.size(), jsonBriefly(shape)));
    std::uint64_t bytes = array.valueBytes();
    for (const std::uint64_t length : *chunk) {
        if (bytes > kMaxChunkBytes / length)
            throw std::invalid_argument(
                fmt::format("{}: expected a chunk of at most {} bytes, "
                            "found {} values of {}",
                            place, kMaxChunkBytes, jsonBriefly(shape),
                            array.type ? typeName(*array.type) : "bytes"));
        bytes *= length;
    }
    array.chunk = *chunk;
    for (std::size_t d = 0; d < chunk->size(); ++d) array.order.push_back(d);
}

void takeZarrFill(const ZarrJson* fill, ZarrArray& array) {
    if (!fill || fill->is_null()) return;
    const auto number =
        *fill == "NaT" ? Number(std::numeric_limits<std::int64_t>::min()) : jsonNumber(*fill);
    const bool isValue = number && withType(*array.type, [&](auto t) {
                             return storedFill<decltype(t)>(*number).has_value();
                         });
    if (!isValue)
        throw std::invalid_argument(fmt::format("fill_value: expected a value of {}, found {}",
                                                typeName(*array.type), jsonBriefly(fill)));
    array.fill = number;
}

void takeZarrTimes(bool areDates, std::string_view unit, std::uint64_t each, ZarrArray& array) {
    // Months and years of NumPy differ in length.
    constexpr std::array<std::pair<std::string_view, const char*>, 8> kUnits{
        {{"W", "weeks"},
         {"D", "days"},
         {"h", "hours"},
         {"m", "minutes"},
         {"s", "seconds"},
         {"ms", "milliseconds"},
         {"us", "microseconds"},
         {"ns", "nanoseconds"}}};
    const auto named =
        std::ranges::find(kUnits, unit, &std::pair<std::string_view, const char*>::first);
    if (named == kUnits.end() || each == 0)
        throw std::invalid_argument(
            fmt::format("times: expected them in W, D, h, m, s, ms, us or ns, found \"{}\"", unit));
    array.type = ValueType::I64;
    if (!array.attributes.is_object()) array.attributes = ZarrJson::object();
    const std::string count = each == 1 ? "" : fmt::format("{} ", each);
    const auto unlessSaid = [&](const char* name, const ZarrJson& value) {
        if (!array.attributes.contains(name)) array.attributes[name] = value;
    };
    unlessSaid("units", count + named->second + (areDates ? " since 1970-01-01" : ""));
    if (areDates) unlessSaid("calendar", "proleptic_gregorian");
    unlessSaid("missing_value", std::numeric_limits<std::int64_t>::min());
}

void takeZarrDimensions(const ZarrJson* names, const char* place, ZarrArray& array) {
    if (!names || names->is_null()) return;
    const bool fits = names->is_array() && names->size() == array.shape.size() &&
                      std::ranges::all_of(*names, [](const ZarrJson& name) {
                          return name.is_string() || name.is_null();
                      });
    if (!fits)
        throw std::invalid_argument(fmt::format("{}: expected {} names of dimensions, found {}",
                                                place, array.shape.size(), jsonBriefly(names)));
    for (const ZarrJson& name : *names) array.dimensions.push_back(jsonText(&name));
}

}  // namespace timeseries
