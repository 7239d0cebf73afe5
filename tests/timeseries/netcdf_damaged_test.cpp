// Files that are cut, damaged or lie about their size: one sentence, in bounded time and memory.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <optional>
#include <random>

#include "tests/support/files.h"
#include "tests/support/netcdf_builder.h"
#include "tests/support/read_variables.h"
#include "tests/support/rounds.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using tests::NetcdfBuilder;
using tests::readBytes;
using tests::refusalOf;
using Path = std::filesystem::path;

Path write(const std::string& name, const std::string& bytes) {
    const Path path = tests::testFolder() / name;
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
}

// Everything a file holds; nothing when it is refused. The refusal is one sentence with the path.
std::optional<std::vector<Values>> contents(const Path& path) {
    try {
        const auto reader = openReader(std::span(&path, 1));
        std::vector<Values> all;
        for (std::size_t v = 0; v < reader->variables().size(); ++v)
            for (std::size_t t = 0; t < reader->variables()[v].time->points.size(); ++t)
                all.push_back(reader->read(v, t).values);
        return all;
    } catch (const FileError& error) {
        EXPECT_THAT(error.what(), StartsWith(path.string() + ": "));
        EXPECT_THAT(error.what(), HasSubstr("expected"));
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        EXPECT_THAT(error.what(), testing::Not(HasSubstr("link"))) << "it has none";
        return std::nullopt;
    }
}

// Two record variables, a fixed one, coordinates and attributes.
Path sample(int mode) {
    NetcdfBuilder file("sample.nc", mode);
    const int t = file.dimension("time", NC_UNLIMITED), z = file.dimension("z", 3),
              y = file.dimension("y", 5), x = file.dimension("x", 7);
    const int time = file.variable("time", NC_DOUBLE, {t});
    file.text(time, "units", "hours since 2000-01-01");
    const int zs = file.variable("z", NC_FLOAT, {z});
    const int a = file.variable("a", NC_SHORT, {t, z, y, x}),
              b = file.variable("b", NC_FLOAT, {t, y, x});
    const int fixed = file.variable("fixed", NC_BYTE, {y, x});
    file.text(a, "long_name", "odd number of shorts");
    file.number(a, "scale_factor", 0.5);
    if (mode & NC_NETCDF4) NetcdfBuilder::check(nc_def_var_deflate(file.id(), b, 1, 1, 6));
    std::vector<std::int16_t> shorts(4 * 105);
    std::vector<float> floats(4 * 35);
    for (std::size_t i = 0; i < shorts.size(); ++i) shorts[i] = static_cast<std::int16_t>(i + 1);
    for (std::size_t i = 0; i < floats.size(); ++i) floats[i] = static_cast<float>(i) + 0.5f;
    file.write(time, {0}, {4}, std::vector<double>{1, 2, 3, 4});
    file.write(zs, std::vector<float>{1, 2, 4});
    file.write(a, {0, 0, 0, 0}, {4, 3, 5, 7}, shorts);
    file.write(b, {0, 0, 0}, {4, 5, 7}, floats);
    file.write(fixed, std::vector<std::int8_t>(35, 9));
    return file.close();
}

void cutEverywhere(int mode, std::size_t stride) {
    const std::string whole = readBytes(sample(mode));
    const auto expected = contents(write("whole.nc", whole));
    ASSERT_TRUE(expected);
    std::size_t refused = 0;
    const Path path = write(fmt::format("cut{}.nc", mode), whole);
    std::size_t cuts = 0;
    for (std::size_t length = whole.size() - 1; length > stride; length -= stride, ++cuts) {
        std::filesystem::resize_file(path, length);
        const auto found = contents(path);
        refused += !found;
        if (found) {
            EXPECT_EQ(*found, *expected) << "cut at " << length << " of " << whole.size();
        }
    }
    // Only the padding after the last value may be missed.
    EXPECT_GE(refused + 3, cuts);
}

TEST(DamagedNetcdf, ClassicFilesCutAnywhereAreRefused) { cutEverywhere(0, 1); }
TEST(DamagedNetcdf, OffsetFilesCutAnywhereAreRefused) { cutEverywhere(NC_64BIT_OFFSET, 1); }
TEST(DamagedNetcdf, Cdf5FilesCutAnywhereAreRefused) { cutEverywhere(NC_CDF5, 1); }
TEST(DamagedNetcdf, Netcdf4FilesCutAnywhereAreRefused) {
    cutEverywhere(NC_NETCDF4, 8 * 37);  // each is tried by a process
}

// What a wrong header says must not crash the reader; values may differ, for they are not checked.
TEST(DamagedNetcdf, ClassicHeadersWithWrongBytesAreReadOrRefused) {
    std::mt19937 random(5);
    for (const int mode : {0, NC_CDF5}) {
        const std::string whole = readBytes(sample(mode));
        const Path path = tests::testFolder() / "flipped.nc";
        for (int i = 0; i < 1000; ++i) {
            std::string bytes = whole;
            for (int n = 0; n < 1 + i % 3; ++n)
                bytes[4 + random() % 700] = static_cast<char>(random() % 3 ? random() : 0xFF);
            std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
            contents(path);
        }
    }
}

