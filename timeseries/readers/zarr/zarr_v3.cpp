// Arrays of Zarr, version 3 (specification 3.1, "Array metadata").
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "timeseries/readers/zarr/zarr_array.h"

namespace timeseries {
namespace {

[[noreturn]] void refuseV3(const char* place, std::string_view expected, const ZarrJson* found) {
    throw std::invalid_argument(
        fmt::format("{}: expected {}, found {}", place, expected, jsonBriefly(found)));
}

// Extensions are named by {"name": ...}, or by a text alone.
const ZarrJson* nameOfV3(const ZarrJson* extension) {
    return extension && extension->is_string() ? extension : jsonMember(extension, "name");
}

const ZarrJson* settingOf(const ZarrJson* extension, const char* name) {
    return jsonMember(jsonMember(extension, "configuration"), name);
}

void takeV3Type(const ZarrJson& metadata, ZarrArray& array) {
    const ZarrJson* const json = jsonMember(&metadata, "data_type");
    const std::string name = jsonText(json), extension = jsonText(nameOfV3(json));
    if (extension == "numpy.datetime64" || extension == "numpy.timedelta64") {
        const ZarrJson* const each = settingOf(json, "scale_factor");
        return takeZarrTimes(extension == "numpy.datetime64", jsonText(settingOf(json, "unit")),
                             each ? jsonCount(*each).value_or(0) : 1, array);
    }
    for (std::size_t i = 0; i < std::variant_size_v<Values>; ++i)
        if (typeName(static_cast<ValueType>(i)) == name) array.type = static_cast<ValueType>(i);
    if (!array.type)
        refuseV3("data_type", "integers of 8 to 64 bits, float32 or float64",
                 json && json->is_object() ? nameOfV3(json) : json);
}

// Whether the values' bytes are to be swapped.
bool isSwapped(const ZarrJson* bytes, std::size_t valueBytes) {
    const ZarrJson* const endian = settingOf(bytes, "endian");
    const std::string order = jsonText(endian);
    if (valueBytes == 1 && order.empty()) return false;
    if (order != "little" && order != "big")
        refuseV3("codec bytes: endian", "little or big", endian);
    return (order == "little") != (std::endian::native == std::endian::little);
}

// The dimensions as `transpose` puts them. Several follow each other.
void transpose(const ZarrJson* codec, ZarrArray& array) {
    const ZarrJson* const json = settingOf(codec, "order");
    const auto order = jsonCounts(json);
    std::vector<std::uint64_t> sorted = order.value_or(std::vector<std::uint64_t>());
    std::ranges::sort(sorted);
    for (std::size_t d = 0; d < sorted.size(); ++d)
        if (sorted[d] != d) sorted.clear();
    if (!order || sorted.size() != array.order.size())
        refuseV3("codec transpose: order", "each dimension once", json);
    const std::vector<std::size_t> before = array.order;
    for (std::size_t d = 0; d < before.size(); ++d) array.order[d] = before[(*order)[d]];
}

// array -> array codecs, then one array -> bytes codec, then those that pack bytes.
void takePackers(const ZarrJson& list, std::size_t from, std::vector<ZarrCodec>& codecs) {
    for (std::size_t i = from; i < list.size(); ++i) {
        const ZarrJson* const name = nameOfV3(&list[i]);
        const auto codec = zarrCodecOf(jsonText(name));
        if (!codec)
            refuseV3("codecs", "zlib, gzip, bz2, zstd, lz4, blosc or crc32c behind bytes", name);
        codecs.push_back(*codec);
    }
    if (std::ssize(codecs) - std::ranges::count(codecs, ZarrCodec::Crc32c) > 1)
        throw std::invalid_argument("codecs: expected one that compresses, found several");
}

void takeChunkCodecs(const ZarrJson* list, ZarrArray& array) {
    if (!list || !list->is_array()) refuseV3("codecs", "a list", list);
    std::size_t at = 0;
    while (at < list->size() && jsonText(nameOfV3(&(*list)[at])) == "transpose")
        transpose(&(*list)[at++], array);
    const ZarrJson* const bytes = at < list->size() ? &(*list)[at] : nullptr;
    if (jsonText(nameOfV3(bytes)) != "bytes") refuseV3("codecs", "bytes", nameOfV3(bytes));
    array.swapped = isSwapped(bytes, array.valueBytes());
    takePackers(*list, at + 1, array.codecs);
}

// The index is of 64-bit numbers, packed by nothing but a checksum.
void takeIndexCodecs(const ZarrJson* list, ZarrShards& shards) {
    const ZarrJson* const bytes =
        list && list->is_array() && !list->empty() ? &list->front() : nullptr;
    if (jsonText(nameOfV3(bytes)) != "bytes") refuseV3("index_codecs", "bytes", list);
    shards.indexSwapped = isSwapped(bytes, sizeof(std::uint64_t));
    takePackers(*list, 1, shards.indexCodecs);
    if (std::ranges::count(shards.indexCodecs, ZarrCodec::Crc32c) != std::ssize(shards.indexCodecs))
        refuseV3("index_codecs", "bytes and crc32c alone", list);
}

// REQUIRES: array.chunk is the shape of a shard.
void takeShards(const ZarrJson& codec, ZarrArray& array) {
    constexpr std::uint64_t kMostInShard = 1 << 20;  // 16 MB of an index
    ZarrShards shards{.shape = array.chunk, .indexCodecs = {}};
    array.order.clear();
    takeZarrChunk(settingOf(&codec, "chunk_shape"), "chunk_shape of shards", array);
    std::uint64_t count = 1;
    for (std::size_t d = 0; d < array.chunk.size(); ++d) {
        const std::uint64_t along = shards.shape[d] / array.chunk[d];
        if (along == 0 || shards.shape[d] % array.chunk[d] != 0 || count > kMostInShard / along)
            throw std::invalid_argument(fmt::format(
                "chunk_shape of shards: expected shards of whole chunks, at most {} in each, found "
                "{} in {}",
                kMostInShard, fmt::join(array.chunk, " x "), fmt::join(shards.shape, " x ")));
        count *= along;
    }
    takeChunkCodecs(settingOf(&codec, "codecs"), array);
    takeIndexCodecs(settingOf(&codec, "index_codecs"), shards);
    const ZarrJson* const location = settingOf(&codec, "index_location");
    const std::string where = location ? jsonText(location) : "end";
    if (where != "end" && where != "start") refuseV3("index_location", "end or start", location);
    shards.indexFirst = where == "start";
    array.shards = std::move(shards);
}

// The shape of a shard has no limit of its own: its chunks have.
void takeShardShape(const ZarrJson* shape, ZarrArray& array) {
    const auto lengths = jsonCounts(shape);
    if (!lengths || lengths->size() != array.shape.size())
        refuseV3("chunk_shape", "a length for each dimension", shape);
    array.chunk = *lengths;
}

void takeV3Chunks(const ZarrJson& metadata, ZarrArray& array) {
    const ZarrJson* const grid = jsonMember(&metadata, "chunk_grid");
    if (jsonText(nameOfV3(grid)) != "regular") refuseV3("chunk_grid", "regular", nameOfV3(grid));
    const ZarrJson* const codecs = jsonMember(&metadata, "codecs");
    const ZarrJson* const first =
        codecs && codecs->is_array() && !codecs->empty() ? &codecs->front() : nullptr;
    if (jsonText(nameOfV3(first)) != "sharding_indexed") {
        takeZarrChunk(settingOf(grid, "chunk_shape"), "chunk_shape", array);
        takeChunkCodecs(codecs, array);
        return;
    }
    if (codecs->size() > 1) refuseV3("codecs", "none beside sharding_indexed", codecs);
    takeShardShape(settingOf(grid, "chunk_shape"), array);
    takeShards(*first, array);
}

void takeV3Keys(const ZarrJson& metadata, ZarrArray& array) {
    const ZarrJson* const encoding = jsonMember(&metadata, "chunk_key_encoding");
    const std::string name = jsonText(nameOfV3(encoding));
    if (name != "default" && name != "v2")
        refuseV3("chunk_key_encoding", "default or v2", nameOfV3(encoding));
    array.keyStart = name == "default" ? "c" : "";
    const ZarrJson* const separator = settingOf(encoding, "separator");
    array.separator = separator ? jsonText(separator) : name == "default" ? "/" : ".";
    if (array.separator != "." && array.separator != "/")
        refuseV3("chunk_key_encoding: separator", ". or /", separator);
}

// A fill of a float may be its bits: "0x7fc00000".
ZarrJson fillOfV3(const ZarrJson& metadata, const ZarrArray& array) {
    const ZarrJson* const json = jsonMember(&metadata, "fill_value");
    const std::string text = jsonText(json);
    if (!json || !text.starts_with("0x") || text.size() != 2 + 2 * array.valueBytes())
        return json ? *json : ZarrJson();
    if (text.find_first_not_of("0123456789abcdefABCDEF", 2) != text.npos) return *json;
    const std::uint64_t bits = std::stoull(text.substr(2), nullptr, 16);
    if (array.type == ValueType::F32) return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    return array.type == ValueType::F64 ? ZarrJson(std::bit_cast<double>(bits)) : *json;
}

}  // namespace

ZarrArray zarrArrayOfV3(const ZarrJson& metadata) {
    ZarrArray array;
    if (const ZarrJson* const attributes = jsonMember(&metadata, "attributes"))
        array.attributes = *attributes;
    takeZarrShape(metadata, array);
    try {
        takeZarrDimensions(jsonMember(&metadata, "dimension_names"), "dimension_names", array);
        takeV3Type(metadata, array);
        takeV3Chunks(metadata, array);
        takeV3Keys(metadata, array);
        const ZarrJson fill = fillOfV3(metadata, array);
        takeZarrFill(&fill, array);
        if (const ZarrJson* const others = jsonMember(&metadata, "storage_transformers");
            others && !others->empty())
            refuseV3("storage_transformers", "none", others);
    } catch (const std::invalid_argument& flaw) {
        array.flaw = flaw.what();
    }
    return array;
}

}  // namespace timeseries
