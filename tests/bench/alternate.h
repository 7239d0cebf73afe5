// Two ways to do one thing, measured by turns: what else the machine does falls on both alike.
#pragma once

#include <benchmark/benchmark.h>

#include <chrono>
#include <ctime>
#include <vector>

#include "tests/bench/median.h"

namespace bench {

struct Cost {
    std::vector<double> ms, cpu;  // of the wall clock; of all the process's threads
};

// Adds one measurement of `times` goes, per go.
template <typename Do>
void measure(Cost& cost, int times, const Do& what) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t cpu = std::clock();
    for (int i = 0; i < times; ++i) what();
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    cost.cpu.push_back(1000.0 * static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC / times);
    cost.ms.push_back(took.count() / times);
}

// Each iteration does `first` and `second`, `oftener` times the first for each second: far quicker
// things need more turns. Counters: their medians in milliseconds, and second / first; of processor
// time too, which other programs disturb less. Each is done once before, unmeasured.
template <typename First, typename Second>
void alternate(benchmark::State& state, const First& first, const Second& second, int oftener = 1) {
    first();
    second();
    Cost a, b;
    for (auto _ : state) {
        measure(a, oftener, first);
        measure(b, 1, second);
    }
    state.counters["first_ms"] = median(a.ms);
    state.counters["second_ms"] = median(b.ms);
    state.counters["second/first"] = median(b.ms) / median(a.ms);
    state.counters["first_cpu_ms"] = median(a.cpu);
    state.counters["second_cpu_ms"] = median(b.cpu);
    state.counters["cpu2/cpu1"] = median(b.cpu) / median(a.cpu);
}

}  // namespace bench
