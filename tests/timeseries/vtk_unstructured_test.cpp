// Unstructured grids of VTK files: their pieces, their lists of cells, steps whose cells change.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "tests/support/read_variables.h"
#include "tests/support/unstructured.h"
#include "tests/support/vtk_files.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

using testing::HasSubstr;
using tests::dataArray;
using tests::open;
using tests::unstructuredText;
using Path = std::filesystem::path;

const std::string kTwelve =
    dataArray("Float64", "v", std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
const std::string kTwo = dataArray("Float32", "w", std::vector<double>{5, 6});

std::string refusal(const std::string& text) {
    try {
        const auto reader = open(tests::write("refused.vtu", text));
        reader->read(0, 0);
    } catch (const FileError& error) {
        return error.what();
    }
    return "";
}

double volume(const Grid& grid) { return tests::volume(*grid.mesh()); }

TEST(VtkUnstructured, PointsAndCellsHaveGridsOfTheirOwn) {
    const auto reader = open(tests::write("two.vtu", unstructuredText(kTwelve, kTwo)));
    EXPECT_EQ(reader->format(), "VTK unstructured grid (XML)");
    const auto variables = reader->variables();
    ASSERT_EQ(variables.size(), 2u);
    EXPECT_EQ(variables[0].grid->count(), 12u);
    EXPECT_EQ(variables[1].grid->count(), 2u);
    EXPECT_NEAR(volume(*variables[0].grid), 3, 1e-6);
    EXPECT_NEAR(volume(*variables[1].grid), 3, 1e-6);
    EXPECT_EQ(std::get<std::vector<float>>(reader->read(1, 0).values), (std::vector<float>{5, 6}));
}

// As VTK writes them since 9.4: each face once, in any order.
TEST(VtkUnstructured, FacesMayStandInTables) {
    const auto list = [](const char* name, const char* numbers, const char* type = "Int64") {
        return fmt::format("<DataArray type=\"{}\" Name=\"{}\" format=\"ascii\">{}</DataArray>\n",
                           type, name, numbers);
    };
    const std::string tables =
        list("connectivity", "0 1 4 3 6 7 10 9 1 2 4 5 7 8 10 11") + list("offsets", "8 16") +
        list("types", "12 42", "UInt8") +
        list("face_connectivity", "2 5 11 8 1 2 5 4 1 2 8 7 7 8 11 10 4 5 11 10 1 4 10 7") +
        list("face_offsets", "4 8 12 16 20 24") + list("polyhedron_to_faces", "1 3 2 4 5 0") +
        list("polyhedron_offsets", "0 6");
    const auto old = open(tests::write("old.vtu", unstructuredText(kTwelve, kTwo)));
    const auto now = open(tests::write("now.vtu", unstructuredText(kTwelve, kTwo, tables)));
    for (const std::size_t variable : {0u, 1u})
        EXPECT_EQ(*now->variables()[variable].grid->mesh(),
                  *old->variables()[variable].grid->mesh());
}

// One behind the other; a piece without anything is passed over.
TEST(VtkUnstructured, PiecesAreOneGrid) {
    std::string text = unstructuredText(kTwelve, kTwo);
    const std::size_t first = text.find("<Piece"), end = text.find("</Piece>") + 9;
    const std::string piece = text.substr(first, end - first);
    const std::string nothing =
        "<Piece NumberOfPoints=\"0\" NumberOfCells=\"0\"><PointData/><CellData/></Piece>\n";
    text.insert(end, piece);
    text.insert(first, nothing);
    const auto reader = open(tests::write("pieces.vtu", text));
    EXPECT_EQ(reader->variables()[0].grid->count(), 24u);
    ASSERT_EQ(reader->variables()[1].grid->count(), 4u);
    EXPECT_NEAR(volume(*reader->variables()[1].grid), 6, 1e-6);
    EXPECT_EQ(tests::nodesOf(*reader->variables()[1].grid->mesh()), 12u) << "where they meet";
    EXPECT_EQ(reader->variables()[1].grid->position(3), reader->variables()[1].grid->position(1));
    EXPECT_EQ(std::get<std::vector<float>>(reader->read(1, 0).values),
              (std::vector<float>{5, 6, 5, 6}));
}

TEST(VtkUnstructured, ListsThatNameWhatIsNotThereAreRefused) {
    const auto list = [](const char* name, const std::string& numbers, const char* type = "Int64") {
        return fmt::format("<DataArray type=\"{}\" Name=\"{}\" format=\"ascii\">{}</DataArray>\n",
                           type, name, numbers);
    };
    const auto lists = [&](const std::string& corners, const std::string& ends,
                           const std::string& types, const std::string& more = "") {
        const std::string all =
            list("connectivity", corners) + list("offsets", ends) + list("types", types) + more;
        const std::string why = refusal(unstructuredText(kTwelve, "", all));
        // Whose points are ghosts' is not asked before. All in the same lines.
        std::string ghosts = list("vtkGhostType", "1 0", "UInt8");
        ghosts.pop_back();
        EXPECT_EQ(refusal(unstructuredText(kTwelve, ghosts, all)), why);
        return why;
    };
    EXPECT_EQ(lists("0 1 3 6 1 2 4 7", "4 8", "10 10"), "");
    EXPECT_THAT(lists("0 1 3 6 1 2 4 12", "4 8", "10 10"), HasSubstr("cell 1 has point 12 of 12"));
    for (const char* other : {"-1", "-7", "4294967295", "99"})
        EXPECT_THAT(lists(fmt::format("0 1 3 6 1 2 4 {}", other), "4 8", "10 10"),
                    HasSubstr(fmt::format("cell 1 has point {} of 12", other)));
    EXPECT_THAT(lists("0 1 3 6 1 2 4 7", "4 9", "10 10"), HasSubstr("cell 1 ends at 9 of 8"));
    EXPECT_THAT(lists("0 1 3 6 1 2 4 7", "4 -8", "10 10"), HasSubstr("cell 1 ends at"));
    EXPECT_THAT(lists("0 1 3 6 1 2 4 7", "8 4", "10 10"), HasSubstr("cell 1 ends at 4 of 8"));
    EXPECT_THAT(lists("0 1 3 6 1 2 4 7", "3 8", "10 10"),
                HasSubstr("cell 0 of type 10 has 3 points, fewer than 4"));
    EXPECT_THAT(lists("0 1 3 6 1 2 4 7", "4 8", "10 42"),
                HasSubstr("cell 1 is a polyhedron without faces"));
    EXPECT_THAT(lists("0 1 3 6 1 2 4 7", "4", "10 10"), HasSubstr("expected 2 values, found 1"));
    EXPECT_THAT(
        lists("0 1 3 6 1 2 4 7", "4 8", "10 42",
              list("faces", "4 3 1 2 4 3 1 2 7 3 1 4 7 3 2 4 77") + list("faceoffsets", "-1 17")),
        HasSubstr("a face of cell 1 has point"));
    EXPECT_THAT(lists("0 1 3 6 1 2 4 7", "4 8", "10 42",
                      list("faces", "4 3 1 2 4") + list("faceoffsets", "-1 17")),
                HasSubstr("faces: cell 1 ends at 17 of 5"));
    EXPECT_THAT(lists("0 1 3 6 1 2 4 7", "4 8", "10 42", list("faces", "1 3 1 2 4")),
                HasSubstr("expected faceoffsets beside faces"));
    const auto tables = [&](const std::string& ends, const std::string& faces,
                            const std::string& more = "polyhedron_offsets") {
        return lists("0 1 3 6 1 2 4 7", "4 8", "10 42",
                     list("face_connectivity", "1 2 4 1 2 7 1 4 7 2 4 7") +
                         list("face_offsets", ends) + list("polyhedron_to_faces", faces) +
                         list(more.c_str(), "0 4"));
    };
    EXPECT_EQ(tables("3 6 9 12", "0 1 2 3"), "");
    for (const auto& [ends, faces] : {std::pair("3 6 9 12", "0 1 2 4"),
                                      {"3 6 9 12", "0 1 2 -1"},
                                      {"3 6 9 13", "0 1 2 3"},
                                      {"3 6 2 12", "0 1 2 3"},
                                      {"3 6 -9 12", "0 1 2 3"},
                                      {"12 12 12 12", "0 0 0 0"}})
        EXPECT_THAT(tables(ends, faces), HasSubstr("a face of cell 1 has point")) << ends << faces;
    EXPECT_THAT(tables("3 6 9 12", "0 1 2"), HasSubstr("the faces of cell 1"));
    EXPECT_THAT(tables("3 6 9 12", "0 1 2 3", "polyhedron_ends"),
                HasSubstr("expected face_offsets, polyhedron_to_faces and polyhedron_offsets"));
    EXPECT_THAT(lists("0 1 3 6 1 2 4 7", "4 8", "200 201"),
                HasSubstr("expected cells that take space"))
        << "of kinds that nobody knows";
    EXPECT_THAT(lists("0 1 3 6 1 2 4 7", "4 8", "266 266"),
                HasSubstr("expected cells that take space"))
        << "256 more than a tetrahedron's number";
    EXPECT_THAT(refusal(unstructuredText(kTwelve, "", list("connectivity", "0 1 3 6"))),
                HasSubstr("expected connectivity, offsets and types"));
    EXPECT_THAT(
        refusal(unstructuredText(kTwelve, "", list("connectivity", "0 1 3 6 1 2 4 7", "Float64"))),
        HasSubstr("expected a DataArray of whole numbers"));
}

// The grid once a piece, each so far behind the other; places and lists stand there as in memory.
constexpr double kApart = 32;
template <typename Place, typename Index>
std::string rawText(const UnstructuredGrid& grid, int pieces, const char* place,
                    const char* index) {
    std::string head, appended;
    const auto array = [&](const char* type, const char* name, int components, const auto& values) {
        head += fmt::format(
            "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" "
            "offset=\"{}\"/>\n",
            type, name, components, appended.size());
        appended += tests::appendedBlock(values);
    };
    std::vector<float> values(grid.types.size());
    std::iota(values.begin(), values.end(), 0.0f);
    for (int piece = 0; piece < pieces; ++piece) {
        head += fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<CellData>\n",
                            grid.points.size(), grid.types.size());
        array("Float32", "w", 1, values);
        head += "</CellData>\n<Points>\n";
        std::vector<Place> places;
        for (const glm::dvec3& at : grid.points)
            for (int c = 0; c < 3; ++c)
                places.push_back(static_cast<Place>(at[c] + (c == 0 ? kApart * piece : 0)));
        array(place, "p", 3, places);
        head += "</Points>\n<Cells>\n";
        array(index, "connectivity", 1,
              std::vector<Index>(grid.corners.begin(), grid.corners.end()));
        array(index, "offsets", 1, std::vector<Index>(grid.ends.begin(), grid.ends.end()));
        array("UInt8", "types", 1, std::vector<std::uint8_t>(grid.types.begin(), grid.types.end()));
        head += "</Cells>\n</Piece>\n";
    }
    return "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
           "<UnstructuredGrid>\n" +
           head + "</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_" + appended +
           "\n</AppendedData>\n</VTKFile>\n";
}

