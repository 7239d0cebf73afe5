// The order in which the points of a block are drawn.
#include "render/points/block_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

#include "render/points/subset.h"

namespace render {
namespace {

// Grid indices of a grid, each at most once, shuffled.
std::vector<std::uint32_t> someOf(glm::uvec3 size, std::size_t count) {
    std::vector<std::uint32_t> all(std::size_t(size.x) * size.y * size.z);
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint32_t>(i);
    std::shuffle(all.begin(), all.end(), std::mt19937(11));
    all.resize(std::min(count, all.size()));
    return all;
}

glm::uvec3 at(std::uint32_t i, glm::uvec3 size) {
    return {i % size.x, i / size.x % size.y, i / size.x / size.y};
}

// Bits of x, y and z by turns, z's the most significant of each three.
std::uint32_t mortonCode(glm::uvec3 cell) {
    std::uint32_t code = 0;
    for (int bit = 4; bit >= 0; --bit)
        for (int a = 2; a >= 0; --a) code = 2 * code + (cell[a] >> bit & 1);
    return code;
}

const std::vector<glm::uvec3> kSizes = {{64, 64, 64}, {200, 3, 70}, {1, 1, 90}, {1000, 1000, 2}};

TEST(BlockOrder, IsBySubsetThenByCellOnMortonsCurveThenAsGiven) {
    for (const glm::uvec3 size : kSizes)
        for (const std::size_t most : {kSubsetPeriod, std::uint64_t{1000}}) {
            const auto index = someOf(size, most);
            std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint16_t>> expected;
            for (std::size_t i = 0; i < index.size(); ++i) {
                std::uint32_t stride = 256;  // of the coarsest subset that has it
                while (!inSubset(i, stride)) stride /= 4;
                expected.emplace_back(256 / stride, mortonCode(at(index[i], size) * 32u / size),
                                      static_cast<std::uint16_t>(i));
            }
            std::ranges::sort(expected);
            const auto order = blockOrder(index, size);
            ASSERT_EQ(order.size(), expected.size());
            for (std::size_t i = 0; i < order.size(); ++i)
                ASSERT_EQ(order[i], std::get<2>(expected[i])) << i;
        }
    EXPECT_TRUE(blockOrder({}, {4, 4, 4}).empty());
}

// Of a mesh places tell what is near, not numbers.
TEST(BlockOrder, OfAMeshIsThatOfItsPlaces) {
    const glm::uvec3 size(20, 9, 13);
    const auto index = someOf(size, 2000);
    // Point i of the mesh lies where point index[i] of the grid does; one has no place.
    const glm::dvec3 lo(-7, 100, 0);
    const timeseries::Mesh mesh(
        index.size(), std::vector{lo, lo + 2.0 * glm::dvec3(size - 1u)}, 1, [&](std::uint64_t i) {
            glm::dvec3 place = lo + 2.0 * glm::dvec3(at(index[i], size));
            if (i == 17) place.x = std::nan("");
            return timeseries::MeshPoint{place, {glm::dvec3(1, 0, 0), {0, 1, 0}, {0, 0, 1}}};
        });
    std::vector<std::uint32_t> all(index.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint16_t>> expected;
    for (std::size_t i = 0; i < all.size(); ++i) {
        std::uint32_t stride = 256;
        while (!inSubset(i, stride)) stride /= 4;
        // 32 cells between the outermost places, the last of which holds them, too.
        glm::uvec3 cell = glm::min(32u * at(index[i], size) / (size - 1u), glm::uvec3(31));
        if (i == 17) cell = glm::uvec3(0);
        expected.emplace_back(256 / stride, mortonCode(cell), static_cast<std::uint16_t>(i));
    }
    std::ranges::sort(expected);
    const auto order = blockOrder(all, mesh);
    ASSERT_EQ(order.size(), expected.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        ASSERT_EQ(order[i], std::get<2>(expected[i])) << i;
}

TEST(BlockOrder, BeginsWithASubsetThatHoldsAny) {
    for (std::uint32_t stride = 1; stride <= kMaxStride; stride *= 2) {
        EXPECT_LE(prefixStride(stride), stride);
        EXPECT_LT(stride, 4 * prefixStride(stride));
    }
    for (const std::size_t count : {kSubsetPeriod, std::uint64_t{777}}) {
        const auto order = blockOrder(someOf({64, 64, 64}, count), {64, 64, 64});
        for (std::uint32_t stride = 1; stride <= kMaxStride; stride *= 2)
            for (std::size_t i = 0; i < order.size(); ++i)
                ASSERT_EQ(inSubset(order[i], prefixStride(stride)),
                          i < subsetCount({0, count}, prefixStride(stride)));
    }
}

}  // namespace
}  // namespace render
