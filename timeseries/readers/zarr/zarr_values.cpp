#include "timeseries/readers/zarr/zarr_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "timeseries/readers/limits.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

// An offset and a size of all ones: a chunk that was never written (sharding_indexed, "Binary shard
// format").
constexpr std::uint64_t kNoChunk = ~std::uint64_t{0};

void swapBytes(ZarrBytes& bytes, std::size_t valueBytes) {
    for (auto at = bytes.begin(); at != bytes.end(); at += static_cast<std::ptrdiff_t>(valueBytes))
        std::reverse(at, at + static_cast<std::ptrdiff_t>(valueBytes));
}

// Where a chunk and the block that is read share values, in one and in the other, in values.
struct Overlap {
    std::vector<std::uint64_t> count, fromStride, toStride;
    std::uint64_t from = 0, to = 0;
};

Overlap overlapOf(const ZarrArray& array, std::span<const std::uint64_t> chunk,
                  std::span<const std::size_t> start, std::span<const std::size_t> count) {
    const std::size_t rank = array.shape.size();
    Overlap both{std::vector<std::uint64_t>(rank), std::vector<std::uint64_t>(rank),
                 std::vector<std::uint64_t>(rank)};
    std::uint64_t stride = 1;
    for (std::size_t i = rank; i-- > 0; stride *= array.chunk[array.order[i]])
        both.fromStride[array.order[i]] = stride;
    stride = 1;
    for (std::size_t d = rank; d-- > 0; stride *= count[d]) both.toStride[d] = stride;
    for (std::size_t d = 0; d < rank; ++d) {
        const std::uint64_t begin = chunk[d] * array.chunk[d];
        const std::uint64_t first = std::max<std::uint64_t>(begin, start[d]);
        // The last chunk reaches beyond the array.
        const std::uint64_t last =
            std::min<std::uint64_t>(begin + array.chunk[d], start[d] + count[d]);
        both.count[d] = last - first;
        both.from += (first - begin) * both.fromStride[d];
        both.to += (first - start[d]) * both.toStride[d];
    }
    return both;
}

// Calls row(from, to) for each row along the last dimension.
template <typename Row>
void forEachRowOf(const Overlap& both, Row row) {
    const std::size_t rank = both.count.size();
    std::vector<std::uint64_t> at(rank, 0);
    std::uint64_t from = both.from, to = both.to;
    while (true) {
        row(from, to);
        std::size_t d = rank;
        while (d-- > 1) {  // the last but one is the fastest
            const std::size_t axis = d - 1;
            from += both.fromStride[axis];
            to += both.toStride[axis];
            if (++at[axis] < both.count[axis]) break;
            from -= both.fromStride[axis] * both.count[axis];
            to -= both.toStride[axis] * both.count[axis];
            at[axis] = 0;
        }
        if (d == 0 || rank == 0) return;
    }
}

// Values of so many bytes each.
template <std::size_t kBytes>
void copyRows(const Overlap& both, const std::byte* from, std::byte* to) {
    const std::uint64_t count = both.count.empty() ? 1 : both.count.back();
    const std::uint64_t stride = both.count.empty() ? 1 : both.fromStride.back();
    forEachRowOf(both, [&](std::uint64_t source, std::uint64_t target) {
        if (stride == 1) {
            std::memcpy(to + target * kBytes, from + source * kBytes, count * kBytes);
            return;
        }
        for (std::uint64_t i = 0; i < count; ++i)
            std::memcpy(to + (target + i) * kBytes, from + (source + i * stride) * kBytes, kBytes);
    });
}

// `from` is one value, for all.
template <std::size_t kBytes>
void fillRows(const Overlap& both, const std::byte* from, std::byte* to) {
    const std::uint64_t count = both.count.empty() ? 1 : both.count.back();
    forEachRowOf(both, [&](std::uint64_t, std::uint64_t target) {
        for (std::uint64_t i = 0; i < count; ++i)
            std::memcpy(to + (target + i) * kBytes, from, kBytes);
    });
}

