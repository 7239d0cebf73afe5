// Why VTK files are refused.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/vtk_files.h"
#include "timeseries/readers/reader.h"

namespace timeseries::vtk_refusals {

using testing::HasSubstr;
using testing::StartsWith;
using tests::dataArray;
using tests::Image;
using tests::imageText;
using Path = std::filesystem::path;

// Everything a file holds; nothing when it is refused, by one sentence.
inline std::optional<std::vector<Values>> contents(const Path& path, std::string* why = nullptr) {
    try {
        const auto reader = openReader(std::span(&path, 1));
        std::vector<Values> all;
        for (std::size_t v = 0; v < reader->variables().size(); ++v)
            all.push_back(reader->read(v, 0).values);
        return all;
    } catch (const FileError& error) {
        using testing::AllOf;
        EXPECT_THAT(error.what(),
                    testing::AnyOf(AllOf(StartsWith(path.string() + ": "), HasSubstr("expected")),
                                   AllOf(StartsWith(path.string() + " is a VTK file of type "),
                                         HasSubstr("; isochron reads "))));
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        if (why) *why = error.what();
        return std::nullopt;
    }
}

inline std::string whyRefused(const std::string& text) {
    std::string why;
    contents(tests::write("refused", text), &why);
    return why;
}

inline std::vector<double> twelve() {
    std::vector<double> values(12);
    std::iota(values.begin(), values.end(), 0.25);
    return values;
}

}  // namespace timeseries::vtk_refusals
