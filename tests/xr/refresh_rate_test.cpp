// Frame times of modelled machines in, a display's rate out.
#include "xr/refresh_rate.h"

#include <gtest/gtest.h>

#include <cmath>

namespace xr {
namespace {

using std::chrono::nanoseconds;

// A machine that needs `fixed` ms a frame and `perPixels` more at full resolution, on a display
// that takes the rate that it is asked for.
struct Loop {
    explicit Loop(std::vector<double> rates) : rate(std::move(rates)) {}
    RefreshRate rate;
    RenderScale scale;

    void run(double fixed, double perPixels, int frames) {
        for (int i = 0; i < frames; ++i) {
            const double ms = fixed + perPixels * scale.scale() * scale.scale();
            const nanoseconds frame(std::llround(1e6 * ms));
            scale.took(frame, nanoseconds(std::llround(1e9 / *rate.wanted())));
            rate.took(frame, scale);
        }
    }
};
constexpr int kLong = 20'000;

TEST(RefreshRate, BeginsAtTheHighestAndStaysWhereFramesAreInTime) {
    Loop loop({72, 120, 90});
    EXPECT_EQ(loop.rate.wanted(), 120);
    loop.run(2, 5, kLong);
    EXPECT_EQ(loop.rate.wanted(), 120);
    EXPECT_EQ(loop.rate.loweredText(), "");
}

TEST(RefreshRate, FewerPixelsComeFirst) {
    Loop loop({90, 72});
    loop.run(3, 12, kLong);  // 6 ms at the lowest scale
    EXPECT_LT(loop.scale.scale(), 1);
    EXPECT_EQ(loop.rate.wanted(), 90);
    // A runtime that shows every second period by itself leaves pixels to lower.
    RefreshRate rate({90, 72});
    RenderScale whole;
    for (int i = 0; i < kLong; ++i) {
        constexpr nanoseconds kFrame(15'000'000), kToldPeriod(22'222'222);
        whole.took(kFrame, kToldPeriod);
        rate.took(kFrame, whole);
    }
    EXPECT_EQ(whole.scale(), 1);
    EXPECT_EQ(rate.wanted(), 90);
}

TEST(RefreshRate, ComesToRestAtTheHighestThatCanBeHeld) {
    // At the lowest scale 9.5, 12.5, 30 ms, against 7.9, 10.6 and 13.2 (0.95 periods).
    for (const auto& [fixed, expected] : {std::pair{9.0, 90.0}, {12.0, 72.0}, {29.5, 72.0}}) {
        Loop loop({90, 72, 120});
        loop.run(fixed, 2, kLong);
        EXPECT_EQ(loop.rate.wanted(), expected);
        for (int i = 0; i < 2000; ++i) {
            loop.run(fixed, 2, 1);
            ASSERT_EQ(loop.rate.wanted(), expected) << "does not swing";
        }
    }
    Loop loop({90, 72, 120});
    loop.run(12, 2, kLong);
    EXPECT_EQ(loop.rate.loweredText(), "72 of 120 Hz");
}

TEST(RefreshRate, ClimbsBackSlowlyWhereThereIsRoom) {
    Loop loop({90, 72, 120});
    loop.run(30, 2, kLong);
    ASSERT_EQ(loop.rate.wanted(), 72);
    loop.run(2, 2, RefreshRate::kQuickFrames);  // the scale has to climb first
    EXPECT_EQ(loop.rate.wanted(), 72);
    loop.run(2, 2, kLong);
    EXPECT_EQ(loop.rate.wanted(), 120);
}

TEST(RefreshRate, AFewLateFramesChangeNothing) {
    Loop loop({90, 72});
    loop.run(30, 2, RefreshRate::kLateFrames - 1);
    for (int i = 0; i < 100; ++i) {
        loop.run(1, 1, 1);
        loop.run(30, 2, RefreshRate::kLateFrames - 1);
    }
    EXPECT_EQ(loop.rate.wanted(), 90);
}

TEST(RefreshRate, WithoutAChoiceThereIsNothingToAskFor) {
    RefreshRate none;
    RenderScale scale;
    for (int i = 0; i < 1000; ++i) {
        scale.took(std::chrono::seconds(1), std::chrono::milliseconds(1));
        none.took(std::chrono::seconds(1), scale);
    }
    EXPECT_EQ(none.wanted(), std::nullopt);
    EXPECT_EQ(RefreshRate({0, -1, std::nan("")}).wanted(), std::nullopt) << "not rates";
    Loop one({60});
    one.run(100, 2, kLong);
    EXPECT_EQ(one.rate.wanted(), 60);
}

}  // namespace
}  // namespace xr
