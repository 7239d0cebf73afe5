// Arrays of several numbers a point.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "tests/support/read_variables.h"
#include "tests/support/vtk_files.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

using tests::dataArray;
using tests::imageText;
using tests::namesOf;
using tests::valuesOf;

std::unique_ptr<Reader> openVectors(const std::string& text) {
    const std::filesystem::path path = tests::write("vectors.vti", text);
    return openReader(std::span(&path, 1));
}

// As a calculator writes them beside the vector that they are of.
TEST(VtkVectors, ArraysThatAreCalledAsComponentsAreToldApart) {
    const auto reader = openVectors(
        imageText({.points = dataArray("Float64", "U", std::vector<double>(36, 3), 3) +
                             dataArray("Float64", "U[0]", std::vector<double>(12, 7)) +
                             dataArray("Float64", "U magnitude", std::vector<double>(12, 8))}));
    std::map<std::string, double> values;
    for (const std::string& name : namesOf(*reader))
        values[name] = valuesOf<double>(*reader, name)[0];
    EXPECT_EQ(values.size(), reader->variables().size());
    EXPECT_EQ(values["U[0]"], 3);
    EXPECT_EQ(values["U magnitude"], std::sqrt(27.0));
    EXPECT_EQ(values["U[0] (2)"], 7);
    EXPECT_EQ(values["U magnitude (2)"], 8);
}

// Of whole numbers every ray of squares: as numpy and VTK have it, to the last bit.
TEST(VtkVectors, MagnitudesAreTheRootsOfTheSumsOfSquares) {
    std::vector<int> vectors;
    for (int i = 0; i < 12; ++i) vectors.insert(vectors.end(), {5 * i, 5 * i + 1, -7 * i - 5});
    const auto reader = openVectors(imageText({.points = dataArray("Int32", "V", vectors, 3)}));
    const auto lengths = valuesOf<double>(*reader, "V magnitude");
    for (std::size_t i = 0; i < 12; ++i) {
        double squares = 0;
        for (std::size_t c = 0; c < 3; ++c) squares += vectors[3 * i + c] * vectors[3 * i + c];
        EXPECT_EQ(lengths[i], std::sqrt(squares)) << i;
    }
}

}  // namespace
}  // namespace timeseries
