// What a sorted step on disk is put together from, by whoever writes it: blocks, where they lie,
// and what stands around them (FORMAT.md).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "timeseries/index/bit_fields.h"
#include "timeseries/index/step_file.h"

namespace timeseries {

// So many blocks have their ids together, and their keys behind them: few are in memory at once.
constexpr std::uint64_t kBlocksTogether = 256;
// Of which so many are found at a time.
constexpr std::uint64_t kBlocksFound = 64;

struct EncodedBlock {
    Bytes ids, keys;
    StepBlock entry;  // it lies nowhere yet
};

// Into `out`, whose memory it uses again. REQUIRES: at least one point, at most kStepBlock, by
// value, ties by grid index.
template <typename T>
void encodeBlock(std::span<const T> values, std::span<const std::uint32_t> gridIndex,
                 const BrickOrder& order, EncodedBlock& out);

std::array<std::uint32_t, 3> sizeOf(const Grid& grid);

// Makes a block of a list: its number, and into what.
using Encode = std::function<void(std::uint64_t, EncodedBlock&)>;

// Writes a list of so many points: `encode` makes a block of it, on several threads at once, of
// those that `find` was last asked for, kBlocksFound that follow each other from a multiple of it
// on, or the last ones. Nothing: goOn() said no.
struct WrittenBlocks {
    std::vector<StepBlock> directory;
    std::uint64_t end;  // the byte behind them
};
std::optional<WrittenBlocks> writeBlocks(std::uint64_t points,
                                         const std::function<void(const Run&)>& find,
                                         const Encode& encode, ByteSink& sink,
                                         const std::function<bool(double)>& goOn, unsigned threads);

// Gives blocks their places, one after the other from byte `at` on: all of a step, or as many as
// lie together, from a multiple of kBlocksTogether on. Returns the byte behind them.
std::uint64_t placeBlocks(std::span<StepBlock> blocks, std::uint64_t at);

// The ranks of the points that are the quantiles at 0, 1/(n-1), ..., 1 of `among` (nearest rank);
// none of no points.
std::vector<std::uint64_t> quantileRanks(const Run& among, std::size_t n);

// All that a file says of a step beside its points.
struct StepFacts {
    ValueType type{};
    std::array<std::uint32_t, 3> size{};  // of the grid, in points
    StepStatistics statistics;            // finiteMin is NaN where nothing is finite
    std::vector<double> quantiles;
    std::string about;
};

// Directory and summary, from byte `at` on, and the header, which is written last.
void finishStep(const StepFacts& facts, std::span<const StepBlock> directory, std::uint64_t at,
                ByteSink& sink);

}  // namespace timeseries