// More numbers than are read at once.
TEST(VtkUnstructured, WhatIsAppendedAsItIsInMemoryIsReadWhateverItsType) {
    const UnstructuredGrid grid =
        tests::bricks({21, 21, 21}, tests::Cut::Wedges, [](double i, double j, double k) {
            return glm::dvec3(i, j + i * i / 64, k + i * j / 128);
        });
    UnstructuredGrid twice = grid;
    const auto points = static_cast<std::uint32_t>(grid.points.size());
    for (const glm::dvec3& at : grid.points) twice.points.push_back(at + glm::dvec3(kApart, 0, 0));
    twice.types.insert(twice.types.end(), grid.types.begin(), grid.types.end());
    for (const std::uint32_t corner : grid.corners) twice.corners.push_back(corner + points);
    for (const std::uint64_t end : grid.ends) twice.ends.push_back(end + grid.corners.size());
    const auto expectTwice = [&](const std::string& text) {
        const auto reader = open(tests::write("raw.vtu", text));
        EXPECT_TRUE(*reader->variables()[0].grid->mesh() == tests::atCells(twice));
        const Field field = reader->read(0, 0);
        const auto& values = std::get<std::vector<float>>(field.values);
        ASSERT_EQ(values.size(), twice.types.size());
        for (std::size_t i = 0; i < values.size(); ++i)
            EXPECT_EQ(values[i], static_cast<float>(i % grid.types.size()));
    };
    expectTwice(rawText<float, std::int64_t>(grid, 2, "Float32", "Int64"));
    expectTwice(rawText<double, std::int32_t>(grid, 2, "Float64", "Int32"));
    expectTwice(rawText<double, std::uint64_t>(grid, 2, "Float64", "UInt64"));
    expectTwice(rawText<float, std::uint32_t>(grid, 2, "Float32", "UInt32"));
}

