// VTK files that are cut or whose bytes are damaged: one sentence, in bounded time and memory.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "tests/support/vtk_refusals.h"

namespace timeseries {
namespace {

using namespace vtk_refusals;

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

}  // namespace
}  // namespace timeseries
