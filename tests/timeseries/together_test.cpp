#include "timeseries/together.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <barrier>
#include <chrono>
#include <cstdlib>
#include <mutex>
#include <set>
#include <stdexcept>

#include "timeseries/readers/forked_call.h"

namespace timeseries {
namespace {

// Whoever works on it. All wait for each other, so that it ends only where they run at once.
std::set<std::thread::id> workers(unsigned threads) {
    std::barrier all(static_cast<std::ptrdiff_t>(threads));
    std::mutex lock;
    std::set<std::thread::id> found;
    together(threads, [&](unsigned) {
        all.arrive_and_wait();
        const std::lock_guard held(lock);
        found.insert(std::this_thread::get_id());
    });
    return found;
}

TEST(Together, HasEachPartDoneOnceWhateverWasBefore) {
    for (const unsigned threads : {1u, 3u, 2u, 7u, 1u, 5u}) {
        std::vector<int> done(threads);
        together(threads, [&](unsigned k) { ++done[k]; });
        EXPECT_EQ(done, std::vector<int>(threads, 1)) << threads;
    }
}

TEST(Together, RunsAllAtOnceOnTheCallersThreadAndOthersThatAreKept) {
    const std::set<std::thread::id> three = workers(3), again = workers(3), five = workers(5);
    EXPECT_EQ(three.size(), 3u);
    EXPECT_TRUE(three.contains(std::this_thread::get_id()));
    EXPECT_EQ(again, three);
    EXPECT_EQ(five.size(), 5u);
    EXPECT_TRUE(std::ranges::includes(five, three));
}

// Longer apart than a helper stays awake.
TEST(Together, WakesThoseWhoSleep) {
    const std::set<std::thread::id> before = workers(2);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_EQ(workers(2), before);
}

TEST(Together, MayBeCalledByWhoIsCalled) {
    std::atomic<unsigned> sum{0};
    together(3, [&](unsigned k) {
        together(4, [&](unsigned l) { sum += 4 * k + l; });
        sum += static_cast<unsigned>(workers(2).size());
    });
    EXPECT_EQ(sum, 66u + 6u);  // 0 + 1 + ... + 11, and two each
}

TEST(Together, EachCallerHasItsOwn) {
    std::mutex lock;
    std::multiset<std::thread::id> all;
    std::vector<std::jthread> callers;
    std::barrier begun(4);
    for (int i = 0; i < 4; ++i)
        callers.emplace_back([&] {
            for (int call = 0; call < 50; ++call) workers(2);
            const auto found = workers(3);
            begun.arrive_and_wait();  // none has ended
            const std::lock_guard held(lock);
            all.insert(found.begin(), found.end());
        });
    callers.clear();
    EXPECT_EQ(all.size(), 12u);
    EXPECT_EQ(std::set(all.begin(), all.end()).size(), 12u);
}

// Those of a process are not in its copy, which tells by crashing that it came so far: of one that
// waits nothing is told.
TEST(Together, WorksInACopyOfTheProcess) {
    const auto died = [] {
        workers(3);
        std::abort();
    };
    workers(3);
    EXPECT_EQ(endOfForked(died, std::chrono::seconds(20)), "crashes");
    EXPECT_EQ(workers(3).size(), 3u);
}

TEST(Sharing, PassesOnWhatOneHasThrownWhenAllHaveEnded) {
    std::atomic<int> ended{0};
    const auto failing = [&](unsigned k) {
        if (k == 1) throw std::runtime_error("one of them");
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        ++ended;
    };
    EXPECT_THROW(sharing(3, failing), std::runtime_error);
    EXPECT_EQ(ended, 2);
    EXPECT_EQ(workers(3).size(), 3u);
}

TEST(InParts, CoversAllOnceInOrder) {
    for (const std::size_t count : {0u, 1u, 10u, 1001u}) {
        std::vector<int> times(count);
        inParts(count, 3, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) ++times[i];
        });
        EXPECT_EQ(times, std::vector<int>(count, 1));
    }
}

}  // namespace
}  // namespace timeseries
