#include "render/color.h"

#include <gtest/gtest.h>

namespace render {
namespace {

TEST(Color, EncodingAndDecodingAreInverses) {
    for (int i = 0; i <= 1000; ++i)
        EXPECT_NEAR(linearFromSrgb(srgbFromLinear(i / 1000.0)), i / 1000.0, 1e-12) << i;
}

TEST(Color, TheTwoBranchesOfTheCurveMeet) {
    // IEC 61966-2-1: the straight part ends at 0.04045, where both parts agree to the standard's
    // own rounding.
    EXPECT_NEAR(linearFromSrgb(0.04045), linearFromSrgb(0.04045 + 1e-9), 1e-7);
}

}  // namespace
}  // namespace render
