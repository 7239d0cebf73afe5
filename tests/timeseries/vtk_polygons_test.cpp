// Polygons of VTK files (.vtp, .pvtp, legacy): points, lines and surfaces, of several pieces,
// beside what VTK itself makes of them.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>
#include <vtkXMLPolyDataReader.h>

#include "tests/support/read_variables.h"
#include "tests/support/unstructured.h"
#include "tests/support/vtk_files.h"
#include "timeseries/grid/scattered.h"
#include "timeseries/readers/reader.h"

namespace timeseries::vtk_polygons {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using tests::dataArray;
using tests::open;
using tests::valuesOf;

struct Lists {
    std::string connectivity, offsets;
    int count = 0;
};

std::string list(const char* name, const Lists& of) {
    const auto array = [](const char* what, const std::string& numbers) {
        return fmt::format("<DataArray type=\"Int32\" Name=\"{}\" format=\"ascii\">{}</DataArray>",
                           what, numbers);
    };
    return fmt::format("<{}>{}{}</{}>\n", name, array("connectivity", of.connectivity),
                       array("offsets", of.offsets), name);
}

std::string piece(const std::vector<float>& places, const Lists& verts, const Lists& lines,
                  const Lists& polys, const std::string& pointData, const std::string& cellData) {
    std::string points;
    for (const float c : places) points += fmt::format("{} ", c);
    return fmt::format(
        "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" "
        "NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n<PointData>{}</PointData><CellData>{}"
        "</CellData><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" "
        "format=\"ascii\">{}</DataArray></Points>\n{}{}{}</Piece>\n",
        places.size() / 3, verts.count, lines.count, polys.count, pointData, cellData, points,
        list("Verts", verts), list("Lines", lines), list("Polys", polys));
}

std::string polygons(const std::string& pieces) {
    return "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\"><PolyData>\n" +
           pieces + "</PolyData></VTKFile>\n";
}

template <typename T>
std::string values(const char* name, const std::vector<T>& of) {
    return dataArray(std::is_same_v<T, float> ? "Float32" : "Float64", name, of);
}

// A square of two triangles and a line along its side, raised by z.
std::string sheet(float z, const std::vector<float>& cells) {
    return piece({0, 0, z, 2, 0, z, 2, 2, z, 0, 2, z}, {"3", "1", 1}, {"0 1", "2", 1},
                 {"0 1 2 0 2 3", "3 6", 2}, values("p", std::vector<float>{z, z + 1, z + 2, z + 3}),
                 values("c", cells));
}

TEST(VtkPolygons, CellsAreInTheOrderOfTheirValues) {
    const auto path = tests::write(
        "sheets.vtp", polygons(sheet(0, {1, 2, 3, 4}) + "<Piece NumberOfPoints=\"0\"/>\n" +
                               sheet(5, {11, 12, 13, 14})));
    const auto reader = open(path);
    EXPECT_EQ(reader->format(), "VTK polygons (XML)");
    EXPECT_THAT(valuesOf<float>(*reader, "p"), ElementsAre(0, 1, 2, 3, 5, 6, 7, 8));
    const Field cells = reader->read(tests::indexOf(*reader, "c"), 0);
    const vtkNew<vtkXMLPolyDataReader> oracle;
    oracle->SetFileName(path.c_str());
    oracle->Update();
    vtkPolyData* const theirs = oracle->GetOutput();
    ASSERT_EQ(theirs->GetNumberOfCells(), 8);
    ASSERT_EQ(cells.grid->count(), 8u);
    const auto& ours = std::get<std::vector<float>>(cells.values);
    for (vtkIdType i = 0; i < 8; ++i) {
        const auto at = static_cast<std::uint64_t>(i);
        EXPECT_EQ(ours[at], theirs->GetCellData()->GetArray("c")->GetComponent(i, 0)) << i;
        double box[6];
        theirs->GetCell(i)->GetBounds(box);
        EXPECT_GE(cells.grid->position(at).x, box[0] - 1e-5) << i;
        EXPECT_LE(cells.grid->position(at).x, box[1] + 1e-5) << i;
        EXPECT_NEAR(cells.grid->position(at).z, box[4], 1e-5) << i;
        // Beside surfaces only these take space.
        EXPECT_EQ(tests::volume(*cells.grid->mesh(), at) > 0,
                  theirs->GetCell(i)->GetCellDimension() == 2)
            << i;
    }
}

TEST(VtkPolygons, PointsAloneAreScattered) {
    std::vector<float> places;
    std::vector<double> numbers;
    std::vector<glm::dvec3> at;
    std::string ids, ends;
    for (int i = 0; i < 60; ++i) {
        at.emplace_back(i % 4, i / 4 % 5, i / 20 * 2);
        for (int c = 0; c < 3; ++c) places.push_back(static_cast<float>(at.back()[c]));
        numbers.push_back(i);
        ids += fmt::format("{} ", i);
        ends += fmt::format("{} ", i + 1);
    }
    const auto reader = open(tests::write(
        "points.vtp", polygons(piece(places, {ids, ends, 60}, {}, {}, values("v", numbers), ""))));
    EXPECT_EQ(valuesOf<double>(*reader, "v"), numbers);
    EXPECT_EQ(*reader->variables()[0].grid->mesh(), meshOfScattered(at));
}

// As VTK writes what it reads.
std::string legacyOf(const std::filesystem::path& path, bool binary, int version) {
    const vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(path.c_str());
    const vtkNew<vtkPolyDataWriter> writer;
    writer->SetInputConnection(reader->GetOutputPort());
    binary ? writer->SetFileTypeToBinary() : writer->SetFileTypeToASCII();
    writer->SetFileVersion(version);
    writer->WriteToOutputStringOn();
    writer->Write();
    return writer->GetOutputStdString();
}

TEST(VtkPolygons, OfALegacyFileAreThoseOfXml) {
    const auto path =
        tests::write("sheets.vtp", polygons(sheet(0, {1, 2, 3, 4}) + sheet(5, {11, 12, 13, 14})));
    const auto expected = open(path);
    for (const bool binary : {false, true})
        for (const int version : {42, 51}) {
            const auto reader = open(tests::write("sheets.vtk", legacyOf(path, binary, version)));
            EXPECT_EQ(reader->format(), "VTK polygons (legacy)");
            for (const std::string name : {"p", "c"}) {
                EXPECT_EQ(valuesOf<float>(*reader, name), valuesOf<float>(*expected, name));
                EXPECT_EQ(*reader->variables()[tests::indexOf(*reader, name)].grid,
                          *expected->variables()[tests::indexOf(*expected, name)].grid)
                    << name << ' ' << binary << ' ' << version;
            }
        }
    // In any order, and points without any.
    const std::string points = "POINTS 3 float\n0 0 0 1 0 0 0 1 0\n",
                      start = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\n",
                      cells = "CELL_DATA 3\nSCALARS c float\nLOOKUP_TABLE default\n7 8 9\n";
    const auto mixed =
        open(tests::write("mixed.vtk", start + "POLYGONS 1 4\n3 0 1 2\n" + points +
                                           "LINES 1 3\n2 0 1\nVERTICES 1 2\n1 2\n" + cells));
    const Field field = mixed->read(0, 0);
    EXPECT_THAT(std::get<std::vector<float>>(field.values), ElementsAre(7, 8, 9));
    EXPECT_NEAR(field.grid->position(2).x, 1.0 / 3, 1e-6);
    const auto alone = open(tests::write(
        "alone.vtk", start + points + "POINT_DATA 3\nSCALARS p float\nLOOKUP_TABLE d\n1 2 3\n"));
    EXPECT_THAT(valuesOf<float>(*alone, "p"), ElementsAre(1, 2, 3));
}

TEST(VtkPolygons, OfPartsStandBehindEachOther) {
    const std::string list =
        "<VTKFile type=\"PPolyData\" version=\"0.1\"><PPolyData GhostLevel=\"0\">"
        "<Piece Source=\"a.vtp\"/><Piece Source=\"none.vtp\"/><Piece Source=\"b.vtp\"/>"
        "</PPolyData></VTKFile>";
    const auto folder = tests::freshFolder();
    tests::writeBytes(folder / "a.vtp", polygons(sheet(0, {1, 2, 3, 4})));
    tests::writeBytes(folder / "none.vtp", polygons("<Piece NumberOfPoints=\"0\"/>\n"));
    tests::writeBytes(folder / "b.vtp", polygons(sheet(5, {11, 12, 13, 14})));
    tests::writeBytes(folder / "parts.pvtp", list);
    const auto reader = open(folder / "parts.pvtp");
    EXPECT_EQ(reader->format(), "VTK polygons (XML), 2 parts");
    EXPECT_THAT(valuesOf<float>(*reader, "p"), ElementsAre(0, 1, 2, 3, 5, 6, 7, 8));
    EXPECT_THAT(valuesOf<float>(*reader, "c"), ElementsAre(1, 2, 3, 4, 11, 12, 13, 14));
    const Grid& cells = *reader->variables()[tests::indexOf(*reader, "c")].grid;
    EXPECT_NEAR(cells.position(7).z, 5, 1e-5);  // a surface of the second part
    EXPECT_NEAR(cells.position(2).z, 0, 1e-5);
}

// Of a file that says `to` where it said `from`; "" where it is read.
std::string refusalOf(const char* name, std::string text, const std::string& from,
                      const std::string& to) {
    const auto at = text.find(from);
    EXPECT_NE(at, text.npos) << from;
    text.replace(at, from.size(), to);
    try {
        const auto reader = open(tests::write(name, text));
        reader->read(0, 0);
    } catch (const FileError& error) {
        return error.what();
    }
    return "";
}

TEST(VtkPolygons, OfALegacyFileWhatIsNotThereIsTold) {
    const std::string good =
        legacyOf(tests::write("sheet.vtp", polygons(sheet(0, {1, 2, 3, 4}))), false, 42);
    for (const auto& [from, to, told] : std::vector<std::array<std::string, 3>>{
             {"3 0 2 3", "3 0 2 3", ""},
             {"3 0 2 3", "3 0 2 4", "expected cells of points that there are"},
             {"3 0 2 3", "3 0 2 -1", "expected cells of points that there are"},
             {"3 0 2 3", "4 0 2 3", "but its list ends early"},
             {"POLYGONS 2 8", "POLYGONS 2 9", "expected "},
             {"POLYGONS 2 8", "POLYGONS 3 8", "but its list ends early"},
             {"POLYGONS", "TRIANGLE_STRIPS", "triangle strips, which are not read"},
             {"POLYGONS", "LINES", "expected lines once, found another"},
             {"POINTS 4", "POINTS 5", "expected "},
             {"CELL_DATA 4", "CELL_DATA 5", "expected 4 cells, found 5"},
             {"POLYGONS", "CELLS", "expected VERTICES, LINES or POLYGONS, found \"cells\""},
         })
        EXPECT_THAT(
            refusalOf("refused.vtk", good, from, to),
            told.empty() ? testing::Matcher<std::string>(testing::IsEmpty()) : HasSubstr(told))
            << from << " -> " << to;
}

TEST(VtkPolygons, WhatIsNotThereIsTold) {
    const auto refusal = [](const std::string& text, const std::string& from,
                            const std::string& to) {
        return refusalOf("refused.vtp", text, from, to);
    };
    const std::string good = polygons(sheet(0, {1, 2, 3, 4}));
    EXPECT_EQ(refusal(good, "0 1 2 0 2 3", "0 1 2 1 2 3"), "");
    for (const auto& [from, to, told] : std::vector<std::array<std::string, 3>>{
             {"0 1 2 0 2 3", "0 1 2 0 2 4", "expected cells of points that there are"},
             {"0 1 2 0 2 3", "0 1 2 0 2 -1", "expected cells of points that there are"},
             {"0 1 2 0 2 3", "0 1 2", "expected cells of points that there are"},
             {">3 6<", ">6 3<", "expected cells of points that there are"},
             {">3 6<", ">3<", "expected 2"},
             {"NumberOfStrips=\"0\"", "NumberOfStrips=\"1\"",
              "triangle strips, which are not read"},
             {"NumberOfPolys=\"2\"", "NumberOfPolys=\"3\"", "expected "},
             {"NumberOfPoints=\"4\"", "NumberOfPoints=\"0\"", "expected "},
             {"<Polys>", "<Polygons>", "expected "},
         })
        EXPECT_THAT(refusal(good, from, to), HasSubstr(told)) << from << " -> " << to;
}

}  // namespace
}  // namespace timeseries::vtk_polygons
