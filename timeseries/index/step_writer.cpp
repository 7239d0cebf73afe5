#include <algorithm>

#include "timeseries/index/kept_blocks.h"
#include "timeseries/index/step_blocks.h"
#include "timeseries/index/step_header.h"

namespace timeseries {

std::array<std::uint32_t, 3> sizeOf(const Grid& grid) {
    std::array<std::uint32_t, 3> size;
    std::ranges::transform(grid.size(), size.begin(),
                           [](std::size_t n) { return static_cast<std::uint32_t>(n); });
    return size;
}

std::optional<WrittenBlocks> writeBlocks(std::uint64_t points,
                                         const std::function<void(const Run&)>& find,
                                         const Encode& encode, ByteSink& sink,
                                         const std::function<bool(double)>& goOn,
                                         unsigned threads) {
    const std::uint64_t blocks = (points + kStepBlock - 1) / kStepBlock;
    std::vector<StepBlock> directory;
    directory.reserve(blocks);
    std::uint64_t at = kHeaderBytes;
    KeptBlocks kept;
    for (std::uint64_t first = 0; first < blocks; first += kBlocksTogether) {
        if (goOn && !goOn(static_cast<double>(first) / static_cast<double>(blocks)))
            return std::nullopt;
        kept.clear();
        const std::uint64_t end = std::min(first + kBlocksTogether, blocks);
        for (std::uint64_t next = first, behind; next < end; next = behind) {
            behind = std::min(next + kBlocksFound, end);
            find({next * kStepBlock, std::min(points, behind * kStepBlock) - next * kStepBlock});
            kept.add(
                behind - next, [&](std::uint64_t b, EncodedBlock& out) { encode(next + b, out); },
                threads);
        }
        for (const KeptBlock& block : kept.blocks()) directory.push_back(block.entry);
        const auto places = std::span(directory).subspan(first);
        at = placeBlocks(places, at);
        write(kept.blocks(), places, sink);
    }
    return WrittenBlocks{std::move(directory), at};
}

bool writeStep(const SortedStep& step, const std::string& about, ByteSink& sink,
               const std::function<bool(double)>& goOn, unsigned threads) {
    const std::array<std::uint32_t, 3> size = sizeOf(step.grid());
    const BrickOrder order(size);
    Columns columns;
    const auto encode = [&](std::uint64_t block, EncodedBlock& out) {
        const std::uint64_t from = block * kStepBlock;
        const std::uint64_t points = std::min(kStepBlock, step.size() - from);
        std::visit(
            [&]<typename T>(std::span<const T> values) {
                encodeBlock<T>(values.subspan(from, points),
                               columns.gridIndex.subspan(from, points), order, out);
            },
            columns.values);
    };
    const auto blocks = writeBlocks(
        step.size(),
        [&](const Run& points) {
            columns = step.columns({&points, 1});
        },
        encode, sink, goOn, threads);
    if (!blocks) return false;
    finishStep({step.type(), size, step.statistics(), step.quantiles(kStepQuantiles), about},
               blocks->directory, blocks->end, sink);
    return true;
}

}  // namespace timeseries
