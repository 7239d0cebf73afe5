// Fields of every type, and what a sorted step of one must hold: by brute force.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <memory>
#include <numeric>
#include <random>
#include <set>
#include <sstream>
#include <vector>

#include "tests/support/ranges.h"
#include "tests/support/selection_oracle.h"
#include "timeseries/index/sorted_step.h"

namespace tests::sorted {

using namespace timeseries;
using oracle::describe;
using Indices = std::vector<std::uint32_t>;
using Runs = std::vector<Run>;  // inside a test, Run is gtest's

inline Range closed(Number lo, Number hi) { return {{lo, false}, {hi, false}}; }
inline RangeSet rangeOf(Bound lo, Bound hi) { return RangeSet(std::vector<Range>{{lo, hi}}); }

inline std::shared_ptr<const Grid> lineOf(std::size_t n) {
    Axis x{"x", "index", std::vector<double>(n)};
    std::iota(x.coordinates.begin(), x.coordinates.end(), 0.0);
    return std::make_shared<const Grid>(
        std::array<Axis, 3>{std::move(x), Axis{"y", "index", {0.0}}, Axis{"z", "index", {0.0}}});
}

template <typename T>
Field fieldOf(std::vector<T> values, std::vector<bool> missing = {}) {
    auto grid = lineOf(values.size());
    return {std::move(grid), std::move(values), std::move(missing)};
}

template <typename T>
const std::vector<T>& valuesIn(const Field& field) {
    return std::get<std::vector<T>>(field.values);
}

template <typename T>
bool valid(const Field& field, std::size_t i) {
    const T value = valuesIn<T>(field)[i];
    return (field.missing.empty() || !field.missing[i]) && value == value;
}

// Every point of the field that the ranges hold, ascending by grid index.
template <typename T>
Indices expectedPoints(const Field& field, std::span<const Range> ranges) {
    Indices points;
    for (std::size_t i = 0; i < valuesIn<T>(field).size(); ++i)
        if (valid<T>(field, i) && oracle::holds(ranges, valuesIn<T>(field)[i]))
            points.push_back(static_cast<std::uint32_t>(i));
    return points;
}

// Grid indices of all points in the runs, ascending; also checks that the runs are as promised.
inline Indices pointsOf(const SortedStep& step, std::span<const Run> runs) {
    Indices points;
    std::uint64_t end = 0;
    for (const Run& run : runs) {
        EXPECT_GT(run.count, 0U);
        EXPECT_GE(run.first, end);
        end = run.first + run.count;
        EXPECT_LE(end, step.size());
        if (testing::Test::HasFailure()) return {};
        const auto indices = step.gridIndex().subspan(run.first, run.count);
        points.insert(points.end(), indices.begin(), indices.end());
    }
    std::sort(points.begin(), points.end());
    return points;
}

template <typename T>
void expectSelects(const SortedStep& step, const Field& field, const RangeSet& ranges) {
    const Indices expected = expectedPoints<T>(field, ranges.ranges());
    ASSERT_EQ(pointsOf(step, step.select(ranges)), expected) << describe(ranges.ranges());
    ASSERT_EQ(step.count(ranges), expected.size()) << describe(ranges.ranges());
}

// All that is promised of a step but selection: points, order, ties, statistics, memory.
template <typename T>
void expectSorted(const SortedStep& step, const Field& field) {
    const auto& given = valuesIn<T>(field);
    const auto sorted = std::get<std::span<const T>>(step.columns().values);
    Indices expected = expectedPoints<T>(field, step.kept().ranges());
    std::stable_sort(expected.begin(), expected.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return given[a] < given[b]; });
    ASSERT_EQ(step.type(), field.type());
    ASSERT_EQ(step.size(), expected.size());
    ASSERT_EQ(sorted.size(), expected.size());
    ASSERT_TRUE(std::equal(expected.begin(), expected.end(), step.gridIndex().begin()));
    for (std::size_t k = 0; k < expected.size(); ++k)
        ASSERT_EQ(sorted[k], given[expected[k]]) << "at " << k;
    // Vectors' own slots, the kept ranges and the statistics; 16 bytes a bound and its tag.
    std::size_t constant = sizeof(SortedStep) + 128 * (step.kept().ranges().size() + 1);
    // Where each starts, of each value that there is.
    if (sizeof(T) <= 2) constant += 16 * std::set<T>(sorted.begin(), sorted.end()).size();
    ASSERT_GE(step.bytes(), (sizeof(T) + 4) * expected.size());
    ASSERT_LE(step.bytes(), (sizeof(T) + 4) * expected.size() + constant);
}

