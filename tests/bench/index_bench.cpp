// The price of the index: sorting a step, and finding the points of a range in it, each beside the
// plain way to do the same (sorting packed keys with std::sort; comparing every value).
#include <benchmark/benchmark.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <type_traits>

#include "timeseries/run_search.h"
#include "timeseries/sorted_step.h"

namespace {

using timeseries::Field;
using timeseries::Interval;
using timeseries::RangeSet;
using timeseries::SortedStep;

// A hash of the point (splitmix64, Steele et al. 2014), as noise in [0, 1).
double noise(std::uint64_t i) {
    i += 0x9e3779b97f4a7c15U;
    i = (i ^ (i >> 30)) * 0xbf58476d1ce4e5b9U;
    i = (i ^ (i >> 27)) * 0x94d049bb133111ebU;
    return static_cast<double>((i ^ (i >> 31)) >> 11) * 0x1p-53;
}

// n^3 values in about [-1, 1]: waves of five lengths whose amplitudes fall as in turbulence
// (Kolmogorov 1941: k^(-1/3) for the velocity at wave number k), and a little noise, so that values
// are neither in order nor tied. Integers get the same scaled to their type.
template <typename T>
Field turbulence(std::size_t n) {
    constexpr double kWaves[] = {1, 2, 5, 11, 23};
    const auto size = static_cast<double>(n);
    const auto wave = [&](double k, std::size_t i, double phase) {
        return std::sin(2 * std::numbers::pi * k * static_cast<double>(i) / size + phase);
    };
    std::vector<std::vector<double>> sines;  // [wave * 3 + axis][i]
    for (double k : kWaves)
        for (double phase : {0.3 * k, 1.1 * k, 2.3 * k}) {
            auto& line = sines.emplace_back(n);
            for (std::size_t i = 0; i < n; ++i) line[i] = wave(k, i, phase);
        }
    std::vector<T> values;
    values.reserve(n * n * n);
    for (std::size_t z = 0; z < n; ++z)
        for (std::size_t y = 0; y < n; ++y)
            for (std::size_t x = 0; x < n; ++x) {
                double sum = 0.1 * noise(values.size());
                for (std::size_t w = 0; w < std::size(kWaves); ++w)
                    sum += 0.3 / std::cbrt(kWaves[w]) * sines[3 * w][x] *
                           (sines[3 * w + 1][y] + sines[3 * w + 2][z]);
                if constexpr (std::is_integral_v<T>)
                    sum = std::clamp(sum / 2, -1.0, 1.0) * std::numeric_limits<T>::max();
                values.push_back(static_cast<T>(sum));
            }
    timeseries::Axis axis{"x", "index", std::vector<double>(n)};
    std::iota(axis.coordinates.begin(), axis.coordinates.end(), 0.0);
    auto grid = std::make_shared<const timeseries::Grid>(std::array{axis, axis, axis});
    return {std::move(grid), std::move(values), {}};
}

// Pairs of values of the field, low end first: so many that the searches do not stay in the cache.
template <typename T>
std::vector<Interval<T>> randomIntervals(const std::vector<T>& values) {
    std::mt19937_64 random(1996);
    std::vector<Interval<T>> intervals(1 << 16);
    for (Interval<T>& interval : intervals) {
        const T a = values[random() % values.size()], b = values[random() % values.size()];
        interval = {std::min(a, b), std::max(a, b)};
    }
    return intervals;
}

template <typename T>
RangeSet rangeOf(const Interval<T>& interval) {
    using Exact = std::conditional_t<std::is_integral_v<T>, std::int64_t, double>;
    return RangeSet(std::vector<timeseries::Range>{
        {{static_cast<Exact>(interval.lo)}, {static_cast<Exact>(interval.hi)}}});
}

template <typename T>
std::vector<RangeSet> rangesOf(const std::vector<Interval<T>>& intervals) {
    std::vector<RangeSet> ranges;
    for (const Interval<T>& interval : intervals) ranges.push_back(rangeOf(interval));
    return ranges;
}

// Most comparisons any of the searches needs, over what the contract allows.
template <typename T>
void countComparisons(benchmark::State& state, const SortedStep& step,
                      const std::vector<Interval<T>>& intervals) {
    const std::span<const T> values = std::get<std::vector<T>>(step.values());
    std::uint64_t most = 0;
    for (const Interval<T>& interval : intervals) {
        std::uint64_t calls = 0;
        timeseries::findRun(values, interval, [&](T a, T b) {
            ++calls;
            return a < b;
        });
        most = std::max(most, calls);
    }
    state.counters["comparisons"] = static_cast<double>(most);
    state.counters["allowed"] = 2 * (std::log2(static_cast<double>(values.size())) + 1);
}

void countPoints(benchmark::State& state, std::uint64_t points) {
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points));
}

