#include "render/image/encode_srgb.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "render/image/color.h"

namespace {

// Light well within the step of each of the 256 bytes.
float lightOf(std::uint8_t step) {
    const double s = step / 255.0;
    return static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
}

std::vector<std::uint8_t> encoded(const std::vector<float>& light) {
    std::vector<std::uint8_t> bytes(light.size());
    render::encodeSrgb8(light, bytes);
    return bytes;
}

TEST(EncodeSrgb, KnowsEveryStep) {
    std::vector<float> light;
    for (int step = 0; step < 256; ++step)
        light.push_back(lightOf(static_cast<std::uint8_t>(step)));
    const std::vector<std::uint8_t> bytes = encoded(light);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        EXPECT_EQ(bytes[i], i);
        EXPECT_EQ(bytes[i], render::srgb8FromLinear(light[i]));
    }
}

TEST(EncodeSrgb, WhatIsNoLightIsBlackAndWhatIsMoreThanAllIsWhite) {
    const std::vector<float> light{-1, std::nanf(""), -INFINITY, 0, 1, 2, INFINITY, 1e30f};
    EXPECT_EQ(encoded(light), (std::vector<std::uint8_t>{0, 0, 0, 0, 255, 255, 255, 255}));
}

// Ground is one colour again and again; one value among it that is another must not be lost,
// wherever it lies, nor reach beside itself.
TEST(EncodeSrgb, OneOtherValueInAnEvenGround) {
    for (const std::size_t channels : {1, 3, 4})
        for (const std::size_t count : {std::size_t{1}, std::size_t{3}, std::size_t{500}}) {
            std::vector<float> light;
            std::vector<std::uint8_t> expected;
            for (std::size_t i = 0; i < count * channels; ++i) {
                expected.push_back(static_cast<std::uint8_t>(40 + 50 * (i % channels)));
                light.push_back(lightOf(expected.back()));
            }
            EXPECT_EQ(encoded(light), expected);
            for (std::size_t other = 0; other < light.size(); ++other) {
                auto changed = light;
                auto changedBytes = expected;
                changed[other] = lightOf(changedBytes[other] = 7);
                ASSERT_EQ(encoded(changed), changedBytes) << other << " of " << light.size();
            }
        }
}

}  // namespace