template <typename Use>
void withBytes(std::size_t valueBytes, Use use) {
    switch (valueBytes) {
        case 1:
            return use(std::integral_constant<std::size_t, 1>());
        case 2:
            return use(std::integral_constant<std::size_t, 2>());
        case 4:
            return use(std::integral_constant<std::size_t, 4>());
        default:
            return use(std::integral_constant<std::size_t, 8>());
    }
}

}  // namespace

std::string ZarrValues::tooLarge(std::uint64_t values) const {
    // What no file holds is the fill, so that any file may declare any size: beyond some for all,
    // what is believed of the best packed (of Zstandard, 2^15 times its bytes), half never written.
    constexpr double kFree = 1 << 24, kMostPerByte = 1 << 16;
    if (values > kMaxPoints) return fmt::format("expected at most 2^32 points, found {}", values);
    const double bytes = static_cast<double>(values) * static_cast<double>(array_.valueBytes());
    const double held =
        kFree + kMostPerByte * store_.bytesBelow(array_.folder, (bytes - kFree) / kMostPerByte);
    return held >= bytes ? ""
                         : fmt::format(
                               "expected files that hold {:.0f} bytes of values, found few "
                               "or none",
                               bytes);
}

// "c/0/1/2" of version 3's own names, "0.1.2" of version 2; of an array without dimensions "c",
// "0".
std::string ZarrValues::fileOf(const Index& chunk) const {
    std::string name = array_.keyStart;
    for (const std::uint64_t along : chunk)
        name += (name.empty() ? "" : array_.separator) + std::to_string(along);
    return zarrJoined(array_.folder, name.empty() ? "0" : name);
}

std::optional<ZarrValues::Packed> ZarrValues::find(const Index& chunk) {
    if (array_.shards) return findInShard(chunk);
    chunkFile_ = fileOf(chunk);
    auto file = store_.open(chunkFile_);
    if (!file) return std::nullopt;
    const std::uint64_t most = mostPackedBytes(array_.chunkBytes()), bytes = file->bytes();
    if (bytes > most)
        throw std::invalid_argument(
            fmt::format("expected at most {} bytes for {} of values, found "
                        "{}",
                        most, array_.chunkBytes(), bytes));
    return Packed{std::move(file), 0, bytes};
}

void ZarrValues::openShard(const std::string& name) {
    shardFile_.clear();
    shardIndex_.clear();
    if (const auto file = store_.open(name)) {
        shardWritten_ = file->written();
        std::uint64_t bytes = 2 * sizeof(std::uint64_t);
        for (std::size_t d = 0; d < array_.chunk.size(); ++d)
            bytes *= array_.shards->shape[d] / array_.chunk[d];
        const auto& codecs = array_.shards->indexCodecs;
        const std::uint64_t whole = bytes + 4 * codecs.size();
        const std::uint64_t from =
            array_.shards->indexFirst ? 0 : file->bytes() - std::min(whole, file->bytes());
        ZarrBytes index = unpackZarrChunk(file->read(from, whole), codecs, bytes);
        if (array_.shards->indexSwapped) swapBytes(index, sizeof(std::uint64_t));
        shardIndex_.resize(bytes / sizeof(std::uint64_t));
        std::memcpy(shardIndex_.data(), index.data(), bytes);
    }
    shardFile_ = name;
}

