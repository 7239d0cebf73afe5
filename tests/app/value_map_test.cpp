#include "app/value_map.h"

#include <gtest/gtest.h>

#include <cmath>
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
    return SortedStep::build(
        {std::make_shared<Grid>(std::array{x, one, one}), std::move(values), {}});
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

TEST(Density, OfMonotoneQuantilesIsTheHistogramToAFewPoints) {
    const SortedStep step = stepOf(randomValues(50'000));
    timeseries::StepSummary summary;
    summary.quantiles = step.quantiles(timeseries::Series::kQuantiles);
    summary.points = step.size();
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
    const auto counts = density(summary, 0, 10, 20);
    EXPECT_NEAR(counts[10], 1000, 4);  // [5, 5.5)
    EXPECT_NEAR(std::accumulate(counts.begin(), counts.end(), 0.0), 1002, 1);
}

TEST(Density, OfNoPointsIsNothing) {
    EXPECT_EQ(density({}, 0, 1, 3), (std::vector<double>{0, 0, 0}));
}

}  // namespace
}  // namespace app