template <typename T>
void expectStatistics(const SortedStep& step, const Field& field) {
    const auto& given = valuesIn<T>(field);
    std::vector<T> all;
    for (std::size_t i = 0; i < given.size(); ++i)
        if (valid<T>(field, i)) all.push_back(given[i]);
    const StepStatistics& statistics = step.statistics();
    ASSERT_EQ(statistics.points, all.size());
    ASSERT_EQ(statistics.missing, given.size() - all.size());
    if (all.empty()) {
        ASSERT_TRUE(std::isnan(toDouble(statistics.min)));
        ASSERT_TRUE(std::isnan(toDouble(statistics.max)));
        return;
    }
    ASSERT_EQ(oracle::real(statistics.min), *std::min_element(all.begin(), all.end()));
    ASSERT_EQ(oracle::real(statistics.max), *std::max_element(all.begin(), all.end()));
    std::erase_if(all, [](T value) { return std::isinf(static_cast<oracle::Real>(value)); });
    if (all.empty()) {
        ASSERT_TRUE(std::isnan(toDouble(statistics.finiteMin)));
        ASSERT_TRUE(std::isnan(toDouble(statistics.finiteMax)));
        return;
    }
    ASSERT_EQ(oracle::real(statistics.finiteMin), *std::min_element(all.begin(), all.end()));
    ASSERT_EQ(oracle::real(statistics.finiteMax), *std::max_element(all.begin(), all.end()));
}

template <typename T>
T randomValue(std::mt19937_64& random) {
    if constexpr (std::is_same_v<T, float>) {
        return std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    } else if constexpr (std::is_same_v<T, double>) {
        return std::bit_cast<double>(random());
    } else {
        return static_cast<T>(random());
    }
}

template <typename T>
std::vector<T> withNan(std::vector<T> values) {
    if constexpr (std::is_floating_point_v<T>) {
        values.push_back(std::numeric_limits<T>::quiet_NaN());
        values.push_back(-std::numeric_limits<T>::quiet_NaN());
    }
    return values;
}

// A field of n points: few awkward values (many ties), any bits, or one value; some with missing.
template <typename T>
Field randomField(std::mt19937_64& random, std::size_t n) {
    const std::vector<T> pool = withNan(oracle::awkwardValues<T>());
    const std::size_t kinds = 1 + random() % pool.size();
    const std::uint64_t shape = random() % 4;
    std::vector<T> values(n);
    for (T& value : values) {
        if (shape == 0) value = pool[random() % pool.size()];
        if (shape == 1) value = pool[random() % kinds];
        if (shape == 2) value = randomValue<T>(random);
        if (shape == 3) value = pool[kinds - 1];
    }
    std::vector<bool> missing;
    if (random() % 2 == 0) {
        missing.resize(n);
        const std::uint64_t oneIn = 1 + random() % 4;  // 1: all of them
        for (std::size_t i = 0; i < n; ++i) missing[i] = random() % oneIn == 0;
    }
    return fieldOf(std::move(values), std::move(missing));
}

template <typename T>
std::string describe(const Field& field) {
    std::ostringstream out;
    out.precision(21);
    out << typeName(field.type()) << " [";
    for (std::size_t i = 0; i < valuesIn<T>(field).size() && i < 40; ++i) {
        out << ' ' << static_cast<oracle::Real>(valuesIn<T>(field)[i]);
        if (!field.missing.empty() && field.missing[i]) out << "(missing)";
    }
    out << " ] of " << valuesIn<T>(field).size();
    return out.str();
}

// Awkward numbers, and some of the field's own values as a reader of its type would state them.
template <typename T>
std::vector<Number> boundsFor(const Field& field) {
    std::vector<Number> bounds = oracle::awkwardNumbers();
    const auto& values = valuesIn<T>(field);
    for (std::size_t i = 0; i < values.size() && i < 20; ++i) {
        bounds.push_back(static_cast<double>(values[i]));
        if constexpr (std::is_signed_v<T> && std::is_integral_v<T>)
            bounds.push_back(static_cast<std::int64_t>(values[i]));
        if constexpr (std::is_unsigned_v<T>)
            bounds.push_back(static_cast<std::uint64_t>(values[i]));
    }
    return bounds;
}

using ValueTypes =
    testing::Types<std::uint8_t, std::int8_t, std::uint16_t, std::int16_t, std::uint32_t,
                   std::int32_t, std::uint64_t, std::int64_t, float, double>;

}  // namespace tests::sorted