// Copies of a file of which one object of HDF5's heap says to be longer by 2^40 bytes, each of them
// in turn.
std::vector<std::string> withLongHeapObjects(const std::string& whole) {
    const std::size_t heap = whole.find("GCOL");
    EXPECT_NE(heap, std::string::npos);
    std::vector<std::string> copies;
    std::size_t size = 0;
    for (std::size_t at = heap + 16; whole[at] != 0; at += 16 + (size + 7) / 8 * 8) {
        std::memcpy(&size, whole.data() + at + 8, 8);
        EXPECT_LT(at + 16 + size, whole.size());
        copies.push_back(whole);
        copies.back()[at + 8 + 5] = 1;
    }
    return copies;
}

// HDF5 1.10 copies as many bytes as an object of its global heap claims to have. The heap ("HDF5
// File Format Specification", III.E): 16 bytes, then objects, each an index in 2 bytes, 6 others,
// its size in 8 and its bytes, padded to 8; index 0 is what is free.
TEST(DamagedNetcdf, Netcdf4HeadersThatCrashHdf5AreReadOrRefused) {
    const Path path = tests::testFolder() / "heap.nc";
    const auto damaged = withLongHeapObjects(readBytes(sample(NC_NETCDF4)));
    for (const std::string& bytes : damaged) {
        tests::writeBytes(path, bytes);
        contents(path);
    }
    EXPECT_GE(damaged.size(), 4u);  // one a dimension at least
}

// The files of a series are tried together: where that ends badly, each by itself.
TEST(DamagedNetcdf, AHeaderThatCrashesHdf5AmongASeriesIsToldOfItsFile) {
    const auto step = [](int number) {
        NetcdfBuilder file(fmt::format("s{}.nc", number));
        const int t = file.dimension("time", NC_UNLIMITED), y = file.dimension("y", 2),
                  x = file.dimension("x", 2);
        file.text(file.variable("time", NC_DOUBLE, {t}), "units", "s");
        file.variable("v", NC_FLOAT, {t, y, x});
        file.write(0, {0}, {1}, std::vector<double>{double(number)});
        file.write(1, {0, 0, 0}, {1, 2, 2}, std::vector<float>(4, float(number)));
        return file.close();
    };
    std::vector<Path> series;
    for (int number = 0; number < 4; ++number) series.push_back(step(number));
    EXPECT_EQ(openReader(series)->variables()[0].time->points.size(), 4u);
    const std::string whole = readBytes(series[2]);
    for (const std::string& bytes : withLongHeapObjects(whole)) {
        tests::writeBytes(series[2], bytes);
        const std::string told = refusalOf(series);
        if (!told.empty()) {
            EXPECT_THAT(told, HasSubstr("s2.nc"));
        }
    }
}

TEST(DamagedNetcdf, PathsThatAreNoFilesAreNamed) {
    EXPECT_EQ(refusalOf(std::vector<Path>{}), "expected a file to open, but none is named");
    const Path missing = tests::testFolder() / "there_is_none.nc";
    EXPECT_EQ(refusalOf({missing}), missing.string() + ": expected a file, but there is none");
    const Path folder = tests::testFolder();
    EXPECT_EQ(refusalOf({folder}), folder.string() + ": expected a file, but it is a folder");
    EXPECT_THAT(refusalOf("/dev/null"), HasSubstr("expected an ordinary file"));
    const Path empty = write("empty.nc", "");
    EXPECT_THAT(refusalOf({empty}), HasSubstr("but it is empty"));
    const Path circle = folder / "circle.nc";
    std::filesystem::create_symlink(circle, circle);
    EXPECT_EQ(refusalOf({circle}), circle.string() + ": expected a file that can be read, but " +
                                       std::generic_category().message(ELOOP));
    if (geteuid() == 0) return;  // whom nothing is forbidden
    const std::string denied =
        ": expected a file that can be read, but " + std::generic_category().message(EACCES);
    const Path locked = write("locked.nc", "CDF\1");
    std::filesystem::permissions(locked, std::filesystem::perms::none);
    EXPECT_EQ(refusalOf({locked}), locked.string() + denied);
    const Path shut = folder / "shut", inside = shut / "v.nc";
    std::filesystem::create_directory(shut);
    std::filesystem::permissions(shut, std::filesystem::perms::none);
    EXPECT_EQ(refusalOf({inside}), inside.string() + denied);
    std::filesystem::permissions(shut, std::filesystem::perms::owner_all);
}

