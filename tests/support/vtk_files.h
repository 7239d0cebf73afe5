// Small VTK files for tests, written by hand.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/files.h"

namespace tests {

// The values' bytes, in this machine's order.
template <typename T>
std::string rawBytes(const std::vector<T>& values) {
    std::string bytes(values.size() * sizeof(T), '\0');
    if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

template <typename T>
std::string bigEndianBytes(const std::vector<T>& values) {
    std::string bytes;
    for (const T& value : values) {
        std::string one = rawBytes(std::vector<T>{value});
        std::ranges::reverse(one);
        bytes += one;
    }
    return bytes;
}

// A block of appended raw values: its length, then the values.
template <typename T>
std::string appendedBlock(const std::vector<T>& values) {
    return rawBytes(
               std::vector<std::uint32_t>{static_cast<std::uint32_t>(values.size() * sizeof(T))}) +
           rawBytes(values);
}

template <typename T>
std::string dataArray(const std::string& type, const std::string& name,
                      const std::vector<T>& values, std::size_t components = 1) {
    std::string text = fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n", type,
        name, components);
    for (const T& value : values) {
        if constexpr (std::is_arithmetic_v<T>)
            text += fmt::format("{} ", +value);
        else
            text += value + " ";
    }
    return text + "\n</DataArray>\n";
}

struct Image {
    std::string extent = "0 2 0 1 0 1";
    std::string attributes = "Origin=\"10 20 30\" Spacing=\"1 2 3\"";
    std::string points = {}, cells = {}, field = {}, appended = {};
};

inline std::string imageText(const Image& image) {
    return fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"0.1\" "
        "byte_order=\"LittleEndian\">\n<ImageData WholeExtent=\"{0}\" {1}>\n{2}"
        "<Piece Extent=\"{0}\">\n<PointData>\n{3}</PointData>\n<CellData>\n{4}</CellData>\n"
        "</Piece>\n</ImageData>\n{5}</VTKFile>\n",
        image.extent, image.attributes,
        image.field.empty() ? "" : "<FieldData>\n" + image.field + "</FieldData>\n", image.points,
        image.cells,
        image.appended.empty()
            ? ""
            : "<AppendedData encoding=\"raw\">\n_" + image.appended + "\n</AppendedData>\n");
}

// Of 3 x 2 x 2 points, each a little beside its index.
inline std::vector<double> placesOfTwelve() {
    std::vector<double> places;
    for (int n = 0; n < 12; ++n)
        for (const double c : {n % 3 + 0.25 * (n / 3 % 2), n / 3 % 2 + 0.5, 1.5 * (n / 6)})
            places.push_back(c);
    return places;
}

// Of an image only its arrays and its extent.
inline std::string structuredText(const Image& image,
                                  const std::string& places = "<Points>\n" +
                                                              dataArray("Float64", "p",
                                                                        placesOfTwelve(), 3) +
                                                              "</Points>\n") {
    return fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"StructuredGrid\" version=\"0.1\" "
        "byte_order=\"LittleEndian\">\n<StructuredGrid WholeExtent=\"{0}\">\n"
        "<Piece Extent=\"{0}\">\n<PointData>\n{1}</PointData>\n<CellData>\n{2}</CellData>\n{3}"
        "</Piece>\n</StructuredGrid>\n</VTKFile>\n",
        image.extent, image.points, image.cells, places);
}

// Two unit cubes beside each other, one a hexahedron, one a polyhedron, of 12 points.
inline std::string unstructuredText(const std::string& points, const std::string& cells,
                                    const std::string& lists = "") {
    const auto list = [](const char* name, const std::string& numbers) {
        return fmt::format(
            "<DataArray type=\"Int64\" Name=\"{}\" format=\"ascii\">{}</DataArray>\n", name,
            numbers);
    };
    std::string usual =
        list("connectivity", "0 1 4 3 6 7 10 9 1 2 4 5 7 8 10 11") + list("offsets", "8 16") +
        list("types", "12 42") +
        list("faces", "6 4 1 2 5 4 4 7 8 11 10 4 1 2 8 7 4 4 5 11 10 4 1 4 10 7 4 2 5 11 8") +
        list("faceoffsets", "-1 31");
    return fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
        "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n"
        "<Piece NumberOfPoints=\"12\" NumberOfCells=\"2\">\n<PointData>\n{}</PointData>\n"
        "<CellData>\n{}</CellData>\n<Points>\n{}</Points>\n<Cells>\n{}</Cells>\n"
        "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n",
        points, cells, dataArray("Float64", "p", placesOfTwelve(), 3),
        lists.empty() ? usual : lists);
}

inline std::filesystem::path write(const std::string& name, const std::string& bytes) {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string flatName = std::string(test->test_suite_name()) + "_" + test->name() + "_" + name;
    std::ranges::replace(flatName, '/', '_');  // of typed tests
    const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / flatName;
    tests::writeBytes(path, bytes);
    return path;
}

}  // namespace tests
