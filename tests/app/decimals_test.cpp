#include "app/choices/decimals.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>
#include <sstream>
#include <string>

namespace app {
namespace {

// The exponent in shortest scientific text: of 0.00025, which is 25e-5, it is -5; 120 is 12e1.
int lastDigit(double value) {
    if (value == 0) return 1000;
    std::string text;
    for (int digits = 0; digits < 20; ++digits) {
        std::ostringstream out;
        out.precision(digits);
        out << std::scientific << value;
        text = out.str();
        if (std::stod(text) == value) return std::stoi(text.substr(text.find('e') + 1)) - digits;
    }
    return -1000;
}

TEST(Decimals, RoundsToTheNearestAndPrintsAsSuch) {
    EXPECT_EQ(toDecimals(23.7421, 1), 23.7);
    EXPECT_EQ(toDecimals(-0.05, 3), -0.05);
    EXPECT_EQ(toDecimals(1234567, -3), 1235e3);
    EXPECT_EQ(toDecimals(1.26e25, -24), 1.3e25);
    EXPECT_EQ(toDecimals(-4, -1), 0);
    const double most = std::numeric_limits<double>::max();
    EXPECT_EQ(toDecimals(most, -308), most) << "rounded up it would be no double";
}

TEST(Decimals, RoundingTellsNeighboursApartWithTheFewestDigits) {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> unit(-1, 1), log(-14, 14);
    for (int i = 0; i < 5000; ++i) {
        double resolution = std::pow(10, log(random));
        // Powers of ten themselves, where logarithms are off by a rounding.
        if (i % 3 == 0) resolution = std::stod("1e" + std::to_string(i % 29 - 14));
        const double value = unit(random) * resolution * 1e5;
        const double rounded = roundedTo(value, resolution);
        EXPECT_LE(std::abs(rounded - value), 0.5001 * resolution) << value << ' ' << resolution;
        EXPECT_NE(roundedTo(value + 1.0001 * resolution, resolution), rounded)
            << value << ' ' << resolution;
        // The unit is the largest power of ten that is no more than the resolution.
        const double unitOfDigits = std::pow(10, lastDigit(rounded));
        EXPECT_GE(unitOfDigits, 0.0999 * resolution) << value << ' ' << resolution;
    }
}

TEST(Decimals, AsManyDigitsTellNumbersApartAsTheyNeed) {
    for (const double size : {1.0, 3.7, 1e7, 123456789.0, 1e-20})
        for (const double share : {0.5, 1e-3, 1e-7, 3e-12}) {
            const double apart = size * share;
            const int digits = digitsApart(size, apart, 1);
            const auto text = [&](double v) { return fmt::format("{:.{}g}", v, digits); };
            EXPECT_NE(text(size), text(size - apart)) << size << ' ' << share;
            EXPECT_EQ(digitsApart(size, -apart, 17), 17) << "no fewer";
        }
    EXPECT_EQ(digitsApart(0, 0, 6), 6);
    EXPECT_EQ(digitsApart(1, 0, 6), 6) << "nothing tells them apart";
    EXPECT_EQ(digitsApart(1e300, 1e-300, 6), 6);
}

TEST(Decimals, TheNextRoundedValueIsBesideAtMostAUnitAway) {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> unit(-1, 1), log(-8, 8);
    for (int i = 0; i < 3000; ++i) {
        const double resolution = std::pow(10, log(random));
        double value = unit(random) * resolution * 1e4;
        if (i % 2 == 0) value = roundedTo(value, resolution);
        const double below = roundedBelow(value, resolution),
                     above = roundedAbove(value, resolution);
        SCOPED_TRACE(fmt::format("{} to {}", value, resolution));
        EXPECT_LT(below, value);
        EXPECT_GT(above, value);
        for (const double next : {below, above}) {
            EXPECT_EQ(next, roundedTo(next, resolution));
            EXPECT_LE(std::abs(next - value), 1.0001 * resolution);
        }
    }
    EXPECT_EQ(roundedBelow(30, 0.27), 29.9);
    EXPECT_EQ(roundedBelow(30.04, 0.27), 30);
    EXPECT_EQ(roundedAbove(30, 30), 40);
    EXPECT_FALSE(std::signbit(roundedAbove(-0.05, 0.1)));
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double resolution : {0.0, 1e-30, infinity})
        EXPECT_EQ(roundedBelow(30, resolution), std::nextafter(30, 0)) << resolution;
    EXPECT_EQ(roundedBelow(infinity, 1), std::numeric_limits<double>::max());
    EXPECT_EQ(roundedAbove(infinity, 1), infinity);
}

// Against sums of whole numbers.
TEST(Decimals, AddUpAsDigitsDo) {
    EXPECT_EQ(decimalSum(0.1, 0.2), 0.3);
    EXPECT_EQ(decimalSum(20.1, -10), 10.1);
    EXPECT_EQ(decimalSum(1e20, 3e-7), 1e20);
    EXPECT_EQ(decimalSum(1e22, 1e22), 2e22);
    EXPECT_FALSE(std::signbit(decimalSum(0.1, -0.1)));
    const double most = std::numeric_limits<double>::max();
    EXPECT_EQ(decimalSum(most, most), std::numeric_limits<double>::infinity());
    std::mt19937 random(10);
    for (int i = 0; i < 3000; ++i) {
        const int a = static_cast<int>(random() % 2'000'000) - 1'000'000,
                  b = static_cast<int>(random() % 2'000'000) - 1'000'000,
                  decimals = static_cast<int>(random() % 30) - 10;
        const auto scaled = [&](int n) { return std::stod(fmt::format("{}e{}", n, -decimals)); };
        EXPECT_EQ(decimalSum(scaled(a), scaled(b)), scaled(a + b))
            << a << ' ' << b << ' ' << decimals;
    }
}

TEST(Decimals, ZeroHasNoSign) {
    EXPECT_FALSE(std::signbit(roundedTo(-0.04, 0.1)));
    EXPECT_FALSE(std::signbit(toDecimals(-4, -1)));
}

TEST(Decimals, WhatCannotBeRoundedStays) {
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(roundedTo(infinity, 1), infinity);
    EXPECT_EQ(roundedTo(3.25, infinity), 3.25);
    EXPECT_EQ(roundedTo(5e-324, 5e-324), 5e-324);
    EXPECT_EQ(roundedTo(1e300, 1e-300), 1e300);
}

using timeseries::RangeSet;
using timeseries::ValueType;

TEST(Decimals, TellAFloatWithTheFewestDigitsThatReadBackAsIt) {
    std::mt19937 random(4);
    for (int i = 0; i < 3000; ++i) {
        const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
        if (!std::isfinite(value)) continue;
        const double told = shortestIn(ValueType::F32, static_cast<double>(value));
        EXPECT_EQ(static_cast<float>(told), value);
        EXPECT_EQ(fmt::format("{}", told), fmt::format("{}", std::stod(fmt::format("{}", value))));
    }
    EXPECT_EQ(shortestIn(ValueType::F32, 34.17789840698242), 34.1779);
    EXPECT_EQ(shortestIn(ValueType::F32, -29.700000000000003), -29.7);
    // A double says all of its digits, and so does what is no float.
    EXPECT_EQ(shortestIn(ValueType::F64, 34.17789840698242), 34.17789840698242);
    EXPECT_EQ(shortestIn(ValueType::F32, 1e300), 1e300);
}

TEST(Decimals, TellRangesOfFloatsAlike) {
    const auto told = [](const char* text) {
        return shortestIn(ValueType::F32, RangeSet::parse(text)).text();
    };
    EXPECT_EQ(told("-3:34.17789840698242"), "-3:34.1779");
    EXPECT_EQ(told("min:0.10000000149011612,(2,max]"), "min:0.1,(2,max]");
    // One value of the field, but not of the text: all stays as it was entered.
    for (const char* text : {"(1,1.000000000001)", "1:2,2.0000000000001:3"})
        EXPECT_EQ(told(text), RangeSet::parse(text).text());
}

}  // namespace
}  // namespace app