TEST(VtkUnstructured, WhatIsAppendedAndNamesWhatIsNotThereIsRefused) {
    const UnstructuredGrid good = tests::bentBricks(tests::Cut::Hexahedra);
    const auto refusalOf = [&](const auto& change) {
        UnstructuredGrid grid = good;
        change(grid);
        return refusal(rawText<double, std::int32_t>(grid, 2, "Float64", "Int32"));
    };
    EXPECT_EQ(refusalOf([](const auto&) {}), "");
    EXPECT_THAT(refusalOf([](auto& grid) { grid.corners[17] = 120; }),
                HasSubstr("cell 2 has point 120 of"))
        << "the first of the other piece";
    EXPECT_THAT(refusalOf([](auto& grid) { grid.corners[17] = kNoPoint; }),
                HasSubstr("cell 2 has point -1 of"));
    EXPECT_THAT(refusalOf([](auto& grid) { grid.ends[5] = 200; }),
                HasSubstr("cell 6 ends at 56 of 960"));
    EXPECT_THAT(refusalOf([](auto& grid) { grid.ends[59] = 999; }),
                HasSubstr("cell 59 ends at 999 of 960"));
    EXPECT_THAT(refusalOf([](auto& grid) { grid.types[0] = 16; }),
                HasSubstr("cell 0 of type 16 has 8 points"));
    EXPECT_THAT(refusalOf([](auto& grid) { grid.types[0] = kPolyhedron; }),
                HasSubstr("cell 0 is a polyhedron without faces"));
}

