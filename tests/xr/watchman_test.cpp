#include "xr/watchman.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cerrno>

namespace xr {
namespace {

using namespace std::chrono_literals;

TEST(Watchman, EndsASystemCallThatTakesTooLong) {
    Watchman watchman;
    std::array<int, 2> ends{};
    ASSERT_EQ(pipe(ends.data()), 0);
    const Watchman::Watch watch(watchman, 10ms);
    char c = 0;
    EXPECT_EQ(read(ends[0], &c, 1), -1) << "nobody writes";
    EXPECT_EQ(errno, EINTR);
    EXPECT_TRUE(watch.fired());
    for (const int end : ends) close(end);
}

TEST(Watchman, LeavesAloneWhatIsInTime) {
    Watchman watchman;
    const Watchman::Watch watch(watchman, 1h);
    EXPECT_FALSE(watch.fired());
}

// On a busy machine its thread may be late, and the call may have come back by another way.
TEST(Watchman, KnowsThatPatienceIsOverBeforeItsThreadDoes) {
    Watchman watchman;
    for (int i = 0; i < 1000; ++i) {
        const Watchman::Watch watch(watchman, 0ns);
        ASSERT_TRUE(watch.fired()) << i;
    }
}

}  // namespace
}  // namespace xr
