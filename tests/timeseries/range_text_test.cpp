#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "tests/support/ranges.h"
#include "tests/support/selection_oracle.h"
#include "timeseries/index/range_set.h"

namespace timeseries {
namespace {

using oracle::describe;
using tests::ranges::closed;
using tests::ranges::halfOpen;
using tests::ranges::kTwo60;
using tests::ranges::open;
using tests::ranges::openLow;
using tests::ranges::operator""_i;

TEST(RangeText, DocumentedFormsAreRead) {
    const std::pair<const char*, RangeSet> cases[] = {
        {"1:2", RangeSet({closed(1_i, 2_i)})},
        {"-1.5:2e3", RangeSet({closed(-1.5, 2000.0)})},
        {"[1,2)", RangeSet({halfOpen(1_i, 2_i)})},
        {"(1,2]", RangeSet({openLow(1_i, 2_i)})},
        {"(1,2)", RangeSet({open(1_i, 2_i)})},
        {"[1,2]", RangeSet({closed(1_i, 2_i)})},
        {"[1:2)", RangeSet({halfOpen(1_i, 2_i)})},
        {"(1:2]", RangeSet({openLow(1_i, 2_i)})},
        {"5~2", RangeSet({closed(3_i, 7_i)})},
        {"5 \u00b1 2", RangeSet({closed(3_i, 7_i)})},  // as legends have it
        {"3~5", RangeSet({closed(-2.0, 8.0)})},
        {"1.5~0.25", RangeSet({closed(1.25, 1.75)})},
        {"0.7~0.1", RangeSet({closed(0.6, 0.8)})},  // 0.7 + 0.1 is less in doubles
        {"1.1~0.2", RangeSet({closed(0.9, 1.3)})},
        {"7e-1~1E-1", RangeSet({closed(0.6, 0.8)})},
        {"-3e-01~1e+2", RangeSet({closed(-100.3, 99.7)})},
        {"1~1e-300", RangeSet({closed(1.0, 1.0)})},
        {"-1.5~0", RangeSet({closed(-1.5, -1.5)})},
        {"min:2", RangeSet({closed(-kInfinity, 2.0)})},
        {"2:max", RangeSet({closed(2.0, kInfinity)})},
        {"min:max", RangeSet::everything()},
        {"-inf:inf", RangeSet::everything()},
        {"inf", RangeSet({closed(kInfinity, kInfinity)})},
        {"(0,max]", RangeSet({openLow(0.0, kInfinity)})},
        {"[min,0)", RangeSet({halfOpen(-kInfinity, 0.0)})},
        {"7", RangeSet({closed(7_i, 7_i)})},
        {"-7.5", RangeSet({closed(-7.5, -7.5)})},
        {"1e-3", RangeSet({closed(1e-3, 1e-3)})},
        {"1:2,5:6", RangeSet({closed(1_i, 2_i), closed(5_i, 6_i)})},
        {"5:6,1:2", RangeSet({closed(1_i, 2_i), closed(5_i, 6_i)})},
        {"1:3,2:4", RangeSet({closed(1_i, 4_i)})},
        {"1 to 2", RangeSet({closed(1_i, 2_i)})},
        {"-3 to -1e-3", RangeSet({closed(-3_i, -1e-3)})},
        {"min to 2", RangeSet({closed(-kInfinity, 2.0)})},
        {"[1 to 2)", RangeSet({halfOpen(1_i, 2_i)})},
        {">1", RangeSet({openLow(1_i, kInfinity)})},
        {"> -1.5", RangeSet({openLow(-1.5, kInfinity)})},
        {">=1", RangeSet({closed(1_i, kInfinity)})},
        {"<1e-3", RangeSet({halfOpen(-kInfinity, 1e-3)})},
        {"<= 5", RangeSet({closed(-kInfinity, 5_i)})},
        {"<1,>2", RangeSet({halfOpen(-kInfinity, 1_i), openLow(2_i, kInfinity)})},
        // As legends write them.
        {"\u2265 600", RangeSet({closed(600_i, kInfinity)})},
        {"\u2264 \u22125", RangeSet({closed(-kInfinity, -5_i)})},
        {"\u22123 to 4.5", RangeSet({closed(-3_i, 4.5)})},
        {"[1,2),(3:4],9, 20~1,100:max",
         RangeSet({halfOpen(1_i, 2_i), openLow(3_i, 4_i), closed(9_i, 9_i), closed(19_i, 21_i),
                   closed(100.0, kInfinity)})},
    };
    for (const auto& [text, expected] : cases) {
        const RangeSet read = RangeSet::parse(text);
        EXPECT_EQ(read, expected) << text << " was read as " << describe(read.ranges());
    }
}

TEST(RangeText, IntegersStayIntegers) {
    const RangeSet set = RangeSet::parse("1152921504606846977:1152921504606846978");
    ASSERT_EQ(set.ranges().size(), 1U);
    EXPECT_TRUE(compare(set.ranges()[0].lo.value, kTwo60 + 1) == 0);
    EXPECT_TRUE(compare(set.ranges()[0].hi.value, kTwo60 + 2) == 0);
    EXPECT_FALSE(std::holds_alternative<double>(set.ranges()[0].lo.value));

    EXPECT_EQ(RangeSet::parse("1152921504606846977~1"), RangeSet({closed(kTwo60, kTwo60 + 2)}));
    EXPECT_EQ(RangeSet::parse("-9223372036854775808:18446744073709551615"),
              RangeSet({closed(std::numeric_limits<std::int64_t>::min(),
                               std::numeric_limits<std::uint64_t>::max())}));
    EXPECT_TRUE(std::holds_alternative<double>(RangeSet::parse("1.0").ranges()[0].lo.value));
    EXPECT_TRUE(std::holds_alternative<double>(RangeSet::parse("1e0").ranges()[0].lo.value));
}

TEST(RangeText, CentreAndWidthAreExactForIntegers) {
    // Through doubles, c - d and c + d would both round to 2^63.
    EXPECT_EQ(RangeSet::parse("9223372036854775809~3"),
              RangeSet({closed((std::uint64_t{1} << 63) - 2, (std::uint64_t{1} << 63) + 4)}));
    EXPECT_EQ(RangeSet::parse("-9223372036854775807~1"),
              RangeSet({closed(std::numeric_limits<std::int64_t>::min(),
                               std::numeric_limits<std::int64_t>::min() + 2)}));
    EXPECT_EQ(RangeSet::parse("9223372036854775808~9223372036854775807"),
              RangeSet({closed(1_i, std::numeric_limits<std::uint64_t>::max())}));
}

// From 2^53 on a double may be another whole number than the one that is written.
TEST(RangeText, WholeNumbersBeyondDoublesStayExactBehindAPointAndAWidth) {
    EXPECT_EQ(RangeSet::parse("1152921504606846977.0:max"),
              RangeSet({closed(kTwo60 + 1, kInfinity)}));
    EXPECT_EQ(RangeSet::parse("-1152921504606846977.00"),
              RangeSet({closed(-kTwo60 - 1, -kTwo60 - 1)}));
    EXPECT_EQ(RangeSet::parse("18446744073709551615."),
              RangeSet({closed(std::numeric_limits<std::uint64_t>::max(),
                               std::numeric_limits<std::uint64_t>::max())}));
    // No value lies at a half there.
    EXPECT_EQ(RangeSet::parse("1152921504606846977~2.5"),
              RangeSet({closed(kTwo60 - 1, kTwo60 + 3)}));
    EXPECT_EQ(RangeSet::parse("1152921504606846977~2.0"),
              RangeSet({closed(kTwo60 - 1, kTwo60 + 3)}));
    // Below, and with an exponent, a number is a double's as ever.
    EXPECT_EQ(RangeSet::parse("4503599627370496.5"),
              RangeSet({closed(4503599627370496.5, 4503599627370496.5)}));
    EXPECT_TRUE(std::holds_alternative<double>(
        RangeSet::parse("1.1529215046068470e18").ranges()[0].lo.value));
}

TEST(RangeText, AnIntegerBeyondAllTypesIsTheNearestDouble) {
    // The doubles next to 10^20 are 2^14 apart: 10^20 - 1 is nearest to 10^20 = 2^20 5^20.
    for (const char* text : {"99999999999999999999", "100000000000000000000"})
        EXPECT_EQ(RangeSet::parse(text), RangeSet({closed(1e20, 1e20)})) << text;
    const double two64 = std::ldexp(1.0, 64);
    EXPECT_EQ(RangeSet::parse("18446744073709551616"), RangeSet({closed(two64, two64)}));
}

// A comma in digits is read as what stands between ranges where nothing else can be meant.
TEST(RangeText, CommasBetweenRangesAreReadAsSuch) {
    const std::pair<const char*, RangeSet> cases[] = {
        {"300:400,900:max", RangeSet({closed(300_i, 400_i), closed(900_i, kInfinity)})},
        {"300:400,900:1000,2000~5",
         RangeSet({closed(300_i, 400_i), closed(900_i, 1000_i), closed(1995_i, 2005_i)})},
        {"1,3,5", RangeSet({closed(1_i, 1_i), closed(3_i, 3_i), closed(5_i, 5_i)})},
        {"1:1,3:3", RangeSet({closed(1_i, 1_i), closed(3_i, 3_i)})},
        {"600, 5:700", RangeSet({closed(600_i, 600_i), closed(5_i, 700_i)})},
        {"600.5,5:6", RangeSet({closed(600.5, 600.5), closed(5_i, 6_i)})},
        {"3,-1:2", RangeSet({closed(3_i, 3_i), closed(-1_i, 2_i)})},
        {"5:6,min:2", RangeSet({closed(5_i, 6_i), closed(-kInfinity, 2.0)})},
        {"[1,2),9", RangeSet({halfOpen(1_i, 2_i), closed(9_i, 9_i)})},
        {"9,[1,2)", RangeSet({halfOpen(1_i, 2_i), closed(9_i, 9_i)})}};
    for (const auto& [text, expected] : cases) EXPECT_EQ(RangeSet::parse(text), expected) << text;
}

// The sentence by which a text is refused.
std::string refusal(std::string_view text) {
    try {
        return "read as " + describe(RangeSet::parse(text).ranges());
    } catch (const RangeSyntaxError& error) {
        return error.what();
    }
}

TEST(RangeText, WhatMayBeADecimalCommaIsAskedForInOtherWords) {
    const std::array<std::string, 3> cases[] = {
        // text, as one range, as several
        {"600,5:700", "600.5:700", "600:600,5:700"},
        {"600:700,5", "600:700.5", "600:700,5:5"},
        {"600,5:700,8", "600.5:700.8", "600:600,5:700,8:8"},
        {"850,5~50", "850.5~50", "850:850,5~50"},
        {"850~0,5", "850~0.5", "850~0,5:5"},
        {"1,3", "1.3", "1:1,3:3"},
        {"1,5e3:max", "1.5e3:max", "1:1,5e3:max"},
        {"300,5:400,900:max", "300.5:400,900:max", "300:300,5:400,900:max"}};
    for (const auto& [text, one, several] : cases) {
        EXPECT_THAT(refusal(text), testing::StartsWith("range '" + text + "': ")) << text;
        EXPECT_THAT(refusal(text), testing::EndsWith("write " + one + " or " + several)) << text;
    }
    // Only what can be read is offered.
    EXPECT_THAT(refusal("-0,5:0,5"), testing::EndsWith("write -0.5:0.5"));
    EXPECT_THAT(refusal("1,2,3:4"), testing::EndsWith("write 1:1,2:2,3:4"));
    EXPECT_THAT(refusal("[600,5:700]"), testing::HasSubstr("point"));
    EXPECT_THAT(refusal("[1,5,2,5]"), testing::HasSubstr("point"));
}

TEST(RangeText, OtherSpellingsOfARangeAreAnsweredWithTheRightOne) {
    const std::pair<std::string, std::string> cases[] = {
        {"600-800", "600:800"},      {"600 - 800", "600:800"},      {"-5-3", "-5:3"},
        {"-5--3", "-5:-3"},          {"1e-3-2e-3", "1e-3:2e-3"},    {"0.5..1.5", "0.5:1.5"},
        {"600\u2013800", "600:800"}, {"1.5e-3 - 2.5", "1.5e-3:2.5"}};
    for (const auto& [text, spelling] : cases)
        EXPECT_EQ(refusal(text), "range '" + text + "': a range is written " + spelling);
    // These are numbers, not ranges.
    for (const char* text : {"1e-3", "-1e-3", "-5"})
        EXPECT_THAT(refusal(text), testing::StartsWith("read as")) << text;
}

// As doubles they would be -2^63, which is a value; above, 2^64 is none.
TEST(RangeText, WhatIsJustBelowAllWholeNumbersIsNoneOfThem) {
    for (const char* text :
         {"-9223372036854775809", "-9223372036854776000", "-9223372036854775809.0"})
        EXPECT_EQ(refusal(text), fmt::format("range '{0}': '{0}' is below all whole numbers of 64 "
                                             "bits: write min, or an exponent",
                                             text));
    for (const char* text :
         {"-9223372036854775808", "-9223372036854775808.0", "-9223372036854775808:0",
          "-9.223372036854775809e18", "-9223372036854777000"})
        EXPECT_THAT(refusal(text), testing::StartsWith("read as")) << text;
}

TEST(RangeText, UnitsAreLeftOut) {
    const auto told = [](const std::string& range, const char* end, const char* number) {
        return fmt::format("range '{}': '{}' is not a number: units are left out, write {}", range,
                           end, number);
    };
    EXPECT_EQ(refusal("600:800 K"), told("600:800 K", "800 K", "800"));
    EXPECT_EQ(refusal("600 K to 800 K"), told("600 K to 800 K", "600 K", "600"));
    EXPECT_EQ(refusal("-1.5e-3m/s~2"), told("-1.5e-3m/s~2", "-1.5e-3m/s", "-1.5e-3"));
    EXPECT_EQ(refusal("20 °C"), told("20 °C", "20 °C", "20"));
    EXPECT_EQ(refusal("[5 %,7]"), told("[5 %,7]", "5 %", "5"));
    for (const char* other : {"1e", "0x1f", "1to2", "abc", "1.2.3", "1 2"})
        EXPECT_THAT(refusal(other), testing::Not(testing::HasSubstr("units"))) << other;
}

TEST(RangeText, ValuesBetweenTwoComparisonsAreAskedForAsARange) {
    // As a union these hold everything, which nobody means.
    for (const auto& [text, spelling] :
         {std::pair(">=600,<700", "[600,700)"), std::pair("< 700, > 600", "(600,700)"),
          std::pair("\u2265 -1.5,\u2264 2", "[-1.5,2]")})
        EXPECT_THAT(refusal(text), testing::HasSubstr(std::string("write ") + spelling)) << text;
    EXPECT_THAT(refusal("<600,>700"), testing::StartsWith("read as"));
}

TEST(RangeText, AFractionThatNoValueHasIsRefused) {
    EXPECT_THAT(refusal("1152921504606846976.5:max"), testing::HasSubstr("has a fraction"));
    EXPECT_THAT(refusal("0:9007199254740992.25"), testing::HasSubstr("has a fraction"));
}

TEST(RangeText, MalformedTextsGiveOneSentenceThatQuotesThem) {
    for (const std::string text : {"",
                                   " ",
                                   ",",
                                   "1:",
                                   ":2",
                                   ":",
                                   "1:2:3",
                                   "abc",
                                   "1:2,",
                                   ",1",
                                   "1,,2",
                                   "2:1",
                                   "nan",
                                   "nan:1",
                                   "1:nan",
                                   "NaN~1",
                                   "1~nan",
                                   "1~-1",
                                   "1~",
                                   "~1",
                                   "1~2~3",
                                   "1~-0.5",
                                   "[1,2",
                                   "1,2]",
                                   "(1:2",
                                   "1:2)",
                                   "[1 2]",
                                   "1..2",
                                   "1.2.3",
                                   "1:2 x",
                                   "x1:2",
                                   "--1",
                                   "1e",
                                   "1e+",
                                   "e5",
                                   ".",
                                   "-",
                                   "+",
                                   "[]",
                                   "[,]",
                                   "[1,]",
                                   "[,1]",
                                   "[[1,2]",
                                   "[1,2]]",
                                   "[1,2]3",
                                   "3[1,2]",
                                   "[1,2,3]",
                                   "max:min",
                                   "inf:-inf",
                                   "[2,1)",
                                   "{1,2}",
                                   "1:2;3:4",
                                   "1-2",
                                   "1/2",
                                   "0x",
                                   "minmax",
                                   "min:mix",
                                   "1:2,3:2",
                                   "[1:2],",
                                   "1'000",
                                   "1:2\n:3",
                                   "[1~2]:",
                                   "2:1.9999",
                                   "9223372036854775809:9223372036854775808",
                                   "18446744073709551615:-1",
                                   ">",
                                   "<=",
                                   "=5",
                                   ">1:2",
                                   "> <5",
                                   "><5",
                                   ">max",
                                   "<min",
                                   "1,2:x",
                                   ">nan",
                                   "[>1,2]",
                                   "1 to",
                                   "to 2",
                                   " to ",
                                   "1 to 2 to 3",
                                   "2 to 1",
                                   "1to2",
                                   "1..",
                                   "-"}) {
        try {
            const RangeSet set = RangeSet::parse(text);
            ADD_FAILURE() << "'" << text << "' was read as " << describe(set.ranges());
        } catch (const RangeSyntaxError& error) {
            const std::string what = error.what();
            // It quotes the text, or the one range of it that is wrong.
            const std::size_t begin = what.find('\''), end = what.find("':", begin + 1);
            ASSERT_TRUE(begin != std::string::npos && end != std::string::npos) << what;
            EXPECT_THAT(text, testing::HasSubstr(what.substr(begin + 1, end - begin - 1)));
            // One sentence: nothing follows a full stop.
            EXPECT_THAT(what, testing::Not(testing::HasSubstr(". "))) << text;
        }
    }
}

TEST(RangeText, AnEmbeddedNulIsMalformed) {
    EXPECT_THROW(RangeSet::parse(std::string_view("1:2\0,3", 6)), RangeSyntaxError);
}

TEST(RangeText, TheEmptySetHasNoText) { EXPECT_EQ(RangeSet().text(), ""); }

TEST(RangeText, RandomSetsReadBackTheSame) {
    const std::vector<Number> awkward = oracle::awkwardNumbers();
    std::mt19937_64 random(24);
    for (int i = 0; i < 4000; ++i) {
        std::vector<Number> numbers = awkward;
        for (int k = 0; k < 20; ++k) {
            const std::uint64_t bits = random();
            const double value = std::bit_cast<double>(bits);
            if (!std::isnan(value)) numbers.push_back(value);
            numbers.push_back(bits);
            numbers.push_back(static_cast<std::int64_t>(bits));
        }
        const RangeSet set(oracle::randomRanges(random, 6, numbers));
        if (set.empty()) continue;
        SCOPED_TRACE("case " + std::to_string(i) + " " + describe(set.ranges()) + " text " +
                     set.text());
        const RangeSet read = RangeSet::parse(set.text());
        ASSERT_EQ(read, set) << "read as " << describe(read.ranges());
        ASSERT_EQ(RangeSet::parse(read.text()), set) << read.text();
    }
}

}  // namespace
}  // namespace timeseries
