// CIEDE2000 against the published test data, and what of it follows from its formula.
#include "render/reference/color_difference.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace render {
namespace {

struct Pair {
    Lab one, other;
    double difference;
};
// Sharma, Wu and Dalal 2005, table 1.
constexpr std::array<Pair, 34> kPublished = {{
    {{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
    {{50, 3.1571, -77.2803}, {50, 0, -82.7485}, 2.8615},
    {{50, 2.8361, -74.0200}, {50, 0, -82.7485}, 3.4412},
    {{50, -1.3802, -84.2814}, {50, 0, -82.7485}, 1.0000},
    {{50, -1.1848, -84.8006}, {50, 0, -82.7485}, 1.0000},
    {{50, -0.9009, -85.5211}, {50, 0, -82.7485}, 1.0000},
    {{50, 0, 0}, {50, -1, 2}, 2.3669},
    {{50, -1, 2}, {50, 0, 0}, 2.3669},
    {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0009}, 7.1792},
    {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0010}, 7.1792},
    {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0011}, 7.2195},
    {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0012}, 7.2195},
    {{50, -0.0010, 2.4900}, {50, 0.0009, -2.4900}, 4.8045},
    {{50, -0.0010, 2.4900}, {50, 0.0010, -2.4900}, 4.8045},
    {{50, -0.0010, 2.4900}, {50, 0.0011, -2.4900}, 4.7461},
    {{50, 2.5, 0}, {50, 0, -2.5}, 4.3065},
    {{50, 2.5, 0}, {73, 25, -18}, 27.1492},
    {{50, 2.5, 0}, {61, -5, 29}, 22.8977},
    {{50, 2.5, 0}, {56, -27, -3}, 31.9030},
    {{50, 2.5, 0}, {58, 24, 15}, 19.4535},
    {{50, 2.5, 0}, {50, 3.1736, 0.5854}, 1.0000},
    {{50, 2.5, 0}, {50, 3.2972, 0}, 1.0000},
    {{50, 2.5, 0}, {50, 1.8634, 0.5757}, 1.0000},
    {{50, 2.5, 0}, {50, 3.2592, 0.3350}, 1.0000},
    {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
    {{63.0109, -31.0961, -5.8663}, {62.8187, -29.7946, -4.0864}, 1.2630},
    {{61.2901, 3.7196, -5.3901}, {61.4292, 2.2480, -4.9620}, 1.8731},
    {{35.0831, -44.1164, 3.7933}, {35.0232, -40.0716, 1.5901}, 1.8645},
    {{22.7233, 20.0904, -46.6940}, {23.0331, 14.9730, -42.5619}, 2.0373},
    {{36.4612, 47.8580, 18.3852}, {36.2715, 50.5065, 21.2231}, 1.4146},
    {{90.8027, -2.0831, 1.4410}, {91.1528, -1.6435, 0.0447}, 1.4441},
    {{90.9257, -0.5406, -0.9208}, {88.6381, -0.8985, -0.7239}, 1.5381},
    {{6.7747, -0.2908, -2.4247}, {5.8714, -0.0985, -2.2286}, 0.6377},
    {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082},
}};

TEST(Ciede2000, IsThePublishedDataToTheirLastDigit) {
    for (std::size_t i = 0; i < kPublished.size(); ++i) {
        const auto& [one, other, difference] = kPublished[i];
        EXPECT_NEAR(ciede2000(one, other), difference, 5.1e-5) << "pair " << i + 1;
    }
}

TEST(Ciede2000, IsSymmetricAndNoneBetweenEquals) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> l(0, 100), ab(-100, 100);
    for (int i = 0; i < 1000; ++i) {
        const Lab one{l(random), ab(random), ab(random)}, other{l(random), ab(random), ab(random)};
        EXPECT_NEAR(ciede2000(one, other), ciede2000(other, one), 1e-9);
        EXPECT_EQ(ciede2000(one, one), 0);
        EXPECT_GT(ciede2000(one, other), 0);
    }
}

