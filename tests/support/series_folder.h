// A folder of files that are told by their names alone.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

#include "tests/support/files.h"
#include "timeseries/readers/reader.h"
#include "timeseries/readers/series_files.h"

namespace tests {

// Empty files of these names, in the folder of the test.
class SeriesFolder : public testing::Test {
 protected:
    void make(const std::vector<std::string>& names) {
        for (const std::string& name : names) writeBytes(folder_ / name, "");
    }
    timeseries::ExpandedSeries expand(const std::string& name) const { return expand({name}); }
    timeseries::ExpandedSeries expand(std::initializer_list<std::string> names) const {
        std::vector<std::filesystem::path> paths;
        for (const std::string& name : names) paths.push_back(folder_ / name);
        return timeseries::expandSeries(paths);
    }
    std::string failure(const std::string& name) const {
        try {
            expand(name);
        } catch (const timeseries::FileError& error) {
            return error.what();
        }
        return "";
    }

    const std::filesystem::path folder_ = freshFolder();
};

inline std::vector<std::string> names(const timeseries::ExpandedSeries& series) {
    std::vector<std::string> all;
    for (const std::filesystem::path& file : series.files) all.push_back(file.filename().string());
    return all;
}

}  // namespace tests
