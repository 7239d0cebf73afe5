// A sorted step on disk: its points in order of value, in blocks that are read one by one.
// timeseries/index/FORMAT.md says what lies where.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "timeseries/grid/field.h"
#include "timeseries/index/brick_order.h"
#include "timeseries/index/byte_source.h"
#include "timeseries/index/key_codec.h"
#include "timeseries/index/sorted_step.h"

namespace timeseries {

struct StepHeader;  // timeseries/index/step_header.h

// Points of a block; the last one may have fewer.
constexpr std::uint64_t kStepBlock = std::uint64_t{1} << 15;

// A block as the file lists it. Keys are OrderedKey's, widened.
struct StepBlock {
    std::uint64_t least = 0, greatest = 0;  // keys
    std::uint64_t idsAt = 0, keysAt = 0;    // bytes into the file
    std::uint32_t idsBytes = 0, keysBytes = 0;
    std::uint32_t idsSum = 0, keysSum = 0;  // the lower half of XXH3
    std::uint32_t count = 0;
    KeyLayout layout;
    std::uint8_t spare = 0;
};
static_assert(sizeof(StepBlock) == 56);

// Immutable; every member is safe to call from any thread. What a damaged file says is never
// believed further than it can be checked: members throw StepFileError, whose sentence names it.
class StepFile {
 public:
    // Reads what the file lists, a few hundred thousandths of it.
    explicit StepFile(std::unique_ptr<const ByteSource> bytes);

    ValueType type() const { return type_; }
    const std::array<std::uint32_t, 3>& size() const { return size_; }  // of the grid, in points
    const StepStatistics& statistics() const { return statistics_; }
    std::span<const StepBlock> blocks() const { return blocks_; }
    // StepSummary's, of all points.
    const std::vector<double>& quantiles() const { return quantiles_; }
    // What whoever wrote it said of it.
    const std::string& about() const { return about_; }
    std::uint64_t bytes() const { return bytes_->size(); }
    std::string name() const { return bytes_->name(); }
    void willNeed(std::size_t firstBlock, std::size_t blocks) const;

    // The block's points by value, ties by grid index, as SortedStep has them. REQUIRES: T is of
    // type(), and both spans have the block's count.
    template <typename T>
    void read(std::size_t block, std::span<T> values, std::span<std::uint32_t> gridIndex) const;
    // How many of a block's keys are below this one.
    std::uint64_t below(std::size_t block, std::uint64_t key) const;
    // Reads all of it: whether each point is there at most once, and what is told of all of them is
    // theirs. Takes a bit for each point of the grid, or less.
    void check() const;

 private:
    StepHeader readHeader() const;
    void checkSizes(const StepHeader& header) const;
    void readBlocks(const StepHeader& header);
    void readSummary(const StepHeader& header);
    template <typename T>
    void checkPoints() const;
    template <typename Key>
    void readKeys(const StepBlock& block, std::span<Key> keys) const;
    [[noreturn]] void damaged(const std::string& what) const;

    std::unique_ptr<const ByteSource> bytes_;
    ValueType type_{};
    std::array<std::uint32_t, 3> size_{};
    StepStatistics statistics_;
    std::vector<StepBlock> blocks_;
    std::vector<double> quantiles_;
    std::string about_;
    const BrickOrder& order() const;
    // Made when the first block is read: of thousands of steps that are opened few are.
    mutable std::once_flag orderMade_;
    mutable std::unique_ptr<const BrickOrder> order_;
};

// Writes a step: the same bytes for the same points, on any number of threads. `about`: what to
// keep beside them. `goOn` is asked, with the share that is written, between some blocks.
// REQUIRES: all values were kept, and the step has a point. False: goOn() said no, and what is
// written is of no use. Throws StepFileError, and std::bad_alloc.
bool writeStep(const SortedStep& step, const std::string& about, ByteSink& sink,
               const std::function<bool(double)>& goOn = {}, unsigned threads = sharingThreads());
// The same of the field that a step would be built of, with less memory than its list: of `atOnce`
// points of it, and fewer than 2^21 and a bucket's more; 0: of a part of them. REQUIRES: a value
// that is neither missing nor NaN. Throws std::length_error for more than 2^32 points, too.
bool writeField(const Field& field, const std::string& about, ByteSink& sink,
                const std::function<bool(double)>& goOn = {}, unsigned threads = sharingThreads(),
                std::uint64_t atOnce = 0);

}  // namespace timeseries