template <typename T>
void build(benchmark::State& state) {
    const Field field = turbulence<T>(static_cast<std::size_t>(state.range(0)));
    for (auto _ : state) {
        const SortedStep step = SortedStep::build(field);
        benchmark::DoNotOptimize(step.gridIndex().data());
    }
    countPoints(state, field.grid->count());
}

// What most would write first: value and index in one key, sorted by the standard library. Nothing
// is unpacked, so the real thing does a little more.
void buildByStdSort(benchmark::State& state) {
    const Field field = turbulence<float>(static_cast<std::size_t>(state.range(0)));
    const auto& values = std::get<std::vector<float>>(field.values);
    for (auto _ : state) {
        std::vector<std::uint64_t> keys(values.size());
        for (std::size_t i = 0; i < values.size(); ++i) {
            const auto bits = std::bit_cast<std::uint32_t>(values[i]);
            const std::uint32_t ordered = bits & 0x80000000U ? ~bits : bits | 0x80000000U;
            keys[i] = std::uint64_t{ordered} << 32 | i;
        }
        std::sort(keys.begin(), keys.end());
        benchmark::DoNotOptimize(keys.data());
    }
    countPoints(state, values.size());
}

template <typename T>
void select(benchmark::State& state) {
    const Field field = turbulence<T>(static_cast<std::size_t>(state.range(0)));
    const SortedStep step = SortedStep::build(field);
    const auto intervals = randomIntervals(std::get<std::vector<T>>(field.values));
    const auto ranges = rangesOf(intervals);
    std::size_t next = 0;
    for (auto _ : state) benchmark::DoNotOptimize(step.select(ranges[next++ % ranges.size()]));
    countComparisons(state, step, intervals);
}

template <typename T>
void count(benchmark::State& state) {
    const Field field = turbulence<T>(static_cast<std::size_t>(state.range(0)));
    const SortedStep step = SortedStep::build(field);
    const auto ranges = rangesOf(randomIntervals(std::get<std::vector<T>>(field.values)));
    std::size_t next = 0;
    for (auto _ : state) benchmark::DoNotOptimize(step.count(ranges[next++ % ranges.size()]));
}

// Without an index: every value is compared. Only counts; a list of points would cost more.
template <typename T>
void countByScan(benchmark::State& state) {
    const Field field = turbulence<T>(static_cast<std::size_t>(state.range(0)));
    const auto& values = std::get<std::vector<T>>(field.values);
    const auto intervals = randomIntervals(values);
    std::size_t next = 0;
    for (auto _ : state) {
        const Interval<T> interval = intervals[next++ % intervals.size()];
        std::uint32_t inside = 0;
        for (const T v : values) inside += (interval.lo <= v) & (v <= interval.hi);
        benchmark::DoNotOptimize(inside);
    }
    countPoints(state, values.size());
}

BENCHMARK(build<float>)->Arg(64)->Arg(128)->Arg(256)->Unit(benchmark::kMillisecond);
BENCHMARK(build<double>)->Arg(128)->Unit(benchmark::kMillisecond);
BENCHMARK(build<std::int16_t>)->Arg(128)->Unit(benchmark::kMillisecond);
BENCHMARK(buildByStdSort)->Arg(64)->Arg(128)->Arg(256)->Unit(benchmark::kMillisecond);
BENCHMARK(select<float>)->Arg(64)->Arg(128)->Arg(256);
BENCHMARK(select<double>)->Arg(128);
BENCHMARK(select<std::int16_t>)->Arg(128);
BENCHMARK(count<float>)->Arg(64)->Arg(128)->Arg(256);
BENCHMARK(count<double>)->Arg(128);
BENCHMARK(count<std::int16_t>)->Arg(128);
BENCHMARK(countByScan<float>)->Arg(64)->Arg(128)->Arg(256);
BENCHMARK(countByScan<double>)->Arg(128);
BENCHMARK(countByScan<std::int16_t>)->Arg(128);

}  // namespace

BENCHMARK_MAIN();
