#include "timeseries/index/kept_blocks.h"

#include <algorithm>

#include "timeseries/together.h"

namespace timeseries {
namespace {

constexpr std::size_t kPiece = std::size_t{8} << 20;  // more than any block has
constexpr std::uint64_t kMostTogether = std::uint64_t{64} << 20;
constexpr std::size_t kPiecesWorthAThread = 64;  // pieces of some 50 KB

}  // namespace

std::span<const std::byte> BlockMemory::copyOf(const Bytes& bytes) {
    if (used_ + bytes.size() > kPiece) {
        ++piece_;
        used_ = 0;
    }
    if (piece_ == pieces_.size()) pieces_.emplace_back(kPiece);
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

void BlockWriter::write(std::span<const KeptBlock> blocks, std::span<const StepBlock> places) {
    std::vector<Piece> pieces;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        pieces.push_back({places[b].idsAt, blocks[b].ids});
        pieces.push_back({places[b].keysAt, blocks[b].keys});
    }
    std::ranges::sort(pieces, {}, &Piece::at);
    for (std::size_t first = 0, end; first < pieces.size(); first = end) {
        std::uint64_t behind = pieces[first].at;
        for (end = first; end < pieces.size() && pieces[end].at == behind &&
                          behind - pieces[first].at < kMostTogether;
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
