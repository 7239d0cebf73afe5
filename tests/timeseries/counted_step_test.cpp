// Steps written from their fields, without a list of all points: the bytes that the list's writer
// makes.
#include <gtest/gtest.h>

#include <random>

#include "tests/support/scenes.h"
#include "tests/support/step_bytes.h"

namespace timeseries {
namespace {

// Values of few kinds and of many, all alike, and with some that are most of all.
enum class HowOften { Even, Alike, Crowded };

template <typename T>
Field fieldOf(const std::array<std::size_t, 3>& size, HowOften spread, bool isMissing,
              unsigned seed) {
    std::mt19937 random(seed);
    std::vector<T> values(size[0] * size[1] * size[2]);
    for (T& value : values) {
        const auto any = static_cast<T>(random());
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
    ASSERT_TRUE(canBeCounted(field.type()));
    tests::BytesWritten counted;
    ASSERT_TRUE(writeCounted(field, "about", counted, {}, threads, atOnce));
    EXPECT_TRUE(counted.bytes == tests::written(SortedStep::build(field), "about"));
}

template <typename T>
class CountedSteps : public testing::Test {};
using ShortTypes = testing::Types<std::uint8_t, std::int8_t, std::uint16_t, std::int16_t>;
TYPED_TEST_SUITE(CountedSteps, ShortTypes);

TYPED_TEST(CountedSteps, AreTheBytesOfTheList) {
    unsigned seed = 1;
    for (const HowOften spread : {HowOften::Even, HowOften::Alike, HowOften::Crowded})
        for (const bool isMissing : {false, true})
            for (const unsigned threads : {1u, 3u}) {
                expectSameBytes(fieldOf<TypeParam>({60, 50, 70}, spread, isMissing, seed++),
                                threads);
                expectSameBytes(fieldOf<TypeParam>({3, 1, 2}, spread, false, seed++), threads);
            }
}

// 2^23 points are found together at least: here two thirds, then the last.
TYPED_TEST(CountedSteps, AreFoundAPartAfterTheOther) {
    expectSameBytes(fieldOf<TypeParam>({256, 256, 190}, HowOften::Crowded, true, 5), 2, 1);
}

TEST(CountedStep, EndWhenTheyAreToldTo) {
    const Field field = fieldOf<std::uint8_t>({60, 50, 70}, HowOften::Even, false, 1);
    tests::BytesWritten out;
    EXPECT_FALSE(writeCounted(field, "", out, [](double) { return false; }));
}

TEST(CountedStep, AreNotOfWideValues) {
    for (const ValueType type : {ValueType::U32, ValueType::I32, ValueType::U64, ValueType::I64,
                                 ValueType::F32, ValueType::F64})
        EXPECT_FALSE(canBeCounted(type));
}

}  // namespace
}  // namespace timeseries
