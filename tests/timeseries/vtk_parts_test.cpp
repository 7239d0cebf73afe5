// Grids whose parts are files of their own, against the same grids in one file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/array_builder.h"
#include "tests/support/unstructured.h"
#include "tests/support/vtk_files.h"
#include "tests/support/vtk_grids.h"

namespace timeseries {
namespace {

using namespace tests;
using testing::ElementsAre;
using testing::HasSubstr;

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
    // What is at points fills what the own cells do, once; the last four are of the ghost alone.
    const auto reader = open(folder / "parts.pvtu");
    const auto atCells = std::ranges::find(reader->variables(), "c", &Variable::name);
    ASSERT_NE(atCells, reader->variables().end());
    EXPECT_EQ(tests::nodesOf(*atCells->grid->mesh()), 6u * 4) << "where they meet";
    const auto found = std::ranges::find(reader->variables(), "p", &Variable::name);
    ASSERT_NE(found, reader->variables().end());
    const Mesh& mesh = *found->grid->mesh();
    double volume = 0;
    for (std::uint64_t i = 0; i < mesh.count(); ++i) volume += tests::volume(mesh, i);
    EXPECT_NEAR(volume, 5, 1e-6);
    EXPECT_EQ(mesh.count(), 16u + 16u);
    EXPECT_EQ(mesh.about().apart, 4u);
    EXPECT_EQ(mesh.solids()->count(), 5u);
}

// As VTK takes them, whichever part stands first.
TEST(VtkParts, ArraysAreThoseThatTheWholeDeclares) {
    const auto folder = freshFolder();
    std::string more = cubes(0, 1, "");
    more.insert(more.find("<CellData>") + 10, dataArray("Float64", "more", std::vector{7.0}));
    writeBytes(folder / "more.vtu", more);
    writeBytes(folder / "less.vtu", cubes(1, 1, ""));
    for (const auto& [first, second] : {std::pair("more", "less"), {"less", "more"}}) {
        writeBytes(folder / "parts.pvtu",
                   fmt::format("<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid>"
                               "<PCellData><PDataArray type=\"Float64\" Name=\"c\"/></PCellData>"
                               "<Piece Source=\"{}.vtu\"/><Piece Source=\"{}.vtu\"/>"
                               "</PUnstructuredGrid></VTKFile>",
                               first, second));
        const auto reader = open(folder / "parts.pvtu");
        ASSERT_EQ(reader->variables().size(), 1u) << first;
        EXPECT_EQ(reader->variables()[0].name, "c");
        EXPECT_EQ(reader->variables()[0].grid->count(), 2u);
    }
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
                HasSubstr("expected the names of other files, but it names itself"));
    std::string other = cubes(2, 3, "");
    other.replace(other.find("Name=\"p\""), 8, "Name=\"q\"");
    writeBytes(folder / "other.vtu", other);
    EXPECT_THAT(told({"Source=\"a.vtu\"", "Source=\"other.vtu\""}),
                HasSubstr("other.vtu: 'p': expected float64 of 1 components, as in a.vtu"));
}

}  // namespace
}  // namespace timeseries
