// Encoded blocks of a step in memory, until it is known where in the file they lie.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "timeseries/grid/pages.h"
#include "timeseries/index/step_blocks.h"

namespace timeseries {

struct KeptBlock {
    StepBlock entry;  // it lies nowhere yet
    std::span<const std::byte> ids, keys;
};

// Where one thread keeps its blocks, in large pages.
class BlockMemory {
 public:
    // It lasts until clear(), or as long as this.
    KeptBlock keep(const EncodedBlock& block);
    void clear();  // the memory itself stays

 private:
    std::span<const std::byte> copyOf(const Bytes& bytes);

    std::vector<Pages<std::byte>> pieces_;
    std::size_t piece_ = 0, used_ = 0;  // of which bytes are taken next
};

// Blocks that are encoded at once, and where they are kept.
class KeptBlocks {
 public:
    // Encodes so many more, from number 0 of `encode` on, on as many threads.
    void add(std::uint64_t count, const Encode& encode, unsigned threads);
    void clear();  // their memory is used again
    std::span<const KeptBlock> blocks() const { return blocks_; }

 private:
    std::vector<KeptBlock> blocks_;
    std::vector<BlockMemory> memory_;  // a thread each
};

// Writes blocks where they lie.
void write(std::span<const KeptBlock> blocks, std::span<const StepBlock> places, ByteSink& sink);

}  // namespace timeseries
