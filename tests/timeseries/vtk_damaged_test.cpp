// VTK files that are cut, damaged or lie about their size: one sentence, in bounded time and
// memory.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <random>

#include "tests/support/vtk_files.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using tests::dataArray;
using tests::Image;
using tests::imageText;
using Path = std::filesystem::path;

// Everything a file holds; nothing when it is refused, by one sentence.
std::optional<std::vector<Values>> contents(const Path& path, std::string* why = nullptr) {
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

std::string whyRefused(const std::string& text) {
    std::string why;
    contents(tests::write("refused", text), &why);
    return why;
}

std::vector<double> twelve() {
    std::vector<double> values(12);
    std::iota(values.begin(), values.end(), 0.25);
    return values;
}

std::map<std::string, std::string> samples() {
    const std::string appended =
        "<DataArray type=\"Float64\" Name=\"v\" format=\"appended\" offset=\"0\"/>";
    const std::string start =
        "DATASET STRUCTURED_POINTS\nDIMENSIONS 3 2 2\nSPACING 1 2 3\nORIGIN 10 20 30\n"
        "POINT_DATA 12\nSCALARS v double 1\nLOOKUP_TABLE default\n";
    std::string numbers;
    for (const double v : twelve()) numbers += fmt::format("{}\n", v);
    const std::string places = "DATASET STRUCTURED_GRID\nDIMENSIONS 3 2 2\nPOINTS 12 double\n";
    const std::string values = "POINT_DATA 12\nSCALARS v double 1\nLOOKUP_TABLE default\n";
    return {
        {"cells.vtu", tests::unstructuredText(dataArray("Float64", "v", twelve()), "")},
        {"text.vts", tests::structuredText({.points = dataArray("Float64", "v", twelve())})},
        {"places.vtk", "# vtk DataFile Version 4.2\ntitle\nBINARY\n" + places +
                           tests::bigEndianBytes(tests::placesOfTwelve()) + "\n" + values +
                           tests::bigEndianBytes(twelve()) + "\n"},
        {"cells.vtk",
         "# vtk DataFile Version 4.2\ntitle\nASCII\nDATASET UNSTRUCTURED_GRID\n"
         "POINTS 4 double\n0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 2 23\n4 0 1 2 3\n"
         "17 4 3 0 1 2 3 0 1 3 3 1 2 3 3 0 2 3\nCELL_TYPES 2\n10\n42\n"
         "CELL_DATA 2\nSCALARS v double 1\nLOOKUP_TABLE default\n0.25\n1.25\n"},
        {"ends.vtk",
         "# vtk DataFile Version 5.1\ntitle\nASCII\nDATASET UNSTRUCTURED_GRID\n"
         "POINTS 4 double\n0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 2 4\n"
         "OFFSETS vtktypeint64\n0 4\nCONNECTIVITY vtktypeint64\n0 1 2 3\n"
         "CELL_TYPES 1\n10\nCELL_DATA 1\nSCALARS v double 1\n"
         "LOOKUP_TABLE default\n0.25\n"},
        {"text.vti", imageText({.points = dataArray("Float64", "v", twelve())})},
        {"raw.vti", imageText({.points = appended, .appended = tests::appendedBlock(twelve())})},
        {"ascii.vtk", "# vtk DataFile Version 4.2\ntitle\nASCII\n" + start + numbers},
        {"binary.vtk", "# vtk DataFile Version 4.2\ntitle\nBINARY\n" + start +
                           tests::bigEndianBytes(twelve()) + "\n"},
    };
}

TEST(DamagedVtk, FilesCutAnywhereAreRefusedOrWhole) {
    for (const auto& [name, whole] : samples()) {
        const auto expected = contents(tests::write(name, whole));
        ASSERT_TRUE(expected) << name;
        const Path path = tests::write("cut", whole);
        std::size_t read = 0;
        for (std::size_t length = whole.size() - 1; length > 0; --length) {
            std::filesystem::resize_file(path, length);
            const auto found = contents(path);
            if (!found) continue;
            // The last digits of text may be lost unseen.
            if (name != "ascii.vtk" && name != "cells.vtk" && name != "ends.vtk") {
                EXPECT_EQ(*found, *expected) << name << " cut at " << length;
            }
            ++read;
        }
        // Of the closing tags and blanks after the last value.
        EXPECT_LE(read, 30u) << name;
    }
}

TEST(DamagedVtk, FilesWithWrongBytesAreReadOrRefused) {
    std::mt19937 random(7);
    for (const auto& [name, whole] : samples()) {
        for (int i = 0; i < 500; ++i) {
            std::string bytes = whole;
            for (int n = 0; n < 1 + i % 3; ++n) {
                const std::size_t at = 4 + random() % (bytes.size() - 4);
                bytes[at] = static_cast<char>(random() % 2 ? '0' + random() % 10 : random());
            }
            contents(tests::write("flipped", bytes));
        }
    }
}

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
                HasSubstr("expected at least one point along each axis"));
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

