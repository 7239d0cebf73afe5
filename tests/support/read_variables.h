// Variables of an open file by their names.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "timeseries/readers/reader.h"

namespace tests {

inline std::unique_ptr<timeseries::Reader> open(const std::filesystem::path& path) {
    return timeseries::openReader(std::span(&path, 1));
}

inline std::vector<std::string> namesOf(const timeseries::Reader& reader) {
    std::vector<std::string> names;
    for (const timeseries::Variable& variable : reader.variables()) names.push_back(variable.name);
    return names;
}

// What they are refused with; "" when they open.
inline std::string refusalOf(const std::vector<std::filesystem::path>& paths) {
    try {
        timeseries::openReader(paths);
    } catch (const timeseries::FileError& error) {
        return error.what();
    }
    return "";
}
inline std::string refusalOf(const std::filesystem::path& path) {
    return refusalOf(std::vector{path});
}
// What opening it or reading a step of its first variable is refused with; "" when both are done.
inline std::string refusalOfRead(const std::filesystem::path& path, std::size_t step = 0) {
    try {
        open(path)->read(0, step);
    } catch (const timeseries::FileError& error) {
        return error.what();
    }
    return "";
}
// Of a file that is being made, once something about it is changed; it begins with the file's path.
template <typename File, typename Change>
std::string refusalAfter(File& file, const Change& change) {
    change(file);
    const auto path = file.close();
    const std::string refusal = refusalOf(path);
    if (!refusal.empty()) {
        EXPECT_THAT(refusal, testing::StartsWith(path.string() + ": "));
    }
    return refusal;
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

// Of the first variable.
inline std::vector<double> timesOf(const timeseries::Reader& reader) {
    std::vector<double> times;
    for (const timeseries::TimePoint& point : reader.variables()[0].time->points)
        times.push_back(point.value);
    return times;
}

}  // namespace tests
