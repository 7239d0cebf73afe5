#include "render/gl/timer.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include "tests/support/gl_planes.h"

namespace render::gl {
namespace {

class GpuTimers : public tests::GlTest {};

// As where rows are summed on the processor, of which the driver knows nothing.
TEST_F(GpuTimers, CountWorkBetweenTheCallsOfTheDriver) {
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::milliseconds kWork(20);
    Timer timer;
    timer.begin();
    for (const auto end = Clock::now() + kWork; Clock::now() < end;) {
    }
    timer.end(7);
    glFinish();
    const auto time = timer.poll();
    ASSERT_TRUE(time);
    EXPECT_EQ(time->label, 7u);
    EXPECT_GE(time->took, kWork);
}

}  // namespace
}  // namespace render::gl
