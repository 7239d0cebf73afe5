#include "render/splat/pieces.h"

#include <algorithm>

#include "render/points/block_order.h"

namespace render {
namespace {

// What passing over a point costs, in splats: a thirtieth on llvmpipe (tests/bench/NOTES.md).
constexpr double kPassedOver = 1.0 / 32;

// `splats` among them, evenly.
void cut(std::vector<Piece>& pieces, Piece whole, std::uint64_t splats) {
    const double each = std::max(
        static_cast<double>(splats) / static_cast<double>(std::max(whole.count, std::uint64_t{1})),
        kPassedOver);
    const std::uint64_t end = whole.first + whole.count;
    for (; whole.first < end; whole.first += kPiecePoints) {
        whole.count = std::min(kPiecePoints, end - whole.first);
        whole.cost = static_cast<std::uint64_t>(std::ceil(each * static_cast<double>(whole.count)));
        pieces.push_back(whole);
    }
}

// All that lies in the blocks that the run touches, or their beginnings, which hold the subset.
void cutRun(std::vector<Piece>& pieces, std::size_t layer, const timeseries::Run& run,
            std::uint32_t stride, std::uint64_t points) {
    constexpr std::uint64_t kBlock = kSubsetPeriod;
    const std::uint64_t end = run.first + run.count;
    for (std::uint64_t block = run.first / kBlock * kBlock; block < end; block += kBlock) {
        const std::uint64_t size = std::min(kBlock, points - block);
        const std::uint64_t from = std::max(run.first, block), to = std::min(end, block + size);
        cut(pieces,
            {.layer = layer,
             .from = static_cast<std::uint32_t>(from - block),
             .last = static_cast<std::uint32_t>(to - 1 - block),
             .stride = stride,
             .first = block,
             .count = subsetCount({block, size}, prefixStride(stride)),
             .cost = 0},
            subsetCount({from, to - from}, stride));
    }
}

}  // namespace

std::vector<Piece> piecesOfSorted(std::uint64_t count) {
    std::vector<Piece> pieces;
    cut(pieces,
        {.layer = 0, .from = 0, .last = 0, .stride = 1, .first = 0, .count = count, .cost = 0},
        count);
    return pieces;
}

std::vector<Piece> piecesOfRuns(const Scene& scene) {
    std::vector<Piece> pieces;
    for (std::size_t k = 0; k < scene.layers.size(); ++k) {
        const std::uint32_t stride = strideOf(scene.layers[k], scene.stride);
        for (const timeseries::Run& run : scene.layers[k].runs)
            cutRun(pieces, k, run, stride, scene.step.size());
    }
    return pieces;
}

}  // namespace render
