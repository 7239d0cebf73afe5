#include "timeseries/index/number.h"
#include "tests/support/ranges.h"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <limits>

#include "tests/support/selection_oracle.h"

namespace timeseries {
namespace {

using tests::ranges::kTwo60;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::partial_ordering expectedOrder(const Number& a, const Number& b) {
    return oracle::real(a) <=> oracle::real(b);
}

TEST(Number, ComparesExactlyAcrossAllPairsOfTypes) {
    const std::vector<Number> numbers = oracle::awkwardNumbers();
    for (const Number& a : numbers)
        for (const Number& b : numbers)
            ASSERT_TRUE(compare(a, b) == expectedOrder(a, b))
                << oracle::describe({{a, false}, {b, false}});
}

TEST(Number, ComparesRandomNeighboursExactly) {
    std::mt19937_64 random(11);
    for (int i = 0; i < 20000; ++i) {
        const std::uint64_t bits = random() >> (random() % 64);
        const auto u = Number(bits);
        const auto s = Number(static_cast<std::int64_t>(bits));
        const double rounded = static_cast<double>(bits);
        for (const Number& d : {Number(rounded), Number(std::nextafter(rounded, 0.0)),
                                Number(std::nextafter(rounded, 1e30)), Number(rounded + 0.5)})
            for (const Number& n : {u, s}) {
                ASSERT_TRUE(compare(n, d) == expectedOrder(n, d))
                    << "case " << i << " " << oracle::describe({{n, false}, {d, false}});
                ASSERT_TRUE(compare(d, n) == expectedOrder(d, n))
                    << "case " << i << " " << oracle::describe({{d, false}, {n, false}});
            }
        ASSERT_TRUE(compare(u, s) == expectedOrder(u, s)) << bits;
    }
}

TEST(Number, NeighboursOfTwoToTheSixtyDiffer) {
    EXPECT_TRUE(compare(kTwo60 + 1, 0x1p60) == std::partial_ordering::greater);
    EXPECT_TRUE(compare(kTwo60 - 1, 0x1p60) == std::partial_ordering::less);
    EXPECT_TRUE(compare(kTwo60, 0x1p60) == std::partial_ordering::equivalent);
}

TEST(Number, UnsignedAndNegativeDoNotWrap) {
    EXPECT_TRUE(compare(std::int64_t{-1}, std::numeric_limits<std::uint64_t>::max()) ==
                std::partial_ordering::less);
    EXPECT_TRUE(compare(std::numeric_limits<std::uint64_t>::max(), 0x1p64) ==
                std::partial_ordering::less);
    EXPECT_TRUE(compare(std::numeric_limits<std::int64_t>::max(), 0x1p63) ==
                std::partial_ordering::less);
}

TEST(Number, NegativeZeroEqualsZeroOfEveryType) {
    for (const Number& zero : {Number(0.0), Number(std::int64_t{0}), Number(std::uint64_t{0})})
        EXPECT_TRUE(compare(-0.0, zero) == std::partial_ordering::equivalent);
}

TEST(Number, NanIsUnorderedWithEverything) {
    for (const Number& other : oracle::awkwardNumbers()) {
        EXPECT_TRUE(compare(kNan, other) == std::partial_ordering::unordered);
        EXPECT_TRUE(compare(other, kNan) == std::partial_ordering::unordered);
    }
    EXPECT_TRUE(compare(kNan, kNan) == std::partial_ordering::unordered);
}

TEST(Number, ToDoubleIsTheNearestDouble) {
    for (const Number& number : oracle::awkwardNumbers())
        EXPECT_EQ(toDouble(number), static_cast<double>(oracle::real(number)))
            << oracle::describe({{number, false}, {number, false}});
    EXPECT_TRUE(std::isnan(toDouble(kNan)));
}

TEST(Number, TextOfIntegersIsTheirDigits) {
    EXPECT_EQ(toText(kTwo60 + 1), "1152921504606846977");
    EXPECT_EQ(toText(std::numeric_limits<std::int64_t>::min()), "-9223372036854775808");
    EXPECT_EQ(toText(std::numeric_limits<std::uint64_t>::max()), "18446744073709551615");
    EXPECT_EQ(toText(std::int64_t{0}), "0");
}

TEST(Number, TextOfInfinitiesAndNan) {
    EXPECT_EQ(toText(std::numeric_limits<double>::infinity()), "inf");
    EXPECT_EQ(toText(-std::numeric_limits<double>::infinity()), "-inf");
    EXPECT_EQ(toText(kNan), "nan");
}

// As a reader of numbers does: an integer when there is nothing but digits.
Number read(const std::string& text) {
    const char *const begin = text.data(), *const end = begin + text.size();
    std::int64_t i = 0;
    if (const auto r = std::from_chars(begin, end, i); r.ec == std::errc() && r.ptr == end)
        return i;
    std::uint64_t u = 0;
    if (const auto r = std::from_chars(begin, end, u); r.ec == std::errc() && r.ptr == end)
        return u;
    double d = kNan;
    const auto r = std::from_chars(begin, end, d);
    return r.ec == std::errc() && r.ptr == end ? d : kNan;
}

void expectShortTextOf(double value) {
    const std::string text = toText(value);
    ASSERT_TRUE(compare(read(text), value) == 0) << text;
    // The standard's shortest form is the measure; an integer may need more digits than a double.
    char shortest[64];
    const auto written = std::to_chars(shortest, shortest + sizeof shortest, value);
    if (std::fabs(value) >= 0x1p53) return;
    ASSERT_LE(text.size(), static_cast<std::size_t>(written.ptr - shortest)) << text;
}

TEST(Number, TextOfDoublesIsShortAndReadsBack) {
    for (const Number& number : oracle::awkwardNumbers())
        if (const double* value = std::get_if<double>(&number)) expectShortTextOf(*value);
    std::mt19937_64 random(12);
    for (int i = 0; i < 20000; ++i) {
        const double value = std::bit_cast<double>(random());
        if (!std::isnan(value)) expectShortTextOf(value);
        expectShortTextOf(std::round(std::ldexp(static_cast<double>(random() >> 40), -20)));
    }
}

}  // namespace
}  // namespace timeseries
