// NRRD files that are cut, damaged, hostile, or lie about their size: one sentence, in bounded time
// and memory.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <ctime>
#include <random>

#include "tests/support/array_builder.h"

namespace timeseries {
namespace {

using namespace tests;
using testing::HasSubstr;
using tests::freshFolder;
using tests::readBytes;
using tests::writeBytes;

class DamagedNrrd : public testing::Test {
 protected:
    // What the file of these bytes is refused with.
    std::string told(const std::string& bytes) {
        // Some file systems wait for the disk when a file is written over.
        std::filesystem::remove(folder / "file.nrrd");
        writeBytes(folder / "file.nrrd", bytes);
        return refusal(folder / "file.nrrd");
    }
    // With a header that is whole but for these lines, and 24 bytes.
    std::string toldOf(const std::string& lines) {
        std::string header = "endian: little\n";
        for (const char* line :
             {"type: uchar\n", "dimension: 3\n", "sizes: 2 3 4\n", "encoding: raw\n"}) {
            const std::string_view field(line, std::string_view(line).find(':') + 1);
            if (lines.find(field) == std::string::npos) header += line;
        }
        return told(nrrd(header + lines, std::string(24, '\1')));
    }
    std::filesystem::path folder = freshFolder();
};

std::string sample(const std::string& encoding) {
    const auto values = ramp<float>(2 * 3 * 4 * 2);
    std::string bytes = bytesOf(values);
    if (encoding == "gzip") bytes = byGzip(bytes);
    if (encoding == "ascii") {
        bytes.clear();
        for (const float value : values) bytes += fmt::format("{} ", value);
    }
    return nrrd(fmt::format("# comment\ntype: float\ndimension: 4\nspace: LPS\nsizes: 2 3 4 2\n"
                            "space directions: (1,0,0) (0,1,0) (0,0,1) none\n"
                            "kinds: space space space time\nlabels: \"a\" \"b\" \"c\" \"hour\"\n"
                            "endian: little\nencoding: {}\nspace origin: (0,0,1.5)\nhours:=1 4\n",
                            encoding),
                bytes);
}

TEST_F(DamagedNrrd, FilesCutAnywhereAreRefused) {
    for (const char* encoding : {"raw", "gzip", "ascii"}) {
        const std::string whole = sample(encoding);
        ASSERT_EQ(told(whole), "") << encoding;
        // Of a text, the last number's digits and the blank behind it: "47 " may end as "4".
        const std::size_t open = encoding == std::string("ascii") ? 2 : 0;
        for (std::size_t length = 0; length + open < whole.size(); ++length)
            EXPECT_NE(told(whole.substr(0, length)), "") << encoding << " cut at " << length;
    }
}

TEST_F(DamagedNrrd, LaterCompressedStreamsThatAreCutOrDamagedAreRefused) {
    const std::string header = "type: uchar\ndimension: 3\nsizes: 4 5 6\nencoding: ";
    const std::string half = bytesOf(ramp<std::uint8_t>(60));
    for (const std::string encoding : {"gzip", "bzip2"}) {
        const std::string lines = header + encoding + "\n", one = encoded(encoding, half);
        ASSERT_EQ(told(nrrd(lines, one + one)), "");
        for (std::size_t length = 0; length < one.size(); ++length)
            EXPECT_NE(told(nrrd(lines, one + one.substr(0, length))), "") << encoding << length;
        EXPECT_THAT(told(nrrd(lines, one)), HasSubstr("expected 120 bytes of values, found 60"));
        EXPECT_THAT(told(nrrd(lines, one + "plain" + half)),
                    HasSubstr("expected 120 bytes of values, found 60"));
        // The checksum of the last stream's values.
        std::string wrong = one + one;
        wrong[wrong.size() - 5] = static_cast<char>(wrong[wrong.size() - 5] ^ 0x10);
        EXPECT_THAT(told(nrrd(lines, wrong)), HasSubstr("damaged or cut")) << encoding;
    }
}

TEST_F(DamagedNrrd, HeadersWithWrongBytesAreReadOrRefused) {
    std::mt19937 random(5);
    for (const char* encoding : {"raw", "gzip", "ascii"}) {
        const std::string whole = sample(encoding);
        for (int i = 0; i < 1500; ++i) {
            std::string bytes = whole;
            for (int n = 0; n < 1 + i % 3; ++n)
                bytes[8 + random() % (whole.size() - 8)] =
                    random() % 3 ? "0123456789-+.e(),%nd:=\" \n"[random() % 25]
                                 : static_cast<char>(random());
            told(bytes);  // asserts that a refusal is one sentence
        }
    }
}

TEST_F(DamagedNrrd, WhatHeadersGetWrongIsNamed) {
    EXPECT_THAT(told("NRRX0004\ntype: uchar\n"), HasSubstr("found no format that is known"));
    EXPECT_THAT(told("NRRD0099\ntype: uchar\n\n"), HasSubstr("NRRD0099"));
    EXPECT_THAT(told("NRRD0004\n"), HasSubstr("header: expected"));
    EXPECT_THAT(told("NRRD0004" + std::string(100, '\0')), HasSubstr("line 1: expected text"));
    EXPECT_THAT(toldOf("type: flot\n"), HasSubstr("flot"));
    EXPECT_THAT(toldOf("type: block\nblock size: 4\n"), HasSubstr("blocks of bytes"));
    EXPECT_THAT(toldOf("dimension: 99999\n"), HasSubstr("header: expected"));
    EXPECT_THAT(toldOf("dimension: -3\n"), HasSubstr("header: expected"));
    EXPECT_THAT(toldOf("dimension: 4\n"), HasSubstr("header: expected"));
    EXPECT_THAT(toldOf("spacings: 1 two 3\n"), HasSubstr("header: expected"));
    EXPECT_THAT(toldOf("no such field: 3\n"), HasSubstr("header: expected"));
    EXPECT_THAT(toldOf("encoding: hex\n"), HasSubstr("field 'encoding': expected raw, gzip"));
    EXPECT_THAT(toldOf("encoding: zrl\n"), HasSubstr("field 'encoding': expected raw, gzip"));
    EXPECT_THAT(toldOf("encoding: gzip\n"), HasSubstr("values: expected gzip data"));
    EXPECT_THAT(toldOf("encoding: bzip2\n"), HasSubstr("values: expected bzip2 data"));
    EXPECT_THAT(toldOf("labels: \"a\" \"b\" \"c\n"), HasSubstr("'labels': expected quotation"));
    EXPECT_THAT(toldOf("units: a b\n"), HasSubstr("header: expected"));
    EXPECT_THAT(toldOf("byte skip: -2\n"), HasSubstr("field 'byte skip'"));
    EXPECT_THAT(toldOf("byte skip: 9000000000000000000\n"), HasSubstr("values: expected"));
    EXPECT_THAT(toldOf("line skip: 4000000000\n"), HasSubstr("lines to skip"));
    EXPECT_THAT(told(nrrd("type: short\ndimension: 1\nsizes: 2\nencoding: raw\n", "abcd")),
                HasSubstr("endian"));
}

TEST_F(DamagedNrrd, SizesThatNoFileHasAreRefused) {
    for (const char* sizes : {"0 3 4", "-2 3 4", "2 x 4", "2.5 3 4", "2 3 99999999999999999999"})
        EXPECT_THAT(toldOf(fmt::format("sizes: {}\n", sizes)), HasSubstr("field 'sizes'")) << sizes;
    EXPECT_NE(toldOf("sizes: 2 3\n"), "");
    EXPECT_THAT(toldOf("sizes: 4294967296 4294967296 4294967296\n"), HasSubstr("expected"));
    EXPECT_THAT(toldOf("sizes: 65536 65536 2\n"), HasSubstr("2^32 points"));
    EXPECT_THAT(toldOf("sizes: 33554432 1 1\n"), HasSubstr("2^24 points along an axis"));
    EXPECT_THAT(toldOf("sizes: 1024 1024 1024\n"), HasSubstr("at least 1073741824 bytes"));
    EXPECT_THAT(toldOf("sizes: 2 3 5\n"),
                "values: expected at least 30 bytes for 30 values, found 24");
    EXPECT_THAT(toldOf("sizes: 1024 1024 1024\nencoding: gzip\n"), HasSubstr("in this encoding"));
    EXPECT_THAT(toldOf("sizes: 1024 1024 1024\nencoding: bzip2\n"), HasSubstr("in this encoding"));
    EXPECT_THAT(toldOf("sizes: 2 3 5\nencoding: ascii\n"), HasSubstr("in this encoding"));
    EXPECT_THAT(toldOf("sizes: 1 1 1048577\nkinds: space space time\n"), HasSubstr("2^20 steps"));
}

TEST_F(DamagedNrrd, HeadersThatWouldTakeTheSquareOfTheirLengthAreNotGivenToTheLibrary) {
    std::string comments, pairs;
    for (int i = 0; i < 100'000; ++i) {
        comments += fmt::format("# {}\n", i);
        pairs += fmt::format("key{}:=\n", i);
    }
    const std::clock_t before = std::clock();
    EXPECT_EQ(toldOf(comments), "");
    EXPECT_THAT(toldOf(pairs), HasSubstr("expected at most 8192 key/value pairs"));
    // teem takes 5 s for the pairs, half a second for the comments, in a release.
    EXPECT_LT(static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC, 2);
}

// teem writes them into a thousand bytes of the stack.
TEST_F(DamagedNrrd, FieldsThatAreTooLongAreNotGivenToTheLibrary) {
    for (const std::size_t length : {700u, 1000u, 1100u, 5000u, 200000u}) {
        const std::string much(length, 'z');
        for (const std::string& line :
             {much, much + ": 1", "units: \"m\" " + much, "spacings: 1 " + much, "kinds: " + much,
              "centers: " + much + " cell", "space: " + much, "labels: \"a\" " + much,
              "sample units: m\nsample units: " + much, "endian: " + much, "data file: " + much,
              "content: a\ncontent: " + much})
            toldOf(line + "\n");  // a sentence, or none
        EXPECT_EQ(toldOf("content: " + much + "\n"), "");
        EXPECT_EQ(toldOf("key:=" + much + "\n"), "");
    }
    EXPECT_THAT(toldOf(std::string(900, 'z') + ": 1\n"),
                HasSubstr("line 7: expected a field of at most 800 characters, found 903"));
}

TEST_F(DamagedNrrd, ValuesThatAreNoNumbersOfTheTypeAreNamed) {
    const auto text = [&](const std::string& type, const std::string& values) {
        return told(
            nrrd(fmt::format("type: {}\ndimension: 1\nsizes: 3\nencoding: ascii\n", type), values));
    };
    EXPECT_EQ(text("uchar", "1 256 3"),
              "values: value 2: expected a number of type uint8, found '256'");
    EXPECT_EQ(text("uchar", "1 2 -3"),
              "values: value 3: expected a number of type uint8, found '-3'");
    EXPECT_EQ(text("float", "1e 2 3"),
              "values: value 1: expected a number of type float32, found '1e'");
    EXPECT_EQ(text("int", "1 2.5 3"),
              "values: value 2: expected a number of type int32, found '2.5'");
    EXPECT_EQ(text("int", "12345 2  "), "values: expected 3 values, found 2");
    EXPECT_THAT(text("double", std::string(100000, '7') + " 2 3"), HasSubstr("value 1"));
}

TEST_F(DamagedNrrd, PointsThatAreNoScalarsAreRefused) {
    EXPECT_THAT(toldOf("kinds: 2-vector domain domain\n"),
                HasSubstr("axis 1: expected one number a point, found 2 (2-vector)"));
    EXPECT_THAT(toldOf("sizes: 4 6 1\nkinds: RGBA-color space space\n"), HasSubstr("axis 1"));
    EXPECT_THAT(told(nrrd("type: uchar\ndimension: 4\nsizes: 3 5 5 5\nencoding: raw\n",
                          std::string(375, 'a'))),
                HasSubstr("axis 1: expected a kind that tells whether its 3 samples are the "
                          "components of a value"));
    EXPECT_THAT(told(nrrd("type: uchar\ndimension: 5\nsizes: 2 2 2 2 2\nencoding: raw\n",
                          std::string(32, 'a'))),
                HasSubstr("three axes of space and one of time"));
    EXPECT_THAT(toldOf("kinds: time space time\n"), HasSubstr("one axis of time"));
}

TEST_F(DamagedNrrd, CompressedValuesWithWrongBytesAreRefused) {
    const std::string whole = sample("gzip");
    const std::size_t values = whole.find("\n\n") + 2;
    for (std::size_t i = values; i < whole.size(); ++i) {
        if (i >= values + 3 && i < values + 10) continue;  // flags and time of gzip's header
        std::string bytes = whole;
        bytes[i] = static_cast<char>(bytes[i] ^ 0x55);
        EXPECT_NE(told(bytes), "") << "byte " << i - values << " of " << whole.size() - values;
    }
}

class DamagedNrrdFiles : public DamagedNrrd {
 protected:
    std::string toldOfFile(const std::string& dataFile) {
        writeBytes(folder / "head/file.nhdr",
                   "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 3 4\nencoding: raw\ndata file: " +
                       dataFile + "\n");
        return refusal(folder / "head/file.nhdr");
    }
    void SetUp() override {
        std::filesystem::create_directory(folder / "head");
        writeBytes(folder / "head/v.raw", std::string(24, 'a'));
    }
};

TEST_F(DamagedNrrdFiles, DataFilesThatCannotBeUsedAreNamed) {
    ASSERT_EQ(toldOfFile("v.raw"), "");
    ASSERT_EQ(toldOfFile((folder / "head/v.raw").string()), "");
    EXPECT_EQ(toldOfFile("none.raw"), "data file: " + (folder / "head/none.raw").string() +
                                          ": expected a file, but there is none");
    EXPECT_THAT(toldOfFile("../none/../v.raw"), HasSubstr("v.raw: expected a file, but there is"));
    EXPECT_THAT(toldOfFile("LIST 3\n \nv.raw"), HasSubstr("data file: expected the name"));
    EXPECT_THAT(toldOfFile(""), HasSubstr("field 'data file': expected the name"));
    for (const char* each : {".", "..", "../..", "/"})
        EXPECT_THAT(toldOfFile(each), HasSubstr("expected a file, but it is a folder")) << each;
    EXPECT_THAT(toldOfFile("/dev/zero"), HasSubstr("/dev/zero: expected an ordinary file"));
    std::filesystem::create_symlink("/dev/zero", folder / "head/zero");
    EXPECT_THAT(toldOfFile("zero"), HasSubstr("zero: expected an ordinary file"));
    std::filesystem::create_symlink("loop", folder / "head/loop");
    EXPECT_THAT(toldOfFile("loop"), HasSubstr("loop: expected a file"));
    EXPECT_THAT(toldOfFile("file.nhdr\ndata file: v.raw"), HasSubstr("expected it once"));
    writeBytes(folder / "head/short.raw", std::string(23, 'a'));
    EXPECT_THAT(toldOfFile("short.raw"), HasSubstr("at least 24 bytes for 24 values, found 23"));
    ASSERT_EQ(mkfifo((folder / "head/pipe").c_str(), 0600), 0);
    EXPECT_THAT(toldOfFile("pipe"), HasSubstr("pipe: expected an ordinary file"));
    EXPECT_THAT(toldOfFile("../head/pipe"), HasSubstr("pipe: expected an ordinary file"));
}

TEST_F(DamagedNrrdFiles, HostilePatternsReachNoPrintf) {
    for (const char* pattern : {"%s", "%n", "v%d%n", "v%d%s%s%s", "v%*d", "v%999999999d", "v%ld",
                                "v%1$d", "v%", "v%5", "%%"})
        EXPECT_THAT(toldOfFile(fmt::format("{} 1 4 1", pattern)), HasSubstr("with one %d"))
            << pattern;
    for (const char* numbers : {"1 4 0", "1 4 -1", "4 1 1", "1 x 1", "1 99999999999 1"})
        EXPECT_THAT(toldOfFile(fmt::format("v%d {}", numbers)), HasSubstr("first and last number"))
            << numbers;
    EXPECT_THAT(toldOfFile("v%d -2147483648 2147483647 1"), HasSubstr("files"));
    EXPECT_THAT(toldOfFile("v%d 1 5 1"), HasSubstr("expected 4 files, found 5"));
    EXPECT_THAT(toldOfFile("v%d 1 4 1 9"), HasSubstr("files of 1 to 3 dimensions"));
    EXPECT_THAT(toldOfFile("v%d 1 4 1 0"), HasSubstr("files of 1 to 3 dimensions"));
    EXPECT_THAT(toldOfFile("v%d 1 4 1"), HasSubstr("v1: expected a file, but there is none"));
}

TEST_F(DamagedNrrdFiles, ListsThatDoNotFitAreRefused) {
    EXPECT_THAT(toldOfFile("LIST"), HasSubstr("expected 4 files, found 0"));
    EXPECT_THAT(toldOfFile("LIST 3\n"), HasSubstr("evenly, found 0"));
    EXPECT_THAT(toldOfFile("LIST 3\nv.raw\nv.raw\nv.raw"), HasSubstr("evenly, found 3"));
    EXPECT_THAT(toldOfFile("LIST x\nv.raw"), HasSubstr("number of dimensions"));
    EXPECT_THAT(toldOfFile("SKIPLIST\n0 v.raw"), HasSubstr("expected LIST"));
}

TEST_F(DamagedNrrdFiles, TooLongAFileIsToldNotRefused) {
    writeBytes(folder / "head/long.raw", std::string(30, 'a'));
    EXPECT_EQ(toldOfFile("long.raw"), "");
    EXPECT_THAT(open(folder / "head/file.nhdr")->variables()[0].notes,
                testing::Contains(HasSubstr("6 bytes behind the values")));
}

}  // namespace
}  // namespace timeseries
