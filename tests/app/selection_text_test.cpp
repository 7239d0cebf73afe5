#include "app/choices/selection_text.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/scenes.h"
#include "tests/support/sorted.h"

namespace app {
namespace {

using testing::HasSubstr;
using timeseries::RangeSet;
using timeseries::SortedStep;

template <typename T>
class SelectionText : public testing::Test {
 protected:
    // Few different values, so that most are tied; negative where the type has such.
    SortedStep tied(std::size_t points, std::vector<T>& sorted,
                    const RangeSet& kept = RangeSet::everything()) {
        std::vector<T> values(points);
        for (T& v : values) {
            v = static_cast<T>(random_() % 12);
            if constexpr (std::is_signed_v<T>) v = static_cast<T>(v - 4);
        }
        const auto grid = std::make_shared<timeseries::Grid>(
            std::array{tests::axis(points), tests::axis(1), tests::axis(1)});
        sorted = values;
        std::ranges::sort(sorted);
        return tests::sorted({grid, std::move(values), {}}, kept);
    }
    std::mt19937 random_{63};
};
using Types = testing::Types<std::uint8_t, std::int8_t, std::uint16_t, std::int16_t, std::uint32_t,
                             std::int32_t, std::uint64_t, std::int64_t, float, double>;
TYPED_TEST_SUITE(SelectionText, Types);

TYPED_TEST(SelectionText, QuantilesSelectAtLeastTheirShareAndSplitNoTie) {
    // Shares in tenths of a percent, as whole numbers: what they are of n points is exact.
    for (int i = 0; i < 400; ++i) {
        const std::size_t n = 1 + this->random_() % 300;
        std::vector<TypeParam> sorted;
        const SortedStep step = this->tied(n, sorted);
        const std::size_t tenths = 1 + this->random_() % 1000;
        const std::size_t share = (tenths * n + 999) / 1000;  // at least
        const std::string percent = fmt::format("{}.{}", tenths / 10, tenths % 10);
        const auto expectPoints = [&](const std::string& text, std::size_t first, std::size_t end) {
            // With all that equal the outermost.
            const auto from = std::ranges::lower_bound(sorted, sorted[first]) - sorted.begin();
            const auto to = std::ranges::upper_bound(sorted, sorted[end - 1]) - sorted.begin();
            const auto runs = step.select(parseSelection(text, step));
            ASSERT_EQ(runs.size(), 1u) << text << " of " << n;
            EXPECT_EQ(runs[0], (timeseries::Run{std::uint64_t(from), std::uint64_t(to - from)}))
                << text << " of " << n;
        };
        expectPoints("top " + percent + " %", n - share, n);
        expectPoints("bottom " + percent + "%", 0, share);
        const std::size_t from = this->random_() % (tenths + 1);
        const std::size_t first = std::min(from * n / 1000, n - 1);
        expectPoints(fmt::format("{}.{}% : {} %", from / 10, from % 10, percent), first,
                     std::max(share, first + 1));
    }
}

TYPED_TEST(SelectionText, QuantilesStayInsideWhatWasKept) {
    std::vector<TypeParam> sorted;
    const SortedStep step = this->tied(500, sorted, RangeSet::parse("2:3,(4,6]"));
    const auto kept = static_cast<std::uint64_t>(std::ranges::count_if(
        sorted, [](auto v) { return (v >= 2 && v <= 3) || (v > 4 && v <= 6); }));
    EXPECT_EQ(step.count(parseSelection("top 100 %", step)), kept);
    EXPECT_EQ(step.count(parseSelection("0 % : 100 %", step)), kept);
    EXPECT_GE(step.count(parseSelection("bottom 50 %", step)), (kept + 1) / 2);
}

SortedStep tenPoints() {
    return tests::stepOf(std::make_shared<timeseries::Grid>(
                             std::array{tests::axis(10), tests::axis(1), tests::axis(1)}),
                         [](std::size_t i) { return double(i); });
}

TEST(SelectionTextOf, TopAndBottomHaveNoOuterBound) {
    // Another step's values beyond those of this one belong to them too.
    EXPECT_EQ(parseSelection("top 20 %", tenPoints()), RangeSet::parse("8:max"));
    EXPECT_EQ(parseSelection(" bottom20%", tenPoints()), RangeSet::parse("min:1"));
    EXPECT_EQ(parseSelection("25% : 75 %", tenPoints()), RangeSet::parse("2:7"));
}

TEST(SelectionTextOf, RangesAreReadAsTheyAre) {
    for (const char* text : {"600:1600", "[600,1600)", "850~50", "300:400,900:max"})
        EXPECT_EQ(parseSelection(text, tenPoints()), RangeSet::parse(text));
}

TEST(SelectionTextOf, WhatIsNeitherIsRefusedByItsText) {
    for (const char* text : {"top",
                             "top 5",
                             "top %",
                             "top -1 %",
                             "top 101 %",
                             "top 0 %",
                             "top nan %",
                             "top inf %",
                             "bottom five %",
                             "5 %",
                             "75 % : 25 %",
                             "25 : 75 %",
                             "25 % : 75",
                             "1 % : 2 % : 3 %",
                             "top 5 %, bottom 5 %",
                             "%",
                             "middle 5 %",
                             "",
                             "five",
                             "2:1"})
        try {
            parseSelection(text, tenPoints());
            ADD_FAILURE() << text;
        } catch (const std::invalid_argument& error) {
            EXPECT_THAT(error.what(), HasSubstr(fmt::format("'{}'", text)));
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        }
}

TEST(SelectionTextOf, NoPointsHaveNoShare) {
    const SortedStep empty = tests::sorted({std::make_shared<timeseries::Grid>(std::array{
                                                tests::axis(1), tests::axis(1), tests::axis(1)}),
                                            std::vector<float>{1},
                                            {}},
                                           RangeSet::parse("5:6"));
    EXPECT_THROW(parseSelection("top 5 %", empty), std::invalid_argument);
    EXPECT_EQ(parseSelection("5:6", empty), RangeSet::parse("5:6"));
}

TEST(SelectionOfFloats, IsToldInFewDigits) {
    const SortedStep step =
        tests::stepOf(tests::cube(10), [](std::size_t i) { return 0.1 * static_cast<double>(i); });
    for (const auto& [text, told] :
         {std::pair("top 1 %", "99:max"), std::pair("bottom 1 %", "min:0.9"),
          std::pair("top 0.2 %", "99.8:max"), std::pair("10 % : 20 %", "10:19.9")}) {
        const RangeSet ranges = parseSelection(text, step);
        EXPECT_EQ(ranges.text(), told);
        EXPECT_EQ(step.count(ranges), step.count(RangeSet::parse(told)));
    }
    EXPECT_EQ(step.count(parseSelection("top 0.2 %", step)), 2u);
}

}  // namespace
}  // namespace app
