// Grids whose parts are files of their own, against the same grids in one file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkRectilinearGrid.h>
#include <vtkStructuredGrid.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLRectilinearGridWriter.h>
#include <vtkXMLStructuredGridWriter.h>

#include <cmath>
#include <map>

#include "tests/support/array_builder.h"
#include "tests/support/unstructured.h"
#include "tests/support/vtk_files.h"

namespace timeseries {
namespace {

using namespace tests;
using testing::ElementsAre;
using testing::HasSubstr;

// Of each point of the file, its values by where it lies; missing ones left out.
std::map<std::array<double, 3>, double> byPlace(const std::filesystem::path& path,
                                                const std::string& name) {
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
double valueAt(int i, int j, int k) { return 100 * i + 10 * j + k; }

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

vtkSmartPointer<vtkDataSet> gridOf(const std::string& type, std::array<int, 6> extent) {
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

void writeGrid(const std::filesystem::path& path, const std::string& type,
               std::array<int, 6> extent) {
    const auto grid = gridOf(type, extent);
    if (type == "ImageData")
        writeWith<vtkXMLImageDataWriter>(path, grid);
    else if (type == "RectilinearGrid")
        writeWith<vtkXMLRectilinearGridWriter>(path, grid);
    else
        writeWith<vtkXMLStructuredGridWriter>(path, grid);
}

// The file that names the parts.
std::string listOf(const std::string& type, const std::string& attributes,
                   const std::vector<std::string>& pieces) {
    std::string text =
        fmt::format("<VTKFile type=\"P{0}\" version=\"0.1\"><P{0} {1}>", type, attributes);
    for (const std::string& piece : pieces) text += "<Piece " + piece + "/>";
    return text + fmt::format("</P{}></VTKFile>", type);
}

const std::string kWhole = "WholeExtent=\"0 4 0 3 0 2\" GhostLevel=\"0\"";

TEST(VtkParts, OfStructuredGridsAreTheWhole) {
    const auto folder = freshFolder();
    for (const std::string type : {"ImageData", "RectilinearGrid", "StructuredGrid"}) {
        // Four that share layers of points, and one of a process that had nothing.
        const std::vector<std::array<int, 6>> extents{
            {0, 2, 0, 3, 0, 1}, {2, 4, 0, 3, 0, 1}, {0, 4, 0, 2, 1, 2}, {0, 4, 2, 3, 1, 2}};
        std::vector<std::string> pieces;
        for (std::size_t i = 0; i < extents.size(); ++i) {
            const std::string name = fmt::format("{} {}.vt", type, i);
            writeGrid(folder / name, type, extents[i]);
            pieces.push_back(fmt::format("Source=\"{}\"", name));
        }
        writeBytes(folder / "parts.pvt", listOf(type, kWhole, pieces));
        writeGrid(folder / "whole.vt", type, {0, 4, 0, 3, 0, 2});
        for (const std::string name : {"p", "c"}) {
            const auto whole = byPlace(folder / "whole.vt", name);
            EXPECT_EQ(whole.size(), name == "p" ? 60u : 24u);
            EXPECT_EQ(byPlace(folder / "parts.pvt", name), whole) << type << ' ' << name;
        }
        EXPECT_THAT(open(folder / "parts.pvt")->format(), HasSubstr("(XML), 4 parts"));
        EXPECT_EQ(open(folder / "parts.pvt")->variables()[0].grid->axes(),
                  open(folder / "whole.vt")->variables()[0].grid->axes())
            << type;
        // One is not enough, and what reaches beyond the whole is none of its parts.
        writeBytes(folder / "parts.pvt", listOf(type, kWhole, {pieces[0], pieces[1]}));
        EXPECT_THAT(refusal(folder / "parts.pvt"),
                    HasSubstr("expected pieces that fill WholeExtent, found"));
        writeBytes(folder / "parts.pvt",
                   listOf(type, "WholeExtent=\"0 3 0 3 0 2\"", {pieces[0], pieces[1]}));
        EXPECT_THROW(open(folder / "parts.pvt"), FileError);
    }
}

// A part of unit cubes from these on along x, at each point and cell its place's number.
std::string cubes(int from, int count, const std::string& ghostCells) {
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

const std::string kNothing =
    "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">"
    "<UnstructuredGrid><Piece NumberOfPoints=\"0\" NumberOfCells=\"0\"/></UnstructuredGrid>"
    "</VTKFile>";

TEST(VtkParts, OfUnstructuredGridsStandBehindEachOther) {
    const auto folder = freshFolder();
    writeBytes(folder / "a.vtu", cubes(0, 2, ""));
    writeBytes(folder / "b.vtu", kNothing);
    writeBytes(folder / "c.vtu", cubes(2, 3, ""));
    writeBytes(folder / "whole.vtu", cubes(0, 5, ""));
    const auto path = folder / "parts.pvtu";
    writeBytes(path, listOf("UnstructuredGrid", "GhostLevel=\"0\"",
                            {"Source=\"a.vtu\"", "Source=\"b.vtu\"", "Source=\"c.vtu\""}));
    for (const std::string name : {"p", "c"})
        EXPECT_EQ(byPlace(path, name), byPlace(folder / "whole.vtu", name)) << name;
    const auto reader = open(path);
    EXPECT_EQ(reader->format(), "VTK unstructured grid (XML), 2 parts");
    // The points between them are in both, each with the volume of its own part's cells.
    const Grid& atPoints = *reader->variables()[0].grid;
    EXPECT_EQ(atPoints.count(), 12u + 16u);
    double volume = 0;
    for (std::uint64_t i = 0; i < atPoints.count(); ++i)
        volume += tests::volume(*atPoints.mesh(), i);
    EXPECT_NEAR(volume, 5, 1e-6);
    // In a collection too.
    writeBytes(
        folder / "series.pvd",
        "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"1\" file=\"parts.pvtu\"/>"
        "<DataSet timestep=\"2\" file=\"parts.pvtu\"/></Collection></VTKFile>");
    const auto series = open(folder / "series.pvd");
    ASSERT_EQ(series->variables()[0].time->points.size(), 2u);
    EXPECT_EQ(std::get<std::vector<double>>(series->read(0, 1).values),
              std::get<std::vector<double>>(reader->read(0, 0).values));
}

// The list says where the whole lies; parts that lie otherwise than each other are none of one.
TEST(VtkParts, OfImagesLieWhereTheListSays) {
    const auto folder = freshFolder();
    const auto part = [](const std::string& extent, const std::string& origin) {
        return imageText({.extent = extent,
                          .attributes = "Origin=\"" + origin + "\" Spacing=\"1 1 1\"",
                          .points = dataArray("Float64", "p", std::vector<double>(8, 1.5))});
    };
    writeBytes(folder / "a.vti", part("0 1 0 1 0 1", "0 0 0"));
    writeBytes(folder / "b.vti", part("1 2 0 1 0 1", "0 0 0"));
    const std::vector<std::string> pieces{"Source=\"a.vti\"", "Source=\"b.vti\""};
    const std::string extent = "WholeExtent=\"0 2 0 1 0 1\"";
    writeBytes(folder / "p.pvti",
               listOf("ImageData", extent + " Origin=\"7 8 9\" Spacing=\"3 1 1\"", pieces));
    const auto reader = open(folder / "p.pvti");
    EXPECT_EQ(reader->variables()[0].grid->axes()[0].coordinates, (std::vector<double>{7, 10, 13}));
    EXPECT_EQ(reader->variables()[0].grid->axes()[2].coordinates, (std::vector<double>{9, 10}));
    writeBytes(folder / "b.vti", part("1 2 0 1 0 1", "500 0 0"));
    EXPECT_THROW(open(folder / "p.pvti"), FileError);
}

TEST(VtkParts, GhostCellsAreMissing) {
    const auto folder = freshFolder();
    writeBytes(folder / "a.vtu", cubes(0, 3, "0 0 1"));
    writeBytes(folder / "c.vtu", cubes(2, 3, "0 0 0"));
    writeBytes(folder / "whole.vtu", cubes(0, 5, ""));
    writeBytes(folder / "parts.pvtu", listOf("UnstructuredGrid", "GhostLevel=\"1\"",
                                             {"Source=\"a.vtu\"", "Source=\"c.vtu\""}));
    EXPECT_EQ(byPlace(folder / "parts.pvtu", "c"), byPlace(folder / "whole.vtu", "c"));
}

TEST(VtkParts, WhatIsWrongIsNamed) {
    const auto folder = freshFolder();
    writeBytes(folder / "a.vtu", cubes(0, 2, ""));
    writeBytes(folder / "empty.vtu", kNothing);
    const auto told = [&](const std::vector<std::string>& pieces) -> std::string {
        writeBytes(folder / "parts.pvtu", listOf("UnstructuredGrid", "", pieces));
        try {
            const auto reader = open(folder / "parts.pvtu");
            reader->read(0, 0);
        } catch (const FileError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_THAT(told({}), HasSubstr("expected a Piece that holds points"));
    EXPECT_THAT(told({"Source=\"empty.vtu\""}), HasSubstr("expected a Piece that holds points"));
    EXPECT_THAT(told({"Extent=\"0 1 0 1 0 1\""}), HasSubstr("expected the name of a file"));
    EXPECT_THAT(told({"Source=\"a.vtu\"", "Source=\"a.vtu\""}), HasSubstr("found a.vtu again"));
    EXPECT_THAT(told({"Source=\"a.vtu\"", "Source=\"./a.vtu\""}), HasSubstr("found ./a.vtu again"));
    EXPECT_THAT(told({"Source=\"none.vtu\""}), HasSubstr("none.vtu: expected a file"));
    EXPECT_THAT(told({"Source=\"parts.pvtu\""}),
                HasSubstr("expected the type UnstructuredGrid, as a part of parts.pvtu"));
    std::string other = cubes(2, 3, "");
    other.replace(other.find("Name=\"p\""), 8, "Name=\"q\"");
    writeBytes(folder / "other.vtu", other);
    EXPECT_THAT(told({"Source=\"a.vtu\"", "Source=\"other.vtu\""}),
                HasSubstr("other.vtu: 'p': expected float64 of 1 components, as in a.vtu"));
}

}  // namespace
}  // namespace timeseries
