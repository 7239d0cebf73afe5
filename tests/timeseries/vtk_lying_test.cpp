// VTK files whose headers lie: one sentence, before memory is taken for what is not there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "tests/support/vtk_refusals.h"

namespace timeseries {
namespace {

using namespace vtk_refusals;

TEST(DamagedVtk, SizesTheFileCannotHoldAreRefusedBeforeAnythingIsAllocated) {
    const auto sized = [](const std::string& extent, const std::string& array) {
        return imageText({.extent = extent, .points = array});
    };
    const std::string appended =
        "<DataArray type=\"Float64\" Name=\"v\" format=\"appended\" offset=\"0\"/>";
    EXPECT_THAT(whyRefused(sized("0 999 0 999 0 999", dataArray("Float64", "v", twelve()))),
                HasSubstr("expected 1000000000 values, found 12"));
    EXPECT_THAT(whyRefused(sized("0 999 0 999 0 999", appended)),
                HasSubstr("expected appended values, but the file ends before"));
    EXPECT_THAT(whyRefused(sized("0 2147483647 0 1 0 1", appended)),
                HasSubstr("expected indices from -1073741824 to 1073741824 at most"));
    EXPECT_THAT(whyRefused(sized("0 99999 0 99999 0 99999", appended)),
                HasSubstr("expected at most 2^32 points"));
    EXPECT_THAT(whyRefused(sized("0 99999999999999999999 0 1 0 1", appended)),
                HasSubstr("expected 6 integers of 32 bits"));
    EXPECT_THAT(whyRefused(sized("5 2 0 1 0 1", appended)), HasSubstr("found the indices 5 to 2"));
    EXPECT_THAT(whyRefused(sized("0 1 0 1", appended)),
                HasSubstr("expected 6 integers of 32 bits"));
    const std::string start = "# vtk DataFile Version 4.2\nt\nBINARY\nDATASET STRUCTURED_POINTS\n";
    const std::string rest = "SCALARS v double 1\nLOOKUP_TABLE default\nabc";
    EXPECT_THAT(whyRefused(start + "DIMENSIONS 1000 1000 1000\nPOINT_DATA 1000000000\n" + rest),
                HasSubstr("expected 8000000000 bytes of values, but the file ends after 3"));
    EXPECT_THAT(whyRefused(start + "DIMENSIONS 100000 100000 100000\nPOINT_DATA 1\n" + rest),
                HasSubstr("expected at most 2^32 points"));
    EXPECT_THAT(whyRefused(start + "DIMENSIONS 0 1 1\nPOINT_DATA 1\n" + rest),
                HasSubstr("expected at least one point"));
    EXPECT_THAT(whyRefused(start + "DIMENSIONS -1 1 1\nPOINT_DATA 1\n" + rest),
                HasSubstr("a whole number, found \"-1\""));
    EXPECT_THAT(whyRefused(start + "DIMENSIONS 2 2 2\nPOINT_DATA 9\n" + rest),
                HasSubstr("expected 8 points, found 9"));
}

// RFC 4648, 4.
std::string base64Of(std::string_view bytes) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::string_view some = bytes.substr(i, 3);
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (k < some.size() ? static_cast<unsigned char>(some[k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += k > some.size() ? '=' : kDigits[group >> (18 - 6 * k) & 63];
    }
    return text;
}

// VTK takes what stands between for values.
TEST(DamagedVtk, Base64IsInOnePiece) {
    std::array<std::uint32_t, 13> stored{48};  // their bytes, and values
    for (std::uint32_t i = 1; i <= 12; ++i) stored[i] = 1000 * i;
    const std::string whole =
        base64Of(std::string_view(reinterpret_cast<const char*>(stored.data()), sizeof stored));
    const auto image = [](const std::string& text) {
        return tests::write("a.vti", imageText({.points = "<DataArray type=\"UInt32\" Name=\"p\" "
                                                          "format=\"binary\">" +
                                                          text + "</DataArray>\n"}));
    };
    for (const std::string around : {"", "\n    "}) {
        const auto reader = open(image(around + whole + around));
        const auto values = std::get<std::vector<std::uint32_t>>(reader->read(0, 0).values);
        EXPECT_TRUE(std::equal(values.begin(), values.end(), stored.begin() + 1, stored.end()));
    }
    for (const std::string between :
         {" ", "\n", "\r\n", "\t", "<!-- c -->", "=", "====", "-", "&#65;", "\n\n"})
        for (const std::size_t at : {8u, 11u, 40u}) {
            const bool isMarkup = between.find_first_of("<&") != between.npos;
            std::string broken = whole;
            broken.insert(at, between);
            EXPECT_THAT(refusalOfRead(image(broken)),
                        AllOf(HasSubstr("'p'"), HasSubstr(isMarkup ? "expected" : "in one piece")))
                << between << at;
        }
}

TEST(DamagedVtk, PlacesThatAreNotThereAreRefused) {
    using tests::structuredText;
    const std::string array = dataArray("Float64", "v", twelve());
    const auto with = [&](const std::string& places) {
        return whyRefused(structuredText({.points = array}, places));
    };
    EXPECT_THAT(with(""), HasSubstr("expected Points of one array"));
    EXPECT_THAT(with("<Points></Points>"), HasSubstr("expected Points of one array"));
    EXPECT_THAT(with("<Points>" + dataArray("Float64", "p", twelve(), 3) + "</Points>"),
                HasSubstr("expected 36 values, found 12"));
    EXPECT_THAT(
        with("<Points>" + dataArray("Float64", "p", tests::placesOfTwelve(), 2) + "</Points>"),
        HasSubstr("expected a DataArray of 3 components, x, y and z"));
    std::vector<std::string> words(36, "1");
    words[7] = "nan";
    EXPECT_THAT(with("<Points>" + dataArray("Float64", "p", words, 3) + "</Points>"),
                HasSubstr("expected finite numbers of its type, found \"nan\""));
    const std::string start = "# vtk DataFile Version 4.2\nt\nASCII\nDATASET STRUCTURED_GRID\n";
    const std::string rest = "\nPOINT_DATA 1\nSCALARS v double 1\nLOOKUP_TABLE default\n5\n";
    EXPECT_THAT(whyRefused(start + "DIMENSIONS 1 1 1" + rest), HasSubstr("expected POINTS"));
    EXPECT_THAT(whyRefused(start + "DIMENSIONS 1 1 1\nPOINTS 2 float\n1 2 3 4 5 6" + rest),
                HasSubstr("expected 1 points once, found 2"));
    EXPECT_THAT(
        whyRefused(start + "DIMENSIONS 1 1 1\nPOINTS 1 float\n1 2 3\nPOINTS 1 float\n1 2 3" + rest),
        HasSubstr("expected 1 points once"));
    EXPECT_THAT(whyRefused(start + "DIMENSIONS 1 1 1\nPOINTS 1 strange\n1 2 3" + rest),
                HasSubstr("expected a type of number, found \"strange\""));
    EXPECT_THAT(whyRefused(start + "DIMENSIONS 500 500 500\nPOINTS 125000000 double\n1 2 3" + rest),
                HasSubstr("expected 375000000 values"));
}

// Of one row along x, each [first, last], with an array at points or at cells.
std::string piecesText(const std::string& whole, const std::vector<std::array<int, 2>>& pieces,
                       bool cells) {
    const std::string group = cells ? "CellData" : "PointData";
    std::string text = "<VTKFile type=\"ImageData\"><ImageData WholeExtent=\"" + whole + "\">";
    for (const auto& [first, last] : pieces) {
        const auto count = static_cast<std::size_t>(std::max(last - first + (cells ? 0 : 1), 1));
        text += fmt::format("<Piece Extent=\"{} {} 0 0 0 0\"><{}>{}</{}></Piece>", first, last,
                            group, dataArray("Float64", "v", std::vector<double>(count, 5)), group);
    }
    return text + "</ImageData></VTKFile>";
}

TEST(DamagedVtk, PiecesThatLeaveSomethingOutAreRefused) {
    const std::string row = "0 9 0 0 0 0";
    EXPECT_THAT(whyRefused(piecesText(row, {{0, 2}, {6, 9}}, false)),
                HasSubstr("fill WholeExtent, found 7 of its 10 points"));
    EXPECT_THAT(whyRefused(piecesText(row, {{0, 2}}, false)),
                HasSubstr("found 3 of its 10 points"));
    // As many points as the whole, but some of them twice.
    EXPECT_THAT(whyRefused(piecesText(row, {{0, 5}, {2, 7}}, false)),
                HasSubstr("found 8 of its 10 points"));
    // Each point is there, the cell between the pieces is not.
    EXPECT_THAT(whyRefused(piecesText(row, {{0, 4}, {5, 9}}, true)),
                HasSubstr("found 8 of its 9 cells"));
    // A layer of points is no cell, also where it would lie beyond the last.
    EXPECT_THAT(whyRefused(piecesText("0 1 0 0 0 0", {{1, 1}, {1, 1}}, true)),
                HasSubstr("found 0 of its 1 cells"));
    EXPECT_EQ(whyRefused(piecesText(row, {{0, 4}, {5, 9}}, false)), "");
    EXPECT_EQ(whyRefused(piecesText(row, {{3, 9}, {0, 4}}, true)), "");
    EXPECT_THAT(whyRefused(piecesText("0 1023 0 1023 0 1023", {{0, 2}}, false)),
                HasSubstr("found 3 of its 1073741824 points"));
}

TEST(DamagedVtk, EmptyPiecesFillNothing) {
    EXPECT_THAT(whyRefused(piecesText("0 9 0 0 0 0", {{0, -1}, {0, 2}, {5, 4}}, false)),
                HasSubstr("fill WholeExtent, found 3 of its 10 points"));
    EXPECT_THAT(whyRefused(piecesText("0 9 0 0 0 0", {{0, -1}}, false)),
                HasSubstr("expected a Piece that holds points, found none"));
}

// VTK 9.1 crashes on the unknown ones, and makes as many strings as are declared.
TEST(DamagedVtk, FieldDataOfUnknownTypeOrSizeIsRefused) {
    const auto with = [](const std::string& array) {
        return imageText({.points = dataArray("Float64", "v", twelve()), .field = array});
    };
    for (const std::string type : {"Float", "float64", ""})
        EXPECT_THAT(whyRefused(with(dataArray(type, "TimeValue", std::vector{2.5}))),
                    HasSubstr("expected a type that VTK knows, found \"" + type + "\""));
    EXPECT_EQ(whyRefused(with("<Array type=\"String\" Name=\"s\" NumberOfTuples=\"1\" "
                              "format=\"ascii\">72 105 0</Array>")),
              "");
    EXPECT_THAT(whyRefused(with("<Array type=\"String\" Name=\"s\" NumberOfTuples=\"1000000000\" "
                                "format=\"ascii\">72 105 0</Array>")),
                HasSubstr("expected values within the file, found 1000000000"));
}

TEST(DamagedVtk, ArraysThatTheFileLacksAreToldOf) {
    const auto array = [](const std::string& attributes) {
        return imageText({.points = "<DataArray type=\"Float64\" Name=\"v\" " + attributes + "/>"});
    };
    EXPECT_THAT(whyRefused(array("format=\"ascii\"")), HasSubstr("expected 12 values, found 0"));
    EXPECT_THAT(whyRefused(array("format=\"binary\"")), HasSubstr("but the file ends"));
    EXPECT_THAT(whyRefused(array("format=\"appended\"")),
                HasSubstr("expected an offset, found \"\""));
    EXPECT_THAT(whyRefused(array("format=\"appended\" offset=\"-1\"")), HasSubstr("found \"-1\""));
    EXPECT_THAT(whyRefused(array("format=\"appended\" offset=\"0\"")),
                HasSubstr("expected appended values, but the file ends before"));
    EXPECT_THAT(whyRefused(array("format=\"hex\"")), HasSubstr("found \"hex\""));
    EXPECT_THAT(whyRefused(array("NumberOfComponents=\"nan\"")),
                HasSubstr("NumberOfComponents: expected a count"));
    EXPECT_THAT(whyRefused(array("NumberOfComponents=\"-3\"")), HasSubstr("expected a count"));

    const std::string start = "<VTKFile type=\"RectilinearGrid\"><RectilinearGrid WholeExtent=\"";
    const auto rectilinear = [&](const std::string& extent, const std::string& coordinates) {
        return start + extent + "\"><Piece Extent=\"" + extent + "\"><PointData>" +
               dataArray("Int8", "v", std::vector<int>{1, 2}) + "</PointData>" + coordinates +
               "</Piece></RectilinearGrid></VTKFile>";
    };
    const std::string two = dataArray("Float32", "", std::vector{0.f, 1.f}),
                      one = dataArray("Float32", "", std::vector{0.f});
    const std::string missing = "expected Coordinates of three arrays, x, y and z";
    EXPECT_EQ(whyRefused(
                  rectilinear("0 1 0 0 0 0", "<Coordinates>" + two + one + one + "</Coordinates>")),
              "");
    EXPECT_THAT(whyRefused(rectilinear("0 1 0 0 0 0", "")), HasSubstr(missing));
    EXPECT_THAT(whyRefused(rectilinear("0 1 0 0 0 0", "<Coordinates/>")), HasSubstr(missing));
    EXPECT_THAT(
        whyRefused(rectilinear("0 1 0 0 0 0", "<Coordinates>" + two + one + "</Coordinates>")),
        HasSubstr(missing));
    EXPECT_THAT(whyRefused(rectilinear("0 1 0 0 0 0",
                                       "<Coordinates>" + one + one + one + "</Coordinates>")),
                HasSubstr("expected 2 values, found 1"));
    EXPECT_THAT(whyRefused(start + "0 1 0 0 0 0\"/></VTKFile>"),
                HasSubstr("expected a Piece that holds points, found none"));
}

TEST(DamagedVtk, MoreArraysThanAnyUseNeedsAreRefused) {
    const std::string legacy =
        "# vtk DataFile Version 4.2\nt\nASCII\nDATASET STRUCTURED_POINTS\n"
        "DIMENSIONS 1 1 1\nPOINT_DATA 1\n";
    std::string field = "FIELD f 4097\n", elements, wide = "FIELD f 65\n";
    for (int i = 0; i < 4097; ++i) {
        field += fmt::format("a{} 1 1 char\n1\n", i);
        elements += dataArray("Int8", fmt::format("a{}", i), std::vector<int>{1});
    }
    std::string ones;
    for (int i = 0; i < 1024; ++i) ones += "1 ";
    for (int i = 0; i < 65; ++i) wide += fmt::format("w{} 1024 1 char\n{}\n", i, ones);
    const std::string why = "expected at most 4096 arrays, found ";
    EXPECT_THAT(whyRefused(legacy + field), HasSubstr(why));
    EXPECT_THAT(whyRefused(imageText({.extent = "0 0 0 0 0 0", .points = elements})),
                HasSubstr(why));
    EXPECT_THAT(whyRefused(imageText({.extent = "0 0 0 0 0 0",
                                      .points = dataArray("Int8", "v", std::vector<int>{1}),
                                      .field = elements})),
                HasSubstr(why));
    EXPECT_THAT(whyRefused(legacy + wide),
                HasSubstr("'w64': expected at most 65536 components of all arrays"));
}

TEST(DamagedVtk, CollectionsThatLieAreRefused) {
    const auto collection = [](const std::string& sets) {
        return "<VTKFile type=\"Collection\"><Collection>" + sets + "</Collection></VTKFile>";
    };
    EXPECT_THAT(whyRefused(collection("")), HasSubstr("expected a file, found none"));
    EXPECT_THAT(whyRefused(collection("<DataSet/>")), HasSubstr("expected the name of a file"));
    EXPECT_THAT(whyRefused(collection("<DataSet timestep=\"nan\" file=\"a.vti\"/>")),
                HasSubstr("timestep: expected a finite number"));
    EXPECT_THAT(whyRefused("<VTKFile type=\"Collection\"/>"), HasSubstr("expected one Collection"));
    // Of itself.
    const Path path = tests::write(
        "loop.pvd",
        collection("<DataSet file=\"DamagedVtk_CollectionsThatLieAreRefused_loop.pvd\"/>"));
    std::string why;
    EXPECT_FALSE(contents(path, &why));
    EXPECT_THAT(why, HasSubstr("expected the names of other files, but it names itself"));
}

TEST(DamagedVtk, ArraysThatAreNotThereAreToldOf) {
    EXPECT_THAT(whyRefused(imageText({})), HasSubstr("expected an array of numbers, found none"));
    EXPECT_THAT(whyRefused(imageText({.points = "<DataArray type=\"String\" Name=\"s\" "
                                                "format=\"ascii\">0</DataArray>"})),
                HasSubstr("found none; 's' has the type String"));
    const std::string v = dataArray("Float64", "v", twelve());
    EXPECT_THAT(whyRefused(imageText({.points = v + v})), HasSubstr("found 'v' again"));
    EXPECT_THAT(whyRefused(imageText({.points = dataArray("Float64", "v", twelve(), 0)})),
                HasSubstr("expected 1 to 1024 components, found 0"));
    EXPECT_THAT(whyRefused("<VTKFile type=\"Table\"><Table/></VTKFile>"),
                HasSubstr(" is a VTK file of type Table; isochron reads "));
    EXPECT_THAT(whyRefused("# vtk DataFile Version 3.0\nt\nASCII\nDATASET FIELD\n"),
                HasSubstr(" is a VTK file of type field; isochron reads "));
    EXPECT_THAT(whyRefused("# vtk DataFile Version 9.0\nt\nASCII\n"),
                HasSubstr("expected a version"));
}

}  // namespace
}  // namespace timeseries
