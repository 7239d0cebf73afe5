// The field that is measured with.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <numbers>
#include <numeric>
#include <type_traits>
#include <vector>

#include "timeseries/grid/field.h"

namespace bench {

// A hash of the point (splitmix64, Steele et al. 2014), as noise in [0, 1).
inline double noise(std::uint64_t i) {
    i += 0x9e3779b97f4a7c15U;
    i = (i ^ (i >> 30)) * 0xbf58476d1ce4e5b9U;
    i = (i ^ (i >> 27)) * 0x94d049bb133111ebU;
    return static_cast<double>((i ^ (i >> 31)) >> 11) * 0x1p-53;
}

// n^3 values in about [-1, 1]: waves of five lengths whose amplitudes fall as in turbulence
// (Kolmogorov 1941: k^(-1/3) for the velocity at wave number k), and a little noise, so that values
// are neither in order nor tied. Integers get the same scaled to their type.
template <typename T>
timeseries::Field turbulence(std::size_t n) {
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

}  // namespace bench
