// The order in which a step on disk numbers its points, and how it writes these numbers.
#include "timeseries/index/id_codec.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <numeric>
#include <random>
#include <span>
#include <vector>

#include "timeseries/index/brick_order.h"

namespace timeseries {
namespace {

TEST(BrickOrder, IsABijectionThatKeepsNearPointsNear) {
    for (const std::array<std::uint32_t, 3> size : {std::array<std::uint32_t, 3>{1, 1, 1},
                                                    {70, 3, 33},
                                                    {64, 64, 64},
                                                    {1, 40, 40},
                                                    {500, 1, 1}}) {
        const BrickOrder order(size);
        const std::uint32_t points = size[0] * size[1] * size[2];
        std::vector<std::uint32_t> codes(points), expected(points);
        std::iota(expected.begin(), expected.end(), 0u);
        for (std::uint32_t i = 0; i < points; ++i) {
            codes[i] = order.code(i);
            ASSERT_LT(codes[i], order.codes());
        }
        EXPECT_TRUE(order.toGridIndices(codes.data(), codes.size()));
        EXPECT_EQ(codes, expected);
    }
    // The 32768 codes of the first brick are its points, whatever lies beyond it.
    const BrickOrder order({64, 64, 64});
    for (std::uint32_t z = 0; z < 64; z += 7)
        for (std::uint32_t x = 0; x < 64; ++x)
            EXPECT_EQ(order.code(x + 64 * 64 * z) < 32768, x < 32 && z < 32);
}

TEST(BrickOrder, RefusesCodesThatNoPointHas) {
    const BrickOrder order({33, 40, 5});
    std::vector<bool> taken(order.codes() + 100);
    for (std::uint32_t i = 0; i < 33 * 40 * 5; ++i) taken[order.code(i)] = true;
    for (std::uint32_t code = 0; code < taken.size(); ++code) {
        std::uint32_t made = code;
        ASSERT_EQ(order.toGridIndices(&made, 1), taken[code]) << code;
    }
}

TEST(IdCodec, GivesBackAnyAscendingNumbers) {
    std::mt19937_64 random(8);
    for (int bits = 1; bits <= 32; ++bits)
        for (const std::size_t most : {1u, 2u, 300u, 32768u}) {
            std::vector<std::uint32_t> ids;
            std::uint64_t id = random() >> (64 - bits);
            while (ids.size() < most && id <= 0xffffffffu) {
                ids.push_back(static_cast<std::uint32_t>(id));
                id += 1 + (random() % 3 == 0 ? random() >> (64 - bits) : random() % 20);
            }
            Bytes bytes;
            encodeIds(ids, bytes);
            const std::size_t size = bytes.size();
            bytes.resize(size + kReadBeyond);
            std::vector<std::uint32_t> decoded(ids.size());
            ASSERT_TRUE(decodeIds(std::span(bytes).first(size), decoded));
            EXPECT_EQ(decoded, ids);
            EXPECT_FALSE(decodeIds(std::span(bytes).first(size - 1), decoded));
        }
}

}  // namespace
}  // namespace timeseries