// Greys differ by lightness alone: |dL| / S_L.
TEST(Ciede2000, GreysDifferByTheirLightness) {
    const double sl = 1 + 0.015 * 100 / std::sqrt(20 + 100);  // the mean lightness is 60
    EXPECT_NEAR(ciede2000({55, 0, 0}, {65, 0, 0}), 10 / sl, 1e-12);
}

TEST(LabFromLinear, WhiteBlackAndGreysAreNeutral) {
    const Lab white = labFromLinear(glm::dvec3(1)), black = labFromLinear(glm::dvec3(0));
    EXPECT_NEAR(white.l, 100, 1e-12);
    EXPECT_NEAR(black.l, 0, 1e-12);
    // L* = 116 (Y / Yn)^(1/3) - 16.
    const Lab grey = labFromLinear(glm::dvec3(0.18));
    EXPECT_NEAR(grey.l, 116 * std::cbrt(0.18) - 16, 1e-12);
    EXPECT_NEAR(grey.a, 0, 1e-12);
    EXPECT_NEAR(grey.b, 0, 1e-12);
    EXPECT_EQ(labFromLinear(glm::dvec3(7)).l, white.l);  // a display shows no more
}

// X, Y, Z of the red primary are 0.4124, 0.2126, 0.0193, of white 0.9505, 1, 1.0890.
TEST(LabFromLinear, RedHasTheCoordinatesOfItsPrimary) {
    const Lab red = labFromLinear({1, 0, 0});
    EXPECT_NEAR(red.l, 116 * std::cbrt(0.2126) - 16, 1e-9);
    EXPECT_NEAR(red.a, 500 * (std::cbrt(0.4124 / 0.9505) - std::cbrt(0.2126)), 1e-9);
    EXPECT_NEAR(red.b, 200 * (std::cbrt(0.2126) - std::cbrt(0.0193 / 1.0890)), 1e-9);
}

const glm::vec3 kGround(0.1f, 0.2f, 0.3f);

TEST(ColorDifferenceQuantile, LeavesOutWhatIsBackgroundInBoth) {
    const Image reference({10, 10}, glm::vec4(kGround, 1));
    Image tested = reference;
    EXPECT_EQ(colorDifferenceQuantile(tested, reference, kGround, 0.95), 0);
    const glm::vec4 white(1);
    tested.at(3, 3) = white;
    const double one = ciede2000(labFromLinear(glm::dvec3(1)), labFromLinear(glm::dvec3(kGround)));
    EXPECT_NEAR(colorDifferenceQuantile(tested, reference, kGround, 0.95), one, 1e-5);
    EXPECT_NEAR(colorDifferenceQuantile(reference, tested, kGround, 0.95), one, 1e-5);
}

// Twenty pixels, one of them off: 0.95 of them are not; of all, one is.
TEST(ColorDifferenceQuantile, IsTheNearestRank) {
    const Image reference({20, 1}, glm::vec4(0.5f));
    Image tested = reference;
    tested.at(7, 0) = glm::vec4(1);
    EXPECT_EQ(colorDifferenceQuantile(tested, reference, kGround, 0.95), 0);
    EXPECT_GT(colorDifferenceQuantile(tested, reference, kGround, 0.951), 10);
    EXPECT_GT(colorDifferenceQuantile(tested, reference, kGround, 1), 10);
}

TEST(ColorDifferenceQuantile, NanIsNeverHidden) {
    const Image reference({20, 1}, glm::vec4(0.5f));
    Image tested = reference;
    tested.at(7, 0).g = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(std::isnan(colorDifferenceQuantile(tested, reference, kGround, 0.5)));
    EXPECT_TRUE(std::isnan(colorDifferenceQuantile(reference, tested, kGround, 0.5)));
}

TEST(ColorDifferenceQuantile, SizesMustAgree) {
    EXPECT_THROW(colorDifferenceQuantile(Image({2, 1}), Image({1, 2}), kGround, 0.95),
                 std::invalid_argument);
}

}  // namespace
}  // namespace render
