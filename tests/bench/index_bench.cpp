// The price of the index: sorting a step, and finding the points of a range in it, each beside the
// plain way to do the same (sorting packed keys with std::sort; comparing every value).
#include <benchmark/benchmark.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <type_traits>

#include "tests/bench/turbulence.h"
#include "timeseries/run_search.h"
#include "timeseries/sorted_step.h"

namespace {

using bench::turbulence;
using timeseries::Field;
using timeseries::Interval;
using timeseries::RangeSet;
using timeseries::SortedStep;

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
    const std::span<const T> values = std::get<std::span<const T>>(step.columns().values);
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

BENCHMARK(build<float>)->Arg(64)->Arg(128)->Arg(256)->Arg(512)->Unit(benchmark::kMillisecond);
BENCHMARK(build<double>)->Arg(128)->Unit(benchmark::kMillisecond);
BENCHMARK(build<std::int16_t>)->Arg(128)->Unit(benchmark::kMillisecond);
BENCHMARK(buildByStdSort)->Arg(64)->Arg(128)->Arg(256)->Unit(benchmark::kMillisecond);
BENCHMARK(select<float>)->Arg(64)->Arg(128)->Arg(256)->Arg(512);
BENCHMARK(select<double>)->Arg(128);
BENCHMARK(select<std::int16_t>)->Arg(128);
BENCHMARK(count<float>)->Arg(64)->Arg(128)->Arg(256)->Arg(512);
BENCHMARK(count<double>)->Arg(128);
BENCHMARK(count<std::int16_t>)->Arg(128);
BENCHMARK(countByScan<float>)->Arg(64)->Arg(128)->Arg(256)->Arg(512);
BENCHMARK(countByScan<double>)->Arg(128);
BENCHMARK(countByScan<std::int16_t>)->Arg(128);

}  // namespace

BENCHMARK_MAIN();
