// What happens to work that is tried out in a copy of the process.
#include "timeseries/readers/forked_call.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <thread>
#include <vector>

#include "tests/support/rounds.h"

namespace timeseries {
namespace {

using namespace std::chrono_literals;

TEST(ForkedCall, WorkThatEndsChangesNothingHere) {
    int value = 1;
    EXPECT_EQ(endOfForked([&] { value = 2; }, 10s), "");
    EXPECT_EQ(value, 1);
    EXPECT_EQ(endOfForked([] { throw std::runtime_error("told later"); }, 10s), "");
    testing::internal::CaptureStderr();
    EXPECT_EQ(endOfForked([] { static_cast<void>(::write(STDERR_FILENO, "noise", 5)); }, 10s), "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ForkedCall, WorkThatCrashesIsToldAndCrashesOnlyTheCopy) {
    for (const int fault : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTERM})
        EXPECT_EQ(endOfForked([=] { std::raise(fault); }, 10s), "crashes") << fault;
    EXPECT_EQ(endOfForked([] { std::abort(); }, 10s), "crashes");
    EXPECT_EQ(endOfForked([] { _exit(3); }, 10s), "crashes");
}

TEST(ForkedCall, WorkThatNeverEndsIsStopped) {
    std::atomic<unsigned> count = 0;
    EXPECT_EQ(endOfForked(
                  [&] {
                      while (true) ++count;
                  },
                  1s),
              "does not end within 1 s");
}

// As for a lock whose owner is not in the copy.
TEST(ForkedCall, WorkThatWaitsForNobodyIsGivenUp) {
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(endOfForked(
                  [] {
                      while (true) pause();
                  },
                  1s),
              "");
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 60s);
}

// It computes less than it waits, in each second of the limit something.
TEST(ForkedCall, WorkThatWaitsNowAndThenIsNotGivenUp) {
    EXPECT_EQ(endOfForked(
                  [] {
                      for (int i = 0; i < 30; ++i) std::this_thread::sleep_for(100ms);
                      std::raise(SIGSEGV);
                  },
                  1s),
              "crashes");
}

TEST(ForkedCall, WorkMayAllocateWhileOtherThreadsDo) {
    if (tests::kSanitized)
        GTEST_SKIP()
            << "the sanitizer's allocator, unlike glibc's, keeps its locks in a forked process";
    std::atomic<bool> stop = false;
    std::vector<std::thread> others;
    for (int i = 0; i < 3; ++i)
        others.emplace_back([&] {
            for (std::size_t n = 1; !stop; n = n % 5000 + 1) std::vector<char>(n).front() = 1;
        });
    for (int i = 0; i < 40; ++i)
        EXPECT_EQ(
            endOfForked([&] { std::vector<std::vector<char>>(50, std::vector<char>(100)); }, 10s),
            "");
    stop = true;
    for (std::thread& other : others) other.join();
}

}  // namespace
}  // namespace timeseries
