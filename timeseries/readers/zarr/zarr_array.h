// What the metadata of a Zarr array says of it: .zarray of version 2 (Zarr specification 2,
// "Arrays", "Metadata"), zarr.json of version 3 (specification 3.1, "Array metadata").
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "timeseries/grid/field.h"
#include "timeseries/readers/zarr/zarr_codecs.h"
#include "timeseries/readers/zarr/zarr_json.h"

namespace timeseries {

// Chunks that are packed together into files (sharding_indexed codec, version 1.0): each has an
// offset and a size in an index, which stands at the file's end or start.
struct ZarrShards {
    std::vector<std::uint64_t> shape;  // whole chunks along each dimension
    std::vector<ZarrCodec> indexCodecs;
    bool indexSwapped = false, indexFirst = false;
};

// Sizes are bounded: shape.size() <= kMaxZarrRank, a chunk has at most kMaxChunkBytes.
struct ZarrArray {
    std::string folder;  // in its store
    std::string name;    // in its hierarchy: "a/b"
    // Why its values cannot be read, as a sentence's end; then of what follows only the shape is
    // known, and what stands before what is wrong.
    std::string flaw;
    std::vector<std::uint64_t> shape;  // slowest first, as all that follows
    std::optional<ValueType> type;     // nothing for what are no numbers
    bool swapped = false;              // not of this machine's byte order
    std::vector<std::uint64_t> chunk;  // none is 0
    std::vector<std::size_t> order;    // the dimensions as values follow each other in a chunk
    std::vector<ZarrCodec> codecs;     // as unpackZarrChunk() takes them
    std::optional<ZarrShards> shards;
    std::string keyStart;                 // "c" of version 3's own names
    std::string separator = ".";          // between the numbers of a chunk's name
    std::optional<Number> fill;           // of what was never written; nothing: any
    std::vector<std::string> dimensions;  // their names, "" of those without; none when none has
    // Version 2 as xarray writes it: its fill is the attribute _FillValue.
    bool fillIsMissing = false;
    ZarrJson attributes;

    std::size_t valueBytes() const;
    std::uint64_t chunkBytes() const;
    std::array<std::byte, 8> fillBytes() const;  // the first valueBytes(), of this machine's order
};

constexpr std::size_t kMaxZarrRank = 32;

// `attributes` stand in a file of their own. Throws std::invalid_argument for a shape that cannot
// be.
ZarrArray zarrArrayOfV2(const ZarrJson& metadata, ZarrJson attributes);
ZarrArray zarrArrayOfV3(const ZarrJson& metadata);

// For both. They throw std::invalid_argument: what was expected and found.
void takeZarrShape(const ZarrJson& metadata, ZarrArray& array);
void takeZarrChunk(const ZarrJson* shape, const char* place, ZarrArray& array);
void takeZarrFill(const ZarrJson* fill, ZarrArray& array);
// NumPy's dates (datetime64) and durations (timedelta64) in its unit, so many of them each: 64-bit
// integers, of which the least is none (NaT), with attributes as CF's times have them.
void takeZarrTimes(bool areDates, std::string_view unit, std::uint64_t each, ZarrArray& array);
// `names`: as many texts as the array has dimensions, or nulls.
void takeZarrDimensions(const ZarrJson* names, const char* place, ZarrArray& array);

}  // namespace timeseries
