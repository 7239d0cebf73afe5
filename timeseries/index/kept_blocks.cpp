#include "timeseries/index/kept_blocks.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "timeseries/together.h"

namespace timeseries {
namespace {

// More than any block has; of a small list little is taken.
constexpr std::size_t kFirstPiece = std::size_t{1} << 20, kPiece = std::size_t{8} << 20;

}  // namespace

std::span<const std::byte> BlockMemory::copyOf(const Bytes& bytes) {
    if (used_ + bytes.size() > (piece_ == 0 ? kFirstPiece : kPiece)) {
        ++piece_;
        used_ = 0;
    }
    if (piece_ == pieces_.size()) pieces_.emplace_back(piece_ == 0 ? kFirstPiece : kPiece);
    std::byte* const at = pieces_[piece_].data() + used_;
    used_ += bytes.size();
    std::ranges::copy(bytes, at);
    return {at, bytes.size()};
}

KeptBlock BlockMemory::keep(const EncodedBlock& block) {
    return {block.entry, copyOf(block.ids), copyOf(block.keys)};
}

void BlockMemory::clear() {
    piece_ = 0;
    used_ = 0;
}

void KeptBlocks::add(std::uint64_t count, const Encode& encode, unsigned threads) {
    const std::size_t before = blocks_.size();
    blocks_.resize(before + count);
    const unsigned parts = threadsFor(count, 1, threads);
    memory_.resize(std::max<std::size_t>(memory_.size(), parts));
    std::atomic<std::uint64_t> next{0};
    sharing(parts, [&](unsigned part) {
        EncodedBlock block;
        for (std::uint64_t b; (b = next++) < count;) {
            encode(b, block);
            blocks_[before + b] = memory_[part].keep(block);
        }
    });
}

void KeptBlocks::clear() {
    blocks_.clear();
    for (BlockMemory& memory : memory_) memory.clear();
}

void write(std::span<const KeptBlock> blocks, std::span<const StepBlock> places, ByteSink& sink) {
    using Piece = std::span<const std::byte>;
    std::vector<std::pair<std::uint64_t, Piece>> all;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        all.emplace_back(places[b].idsAt, blocks[b].ids);
        all.emplace_back(places[b].keysAt, blocks[b].keys);
    }
    std::erase_if(all, [](const auto& piece) { return piece.second.empty(); });  // of one value
    std::ranges::sort(all, {}, [](const auto& piece) { return piece.first; });
    std::vector<Piece> together;
    for (std::size_t i = 0; i < all.size();) {
        const std::uint64_t from = all[i].first;
        std::uint64_t behind = from;
        for (together.clear(); i < all.size() && all[i].first == behind; ++i) {
            together.push_back(all[i].second);
            behind += all[i].second.size();
        }
        sink.writePieces(from, together);
    }
}

}  // namespace timeseries