TEST(DamagedNetcdf, OtherFormatsAreToldApart) {
    using namespace std::string_literals;
    for (const std::string& bytes :
         {"NRRX0004\n"s, "CDF"s, "CDF\3aaaaaaaa"s, "CDF\4aaaaaaaa"s, "\x89HDG\r\n\x1a\n"s,
          "\x89HDF\r\n\x1a"s, std::string(100, '\0')}) {
        const Path path = write("other.bin", bytes);
        EXPECT_THAT(
            refusalOf({path}),
            StartsWith(
                path.string() +
                ": expected a NetCDF, NRRD, NIfTI, MRC, FITS, XDMF, CSV, VTK or OpenVDB file, "
                "found no format that is known"));
    }
    // The right first bytes and nothing after.
    EXPECT_FALSE(contents(write("magic.nc", "CDF\1"s)));
    EXPECT_FALSE(contents(write("magic.nc", "CDF\5aaaaaaaaaaaaaaaaaaaaaaaaa"s)));
    EXPECT_FALSE(contents(write("magic.nc", "\x89HDF\r\n\x1a\n"s)));
    EXPECT_FALSE(contents(write("magic.nc", "\x89HDF\r\n\x1a\n"s + std::string(5000, 'x'))));
}

TEST(DamagedNetcdf, SizesTheFileCannotHoldAreRefusedBeforeAnythingIsAllocated) {
    // A NetCDF-4 file may declare any size: what was never written takes no room.
    NetcdfBuilder file("huge.nc");
    const int y = file.dimension("y", 60000), x = file.dimension("x", 60000);
    file.variable("v", NC_DOUBLE, {y, x});
    const std::string why = refusalOf({file.close()});
    EXPECT_THAT(why, HasSubstr("v(y, x): expected values that a file of"));

    NetcdfBuilder more("more.nc");
    const int z = more.dimension("z", 100000), b = more.dimension("y", 100000),
              a = more.dimension("x", 100000);
    more.variable("v", NC_BYTE, {z, b, a});
    EXPECT_THAT(refusalOf({more.close()}), HasSubstr("expected at most 2^32 points"));

    NetcdfBuilder steps("steps.nc");
    const int t = steps.dimension("time", std::size_t{1} << 40), d = steps.dimension("y", 2),
              c = steps.dimension("x", 2);
    steps.variable("v", NC_BYTE, {t, d, c});
    EXPECT_THAT(refusalOf({steps.close()}), HasSubstr("steps, found 1099511627776"));
}

TEST(DamagedNetcdf, MoreVariablesThanNetcdfAllowsAreRefused) {
    NetcdfBuilder file("many.nc", 0);
    for (int i = 0; i < NC_MAX_VARS + 1; ++i) file.variable(fmt::format("v{}", i), NC_BYTE, {});
    EXPECT_THAT(refusalOf({file.close()}),
                HasSubstr("expected at most 8192 variables, found 8193"));
}

TEST(DamagedNetcdf, CompressedValuesThatCannotBeUnpackedAreToldWhenRead) {
    NetcdfBuilder file("a.nc");
    const int y = file.dimension("y", 64), x = file.dimension("x", 64);
    const int v = file.variable("v", NC_FLOAT, {y, x});
    NetcdfBuilder::check(nc_def_var_deflate(file.id(), v, 0, 1, 6));
    std::mt19937 random(1);
    std::vector<float> values(64 * 64);
    for (float& value : values) value = static_cast<float>(random());
    file.write(v, values);
    const Path path = file.close();
    std::string bytes = readBytes(path);
    // The chunk is most of the file: overwrite the middle of it.
    for (std::size_t i = bytes.size() / 2; i < bytes.size() / 2 + 64; ++i) bytes[i] = '\xFF';
    const Path damaged = write("damaged.nc", bytes);
    const auto reader = openReader(std::span(&damaged, 1));
    try {
        reader->read(0, 0);
        FAIL();
    } catch (const FileError& error) {
        EXPECT_THAT(error.what(), StartsWith(damaged.string() +
                                             ": variable 'v': expected values that can be read"));
    }
}

TEST(DamagedNetcdf, AnEmptySeriesIsTold) {
    // A step would be larger than the file is.
    for (const int format : {NC_NETCDF4, 0, NC_64BIT_OFFSET, NC_64BIT_DATA}) {
        NetcdfBuilder file("a.nc", format);
        const int t = file.dimension("time", NC_UNLIMITED), y = file.dimension("y", 200),
                  x = file.dimension("x", 200);
        file.variable("v", NC_FLOAT, {t, y, x});
        EXPECT_THAT(refusalOf({file.close()}),
                    HasSubstr("v(time, y, x): the dimension time is empty"));
    }
}

TEST(DamagedNetcdf, AFileThatChangesAfterItWasOpenedIsTold) {
    const auto still = [](const char* name, std::size_t n) {
        NetcdfBuilder file(name, 0);
        const int y = file.dimension("y", n), x = file.dimension("x", 2);
        const int v = file.variable("v", NC_BYTE, {y, x});
        file.write(v, std::vector<std::int8_t>(2 * n, 1));
        return file.close();
    };
    const std::vector<Path> paths{still("a.nc", 2), still("b.nc", 2)};
    const auto reader = openReader(paths);
    std::filesystem::copy_file(still("c.nc", 3), paths[1],
                               std::filesystem::copy_options::overwrite_existing);
    EXPECT_THROW(reader->read(0, 1), FileError);
    EXPECT_NO_THROW(reader->read(0, 0));
}

}  // namespace
}  // namespace timeseries
