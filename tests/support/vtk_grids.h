// Small grids of every kind, as VTK's own writers write them, and parts of one of unit cubes.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkRectilinearGrid.h>
#include <vtkSmartPointer.h>
#include <vtkStructuredGrid.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLRectilinearGridWriter.h>
#include <vtkXMLStructuredGridWriter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/support/array_builder.h"
#include "tests/support/vtk_files.h"

namespace tests {

// Of each point of the file, its values by where it lies; missing ones left out.
inline std::map<std::array<double, 3>, double> byPlace(const std::filesystem::path& path,
                                                       const std::string& name) {
    using namespace timeseries;
    const auto reader = open(path);
    const auto variables = reader->variables();
    const auto found = std::ranges::find(variables, name, &Variable::name);
    EXPECT_NE(found, variables.end()) << name;
    const Field field = reader->read(static_cast<std::size_t>(found - variables.begin()), 0);
    std::map<std::array<double, 3>, double> values;
    const auto& held = std::get<std::vector<double>>(field.values);
    for (std::size_t i = 0; i < held.size(); ++i) {
        if (!field.missing.empty() && field.missing[i]) continue;
        const glm::dvec3 at = field.grid->position(i);
        values[{std::round(at.x * 1e4), std::round(at.y * 1e4), std::round(at.z * 1e4)}] = held[i];
    }
    return values;
}

// f of the point or cell of these indices.
inline double valueAt(int i, int j, int k) { return 100 * i + 10 * j + k; }

// A grid of 5 x 4 x 3 points with values at points and cells.
template <typename Grid>
void addValues(Grid& grid) {
    int e[6];
    grid.GetExtent(e);
    for (const bool cells : {false, true}) {
        const vtkNew<vtkDoubleArray> array;
        array->SetName(cells ? "c" : "p");
        for (int k = e[4]; k <= e[5] - cells; ++k)
            for (int j = e[2]; j <= e[3] - cells; ++j)
                for (int i = e[0]; i <= e[1] - cells; ++i) array->InsertNextValue(valueAt(i, j, k));
        cells ? grid.GetCellData()->AddArray(array) : grid.GetPointData()->AddArray(array);
    }
}

inline vtkSmartPointer<vtkDataSet> gridOf(const std::string& type, std::array<int, 6> extent) {
    const auto along = [](int from, int to, double step) {
        const auto array = vtkSmartPointer<vtkDoubleArray>::New();
        for (int i = from; i <= to; ++i) array->InsertNextValue(step * i + 0.1 * i * i);
        return array;
    };
    if (type == "ImageData") {
        const auto grid = vtkSmartPointer<vtkImageData>::New();
        grid->SetExtent(extent.data());
        grid->SetOrigin(1, 2, 3);
        grid->SetSpacing(0.5, 1, 2);
        addValues(*grid);
        return grid;
    }
    if (type == "RectilinearGrid") {
        const auto grid = vtkSmartPointer<vtkRectilinearGrid>::New();
        grid->SetExtent(extent.data());
        grid->SetXCoordinates(along(extent[0], extent[1], 1));
        grid->SetYCoordinates(along(extent[2], extent[3], 2));
        grid->SetZCoordinates(along(extent[4], extent[5], 3));
        addValues(*grid);
        return grid;
    }
    const auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
    grid->SetExtent(extent.data());
    const vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (int k = extent[4]; k <= extent[5]; ++k)
        for (int j = extent[2]; j <= extent[3]; ++j)
            for (int i = extent[0]; i <= extent[1]; ++i)
                points->InsertNextPoint(i + 0.2 * j, j - 0.1 * k, k + 0.05 * i);
    grid->SetPoints(points);
    addValues(*grid);
    return grid;
}

template <typename Writer>
void writeWith(const std::filesystem::path& path, vtkDataSet* grid) {
    const vtkNew<Writer> writer;
    writer->SetFileName(path.c_str());
    writer->SetInputData(grid);
    ASSERT_EQ(writer->Write(), 1);
}

inline void writeGrid(const std::filesystem::path& path, const std::string& type,
                      std::array<int, 6> extent) {
    const auto grid = gridOf(type, extent);
    if (type == "ImageData")
        writeWith<vtkXMLImageDataWriter>(path, grid);
    else if (type == "RectilinearGrid")
        writeWith<vtkXMLRectilinearGridWriter>(path, grid);
    else
        writeWith<vtkXMLStructuredGridWriter>(path, grid);
}

// A part of unit cubes from these on along x, at each point and cell its place's number.
inline std::string cubes(int from, int count, const std::string& ghostCells) {
    std::vector<double> places, points, cells;
    std::string connectivity, offsets, types;
    for (int i = from; i <= from + count; ++i)
        for (int n = 0; n < 4; ++n) {
            for (const double c : {double(i), double(n & 1), double(n >> 1)}) places.push_back(c);
            points.push_back(valueAt(i, n & 1, n >> 1));
        }
    for (int i = 0; i < count; ++i) {
        for (const int n : {0, 4, 5, 1, 2, 6, 7, 3}) connectivity += fmt::format("{} ", 4 * i + n);
        offsets += fmt::format("{} ", 8 * (i + 1));
        types += "12 ";
        cells.push_back(from + i);
    }
    const auto list = [](const char* name, const std::string& numbers) {
        return fmt::format("<DataArray type=\"Int64\" Name=\"{}\" format=\"ascii\">{}</DataArray>",
                           name, numbers);
    };
    return fmt::format(
        "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">"
        "<UnstructuredGrid><Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\"><PointData>{}"
        "</PointData><CellData>{}{}</CellData><Points>{}</Points><Cells>{}</Cells></Piece>"
        "</UnstructuredGrid></VTKFile>",
        points.size(), count, dataArray("Float64", "p", points), dataArray("Float64", "c", cells),
        ghostCells.empty() ? ""
                           : "<DataArray type=\"UInt8\" Name=\"vtkGhostType\" format=\"ascii\">" +
                                 ghostCells + "</DataArray>",
        dataArray("Float64", "places", places, 3),
        list("connectivity", connectivity) + list("offsets", offsets) + list("types", types));
}

}  // namespace tests
