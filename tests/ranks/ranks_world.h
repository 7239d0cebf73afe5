// What tests of several processes share: all of them run each test, in the same order.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "timeseries/ranks/shared_step.h"

namespace timeseries::ranks_world {

namespace fs = std::filesystem;

// Small enough for messages to be cut.
inline const Ranks& world() {
    static const Ranks ranks(MPI_COMM_WORLD, 1 << 16);
    return ranks;
}

// One for all ranks, empty.
inline fs::path sharedFolder() {
    const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(test->test_suite_name()) + "_" + test->name();
    std::ranges::replace(name, '/', '_');
    const fs::path folder =
        fs::temp_directory_path() / ("isochron_ranks_" + std::to_string(world().size())) / name;
    if (world().isFirst()) {
        fs::remove_all(folder);
        fs::create_directories(folder);
    }
    world().fromFirst("");
    return folder;
}

inline std::vector<std::byte> bytesOf(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

// A grid cut into as many boxes, the longest side of the largest box first, anywhere; some of them
// may be empty.
inline std::vector<GridBox> cutAtRandom(std::mt19937_64& random, std::array<std::size_t, 3> size,
                                        std::size_t boxes) {
    std::vector<GridBox> all{{{0, 0, 0}, {size[0], size[1], size[2]}}};
    while (all.size() < boxes) {
        const auto largest = std::ranges::max_element(all, {}, &GridBox::count);
        const auto axis = static_cast<std::size_t>(std::ranges::max_element(largest->size) -
                                                   largest->size.begin());
        const std::uint64_t at = random() % (largest->size[axis] + 1);
        GridBox rest = *largest;
        rest.first[axis] += at;
        rest.size[axis] -= at;
        largest->size[axis] = at;
        all.push_back(rest);
    }
    std::ranges::shuffle(all, random);
    return all;
}

template <typename T>
Field partOf(const Field& whole, const GridBox& box) {
    const auto& all = std::get<std::vector<T>>(whole.values);
    const auto size = whole.grid->size();
    Field part;
    std::vector<T> values;
    for (std::uint64_t z = 0; z < box.size[2]; ++z)
        for (std::uint64_t y = 0; y < box.size[1]; ++y)
            for (std::uint64_t x = 0; x < box.size[0]; ++x) {
                const std::size_t i = (box.first[0] + x) +
                                      size[0] * ((box.first[1] + y) + size[1] * (box.first[2] + z));
                values.push_back(all[i]);
                if (!whole.missing.empty()) part.missing.push_back(whole.missing[i]);
            }
    part.values = std::move(values);
    return part;
}

}  // namespace timeseries::ranks_world