TEST(VtkUnstructured, CellsMayComeAndGoFromStepToStep) {
    const Path folder = tests::freshFolder();
    tests::writeBytes(folder / "a.vtu", unstructuredText(kTwelve, kTwo));
    std::string second = unstructuredText("", dataArray("Float32", "w", std::vector<double>{7}),
                                          "<DataArray type=\"Int32\" Name=\"connectivity\" "
                                          "format=\"ascii\">0 1 3 6</DataArray>\n"
                                          "<DataArray type=\"Int32\" Name=\"offsets\" "
                                          "format=\"ascii\">4</DataArray>\n"
                                          "<DataArray type=\"UInt8\" Name=\"types\" "
                                          "format=\"ascii\">10</DataArray>\n");
    second.replace(second.find("NumberOfCells=\"2\""), 17, "NumberOfCells=\"1\"");
    tests::writeBytes(folder / "b.vtu", second);
    tests::writeBytes(folder / "both.pvd",
                      "<VTKFile type=\"Collection\"><Collection>"
                      "<DataSet timestep=\"0.5\" file=\"a.vtu\"/>"
                      "<DataSet timestep=\"2\" file=\"b.vtu\"/></Collection></VTKFile>");
    const auto reader = open(folder / "both.pvd");
    const auto variables = reader->variables();
    const std::size_t w = variables[0].name == "w" ? 0 : 1;
    ASSERT_EQ(variables[w].time->points.size(), 2u);
    const Field one = reader->read(w, 0), two = reader->read(w, 1), again = reader->read(w, 0);
    EXPECT_EQ(one.grid->count(), 2u);
    EXPECT_EQ(two.grid->count(), 1u);
    EXPECT_TRUE(two.grid->ofOneStep());
    EXPECT_EQ(two.grid->axes()[0].coordinates, one.grid->axes()[0].coordinates) << "all in one box";
    EXPECT_EQ(*again.grid, *one.grid);
}

}  // namespace
}  // namespace timeseries
