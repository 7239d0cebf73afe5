// NRRD headers beside their values.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/support/array_builder.h"

namespace timeseries {
namespace {

using namespace tests;
using tests::freshFolder;
using tests::writeBytes;

// Headers beside their values.
class DetachedNrrd : public testing::Test {
 protected:
    std::string open(const std::string& lines) {
        writeBytes(folder / "file.nhdr",
                   "NRRD0004\r\ntype: uchar\r\ndimension: 3\r\n"
                   "sizes: 2 3 4\r\n" +
                       lines);
        return refusal(folder / "file.nhdr");
    }
    void expectRamp() {
        const auto reader = tests::open(folder / "file.nhdr");
        EXPECT_EQ(valuesOf<std::uint8_t>(*reader), ramp<std::uint8_t>(24));
    }
    std::string part(std::size_t first, std::size_t count) const {
        return bytesOf(ramp<std::uint8_t>(24)).substr(first, count);
    }
    std::filesystem::path folder = freshFolder();
};

TEST_F(DetachedNrrd, OneFileAfterLinesAndBytesThatAreSkipped) {
    std::filesystem::create_directory(folder / "sub");
    writeBytes(folder / "sub/with blank.raw", "one\ntwo\nxyz" + part(0, 24));
    EXPECT_EQ(open("encoding: raw\nline skip: 2\nbyte skip: 3\ndata file: sub/with blank.raw\n"),
              "");
    expectRamp();
    EXPECT_EQ(open("encoding: raw\nbyte skip: -1\ndatafile: ./sub/with blank.raw"), "");
    expectRamp();
    writeBytes(folder / "v.gz", "one\n" + byGzip("xyz" + part(0, 24)));
    EXPECT_EQ(open("encoding: gz\nline skip: 1\nbyte skip: 3\ndata file: v.gz\n\n"), "");
    expectRamp();
    writeBytes(folder / "v.txt",
               "24 values\n0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 "
               "20 21 22 23");
    EXPECT_EQ(open("encoding: txt\nline skip: 1\ndata file: v.txt\n"), "");
    expectRamp();
}

TEST_F(DetachedNrrd, OneFileASliceRowOrSlab) {
    for (std::size_t i = 0; i < 4; ++i)
        writeBytes(folder / fmt::format("s{:03}.raw", 8 - 2 * i), part(6 * i, 6));
    EXPECT_EQ(open("encoding: raw\ndata file: s%03d.raw 8 2 -2\n"), "");
    expectRamp();
    EXPECT_EQ(open("encoding: raw\ndata file: LIST\ns008.raw\ns006.raw\ns004.raw\ns002.raw\n"), "");
    expectRamp();
    for (std::size_t i = 0; i < 12; ++i)
        writeBytes(folder / fmt::format("r%{:2}", i), byGzip(part(2 * i, 2)));
    EXPECT_EQ(open("encoding: gzip\ndata file: r%%%2d 0 11 1 1\n"), "");
    expectRamp();
    for (std::size_t i = 0; i < 12; ++i)
        writeBytes(folder / fmt::format("r%{}", i), byGzip(part(2 * i, 2)));
    EXPECT_EQ(open("encoding: gzip\ndata file: r%%%d 0 11 1 1\n"), "");
    expectRamp();
    writeBytes(folder / "a", part(0, 12));
    writeBytes(folder / "b", part(12, 12));
    EXPECT_EQ(open("encoding: raw\ndata file: LIST 3\na\nb\n"), "");
    expectRamp();
}

TEST_F(DetachedNrrd, FilesOutsideTheHeadersFolderAreFoundFromItOrByAnAbsolutePath) {
    for (const char* each : {"header", "values/raw"})
        std::filesystem::create_directories(folder / each);
    for (std::size_t i = 0; i < 4; ++i)
        writeBytes(folder / fmt::format("values/raw/s{}", i), part(6 * i, 6));
    writeBytes(folder / "values/all", part(0, 24));
    std::filesystem::create_symlink("../values/all", folder / "header/link");
    const std::filesystem::path values = folder / "values";
    folder /= "header";
    for (const std::string& dataFile :
         {std::string("../values/all"), (values / "all").string(), std::string("link"),
          std::string("../values/raw/s%d 0 3 1"), (values / "raw/s%d 0 3 1").string(),
          "LIST\n../values/raw/s0\n../values/raw/../raw/s1\n" + (values / "raw/s2").string() +
              "\n../values/raw/s3"}) {
        EXPECT_EQ(open("encoding: raw\ndata file: " + dataFile + "\n"), "") << dataFile;
        expectRamp();
    }
}

TEST_F(DetachedNrrd, APercentSignWithoutNumbersIsAName) {
    writeBytes(folder / "50%s.raw", part(0, 24));
    EXPECT_EQ(open("encoding: raw\ndata file: 50%s.raw\n"), "");
    expectRamp();
}

}  // namespace
}  // namespace timeseries