TEST(DamagedVtk, PackedBlocksThatLieAreRefused) {
    const auto packed = [](const std::vector<std::uint32_t>& header) {
        std::string text = imageText(
            {.points = "<DataArray type=\"Float64\" Name=\"v\" format=\"appended\" offset=\"0\"/>",
             .appended = tests::rawBytes(header) + std::string(40, 'x')});
        text.insert(text.find("byte_order="), "compressor=\"vtkZLibDataCompressor\" ");
        return text;
    };
    EXPECT_THAT(whyRefused(packed({0xFFFFFFFF, 8, 0, 4})), HasSubstr("blocks of 8 and 0"));
    EXPECT_THAT(whyRefused(packed({1, 96, 0, 0xFFFFFFF0})), HasSubstr("the file ends before"));
    EXPECT_THAT(whyRefused(packed({1, 96, 0, 0})), HasSubstr("which 0 bytes cannot hold"));
    EXPECT_THAT(whyRefused(packed({1, 100, 97, 9})), HasSubstr("expected 96 bytes of values"));
    EXPECT_THAT(whyRefused(packed({1, 96, 0, 30})), HasSubstr("'v'"));  // no zlib stream
}

TEST(DamagedVtk, HostileXmlIsRefused) {
    std::string laughs = "<!DOCTYPE V [<!ENTITY a \"ha\">";
    for (char c = 'b'; c < 'z'; ++c)
        laughs += fmt::format("<!ENTITY {} \"&{};&{};&{};&{};\">", c, char(c - 1), char(c - 1),
                              char(c - 1), char(c - 1));
    EXPECT_THAT(whyRefused("<?xml version=\"1.0\"?>" + laughs + "]><VTKFile type=\"&y;\"/>"),
                HasSubstr("expected no document type declaration"));
    std::string deep = "<VTKFile type=\"ImageData\">";
    for (int i = 0; i < 100000; ++i) deep += "<a>";
    EXPECT_THAT(whyRefused(deep), HasSubstr("nested elements"));
    // expat reads a tag or a comment again from its start with each piece of the file.
    const std::string longText(std::size_t{2} << 20, '1');
    EXPECT_THAT(whyRefused(imageText({.attributes = "Spacing=\"" + longText + "\""})),
                HasSubstr("expected at most 1 MiB in a tag or a comment"));
    EXPECT_THAT(whyRefused("<VTKFile><!--" + longText + "--></VTKFile>"),
                HasSubstr("expected at most 1 MiB in a tag or a comment"));
    const std::string shortText(std::size_t{1} << 19, ' ');
    EXPECT_EQ(whyRefused(imageText({.attributes = "Spacing=\"1 1 1" + shortText + "\"",
                                    .points = dataArray("Float64", "v", twelve())})),
              "");
    std::string many = "<VTKFile type=\"ImageData\">";
    for (int i = 0; i < 300000; ++i) many += "<a/>";
    EXPECT_THAT(whyRefused(many + "</VTKFile>"), HasSubstr("elements"));
    EXPECT_THAT(whyRefused("<VTKFile>"), HasSubstr("expected well-formed XML"));
    EXPECT_THAT(whyRefused("<VTKFile/>"), HasSubstr("expected the type ImageData"));
    EXPECT_THAT(whyRefused("<VTKFile type=\"ImageData\"/>"), HasSubstr("expected one ImageData"));
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

// VTK 9.1 looks for the two digits behind a '%' beyond the end of a short word.
TEST(DamagedVtk, PerCentSignsThatEndShortWordsAreRefused) {
    const std::string start =
        "# vtk DataFile Version 4.2\nt\nASCII\nDATASET STRUCTURED_POINTS\n"
        "DIMENSIONS 1 1 1\nPOINT_DATA 1\n";
    const auto string = [&](const std::string& text) {
        return whyRefused(start +
                          "SCALARS v char 1\nLOOKUP_TABLE default\n1\nFIELD f 1\ns 1 1 string\n" +
                          text + "\n");
    };
    const auto scalars = [&](const std::string& name, const std::string& more = "") {
        return whyRefused(start + "SCALARS " + name + " char 1\nLOOKUP_TABLE default\n1\n" + more);
    };
    EXPECT_EQ(string("%25"), "");
    EXPECT_EQ(string("nothing"), "");
    EXPECT_EQ(scalars("%25"), "");
    const std::string metadata = "METADATA\nINFORMATION 0\nCOMPONENT_NAMES\n";
    EXPECT_EQ(scalars("v", metadata + "%25\n\n"), "");
    for (const std::string wrong : {"%", "5%", "%5", "%%"}) {
        const auto told = HasSubstr("expected %25 for a per cent sign, found \"" + wrong + "\"");
        EXPECT_THAT(string(wrong), told);
        EXPECT_THAT(string(wrong + "\r"), told);
        EXPECT_THAT(scalars(wrong), told);
        EXPECT_THAT(scalars("v", metadata + wrong + "\n\n"), told);
        EXPECT_THAT(scalars("v", "FIELD f 1\n" + wrong + " 1 1 char\n1\n"), told);
    }
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
    EXPECT_THAT(why, HasSubstr("expected the type ImageData"));
}

TEST(DamagedVtk, NumbersThatAreNoneAreRefused) {
    const std::string points = dataArray("Float64", "v", twelve());
    for (const std::string wrong : {"nan 1 1", "1 inf 1", "1 1", "1 1 1 1", "1 1 x"}) {
        EXPECT_THAT(
            whyRefused(imageText({.attributes = "Spacing=\"" + wrong + "\"", .points = points})),
            HasSubstr("Spacing: expected 3 finite numbers"))
            << wrong;
        EXPECT_THAT(
            whyRefused(imageText({.attributes = "Origin=\"" + wrong + "\"", .points = points})),
            HasSubstr("Origin: expected 3 finite numbers"))
            << wrong;
        EXPECT_THAT(whyRefused("# vtk DataFile Version 4.2\nt\nASCII\nDATASET STRUCTURED_POINTS\n"
                               "DIMENSIONS 2 1 1\nSPACING " +
                               wrong + "\nPOINT_DATA 2\nSCALARS v int\nLOOKUP_TABLE d\n1 2\n"),
                    testing::AnyOf(HasSubstr("a finite number, found"), HasSubstr("found \"1\"")))
            << wrong;
    }
    EXPECT_THAT(whyRefused(imageText(
                    {.attributes = "Direction=\"1 0 0 0 nan 0 0 0 1\"", .points = points})),
                HasSubstr("Direction: expected 9 finite numbers"));
    for (const std::string wrong : {"0 nan 0 1 0 1", "0 2.5 0 1 0 1", "0 2 0 1 0 1 0"})
        EXPECT_THAT(whyRefused(imageText({.extent = wrong, .points = points})),
                    HasSubstr("WholeExtent: expected 6 integers of 32 bits"));
    // VTK takes a sign, too.
    EXPECT_EQ(
        whyRefused(imageText(
            {.extent = "+0 +2 0 1 0 1", .attributes = "Spacing=\"+1 1 1\"", .points = points})),
        "");
    EXPECT_EQ(whyRefused("# vtk DataFile Version 4.2\nt\nASCII\nDATASET STRUCTURED_POINTS\n"
                         "DIMENSIONS +2 1 1\nSPACING +1 1 1\nPOINT_DATA +2\nSCALARS v int\n"
                         "LOOKUP_TABLE d\n1 2\n"),
              "");
}

// VTK takes the lower bits of what is beyond a byte, and of what is below 0 for an unsigned type.
TEST(DamagedVtk, TextThatIsNoNumberOfItsTypeIsRefused) {
    struct Word {
        std::string xml, legacy, text;
        bool number;
    };
    const std::vector<Word> words{
        {"UInt8", "unsigned_char", "256", false},
        {"UInt8", "unsigned_char", "-1", false},
        {"UInt8", "unsigned_char", "255", true},
        {"Int8", "char", "128", false},
        {"Int8", "char", "-128", true},
        {"UInt32", "unsigned_int", "-1", false},
        {"UInt32", "unsigned_int", "4294967295", true},
        {"Int32", "int", "1.5", false},
        {"Int64", "vtktypeint64", "9223372036854775807", true},
        {"Int64", "vtktypeint64", "9223372036854775808", false},
        {"Float32", "float", "nan", false},
        {"Float32", "float", "1e39", false},
        {"Float32", "float", "3.4028235e+38", true},
        {"Float32", "float", "1e-50", true},
        {"Float64", "double", "+.5", true},
        {"Float64", "double", "1e-400", true},
        {"Float64", "double", "1..2", false},
    };
    for (const Word& word : words) {
        const auto accepted = [&](const std::string& why) {
            return word.number ? why.empty() : why.find("\"" + word.text + "\"") != why.npos;
        };
        EXPECT_PRED1(accepted, whyRefused(imageText({.extent = "0 1 0 0 0 0",
                                                     .points = dataArray<std::string>(
                                                         word.xml, "v", {"7", word.text})})))
            << word.xml << " " << word.text;
        EXPECT_PRED1(accepted,
                     whyRefused("# vtk DataFile Version 4.2\nt\nASCII\nDATASET STRUCTURED_POINTS\n"
                                "DIMENSIONS 2 1 1\nPOINT_DATA 2\nSCALARS v " +
                                word.legacy + "\nLOOKUP_TABLE d\n7 " + word.text + "\n"))
            << word.legacy << " " << word.text;
    }
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
