// What a library does to the copy of the process in which it is asked.
#include "xr/forked_answer.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <thread>

namespace xr {
namespace {

using namespace std::chrono_literals;
using Answer = std::variant<std::string, NoAnswer>;

TEST(ForkedAnswer, IsWhatWasReturnedThereAndNothingChangesHere) {
    int asked = 0;
    const std::string empty, longer(300'000, 'x');
    for (const std::string& text : {empty, std::string("one sentence"), longer})
        EXPECT_EQ(forkedAnswer([&] { return ++asked, text; }, 60s), Answer(text));
    EXPECT_EQ(asked, 0);
    testing::internal::CaptureStderr();
    EXPECT_EQ(forkedAnswer([] { return std::fputs("noise", stderr), std::string("a"); }, 60s),
              Answer("a"));
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ForkedAnswer, OfALibraryThatCrashesOrEndsTheProgramIsNone) {
    for (const int fault : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGKILL})
        EXPECT_EQ(forkedAnswer([=] { return std::raise(fault), std::string(); }, 60s),
                  Answer(NoAnswer::Crashed))
            << fault;
    EXPECT_EQ(forkedAnswer([]() -> std::string { _exit(0); }, 60s), Answer(NoAnswer::Crashed));
    EXPECT_EQ(forkedAnswer([]() -> std::string { throw std::runtime_error("no"); }, 60s),
              Answer(NoAnswer::Crashed));
}

TEST(ForkedAnswer, OfALibraryThatHangsIsNotWaitedForLong) {
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(forkedAnswer(
                  []() -> std::string {
                      while (true) pause();
                  },
                  50ms),
              Answer(NoAnswer::TookTooLong));
    EXPECT_EQ(forkedAnswer(
                  []() -> std::string {
                      while (true) std::this_thread::yield();
                  },
                  50ms),
              Answer(NoAnswer::TookTooLong));
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 30s);
}

}  // namespace
}  // namespace xr
