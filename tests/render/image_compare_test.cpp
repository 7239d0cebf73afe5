#include "render/reference/image_compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "render/image/color.h"

namespace render {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(CompareScalars, RelativeErrorIsTheNormOfTheDifferenceOverThatOfTheReference) {
    const std::vector<double> reference{3, 4, 0}, tested{3, 4, 2};  // |ref| = 5, |diff| = 2
    const auto error = compareScalars(tested, reference);
    EXPECT_DOUBLE_EQ(error.relativeL2, 2.0 / 5);
    EXPECT_DOUBLE_EQ(error.maxAbsolute, 2);
    EXPECT_DOUBLE_EQ(error.massRatio, 9.0 / 7);
}

TEST(CompareScalars, FloatsAreComparedInDouble) {
    const std::vector<float> tested{1.0f};
    const std::vector<double> reference{1.0 + 0x1p-40};  // rounds to 1 in float
    EXPECT_DOUBLE_EQ(compareScalars(tested, reference).maxAbsolute, 0x1p-40);
}

TEST(CompareScalars, AgainstAZeroReferenceOnlyZeroIsRight) {
    const std::vector<float> zero(5), small{0, 0, 1e-20f, 0, 0};
    EXPECT_EQ(compareScalars(zero, zero).relativeL2, 0);
    EXPECT_EQ(compareScalars(small, zero).relativeL2, kInf);
    EXPECT_EQ(compareScalars(small, zero).massRatio, kInf);
    EXPECT_EQ(compareScalars(zero, zero).massRatio, 1);
    EXPECT_EQ(compareScalars(std::span<const float>(), std::span<const float>()).relativeL2, 0);
}

TEST(CompareScalars, NanIsNeverHidden) {
    const std::vector<double> reference{1, 2, 3}, tested{1, std::nan(""), 30};
    EXPECT_TRUE(std::isnan(compareScalars(tested, reference).relativeL2));
    EXPECT_TRUE(std::isnan(compareScalars(tested, reference).maxAbsolute));
    EXPECT_TRUE(std::isnan(compareScalars(tested, reference).massRatio));
    EXPECT_TRUE(std::isnan(compareScalars(reference, tested).relativeL2));
}

TEST(ComparePictures, EqualPicturesHaveInfinitePsnr) {
    const Image image({4, 3}, glm::vec4(0.2f, 0.4f, static_cast<float>(kInf), 1));
    const auto error = comparePictures(image, image);
    EXPECT_EQ(error.rmseLinear, 0);
    EXPECT_EQ(error.psnrLinear, kInf);
    EXPECT_EQ(error.psnrEncoded, kInf);
    EXPECT_EQ(error.maxAbsolute, 0);
    EXPECT_EQ(error.differingPixels, 0u);
}

TEST(ComparePictures, FiguresFollowTheirDefinitions) {
    const Image reference({2, 2}, glm::vec4(0, 0, 0, 1));
    Image tested = reference;
    tested.at(1, 0).g = 0.5f;
    const auto error = comparePictures(tested, reference);
    const double channels = 4 * 3;
    const double encoded = srgbFromLinear(0.5);
    EXPECT_DOUBLE_EQ(error.rmseLinear, std::sqrt(0.25 / channels));
    EXPECT_DOUBLE_EQ(error.rmseEncoded, std::sqrt(encoded * encoded / channels));
    EXPECT_DOUBLE_EQ(error.psnrLinear, 10 * std::log10(channels / 0.25));
    EXPECT_NEAR(error.psnrEncoded, 10 * std::log10(channels / (encoded * encoded)), 1e-12);
    EXPECT_EQ(error.maxAbsolute, 0.5);
    EXPECT_EQ(error.differingPixels, 1u);
}

TEST(ComparePictures, AlphaCountsAsADifferenceButNotAsColor) {
    const Image reference({2, 1}, glm::vec4(0, 0, 0, 1));
    Image tested = reference;
    tested.at(0, 0).a = 0.75f;
    const auto error = comparePictures(tested, reference);
    EXPECT_EQ(error.rmseLinear, 0);
    EXPECT_EQ(error.maxAbsolute, 0.25);
    EXPECT_EQ(error.differingPixels, 1u);
}

TEST(ComparePictures, LightBeyondTheDisplayCountsInLinearOnly) {
    const auto error = comparePictures(Image({1, 1}, glm::vec4(3)), Image({1, 1}, glm::vec4(2)));
    EXPECT_EQ(error.rmseLinear, 1);
    EXPECT_EQ(error.rmseEncoded, 0);
}

TEST(ComparePictures, DifferencesWithinTheToleranceAreNotCounted) {
    const Image reference({3, 1}, glm::vec4(0.5f));
    Image tested = reference;
    tested.at(0, 0).r = 0.75f;   // off by 0.25 exactly
    tested.at(1, 0).r = 0.875f;  // off by 0.375
    EXPECT_EQ(comparePictures(tested, reference, 0).differingPixels, 2u);
    EXPECT_EQ(comparePictures(tested, reference, 0.25).differingPixels, 1u);
    EXPECT_EQ(comparePictures(tested, reference, 1).differingPixels, 0u);
}

TEST(ComparePictures, NanIsNeverHidden) {
    const Image reference({3, 1}, glm::vec4(0.5f));
    Image tested = reference;
    tested.at(1, 0).b = std::nanf("");
    const auto error = comparePictures(tested, reference, 100);
    EXPECT_TRUE(std::isnan(error.rmseLinear));
    EXPECT_TRUE(std::isnan(error.psnrEncoded));
    EXPECT_TRUE(std::isnan(error.maxAbsolute));
    EXPECT_EQ(error.differingPixels, 1u);
}

TEST(ComparePictures, SizesMustAgree) {
    EXPECT_THROW(comparePictures(Image({2, 1}), Image({1, 2})), std::invalid_argument);
}

}  // namespace
}  // namespace render
