#include "timeseries/in_turn.h"

#include <gtest/gtest.h>

#include <memory>
#include <numeric>
#include <stdexcept>

namespace timeseries {
namespace {

std::vector<std::size_t> from(std::size_t first, std::size_t end) {
    std::vector<std::size_t> all(end - first);
    std::iota(all.begin(), all.end(), first);
    return all;
}

// What cannot be copied is handed on.
TEST(InTurn, TakesInOrderWhateverIsMadeFirst) {
    for (const std::size_t worthAThread : {1, 100, 10'000})
        for (const auto& [first, end] :
             {std::pair<std::size_t, std::size_t>{0, 0}, {0, 1}, {3, 500}, {7, 7}}) {
            std::vector<std::size_t> taken;
            inTurn(
                first, end, worthAThread,
                [](std::size_t i) { return std::make_unique<std::size_t>(i); },
                [&](std::size_t i, std::unique_ptr<std::size_t> made) {
                    EXPECT_EQ(*made, i);
                    taken.push_back(i);
                });
            EXPECT_EQ(taken, from(first, end)) << worthAThread;
        }
}

TEST(InTurn, ThrowsWhatTheFirstInOrderThrows) {
    for (const std::size_t worthAThread : {1, 10'000}) {
        std::vector<std::size_t> taken;
        const auto make = [](std::size_t i) {
            if (i == 200 || i >= 203) throw std::runtime_error(std::to_string(i));
            return i;
        };
        const auto take = [&](std::size_t i, std::size_t) { taken.push_back(i); };
        try {
            inTurn(0, 300, worthAThread, make, take);
            ADD_FAILURE() << "nothing was thrown";
        } catch (const std::runtime_error& error) {
            EXPECT_STREQ(error.what(), "200");
        }
        EXPECT_EQ(taken, from(0, 200));
    }
}

// What one made by a thread alone takes of memory, no other takes beside it.
TEST(InTurn, OnOneThreadTakesEachBeforeTheNextIsMade) {
    std::size_t made = 0;
    inTurn(
        0, 300, 10'000, [&](std::size_t) { return ++made; },
        [&](std::size_t i, std::size_t) { EXPECT_EQ(made, i + 1); });
    EXPECT_EQ(made, 300u);
}

}  // namespace
}  // namespace timeseries
