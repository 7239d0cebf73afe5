#include "timeseries/index/kept_blocks.h"

#include <algorithm>
#include <atomic>

#include "timeseries/together.h"

namespace timeseries {
namespace {

// More than any block has; of a small list little is taken.
constexpr std::size_t kFirstPiece = std::size_t{1} << 20, kPiece = std::size_t{8} << 20;
constexpr std::size_t kPiecesWorthAThread = 64;  // pieces of some 50 KB

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

void BlockWriter::write(std::span<const KeptBlock> blocks, std::span<const StepBlock> places) {
    std::vector<Piece> pieces;
    const auto add = [&](std::uint64_t at, std::span<const std::byte> bytes) {
        if (!bytes.empty()) pieces.push_back({at, bytes});  // keys of one value have none
    };
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        add(places[b].idsAt, blocks[b].ids);
        add(places[b].keysAt, blocks[b].keys);
    }
    std::ranges::sort(pieces, {}, &Piece::at);
    for (std::size_t first = 0, end; first < pieces.size(); first = end) {
        std::uint64_t behind = pieces[first].at;
        for (end = first; end < pieces.size() && pieces[end].at == behind &&
                          behind - pieces[first].at < mostTogether_;
             ++end)
            behind += pieces[end].bytes.size();
        writeTogether(std::span(pieces).subspan(first, end - first));
    }
}

void BlockWriter::writeTogether(std::span<const Piece> pieces) {
    const std::uint64_t from = pieces.front().at,
                        bytes = pieces.back().at + pieces.back().bytes.size() - from;
    together_.resize(std::max<std::size_t>(together_.size(), bytes));
    inParts(pieces.size(), threadsFor(pieces.size(), kPiecesWorthAThread, threads_),
            [&](std::size_t first, std::size_t end) {
                for (const Piece& piece : pieces.subspan(first, end - first))
                    std::ranges::copy(piece.bytes, together_.data() + (piece.at - from));
            });
    sink_.write(from, {together_.data(), bytes});
}

}  // namespace timeseries
