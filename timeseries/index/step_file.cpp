#include "timeseries/index/step_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>

#include "timeseries/grid/with_type.h"
#include "timeseries/index/id_codec.h"
#include "timeseries/index/ordered_key.h"
#include "timeseries/index/pair_sort.h"
#include "timeseries/index/step_blocks.h"
#include "timeseries/index/step_header.h"

namespace timeseries {
namespace {

// What a number of the type was, from its bits.
Number numberOfBits(ValueType type, std::uint64_t bits) {
    return withType(type, [&]<typename T>(T) {
        T value;
        std::memcpy(&value, &bits, sizeof value);
        return numberOf(value);
    });
}

// Bytes read for a decoder, with what it may read beyond them.
class Piece {
 public:
    explicit Piece(std::size_t bytes)
        : bytes_(bytes), at_(std::make_unique_for_overwrite<std::byte[]>(bytes + kReadBeyond)) {
        std::memset(at_.get() + bytes, 0, kReadBeyond);
    }
    std::span<std::byte> bytes() const { return {at_.get(), bytes_}; }

 private:
    std::size_t bytes_;
    std::unique_ptr<std::byte[]> at_;
};

// Which points of a grid a list has come to: a bit each, or where it has few of them, so that a
// damaged grid asks for no more memory than the list does, their numbers.
class PointsMet {
 public:
    PointsMet(std::uint64_t grid, std::uint64_t points) {
        constexpr std::uint64_t kBitsOfNumber = 8 * sizeof(std::uint64_t);
        if (grid / kBitsOfNumber <= points) bits_.resize(grid);
    }
    // False where it has been there before.
    bool meet(std::uint32_t point) {
        if (bits_.empty()) return few_.insert(point).second;
        const bool isNew = !bits_[point];
        bits_[point] = true;
        return isNew;
    }