std::optional<ZarrValues::Packed> ZarrValues::findInShard(const Index& chunk) {
    Index shard(chunk.size());
    std::uint64_t number = 0;  // of the chunk in its shard, in C order
    for (std::size_t d = 0; d < chunk.size(); ++d) {
        const std::uint64_t along = array_.shards->shape[d] / array_.chunk[d];
        shard[d] = chunk[d] / along;
        number = number * along + chunk[d] % along;
    }
    chunkFile_ = fileOf(shard);
    auto file = store_.open(chunkFile_);
    if (chunkFile_ != shardFile_ || (file && file->written() != shardWritten_))
        openShard(chunkFile_);
    if (shardIndex_.empty()) return std::nullopt;
    const std::uint64_t from = shardIndex_[2 * number], bytes = shardIndex_[2 * number + 1];
    if (from == kNoChunk && bytes == kNoChunk) return std::nullopt;
    const std::uint64_t most = mostPackedBytes(array_.chunkBytes());
    if (bytes > most)
        throw std::invalid_argument(
            fmt::format("expected at most {} bytes for {} of values, found {} in the shard's index",
                        most, array_.chunkBytes(), bytes));
    if (!file) throw std::invalid_argument("expected the shard, but it has gone");
    return Packed{std::move(file), from, bytes};
}

const ZarrBytes* ZarrValues::unpacked(const Index& chunk) {
    try {
        const auto packed = find(chunk);
        if (!packed) return nullptr;
        const auto known = kept_.find(chunk);
        const std::int64_t written = packed->file->written();
        if (known != kept_.end() && known->second.written == written) return &known->second.bytes;
        if (!keeps_) kept_.clear();
        ZarrBytes bytes = unpackZarrChunk(packed->file->read(packed->from, packed->bytes),
                                          array_.codecs, array_.chunkBytes());
        if (array_.swapped) swapBytes(bytes, array_.valueBytes());
        return &kept_.insert_or_assign(chunk, Kept{written, std::move(bytes)}).first->second.bytes;
    } catch (const std::invalid_argument& flaw) {
        throw FileError(fmt::format("{}: {}", store_.told(chunkFile_), flaw.what()));
    }
}

void ZarrValues::keepOnly(const Index& first, const Index& last,
                          std::span<const std::size_t> count) {
    double bytes = static_cast<double>(array_.chunkBytes());
    bool haveMore = false;  // than the block
    for (std::size_t d = 0; d < first.size(); ++d) {
        bytes *= static_cast<double>(last[d] - first[d] + 1);
        haveMore = haveMore || (count[d] < array_.chunk[d] && count[d] < array_.shape[d]);
    }
    keeps_ = haveMore && bytes <= kMaxKeptChunks;
    std::erase_if(kept_, [&](const auto& each) {
        const Index& chunk = each.first;
        for (std::size_t d = 0; d < first.size(); ++d)
            if (chunk[d] < first[d] || chunk[d] > last[d]) return true;
        return !keeps_;
    });
}

void ZarrValues::read(std::span<const std::size_t> start, std::span<const std::size_t> count,
                      std::byte* values) {
    const std::size_t rank = array_.shape.size();
    Index first(rank), last(rank);
    double chunks = 1;
    for (std::size_t d = 0; d < rank; ++d) {
        if (count[d] == 0) return;
        first[d] = start[d] / array_.chunk[d];
        last[d] = (start[d] + count[d] - 1) / array_.chunk[d];
        chunks *= static_cast<double>(last[d] - first[d] + 1);
    }
    if (chunks > static_cast<double>(kMaxZarrChunks))
        throw FileError(fmt::format("{}: expected a step in at most {} chunks, found {:.0f}",
                                    store_.told(array_.folder), kMaxZarrChunks, chunks));
    keepOnly(first, last, count);
    const auto fill = array_.fillBytes();
    for (Index chunk = first;;) {
        const ZarrBytes* const bytes = unpacked(chunk);
        const Overlap both = overlapOf(array_, chunk, start, count);
        withBytes(array_.valueBytes(), [&](auto n) {
            if (bytes)
                copyRows<n()>(both, bytes->data(), values);
            else
                fillRows<n()>(both, fill.data(), values);
        });
        std::size_t d = rank;
        for (; d > 0; chunk[d - 1] = first[d - 1], --d)
            if (++chunk[d - 1] <= last[d - 1]) break;
        if (d == 0) return;
    }
}

}  // namespace timeseries
