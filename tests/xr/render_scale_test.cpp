// Frame times of modelled machines in, resolution out.
#include "xr/render_scale.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace xr {
namespace {

using std::chrono::nanoseconds;

constexpr nanoseconds kPeriod{11'111'111};

// A machine that needs `fixed` periods a frame and `perPixels` more at full resolution.
struct Machine {
    double fixed, perPixels;
    double time(double scale) const { return fixed + perPixels * scale * scale; }

    void run(RenderScale& scale, int frames) const {
        for (int i = 0; i < frames; ++i)
            scale.took(nanoseconds(std::llround(time(scale.scale()) * 11'111'111)), kPeriod);
    }
};

TEST(RenderScale, AMachineThatHoldsTheRateDrawsAll) {
    RenderScale scale;
    Machine{0.2, 0.7}.run(scale, 1000);
    EXPECT_EQ(scale.scale(), 1);
}

TEST(RenderScale, ComesToRestWhereFramesAreInTime) {
    for (const Machine machine : {Machine{0.1, 1}, {0.0, 2.5}, {0.5, 0.6}, {0.1, 1.7}}) {
        RenderScale scale;
        machine.run(scale, 1000);
        EXPECT_LE(machine.time(scale.scale()), RenderScale::kLate);
        EXPECT_GT(machine.time(scale.scale() + 0.101), RenderScale::kQuick) << "lower than need be";
        std::set<double> seen;
        for (int i = 0; i < 1000; ++i) {
            machine.run(scale, 1);
            seen.insert(scale.scale());
        }
        EXPECT_EQ(seen.size(), 1u) << "does not swing";
    }
}

TEST(RenderScale, StaysWithinItsBounds) {
    RenderScale scale;
    Machine{3, 3}.run(scale, 1000);
    EXPECT_EQ(scale.scale(), 0.5);
    Machine{0.1, 0.1}.run(scale, 1000);
    EXPECT_EQ(scale.scale(), 1);
}

TEST(RenderScale, GoesInSmallStepsDownQuicklyAndUpSlowly) {
    RenderScale scale;
    int down = 0, up = 0;
    for (double before = 1; scale.scale() > 0.5; before = scale.scale(), ++down) {
        Machine{2, 2}.run(scale, 1);
        EXPECT_LE(before - scale.scale(), 0.05 + 1e-12);
    }
    for (double before = 0.5; scale.scale() < 1; before = scale.scale(), ++up) {
        Machine{0.1, 0.1}.run(scale, 1);
        EXPECT_LE(scale.scale() - before, 0.05 + 1e-12);
    }
    EXPECT_GT(up, 10 * down);
}

TEST(RenderScale, ASingleLateFrameChangesNothing) {
    RenderScale scale;
    for (int i = 0; i < 100; ++i) {
        scale.took(10 * kPeriod, kPeriod);
        scale.took(kPeriod / 2, kPeriod);
    }
    EXPECT_EQ(scale.scale(), 1);
}

}  // namespace
}  // namespace xr
