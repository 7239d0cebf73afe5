// Ranges in words.
#include "app/picture/range_label.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "app/choices/choice_text.h"
#include "tests/support/picture_of_a_ramp.h"
#include "tests/support/scenes.h"

namespace app {
namespace {

using timeseries::RangeSet;
using namespace app::ramp;

TEST(RangeLabel, SaysARangeAsPeopleDo) {
    const auto label = [](const char* text, const char* units = "K") {
        return rangeLabel(RangeSet::parse(text), units);
    };
    EXPECT_EQ(label("600:1600"), "600 to 1600 K");
    EXPECT_EQ(label("600:max"), "≥ 600 K");
    EXPECT_EQ(label("min:600"), "≤ 600 K");
    EXPECT_EQ(label("(600,max]"), "> 600 K");
    EXPECT_EQ(label("[min,600)"), "< 600 K");
    EXPECT_EQ(label("[600,1600)"), "[600, 1600) K");
    EXPECT_EQ(label("(600,1600]"), "(600, 1600] K");
    EXPECT_EQ(label("5"), "5 K");
    EXPECT_EQ(label("-3:-1"), "−3 to −1 K") << "the minus sign of the colour bar";
    EXPECT_EQ(label("min:max"), "all values");
    EXPECT_EQ(label("0:1,5:6,9:max"), "0 to 1, 5 to 6, ≥ 9 K");
    EXPECT_EQ(label("0:1", ""), "0 to 1");
    EXPECT_EQ(label("0:1", "1"), "0 to 1");
    EXPECT_EQ(rangeLabel(RangeSet(), "K"), "no values");
}

// A session writes whole numbers without an exponent.
TEST(RangeLabel, IsTheSameHoweverANumberIsWritten) {
    const auto label = [](const std::string& text) {
        return rangeLabel(RangeSet::parse(text), "K");
    };
    for (const auto& [exponent, digits, told] : {std::array{"1e7", "10000000", "10000000"},
                                                 {"1e10", "10000000000", "1e+10"},
                                                 {"3.8e13", "38000000000000", "3.8e+13"},
                                                 {"-2e2", "-200", "\u2212200"},
                                                 {"-0.0", "0", "0"}}) {
        EXPECT_EQ(label(std::string(exponent) + ":max"), fmt::format("\u2265 {} K", told));
        EXPECT_EQ(label(std::string(digits) + ":max"), fmt::format("\u2265 {} K", told));
    }
}

TEST(RangeLabel, FewClassesAreCalledByTheirNames) {
    timeseries::Variable about;
    about.classes = {{0, "sea"}, {1, "land"}, {2, "ice"}, {5, "lake"}, {7, "swamp"}};
    const auto label = [&](const char* text) { return classLabel(RangeSet::parse(text), about); };
    EXPECT_EQ(label("2"), "ice");
    EXPECT_EQ(label("[2,5)"), "ice");
    EXPECT_EQ(label("0:0,5:max"), "sea, lake, swamp");
    EXPECT_EQ(label("3:4"), "");
    EXPECT_EQ(label("min:max"), "") << "too many to be read";
    about.classes.clear();
    EXPECT_EQ(label("2"), "");
}

TEST(RangeLabel, LongDoublesAreRoundedAndSaidToBe) {
    const auto label = [](const char* text) { return rangeLabel(RangeSet::parse(text), "K"); };
    EXPECT_EQ(label("0.1:0.30000000000000004"), "≈ 0.1 to 0.3 K");
    EXPECT_EQ(label("1426.5184782812678:max"), "≈ ≥ 1426.518 K");
    // As many digits as tell the ends apart, and how far; integers are never rounded.
    EXPECT_EQ(label("1.000000001234:1.000000004567"), "≈ 1.0000000012 to 1.0000000046 K");
    EXPECT_EQ(label("0.3:0.30000000000000004"), "0.3 to 0.30000000000000004 K");
    EXPECT_EQ(label("9007199254740993:9007199254740995"), "9007199254740993 to 9007199254740995 K");
    EXPECT_EQ(label("123456.7:123456789.5"), "123456.7 to 123456789.5 K") << "no shorter so";
}

// As a first choice is where values lie close to each other and far from 0.
TEST(RangeLabel, ShortDoublesAreExact) {
    EXPECT_EQ(rangeLabel(RangeSet::parse("min:1000000000.62,1000000003.57:max"), "Pa"),
              "≤ 1000000000.62, ≥ 1000000003.57 Pa");
    EXPECT_EQ(rangeLabel(RangeSet::parse("-1000000000.5:max"), "Pa"), "≥ −1000000000.5 Pa");
}

TEST(RangeLabel, ARangeIsToldAboutAsWideAsItIs) {
    const auto label = [](const char* text) { return rangeLabel(RangeSet::parse(text), "K"); };
    EXPECT_EQ(label("10000000.2:10000000.75"), "10000000.2 to 10000000.75 K");
    EXPECT_EQ(label("9999999.5:10000000.5"), "9999999.5 to 10000000.5 K");
    EXPECT_EQ(label("101325.1491234:101325.2512345"), "≈ 101325.15 to 101325.25 K");
    EXPECT_EQ(label("12345678.91234:123456789.5"), "12345678.91234 to 123456789.5 K");
    EXPECT_EQ(label("0.000012345678:1000.123456789"), "≈ 1.234568e−05 to 1000.123 K")
        << "nothing is rounded away";
    std::mt19937 random(3);
    std::uniform_real_distribution<double> mantissa(1, 10), exponent(-12, 12), narrow(-9, 1);
    for (int i = 0; i < 3000; ++i) {
        const double sign = random() % 2 == 0 ? 1 : -1;
        const double lo = sign * mantissa(random) * std::pow(10, exponent(random));
        const double hi = lo + std::abs(lo) * std::pow(10, narrow(random));
        std::string told = rangeLabel(RangeSet({timeseries::Range{{lo}, {hi}}}), "");
        for (std::size_t at; (at = told.find("\u2212")) != told.npos;) told.replace(at, 3, "-");
        if (told.starts_with("≈ ")) told.erase(0, std::string_view("≈ ").size());
        const std::size_t to = told.find(" to ");
        ASSERT_NE(to, told.npos) << told;
        const double width = std::stod(told.substr(to + 4)) - std::stod(told.substr(0, to));
        EXPECT_NEAR(width, hi - lo, 0.051 * (hi - lo)) << told;
    }
}

// Doubles that seven digits do not tell apart, as bounds of different ranges.
TEST(RangeLabel, BoundsThatDifferAreWrittenDifferently) {
    const double lo = 0x1p60 + 256, hi = 0x1p60 + 1024;
    const std::string label =
        rangeLabel(RangeSet({timeseries::Range{{-std::numeric_limits<double>::infinity()}, {lo}},
                             timeseries::Range{{hi}, {std::numeric_limits<double>::infinity()}}}),
                   "");
    const std::size_t comma = label.find(", ≥ ");
    ASSERT_NE(comma, label.npos) << label;
    const std::string first = label.substr(0, comma), second = label.substr(comma);
    const double shownLo = std::stod(first.substr(first.find("1."))),
                 shownHi = std::stod(second.substr(second.find("1.")));
    EXPECT_LT(shownLo, shownHi) << label;
    EXPECT_NEAR(shownLo, lo, 1e3);
    EXPECT_NEAR(shownHi, hi, 1e3);
}

TEST(RangeLabel, AnInfiniteValueAloneIsNotAllValues) {
    EXPECT_EQ(rangeLabel(RangeSet::parse("max:max"), "K"), "inf K");
    EXPECT_EQ(rangeLabel(RangeSet::parse("min:min"), "K"), "−inf K");
    EXPECT_EQ(rangeLabel(RangeSet::parse("min:min,max:max"), ""), "−inf, inf");
}

}  // namespace
}  // namespace app
