// The values of one Zarr array: blocks of it, of the chunks that they touch and no others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
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
    struct Packed {
        std::unique_ptr<ZarrStoreFile> file;
        std::uint64_t from = 0, bytes = 0;  // of it
    };
    struct Kept {
        std::int64_t written;  // the file that it is of
        ZarrBytes bytes;
    };
    std::string fileOf(const Index& chunk) const;
    // Null where it was never written. Throws FileError.
    const ZarrBytes* unpacked(const Index& chunk);
    std::optional<Packed> find(const Index& chunk);
    std::optional<Packed> findInShard(const Index& chunk);
    void openShard(const std::string& name);
    // Of those before, the chunks of the block that is read, if they may be wanted again.
    void keepOnly(const Index& first, const Index& last, std::span<const std::size_t> count);

    const ZarrStore& store_;
    const ZarrArray& array_;
    std::string chunkFile_;  // the file looked at last: whose flaws are told
    // Of the shard that was looked at last: where each chunk lies. Empty of one that is missing.
    std::string shardFile_;
    std::int64_t shardWritten_ = 0;
    std::vector<std::uint64_t> shardIndex_;
    std::map<Index, Kept> kept_;
    bool keeps_ = false;  // all of the block's, else the last alone
};

}  // namespace timeseries
