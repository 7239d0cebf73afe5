// Variables of an open file by their names.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "timeseries/readers/reader.h"

namespace tests {

inline std::unique_ptr<timeseries::Reader> open(const std::filesystem::path& path) {
    return timeseries::openReader(std::span(&path, 1));
}

// Fails the test, and is the first, where there is none.
inline std::size_t indexOf(const timeseries::Reader& reader, std::string_view name) {
    const auto& all = reader.variables();
    const auto found = std::ranges::find(all, name, &timeseries::Variable::name);
    if (found != all.end()) return static_cast<std::size_t>(found - all.begin());
    ADD_FAILURE() << "no variable " << name;
    return 0;
}

template <typename T>
std::vector<T> valuesOf(timeseries::Reader& reader, std::string_view name, std::size_t step = 0) {
    return std::get<std::vector<T>>(reader.read(indexOf(reader, name), step).values);
}

}  // namespace tests
