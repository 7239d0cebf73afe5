#include "app/exploration/value_map.h"
#include "tests/support/sorted.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace app {
namespace {

using timeseries::Axis;
using timeseries::Field;
using timeseries::Grid;
using timeseries::SortedStep;

SortedStep stepOf(std::vector<float> values) {
    const auto n = values.size();
    Axis x{"x", "m", timeseries::indexCoordinates(n)}, one{"y", "m", {0}};
    return tests::sorted({std::make_shared<Grid>(std::array{x, one, one}), std::move(values), {}});
}

std::vector<float> randomValues(std::size_t n) {
    std::mt19937 random(5);
    std::normal_distribution<float> normal(10, 3);
    std::vector<float> values(n);
    for (float& v : values) v = normal(random);
    return values;
}

TEST(Histogram, CountsWhatLiesInEachPart) {
    const std::vector<float> values = randomValues(2000);
    const double lo = 2, hi = 18;
    const std::size_t bins = 37;
    std::vector<std::uint64_t> expected(bins);
    for (const float v : values) {
        const double value = static_cast<double>(v);
        if (value < lo || value > hi) continue;
        // The part whose ends enclose the value, by their own formula.
        std::size_t part = bins - 1;
        while (part > 0 && value < lo + (hi - lo) * (static_cast<double>(part) / bins)) --part;
        ++expected[part];
    }
    EXPECT_EQ(histogram(stepOf(values), lo, hi, bins), expected);
}

TEST(Histogram, BothEndsCount) {
    EXPECT_EQ(histogram(stepOf({0, 1, 2, 3, 4}), 0, 4, 2), (std::vector<std::uint64_t>{2, 3}));
}

constexpr float kInf = std::numeric_limits<float>::infinity();

timeseries::StepSummary summaryOf(const SortedStep& step) {
    timeseries::Series series(1, std::numeric_limits<std::uint64_t>::max());
    series.loaded(0, std::make_shared<const SortedStep>(step));
    return *series.summary(0);
}

// They stand at the ends of an axis that reaches as far as the finite values do, and nowhere on one
// that ends before.
TEST(Histogram, InfinitiesCountAtTheEndsOfTheWholeAxis) {
    const SortedStep step = stepOf({-kInf, 0, 1, 2, 3, 4, kInf, kInf, kInf});
    using Counts = std::vector<std::uint64_t>;
    EXPECT_EQ(histogram(step, 0, 4, 2), (Counts{2 + 1, 3 + 3}));
    EXPECT_EQ(histogram(step, -10, 10, 4), (Counts{0 + 1, 0, 5, 0 + 3}));
    EXPECT_EQ(histogram(step, 1, 4, 3), (Counts{1, 1, 2 + 3}));
    EXPECT_EQ(histogram(step, 0, 2, 2), (Counts{1 + 1, 2}));
    EXPECT_EQ(histogram(stepOf({kInf, kInf, -kInf}), 0, 1, 2), (Counts{1, 2}));
}

TEST(Density, InfinitiesStandWhereTheHistogramHasThem) {
    std::vector<float> values = randomValues(20'000);
    values.insert(values.end(), 500, kInf);
    values.insert(values.end(), 30, -kInf);
    const SortedStep step = stepOf(values);
    const timeseries::StepSummary summary = summaryOf(step);
    for (const auto& [lo, hi] : {std::pair{-20.0, 40.0}, {5.0, 40.0}, {-20.0, 12.0}, {8.0, 12.0}}) {
        const auto exact = histogram(step, lo, hi, 24);
        const auto estimate = density(summary, lo, hi, 24);
        for (std::size_t i = 0; i < exact.size(); ++i)
            EXPECT_NEAR(estimate[i], static_cast<double>(exact[i]), 2 * 20'000.0 / 1024) << i;
    }
}

TEST(Density, OfMonotoneQuantilesIsTheHistogramToAFewPoints) {
    const SortedStep step = stepOf(randomValues(50'000));
    timeseries::StepSummary summary;
    summary.quantiles = step.quantiles(timeseries::Series::kQuantiles);
    summary.points = step.size();
    summary.finite = {0, step.size()};
    const auto exact = histogram(step, 4, 16, 24);
    const auto estimate = density(summary, 4, 16, 24);
    // Each edge of a part lies between two quantiles, 50,000 / 1024 points apart.
    for (std::size_t i = 0; i < exact.size(); ++i)
        EXPECT_NEAR(estimate[i], static_cast<double>(exact[i]), 2 * 50'000 / 1024.0) << i;
}

TEST(Density, AValueThatManyPointsHaveKeepsThemTogether) {
    std::vector<float> values(1000, 5.0f);
    values.push_back(0);
    values.push_back(10);
    const SortedStep step = stepOf(values);
    timeseries::StepSummary summary;
    summary.quantiles = step.quantiles(timeseries::Series::kQuantiles);
    summary.points = step.size();
    summary.finite = {0, step.size()};
    const auto counts = density(summary, 0, 10, 20);
    EXPECT_NEAR(counts[10], 1000, 4);  // [5, 5.5)
    EXPECT_NEAR(std::accumulate(counts.begin(), counts.end(), 0.0), 1002, 1);
}

TEST(Density, OfNoPointsIsNothing) {
    EXPECT_EQ(density({}, 0, 1, 3), (std::vector<double>{0, 0, 0}));
}

TEST(CountTicks, AreAFewRoundNumbersFromZeroOn) {
    std::mt19937 random(9);
    for (int i = 0; i < 1000; ++i) {
        const double most = static_cast<double>(1 + random() % (1u << (1 + i % 31)));
        const std::vector<double> linear = countTicks(most, true), powers = countTicks(most, false);
        EXPECT_LE(linear.size(), 4u);
        EXPECT_GE(linear.size(), 2u) << most;
        EXPECT_EQ(powers.size(),
                  static_cast<std::size_t>(std::floor(std::log10(most) + 1e-12)) + 2);
        for (const auto& ticks : {linear, powers}) {
            EXPECT_EQ(ticks.front(), 0);
            EXPECT_LE(ticks.back(), most);
            EXPECT_TRUE(std::ranges::is_sorted(ticks));
            for (const double tick : ticks) {
                EXPECT_EQ(tick, std::round(tick)) << "whole points";
            }
            const double step = ticks[1];
            const double digit = step / std::pow(10, std::floor(std::log10(step) + 1e-12));
            EXPECT_NEAR(digit, std::round(digit), 1e-9) << most << ": one digit is enough";
        }
    }
}

TEST(ShortCount, IsSaidWithALetter) {
    EXPECT_EQ(shortCount(0), "0");
    EXPECT_EQ(shortCount(500), "500");
    EXPECT_EQ(shortCount(1000), "1k");
    EXPECT_EQ(shortCount(20000), "20k");
    EXPECT_EQ(shortCount(5e6), "5M");
    EXPECT_EQ(shortCount(1e9), "1G");
}

}  // namespace
}  // namespace app
