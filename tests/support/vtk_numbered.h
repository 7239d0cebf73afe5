// Numbered .vtu files of two cubes and their times, for tests of series.
#pragma once

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/files.h"
#include "tests/support/read_variables.h"
#include "tests/support/vtk_files.h"

namespace tests {

// Of step i: no text of few digits is it.
inline double timeOfStep(std::size_t i) { return 1.0 / 3 + 1e-9 * static_cast<double>(i * i + 1); }

inline std::string fieldNumber(const std::string& type, const std::string& name,
                               const std::string& number,
                               const std::string& attributes = "NumberOfTuples=\"1\"") {
    return fmt::format("<DataArray type=\"{}\" Name=\"{}\" {} format=\"ascii\">{}</DataArray>\n",
                       type, name, attributes, number);
}

inline std::string timeValue(double time) {
    return fieldNumber("Float64", "TimeValue", fmt::format("{}", time));
}

// Two cubes with 12 values at points; field data before its piece.
inline std::string cubesText(const std::string& field, const std::string& points) {
    std::string text = unstructuredText(points, "");
    const std::string grid = "<UnstructuredGrid>\n";
    return text.insert(text.find(grid) + grid.size(),
                       field.empty() ? "" : "<FieldData>\n" + field + "</FieldData>\n");
}

inline std::string cubesOfStep(std::size_t i) {
    return cubesText(timeValue(timeOfStep(i)),
                     dataArray("Int32", "p", std::vector<int>(12, static_cast<int>(i))));
}

inline std::vector<std::filesystem::path> numberedFiles(const std::filesystem::path& folder,
                                                        const std::vector<std::string>& texts,
                                                        const std::string& extension = "vtu") {
    std::vector<std::filesystem::path> paths;
    for (std::size_t i = 0; i < texts.size(); ++i) {
        paths.push_back(folder / fmt::format("run_{}.{}", 10 * i + 5, extension));
        writeBytes(paths.back(), texts[i]);
    }
    return paths;
}

inline std::vector<std::filesystem::path> threeCubes(const std::filesystem::path& folder) {
    return numberedFiles(folder, {cubesOfStep(0), cubesOfStep(1), cubesOfStep(2)});
}

// "" when it is read.
inline std::string refusalOfStep(timeseries::Reader& reader, std::size_t step) {
    try {
        reader.read(0, step);
    } catch (const timeseries::FileError& error) {
        return error.what();
    }
    return "";
}

inline void expectStep(timeseries::Reader& reader, std::size_t step) {
    EXPECT_THAT(valuesOf<std::int32_t>(reader, "p", step),
                testing::ElementsAreArray(std::vector<int>(12, static_cast<int>(step))));
}

}  // namespace tests
