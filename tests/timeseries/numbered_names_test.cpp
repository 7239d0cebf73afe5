#include "timeseries/readers/text/numbered_names.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <random>
#include <tuple>

namespace timeseries {
namespace {

using Path = std::filesystem::path;

struct Written {
    Path file;
    int whole, fraction;
    double decimal;
};

Written written(const std::string& number) {
    const std::size_t dot = number.find('.');
    Written result{"t_" + number + ".nc", 0, 0, 0};
    const char* const text = number.data();
    std::from_chars(text, text + dot, result.whole);
    std::from_chars(text + dot + 1, text + number.size(), result.fraction);
    std::from_chars(text, text + number.size(), result.decimal);
    return result;
}

std::vector<Path> filesOf(const std::vector<Written>& all) {
    std::vector<Path> files;
    for (const Written& each : all) files.push_back(each.file);
    return files;
}

TEST(NumberedNames, EvenTimesAcrossAWholeNumberAreDecimal) {
    std::mt19937 random(1);
    for (int i = 0; i < 500; ++i) {
        const int digits = 1 + static_cast<int>(random() % 4);
        int one = 1;
        for (int d = 0; d < digits; ++d) one *= 10;
        const int step = 1 + static_cast<int>(random() % static_cast<unsigned>(one));
        int time = (1 + static_cast<int>(random() % 20)) * one - step * 3;
        std::vector<Written> all;
        for (int n = 0; n < 9; ++n, time += step)
            if (time >= 0)
                all.push_back(written(fmt::format("{}.{:0{}}", time / one, time % one, digits)));
        const std::vector<Path> ascending = filesOf(all);
        std::ranges::shuffle(all, random);
        const auto series = numbered(filesOf(all));
        ASSERT_TRUE(series) << ascending.front();
        EXPECT_EQ(series->files, ascending) << "round " << i;
        EXPECT_THAT(series->numbers, testing::Each(testing::HasSubstr("."))) << ascending.front();
    }
}

TEST(NumberedNames, WhatIsTakenIsInTheOrderOfDecimalsAndOfWholesAlike) {
    std::mt19937 random(2);
    int decimal = 0, whole = 0, none = 0;
    for (int i = 0; i < 5000; ++i) {
        std::vector<Written> all;
        const std::size_t wholes = 1 + random() % 3, longest = 1 + random() % 3;
        for (std::size_t n = 0, count = 2 + random() % 4; n < count; ++n) {
            const std::string digits = fmt::format("{}", random() % 1000);
            all.push_back(written(
                fmt::format("{}.{}", random() % wholes, digits.substr(0, 1 + random() % longest))));
        }
        const auto series = numbered(filesOf(all));
        (!series ? none : series->numbers[0].find('.') == std::string::npos ? whole : decimal)++;
        if (!series) continue;
        std::ranges::stable_sort(all, {}, [](const Written& w) { return w.decimal; });
        EXPECT_EQ(series->files, filesOf(all)) << "round " << i;
        std::ranges::stable_sort(all, {},
                                 [](const Written& w) { return std::tuple(w.whole, w.fraction); });
        EXPECT_EQ(series->files, filesOf(all)) << "round " << i;
    }
    // Each of them came often.
    EXPECT_GT(decimal, 500);
    EXPECT_GT(whole, 50);
    EXPECT_GT(none, 500);
}

}  // namespace
}  // namespace timeseries
