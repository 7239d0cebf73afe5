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

#include "tests/bench/alternate.h"
#include "tests/bench/former_build.h"
#include "tests/bench/turbulence.h"
#include "timeseries/index/sorted_step.h"

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

void countPoints(benchmark::State& state, std::uint64_t points) {
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points));
}

template <typename T>
void build(benchmark::State& state) {
    const Field field = turbulence<T>(static_cast<std::size_t>(state.range(0)));
    for (auto _ : state) {
        const SortedStep step = SortedStep::build(field);
        benchmark::DoNotOptimize(step.size());
    }
    countPoints(state, field.grid->count());
}

// Beside the index as it was, all sorted at once by one thread; and with all put in order, too.
template <typename T>
void buildBesideFormer(benchmark::State& state) {
    const Field field = turbulence<T>(static_cast<std::size_t>(state.range(0)));
    const std::span<const T> values = std::get<std::vector<T>>(field.values);
    bench::alternate(
        state, [&] { benchmark::DoNotOptimize(SortedStep::build(field).size()); },
        [&] { benchmark::DoNotOptimize(bench::former::build(values).index.data()); });
}
template <typename T>
void buildWholeBesideFormer(benchmark::State& state) {
    const Field field = turbulence<T>(static_cast<std::size_t>(state.range(0)));
    const std::span<const T> values = std::get<std::vector<T>>(field.values);
    bench::alternate(
        state,
        [&] { benchmark::DoNotOptimize(SortedStep::build(field).columns().gridIndex.data()); },
        [&] { benchmark::DoNotOptimize(bench::former::build(values).index.data()); });
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
    step.columns();
    const auto ranges = rangesOf(randomIntervals(std::get<std::vector<T>>(field.values)));
    std::size_t next = 0;
    for (auto _ : state) benchmark::DoNotOptimize(step.select(ranges[next++ % ranges.size()]));
}

// The first range of a step that was just built: what its two ends fall among is sorted.
template <typename T>
void selectFirst(benchmark::State& state) {
    const Field field = turbulence<T>(static_cast<std::size_t>(state.range(0)));
    const auto ranges = rangesOf(randomIntervals(std::get<std::vector<T>>(field.values)));
    std::size_t next = 0;
    for (auto _ : state) {
        state.PauseTiming();
        {
            const SortedStep step = SortedStep::build(field);
            state.ResumeTiming();
            benchmark::DoNotOptimize(step.select(ranges[next++ % ranges.size()]));
            state.PauseTiming();
        }
        state.ResumeTiming();
    }
}

template <typename T>
void count(benchmark::State& state) {
    const Field field = turbulence<T>(static_cast<std::size_t>(state.range(0)));
    const SortedStep step = SortedStep::build(field);
    step.columns();
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
BENCHMARK(buildBesideFormer<float>)->Arg(128)->Arg(256)->Arg(512)->Unit(benchmark::kMillisecond);
BENCHMARK(buildBesideFormer<std::int16_t>)->Arg(128)->Arg(256)->Unit(benchmark::kMillisecond);
BENCHMARK(buildBesideFormer<std::uint8_t>)->Arg(128)->Arg(256)->Unit(benchmark::kMillisecond);
BENCHMARK(buildWholeBesideFormer<float>)->Arg(256)->Unit(benchmark::kMillisecond);
BENCHMARK(selectFirst<float>)->Arg(256)->Iterations(20)->Unit(benchmark::kMillisecond);
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
