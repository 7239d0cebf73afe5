// The order in which the points of a block are drawn.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <random>
#include <set>
#include <tuple>

#include "render/gpu_step.h"

namespace render {
namespace {

// Grid indices of a lattice, each at most once, shuffled.
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

const std::vector<glm::uvec3> kSizes = {{64, 64, 64}, {200, 3, 70}, {1, 1, 90}, {1000, 1000, 2}};

TEST(NearOrder, HoldsEveryPointOnce) {
    for (const glm::uvec3 size : kSizes) {
        auto order = nearOrder(someOf(size, 1 << 15), size);
        std::sort(order.begin(), order.end());
        for (std::size_t i = 0; i < order.size(); ++i) ASSERT_EQ(order[i], i);
    }
    EXPECT_TRUE(nearOrder({}, {4, 4, 4}).empty());
    const auto most = someOf({64, 64, 64}, 1 << 16);
    EXPECT_EQ(nearOrder(most, {64, 64, 64}).size(), most.size());
}

TEST(NearOrder, VisitsEachOf32CellsAnAxisOnceAndKeepsTheGivenOrderInIt) {
    for (const glm::uvec3 size : kSizes) {
        const auto index = someOf(size, 1 << 15);
        std::set<std::tuple<unsigned, unsigned, unsigned>> left;
        std::tuple<unsigned, unsigned, unsigned> cell{~0u, 0, 0};
        std::size_t before = 0;
        for (const std::size_t i : nearOrder(index, size)) {
            const glm::uvec3 c = at(index[i], size) * 32u / size;
            const std::tuple now{c.x, c.y, c.z};
            if (now == cell) {
                ASSERT_LT(before, i);
            } else {
                ASSERT_TRUE(left.insert(now).second) << "a cell that was left already";
            }
            cell = now;
            before = i;
        }
    }
}

TEST(NearOrder, FollowsMortonsCurve) {
    // Of the 2^3k first points of the curve over a full lattice, all lie in a cube of side 2^k.
    const glm::uvec3 size(32, 32, 32);
    const auto index = someOf(size, 1 << 15);
    const auto order = nearOrder(index, size);
    for (unsigned side = 1, count = 1; side <= 32; side *= 2, count *= 8)
        for (unsigned i = 0; i < count; ++i) {
            const glm::uvec3 p = at(index[order[i]], size);
            ASSERT_LT(std::max({p.x, p.y, p.z}), side);
        }
}

}  // namespace
}  // namespace render
