#include "timeseries/index/kept_blocks.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/step_bytes.h"

namespace timeseries {
namespace {

struct Writes final : tests::BytesWritten {
    void writePieces(std::uint64_t at,
                     std::span<const std::span<const std::byte>> pieces) override {
        sizes.push_back(0);
        for (const auto piece : pieces) {
            write(at + sizes.back(), piece);
            sizes.back() += piece.size();
        }
    }
    std::vector<std::size_t> sizes;
};

TEST(KeptBlocks, AreWrittenWhereTheyLieInAsFewPiecesAsMayBe) {
    std::mt19937 random(3);
    const auto some = [&](std::size_t most) {
        Bytes bytes(random() % most);
        for (std::byte& byte : bytes) byte = static_cast<std::byte>(1 + random() % 255);
        return bytes;
    };
    std::vector<EncodedBlock> blocks(3 * kBlocksTogether - 50);
    std::vector<KeptBlock> kept;
    std::vector<StepBlock> places;
    BlockMemory memory;
    for (EncodedBlock& block : blocks) {
        block.ids = some(9000);
        if (random() % 3 > 0) block.keys = some(9000);
        block.entry.idsBytes = static_cast<std::uint32_t>(block.ids.size());
        block.entry.keysBytes = static_cast<std::uint32_t>(block.keys.size());
        kept.push_back(memory.keep(block));
        places.push_back(block.entry);
    }
    const std::uint64_t end = placeBlocks(places, 100);
    Bytes expected(end);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        std::ranges::copy(blocks[b].ids, expected.begin() + static_cast<long>(places[b].idsAt));
        std::ranges::copy(blocks[b].keys, expected.begin() + static_cast<long>(places[b].keysAt));
    }
    Writes whole;
    write(kept, places, whole);
    EXPECT_EQ(whole.bytes, expected);
    EXPECT_EQ(whole.sizes, std::vector<std::size_t>{end - 100});

    // A rank's, of which others' lie between the ids and the keys.
    Writes part;
    write(std::span(kept).subspan(10, 100), std::span(places).subspan(10, 100), part);
    EXPECT_EQ(part.sizes.size(), 2u);
}

}  // namespace
}  // namespace timeseries
