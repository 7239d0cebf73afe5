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

// Writes blocks where they lie. What lies together is one write, for which the system takes larger
// pages of its cache than for many.
class BlockWriter {
 public:
    // No write begins with so many bytes before it that it could go with: memory is held for it.
    BlockWriter(ByteSink& sink, unsigned threads,
                std::uint64_t mostTogether = std::uint64_t{8} << 20)
        : sink_(sink), threads_(threads), mostTogether_(mostTogether) {}
    void write(std::span<const KeptBlock> blocks, std::span<const StepBlock> places);

 private:
    struct Piece {
        std::uint64_t at;
        std::span<const std::byte> bytes;
    };
    void writeTogether(std::span<const Piece> pieces);

    ByteSink& sink_;
    unsigned threads_;
    std::uint64_t mostTogether_;
    PageVector<std::byte> together_;
};

}  // namespace timeseries
