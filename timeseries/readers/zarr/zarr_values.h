// The values of one Zarr array: blocks of it, of the chunks that they touch and no others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "timeseries/readers/zarr/zarr_array.h"
#include "timeseries/readers/zarr/zarr_store.h"

namespace timeseries {

// The most chunks that one block may touch: a step of 2^32 points in chunks of 32 x 32 x 32 has
// half as many.
constexpr std::uint64_t kMaxZarrChunks = std::uint64_t{1} << 18;

class ZarrValues {
 public:
    // REQUIRES: array.type, no array.flaw; it and its store outlive this.
    ZarrValues(const ZarrStore& store, const ZarrArray& array) : store_(store), array_(array) {}

    // Why so many values of the array are not read, as a sentence's end; "" when they are: what its
    // files hold bounds them, but for small ones.
    std::string tooLarge(std::uint64_t values) const;
    // In C order, of this machine's byte order. REQUIRES: the block lies in the array, `values`
    // holds the product of `count`. Throws FileError, which names the chunk's file.
    void read(std::span<const std::size_t> start, std::span<const std::size_t> count,
              std::byte* values);

 private:
    using Index = std::vector<std::uint64_t>;
    std::string fileOf(const Index& chunk) const;
    std::optional<ZarrBytes> unpacked(const Index& chunk);
    std::optional<ZarrBytes> packed(const Index& chunk);
    std::optional<ZarrBytes> packedInShard(const Index& chunk);
    void openShard(const std::string& name);

    const ZarrStore& store_;
    const ZarrArray& array_;
    std::string chunkFile_;  // the file looked at last: whose flaws are told
    // Of the shard that was looked at last: where each chunk lies. Empty of one that is missing.
    std::string shardFile_;
    std::vector<std::uint64_t> shardIndex_;
};

}  // namespace timeseries
