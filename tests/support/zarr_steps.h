// Arrays (t, z, y, x) in Zarr stores whose every value tells its place, and what reads them whole.
#pragma once

#include <filesystem>
#include <string>
#include <type_traits>
#include <vector>

#include "tests/support/read_variables.h"
#include "tests/support/zarr_store.h"

namespace tests::zarr {

// Not all bytes of it are alike, nor its neighbours.
template <typename T>
T valueAt(const Lengths& at) {
    std::uint64_t n = 7;
    for (const std::size_t along : at) n = n * 31 + along;
    if constexpr (std::is_floating_point_v<T>)
        return static_cast<T>(n % 100000) / static_cast<T>(7);
    else
        return static_cast<T>(n * 0x9E3779B97F4A7C15u >> 3);
}

// The values of step t of an array (t, z, y, x), x fastest.
template <typename T>
std::vector<T> expected(const Lengths& shape, std::size_t t) {
    std::vector<T> values;
    forEachAt({shape[1], shape[2], shape[3]}, [&](const Lengths& at) {
        values.push_back(valueAt<T>({t, at[0], at[1], at[2]}));
    });
    return values;
}

// Chunks that end within the array and beyond it, along each dimension.
inline const Layout kLayout{.shape = {3, 5, 4, 7}, .chunk = {2, 2, 3, 4}};

template <typename T>
void expectStepsRead(const std::filesystem::path& store, const std::string& told) {
    const auto reader = open(store);
    ASSERT_EQ(reader->variables().size(), 1u) << told;
    const timeseries::Variable& variable = reader->variables()[0];
    EXPECT_EQ(variable.time->points.size(), 3u) << told;
    EXPECT_EQ(variable.grid->size(), (std::array<std::size_t, 3>{7, 4, 5})) << told;
    for (const std::size_t step : {0, 1, 2, 0})  // of which chunks have two
        EXPECT_EQ(valuesOf<T>(*reader, variable.name, step), expected<T>(kLayout.shape, step))
            << told << ", step " << step;
}

}  // namespace tests::zarr
