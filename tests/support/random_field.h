// Fields of every kind that is stored differently.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <random>
#include <vector>

#include "tests/support/scenes.h"
#include "tests/support/selection_oracle.h"
#include "timeseries/grid/field.h"

namespace tests {

inline std::shared_ptr<const timeseries::Grid> gridOf(std::array<std::size_t, 3> size) {
    return std::make_shared<const timeseries::Grid>(
        std::array{axis(size[0]), axis(size[1]), axis(size[2])});
}

// Smooth, any bits, awkward or one value almost everywhere; some of it missing.
template <typename T>
timeseries::Field randomField(std::mt19937_64& random, std::array<std::size_t, 3> size, int kind) {
    timeseries::Field field;
    field.grid = gridOf(size);
    const std::size_t n = field.grid->count();
    const std::vector<T> awkward = oracle::awkwardValues<T>();
    std::vector<T> values(n);
    for (std::size_t i = 0; i < n; ++i) {
        const auto p = field.grid->position(i);
        if (kind == 0)
            values[i] = static_cast<T>(60 + 50 * std::sin(p.x * .1) * std::cos(p.y * .2 + p.z));
        if (kind == 1) values[i] = oracle::anyValue<T>(random);
        if (kind == 2) values[i] = awkward[random() % awkward.size()];
        if (kind == 3) values[i] = random() % 100 == 0 ? oracle::anyValue<T>(random) : T{7};
    }
    if (random() % 2 == 0) {
        field.missing.resize(n);
        for (std::size_t i = 0; i < n; ++i) field.missing[i] = random() % 5 == 0;
    }
    values[random() % n] = T{1};
    field.values = std::move(values);
    return field;
}

}  // namespace tests