 private:
    std::vector<bool> bits_;
    std::unordered_set<std::uint32_t> few_;
};

// More than any block of so many points needs, so that a damaged list asks for no more memory.
constexpr std::uint64_t kMostIdsBytes = 64 + 6 * kStepBlock, kMostKeysBytes = 64 + 9 * kStepBlock;

}  // namespace

void StepFile::damaged(const std::string& what) const {
    throw DamagedStepError(fmt::format("{} is a damaged sorted step: {}", name(), what));
}

StepFile::StepFile(std::unique_ptr<const ByteSource> bytes) : bytes_(std::move(bytes)) {
    const StepHeader header = readHeader();
    checkSizes(header);
    type_ = static_cast<ValueType>(header.type);
    size_ = header.size;
    readBlocks(header);
    readSummary(header);
}

StepHeader StepFile::readHeader() const {
    std::array<std::byte, kHeaderBytes> page;
    if (bytes_->size() < page.size())
        throw DamagedStepError(fmt::format("{}: expected an index of a time step, found {} bytes",
                                           name(), bytes_->size()));
    bytes_->read(0, page);
    StepHeader header;
    std::memcpy(&header, page.data(), sizeof header);
    if (header.magic != kStepMagic)
        throw DamagedStepError(
            fmt::format("{}: expected an index of a time step, found another file", name()));
    if (header.endian != kEndianMark && header.endian != kOtherEndianMark)
        damaged(fmt::format("it has no byte order {:#x}", header.endian));
    if (header.endian != kEndianMark)
        throw OtherStepError(
            fmt::format("{} was written on a machine of the other byte order", name()));
    if (header.version != kStepVersion)
        throw OtherStepError(fmt::format("{} is of version {} of the index, expected {}", name(),
                                         header.version, kStepVersion));
    if (header.sum != sumOfBytes(std::span(page).first(offsetof(StepHeader, sum))))
        damaged("its header does not match its checksum");
    for (std::size_t i = sizeof(StepHeader); i < page.size(); ++i)
        if (page[i] != std::byte{0}) damaged(fmt::format("expected 0 at byte {}", i));
    if (header.fileBytes != bytes_->size())
        damaged(fmt::format("expected {} bytes, found {}", header.fileBytes, bytes_->size()));
    return header;
}

void StepFile::checkSizes(const StepHeader& header) const {
    if (header.type > static_cast<std::uint32_t>(ValueType::F64))
        damaged(fmt::format("it has no type {}", header.type));
    // Three numbers of 32 bits: by division, their product may pass 64.
    constexpr std::uint64_t kMostPoints = std::uint64_t{1} << 32;
    std::uint64_t points = 1;
    for (const std::uint32_t n : header.size) {
        if (n == 0 || n > kMostPoints / points) damaged("its grid has no size");
        points *= n;
    }
    if (header.points == 0 || header.points > points || header.missing != points - header.points)
        damaged(fmt::format("{} points and {} missing ones are not the grid's {}", header.points,
                            header.missing, points));
    if (header.blockPoints != kStepBlock || header.blocks != (header.points - 1) / kStepBlock + 1)
        damaged("its number of blocks is not that of its points");

    const auto within = [&](const StepSection& section) {
        return section.at >= kHeaderBytes && section.bytes <= bytes_->size() &&
               section.at <= bytes_->size() - section.bytes;
    };
    if (!within(header.directory) || header.directory.bytes != header.blocks * sizeof(StepBlock))
        damaged("its directory lies outside it");
    if (!within(header.summary) || header.summary.bytes > kMostSummary)
        damaged("its summary lies outside it");
}

void StepFile::readBlocks(const StepHeader& header) {
    blocks_.resize(header.blocks);
    const auto directory = std::as_writable_bytes(std::span(blocks_));
    bytes_->read(header.directory.at, directory);
    if (sumOfBytes(directory) != header.directory.sum)
        damaged("its directory does not match its checksum");
    const std::uint64_t mostKey = withType(type_, [](auto value) {
        return std::uint64_t{std::numeric_limits<OrderedKey<decltype(value)>>::max()};
    });
    std::uint64_t left = header.points, before = 0;
    for (const StepBlock& block : blocks_) {
        const auto inFile = [&](std::uint64_t at, std::uint64_t size, std::uint64_t most) {
            return at >= kHeaderBytes && size <= most && at <= bytes_->size() &&
                   size <= bytes_->size() - at;
        };
        if (block.count != std::min(left, kStepBlock) || block.least < before ||
            block.greatest < block.least || block.greatest > mostKey ||
            !inFile(block.idsAt, block.idsBytes, kMostIdsBytes) ||
            !inFile(block.keysAt, block.keysBytes, kMostKeysBytes))
            damaged(fmt::format("its directory contradicts itself at block {}",
                                &block - blocks_.data()));
        before = block.greatest;
        left -= block.count;
    }

    statistics_ = {header.points,
                   header.missing,
                   numberOfBits(type_, header.extent[0]),
                   numberOfBits(type_, header.extent[1]),
                   std::nan(""),
                   std::nan("")};
    if (header.anyFinite != 0) {
        statistics_.finiteMin = numberOfBits(type_, header.extent[2]);
        statistics_.finiteMax = numberOfBits(type_, header.extent[3]);
    }
}

void StepFile::readSummary(const StepHeader& header) {
    const Piece piece(header.summary.bytes);
    bytes_->read(header.summary.at, piece.bytes());
    if (sumOfBytes(piece.bytes()) != header.summary.sum)
        damaged("its summary does not match its checksum");
    std::uint64_t count = 0;
    if (piece.bytes().size() < sizeof count) damaged("its summary ends early");
    count = load<std::uint64_t>(piece.bytes().data());
    const std::span<const std::byte> rest = piece.bytes().subspan(sizeof count);
    if (count > rest.size() / sizeof(double)) damaged("its summary ends early");
    quantiles_.resize(count);
    std::ranges::copy(rest.first(count * sizeof(double)),
                      std::as_writable_bytes(std::span(quantiles_)).begin());
    const auto text = rest.subspan(count * sizeof(double));
    about_.assign(reinterpret_cast<const char*>(text.data()), text.size());
}

const BrickOrder& StepFile::order() const {
    std::call_once(orderMade_, [&] { order_ = std::make_unique<const BrickOrder>(size_); });
    return *order_;
}

void StepFile::willNeed(std::size_t firstBlock, std::size_t blocks) const {
    // Between the ids of blocks and their keys lie those of others.
    const auto some = std::span(blocks_).subspan(firstBlock, blocks);
    const auto expect = [&](auto at, auto bytes) {
        for (std::size_t i = 0, next; i < some.size(); i = next) {
            std::uint64_t end = some[i].*at;
            for (next = i; next < some.size() && some[next].*at == end; ++next)
                end += some[next].*bytes;
            if (end > some[i].*at) bytes_->willNeed(some[i].*at, end - some[i].*at);
        }
    };
    expect(&StepBlock::idsAt, &StepBlock::idsBytes);
    expect(&StepBlock::keysAt, &StepBlock::keysBytes);
}

template <typename Key>
void StepFile::readKeys(const StepBlock& block, std::span<Key> keys) const {
    const Piece piece(block.keysBytes);
    bytes_->read(block.keysAt, piece.bytes());
    if (static_cast<std::uint32_t>(sumOfBytes(piece.bytes())) != block.keysSum ||
        !decodeKeys<Key>(piece.bytes(), block.layout, static_cast<Key>(block.least),
                         static_cast<Key>(block.greatest), keys))
        damaged(fmt::format("the values of block {} do not match its directory",
                            &block - blocks_.data()));
}

template <typename T>
void StepFile::read(std::size_t index, std::span<T> values,
                    std::span<std::uint32_t> gridIndex) const {
    const StepBlock& block = blocks_[index];
    const Piece piece(block.idsBytes);
    bytes_->read(block.idsAt, piece.bytes());
    if (static_cast<std::uint32_t>(sumOfBytes(piece.bytes())) != block.idsSum ||
        !decodeIds(piece.bytes(), gridIndex) ||
        !order().toGridIndices(gridIndex.data(), gridIndex.size()))
        damaged(fmt::format("the points of block {} do not match its directory", index));
    // Kept from block to block: fresh pages take as long as a tenth of it all.
    static thread_local std::vector<OrderedKey<T>> keys(kStepBlock);
    static thread_local std::vector<PackedPoint<T>> packed(kStepBlock);
    const auto own = std::span(keys).first(block.count);
    readKeys<OrderedKey<T>>(block, own);
    sortPairs<T>(own, gridIndex, values, packed);
}

std::uint64_t StepFile::below(std::size_t index, std::uint64_t key) const {
    const StepBlock& block = blocks_[index];
    if (key <= block.least) return 0;
    if (key > block.greatest) return block.count;
    return withType(type_, [&]<typename T>(T) {
        const auto keys = std::make_unique_for_overwrite<OrderedKey<T>[]>(block.count);
        readKeys<OrderedKey<T>>(block, {keys.get(), block.count});
        std::uint64_t count = 0;
        for (std::uint32_t i = 0; i < block.count; ++i) count += keys[i] < key;
        return count;
    });
}

void StepFile::check() const {
    withType(type_, [&]<typename T>(T) { checkPoints<T>(); });
}

template <typename T>
void StepFile::checkPoints() const {
    PointsMet met(std::uint64_t{size_[0]} * size_[1] * size_[2], statistics_.points);
    std::vector<T> values(kStepBlock);
    std::vector<std::uint32_t> gridIndex(kStepBlock);
    const auto take = [&](std::size_t b) {
        read<T>(b, std::span(values).first(blocks_[b].count),
                std::span(gridIndex).first(blocks_[b].count));
    };
    Run finite{0, 0};  // infinities lie at the ends
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        take(b);
        for (std::uint32_t i = 0; i < blocks_[b].count; ++i) {
            if (!met.meet(gridIndex[i]))
                damaged(fmt::format("point {} stands in its list twice", gridIndex[i]));
            if (!std::isfinite(static_cast<double>(values[i]))) continue;
            if (finite.count++ == 0) finite.first = b * kStepBlock + i;
        }
    }
    std::size_t taken = blocks_.size() - 1;  // is there yet
    const auto numberAt = [&](std::uint64_t rank) {
        if (const std::size_t b = rank / kStepBlock; b != taken) take(taken = b);
        return numberOf(values[rank % kStepBlock]);
    };
    const std::uint64_t last = statistics_.points - 1;
    bool same = numberAt(0) == statistics_.min && numberAt(last) == statistics_.max;
    if (finite.count > 0)
        same = same && numberAt(finite.first) == statistics_.finiteMin &&
               numberAt(finite.first + finite.count - 1) == statistics_.finiteMax;
    else
        same = same && std::isnan(toDouble(statistics_.finiteMin));
    if (!same) damaged("its least and greatest values are not those of its list");
    const std::vector<std::uint64_t> ranks = quantileRanks(finite, quantiles_.size());
    if (!std::ranges::equal(ranks, quantiles_, {}, [&](auto r) { return toDouble(numberAt(r)); }))
        damaged("its quantiles are not those of its list");
}

#define ISOCHRON_TYPE(T) \
    template void StepFile::read(std::size_t, std::span<T>, std::span<std::uint32_t>) const;
ISOCHRON_EACH_TYPE(ISOCHRON_TYPE)
#undef ISOCHRON_TYPE

}  // namespace timeseries
