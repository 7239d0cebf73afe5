#include <algorithm>
#include <atomic>

#include "timeseries/index/step_blocks.h"
#include "timeseries/index/step_header.h"

namespace timeseries {
namespace {

// Blocks [first, first + count) of the step.
std::vector<EncodedBlock> encodeSome(const SortedStep& step, std::uint64_t first,
                                     std::uint64_t count, const BrickOrder& order,
                                     unsigned threads) {
    const Run run{first * kStepBlock,
                  std::min(step.size(), (first + count) * kStepBlock) - first * kStepBlock};
    const Columns columns = step.columns({&run, 1});
    std::vector<EncodedBlock> encoded(count);
    std::atomic<std::uint64_t> next{0};
    sharing(threadsFor(count, 1, threads), [&](unsigned) {
        for (std::uint64_t b; (b = next++) < count;) {
            const std::uint64_t from = (first + b) * kStepBlock;
            const std::uint64_t points = std::min(kStepBlock, step.size() - from);
            encoded[b] = std::visit(
                [&]<typename T>(std::span<const T> values) {
                    return encodeBlock<T>(values.subspan(from, points),
                                          columns.gridIndex.subspan(from, points), order);
                },
                columns.values);
        }
    });
    return encoded;
}

}  // namespace

bool writeStep(const SortedStep& step, const std::string& about, ByteSink& sink,
               const std::function<bool(double)>& goOn, unsigned threads) {
    std::array<std::uint32_t, 3> size;
    std::ranges::transform(step.grid().size(), size.begin(),
                           [](std::size_t n) { return static_cast<std::uint32_t>(n); });
    const BrickOrder order(size);
    const std::uint64_t blocks = (step.size() + kStepBlock - 1) / kStepBlock;

    std::vector<StepBlock> directory;
    directory.reserve(blocks);
    std::uint64_t at = kHeaderBytes;
    Bytes together;
    for (std::uint64_t first = 0; first < blocks; first += kBlocksTogether) {
        if (goOn && !goOn(static_cast<double>(first) / static_cast<double>(blocks))) return false;
        const std::uint64_t count = std::min(kBlocksTogether, blocks - first);
        const auto encoded = encodeSome(step, first, count, order, threads);
        together.clear();
        for (const EncodedBlock& block : encoded) {
            together.insert(together.end(), block.ids.begin(), block.ids.end());
            directory.push_back(block.entry);
        }
        for (const EncodedBlock& block : encoded)
            together.insert(together.end(), block.keys.begin(), block.keys.end());
        sink.write(at, together);
        at = placeBlocks(std::span(directory).subspan(first), at);
    }
    finishStep({step.type(), size, step.statistics(), step.quantiles(kStepQuantiles), about},
               directory, at, sink);
    return true;
}

}  // namespace timeseries
