#include "timeseries/index/joined_lists.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace timeseries {
namespace {

TEST(JoinedLists, AnyStretchIsThatOfTheMergedList) {
    std::mt19937 random(5);
    for (int round = 0; round < 200; ++round) {
        // Numbers dealt out to two lists, in stretches, or all of them to one.
        std::vector<int> all(random() % 60), lists[2];
        int next = -20;
        for (int& number : all) number = next += 1 + static_cast<int>(random() % 3);
        const auto stretch = 1 + random() % 20, only = random() % 6;
        for (std::size_t i = 0; i < all.size(); ++i)
            lists[only < 2 ? only : random() % stretch == 0].push_back(all[i]);
        const JoinedLists<int> joined(lists[0], lists[1]);
        ASSERT_EQ(joined.size(), all.size());
        for (std::size_t from = 0; from <= all.size(); ++from) {
            std::vector<int> some(random() % (all.size() - from + 1));
            joined.copy(from, some);
            ASSERT_TRUE(std::equal(some.begin(), some.end(),
                                   all.begin() + static_cast<std::ptrdiff_t>(from)));
            if (from < all.size()) {
                ASSERT_EQ(joined[from], all[from]);
            }
        }
        for (int number = -25; number < next + 3; ++number)
            ASSERT_EQ(joined.countBelow(number),
                      static_cast<std::uint64_t>(
                          std::ranges::count_if(all, [&](int each) { return each < number; })));
    }
}

}  // namespace
}  // namespace timeseries
