// Steps written from their fields, without a list of all points: the bytes that the list's writer
// makes.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/support/scenes.h"
#include "tests/support/selection_oracle.h"
#include "tests/support/step_bytes.h"

namespace timeseries {
namespace {

// Values of few kinds and of many, all alike, and with some that are most of all.
enum class HowOften { Even, Alike, Crowded };

template <typename T>
Field fieldOf(const std::array<std::size_t, 3>& size, HowOften spread, bool isMissing,
              unsigned seed) {
    std::mt19937_64 random(seed);
    std::vector<T> values(size[0] * size[1] * size[2]);
    for (T& value : values) {
        const T any = oracle::anyValue<T>(random);  // any bits: of floats, NaN and infinities
        value = spread == HowOften::Alike || (spread == HowOften::Crowded && random() % 10 > 0)
                    ? T{7}
                    : any;
    }
    std::vector<bool> missing(isMissing ? values.size() : 0);
    for (std::size_t i = 0; i < missing.size(); ++i) missing[i] = random() % 5 == 0;
    std::array<Axis, 3> axes;
    for (std::size_t a = 0; a < 3; ++a) axes[a] = tests::axis(size[a]);
    return {std::make_shared<const Grid>(axes), std::move(values), std::move(missing)};
}

void expectSameBytes(const Field& field, unsigned threads, std::uint64_t atOnce = 0) {
    tests::BytesWritten ofField;
    ASSERT_TRUE(writeField(field, "about", ofField, {}, threads, atOnce));
    EXPECT_TRUE(ofField.bytes == tests::written(SortedStep::build(field), "about"));
}

template <typename T>
class StepsOfFields : public testing::Test {};
using EachType =
    testing::Types<std::uint8_t, std::int8_t, std::uint16_t, std::int16_t, std::uint32_t,
                   std::int32_t, std::uint64_t, std::int64_t, float, double>;
TYPED_TEST_SUITE(StepsOfFields, EachType);

TYPED_TEST(StepsOfFields, AreTheBytesOfTheList) {
    unsigned seed = 1;
    for (const HowOften spread : {HowOften::Even, HowOften::Alike, HowOften::Crowded})
        for (const bool isMissing : {false, true})
            for (const unsigned threads : {1u, 3u}) {
                expectSameBytes(fieldOf<TypeParam>({60, 50, 70}, spread, isMissing, seed++),
                                threads);
                expectSameBytes(fieldOf<TypeParam>({3, 1, 2}, spread, false, seed++), threads);
            }
}

// 2^23 points are found together at least: here those, then a few.
TEST(StepOfField, IsFoundAPartAfterTheOther) {
    const auto expectSameParts = []<typename T>(T) {
        expectSameBytes(fieldOf<T>({256, 256, 130}, HowOften::Crowded, false, 5), 2, 1);
    };
    expectSameParts(std::uint8_t());
    expectSameParts(double());
}

// Most points have one value, or one of two, or of two that are near each other: parts end among
// them, behind others and before others. Of two zeros, too, which are one.
TEST(StepOfField, IsFoundInPartsAlsoOfOneValue) {
    struct Shares {
        double zeros, sevens;
        float nearly;  // for 1 in 100,000 of these
    };
    for (const auto& [zeros, sevens, nearly] :
         {Shares{0.9, 1.0, 7}, {0.02, 0.6, 7}, {0.5, 0.99, 7}, {0.01, 1.0, 7.001f}}) {
        Field field = fieldOf<float>({256, 256, 266}, HowOften::Alike, sevens < 0.9, 3);
        std::mt19937 random(7);
        for (float& value : std::get<std::vector<float>>(field.values)) {
            const auto any = random();
            const double place = static_cast<double>(any) * 0x1p-32;
            value = place < zeros    ? (any % 2 > 0 ? 0.0f : -0.0f)
                    : place < sevens ? (any % 100'000 > 0 ? 7 : nearly)
                                     : static_cast<float>(any % 1000) - 500;
        }
        expectSameBytes(field, 2, 1);
    }
}

// Twice 2^23 at once, which two groups of blocks are made of, and then the rest.
TEST(StepOfField, IsFoundSeveralGroupsAtOnce) {
    expectSameBytes(fieldOf<float>({256, 256, 340}, HowOften::Even, true, 5), 2, 1 << 23);
}

// Of quantiles, which are of finite values.
TEST(StepOfField, OfInfinitiesAloneIsTheListsToo) {
    constexpr float kInfinite = std::numeric_limits<float>::infinity();
    for (const std::vector<float>& values : {std::vector<float>{kInfinite, -kInfinite, kInfinite},
                                             std::vector<float>{kInfinite, -0.0f, std::nanf("")},
                                             std::vector<float>{-kInfinite, 0.0f, -0.0f}}) {
        Field field{std::make_shared<const Grid>(
                        std::array<Axis, 3>{tests::axis(3), tests::axis(1), tests::axis(1)}),
                    values,
                    {}};
        expectSameBytes(field, 1);
    }
}

TEST(StepOfField, EndWhenTheyAreToldTo) {
    const Field field = fieldOf<std::uint8_t>({60, 50, 70}, HowOften::Even, false, 1);
    tests::BytesWritten out;
    EXPECT_FALSE(writeField(field, "", out, [](double) { return false; }));
}

}  // namespace
}  // namespace timeseries
