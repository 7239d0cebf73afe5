#include "render/image/color.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace render {
namespace {

TEST(Srgb8, EveryStepSurvivesDecodingAndEncoding) {
    for (int step = 0; step <= 255; ++step) {
        EXPECT_EQ(srgb8FromLinear(linearFromSrgb(step / 255.0)), step);
    }
}

TEST(Srgb8, RoundsToTheNearestStepAfterEncoding) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> light(0, 1);
    for (int i = 0; i < 20'000; ++i) {
        const double linear = light(random) * light(random);
        const double encoded = 255 * srgbFromLinear(linear);
        // Ties fall either way within the rounding of the two curves, inverse to about 1e-7 where
        // the standard joins them.
        EXPECT_LE(std::abs(srgb8FromLinear(linear) - encoded), 0.5 + 1e-4) << linear;
    }
}

TEST(Srgb8, ClampsAndTakesNanAsBlack) {
    EXPECT_EQ(srgb8FromLinear(-1), 0);
    EXPECT_EQ(srgb8FromLinear(7), 255);
    EXPECT_EQ(srgb8FromLinear(std::numeric_limits<double>::infinity()), 255);
    EXPECT_EQ(srgb8FromLinear(-std::numeric_limits<double>::infinity()), 0);
    EXPECT_EQ(srgb8FromLinear(std::numeric_limits<double>::quiet_NaN()), 0);
}

}  // namespace
}  // namespace render
