// Two ways to do one thing, measured by turns: what else the machine does falls on both alike.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <vector>

namespace bench {

inline double median(std::vector<double> of) {
    const auto middle = of.begin() + static_cast<std::ptrdiff_t>(of.size() / 2);
    std::nth_element(of.begin(), middle, of.end());
    return *middle;
}

template <typename Do>
double milliseconds(const Do& what) {
    const auto start = std::chrono::steady_clock::now();
    what();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
        .count();
}

// Each iteration does `first` and `second`, `oftener` times the first for each second: far quicker
// things need more turns. Counters: their medians in milliseconds, and second / first. Each is done
// once before, unmeasured.
template <typename First, typename Second>
void alternate(benchmark::State& state, const First& first, const Second& second, int oftener = 1) {
    first();
    second();
    std::vector<double> firsts, seconds;
    for (auto _ : state) {
        firsts.push_back(milliseconds([&] {
                             for (int i = 0; i < oftener; ++i) first();
                         }) /
                         oftener);
        seconds.push_back(milliseconds(second));
    }
    const double a = median(firsts), b = median(seconds);
    state.counters["first_ms"] = a;
    state.counters["second_ms"] = b;
    state.counters["second/first"] = b / a;
}

}  // namespace bench
