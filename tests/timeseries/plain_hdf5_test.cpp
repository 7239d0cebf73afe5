// Arrays of HDF5 that no netCDF wrote: what they say by HDF5's own means.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <numeric>
#include <string>

#include "tests/support/files.h"
#include "tests/support/plain_hdf5.h"
#include "tests/support/read_variables.h"

namespace timeseries {
namespace {

using testing::Each;
using tests::open;
using tests::plain_hdf5::array;

// An array of one dimension that is a scale, as H5DSset_scale() makes it.
void scale(hid_t file, const char* name, const std::vector<double>& places) {
    const hsize_t size = places.size();
    const hid_t space = H5Screate_simple(1, &size, nullptr), one = H5Screate(H5S_SCALAR);
    const hid_t data =
        H5Dcreate2(file, name, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, places.data()), 0);
    const auto say = [&](const char* attribute, const std::string& text) {
        const hid_t type = H5Tcopy(H5T_C_S1);
        H5Tset_size(type, text.size() + 1);
        const hid_t said = H5Acreate2(data, attribute, type, one, H5P_DEFAULT, H5P_DEFAULT);
        EXPECT_GE(H5Awrite(said, type, text.c_str()), 0);
        H5Aclose(said);
        H5Tclose(type);
    };
    say("CLASS", "DIMENSION_SCALE");
    say("NAME", name);
    say("units", "mm");
    H5Dclose(data);
    H5Sclose(one);
    H5Sclose(space);
}

// As H5DSattach_scale() does: the HDF5 Dimension Scale Specification, section 3.
TEST(PlainHdf5, DimensionScalesAreAxes) {
    std::vector<float> values(60);
    std::iota(values.begin(), values.end(), 0.0f);
    const auto path = array<float>(H5T_NATIVE_FLOAT, {3, 4, 5}, std::nullopt, values);
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const std::vector<double> depth{1, 2, 4}, row{-3, -2, -1, 0}, column{0, 0.5, 1, 1.5, 2};
    scale(file, "depth", depth);
    scale(file, "row", row);
    scale(file, "column", column);
    const hid_t data = H5Dopen2(file, "v", H5P_DEFAULT);
    const hid_t list = H5Tvlen_create(H5T_STD_REF_OBJ);
    const hsize_t rank = 3;
    const hid_t space = H5Screate_simple(1, &rank, nullptr);
    const hid_t attached =
        H5Acreate2(data, "DIMENSION_LIST", list, space, H5P_DEFAULT, H5P_DEFAULT);
    std::array<hobj_ref_t, 3> scales{};
    std::array<hvl_t, 3> lists{};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_GE(H5Rcreate(&scales[i], file, std::array{"depth", "row", "column"}[i], H5R_OBJECT,
                            hid_t{-1}),
                  0);
        lists[i] = {1, &scales[i]};
    }
    EXPECT_GE(H5Awrite(attached, list, lists.data()), 0);
    H5Aclose(attached);
    H5Sclose(space);
    H5Tclose(list);
    H5Dclose(data);
    H5Fclose(file);
    const auto reader = open(path);
    const auto& axes = reader->variables()[tests::indexOf(*reader, "v")].grid->axes();
    EXPECT_EQ(axes[0].coordinates, column);
    EXPECT_EQ(axes[1].coordinates, row);
    EXPECT_EQ(axes[2].coordinates, depth);
    EXPECT_EQ(axes[2].name, "depth");
    EXPECT_EQ(axes[0].units, "mm");
    EXPECT_EQ(tests::valuesOf<float>(*reader, "v"), values);
}

// NetCDF's own fill is none where the array has another, or none.
TEST(PlainHdf5, FullScaleIsAValueWhereTheFillIsAnother) {
    std::vector<std::uint16_t> values(60, 100);
    values[7] = 65535;
    const auto path = array<std::uint16_t>(H5T_NATIVE_UINT16, {3, 4, 5}, 0, values);
    const auto reader = open(path);
    EXPECT_EQ(reader->variables()[0].missing, "");
    EXPECT_THAT(reader->read(0, 0).missing, Each(false));
    EXPECT_EQ(std::get<std::vector<std::uint16_t>>(reader->read(0, 0).values), values);
}

// Their values may change while they do not: nothing of them is kept that a file's time stands for.
TEST(PlainHdf5, WhatHasItsValuesInOtherFilesHasNoSources) {
    const auto other =
        array<float>(H5T_NATIVE_FLOAT, {3, 4, 5}, std::nullopt, std::vector<float>(60, 1));
    EXPECT_THAT(open(other)->sources(0, 0).files, testing::ElementsAre(other));
    const auto raw = tests::testFolder() / "raw.bin";
    tests::writeBytes(raw, std::string(240, '\0'));
    const std::array<hsize_t, 3> size{3, 4, 5};
    for (const std::string kind : {"link", "virtual", "storage"}) {
        const auto path = tests::testFolder() / (kind + ".h5");
        const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
        const hid_t space = H5Screate_simple(3, size.data(), nullptr);
        const hid_t made = H5Pcreate(H5P_DATASET_CREATE);
        if (kind == "virtual") H5Pset_virtual(made, space, other.c_str(), "v", space);
        if (kind == "storage") H5Pset_external(made, raw.c_str(), 0, 240);
        if (kind == "link") {
            H5Lcreate_external(other.c_str(), "v", file, "v", H5P_DEFAULT, H5P_DEFAULT);
        } else {
            const hid_t within = H5Gcreate2(file, "g", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
            const hid_t data =
                H5Dcreate2(within, "v", H5T_NATIVE_FLOAT, space, H5P_DEFAULT, made, H5P_DEFAULT);
            H5Dclose(data);
            H5Gclose(within);
        }
        H5Pclose(made);
        H5Sclose(space);
        H5Fclose(file);
        EXPECT_THAT(open(path)->sources(0, 0).files, testing::IsEmpty()) << kind;
    }
}

// netCDF's library then reads nothing of the file, and says "HDF error".
TEST(PlainHdf5, ALinkToWhatIsNotThereIsNamed) {
    const auto other =
        array<float>(H5T_NATIVE_FLOAT, {3, 4, 5}, std::nullopt, std::vector<float>(60, 1));
    const auto withLink = [](const auto& add) {
        const auto path = tests::testFolder() / "linked.h5";
        const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
        const hid_t group = H5Gcreate2(file, "g", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
        add(group);
        H5Gclose(group);
        H5Fclose(file);
        const std::string told = tests::refusalOf(path), begins = path.string() + ": link ";
        EXPECT_THAT(told, testing::StartsWith(begins));
        return told.substr(std::min(begins.size(), told.size()));
    };
    const std::string nothing = ": expected something there, but there is nothing";
    EXPECT_EQ(withLink([](hid_t group) {
                  H5Lcreate_soft("/nowhere", group, "a", H5P_DEFAULT, H5P_DEFAULT);
              }),
              "'g/a', which leads to '/nowhere'" + nothing);
    const auto external = [](const std::string& file, const char* object) {
        return [=](hid_t group) {
            H5Lcreate_external(file.c_str(), object, group, "b", H5P_DEFAULT, H5P_DEFAULT);
        };
    };
    EXPECT_EQ(withLink(external("missing.h5", "/v")),
              "'g/b', which leads to '/v' of missing.h5" + nothing);
    EXPECT_EQ(withLink(external(other.string(), "/w")),
              "'g/b', which leads to '/w' of " + other.string() + nothing);
}

// A file has no byte of a chunk that nobody wrote; of what is more than memory, it says why.
TEST(PlainHdf5, ChunksThatWereNotWrittenAreTheirFill) {
    const auto sparse = [](hsize_t side) {
        const auto path = tests::testFolder() / "sparse.h5";
        const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
        const std::array<hsize_t, 3> size{side, side, side}, chunk{16, 16, 16}, one{1, 1, 1};
        const hid_t space = H5Screate_simple(3, size.data(), nullptr),
                    point = H5Screate_simple(3, one.data(), nullptr),
                    made = H5Pcreate(H5P_DATASET_CREATE);
        const std::uint8_t fill = 3, seven = 7;
        H5Pset_chunk(made, 3, chunk.data());
        H5Pset_fill_value(made, H5T_NATIVE_UINT8, &fill);
        const hid_t data =
            H5Dcreate2(file, "v", H5T_NATIVE_UINT8, space, H5P_DEFAULT, made, H5P_DEFAULT);
        H5Sselect_hyperslab(space, H5S_SELECT_SET, chunk.data(), nullptr, one.data(), nullptr);
        H5Dwrite(data, H5T_NATIVE_UINT8, point, space, H5P_DEFAULT, &seven);
        for (const hid_t id : {space, point}) H5Sclose(id);
        H5Pclose(made);
        H5Dclose(data);
        H5Fclose(file);
        return path;
    };
    const Field field = open(sparse(300))->read(0, 0);
    const auto& values = std::get<std::vector<std::uint8_t>>(field.values);
    EXPECT_EQ(std::ranges::count(values, 3), 300 * 300 * 300 - 1);
    EXPECT_EQ(values[16 * (1 + 300 * (1 + 300))], 7);
    EXPECT_THAT(tests::refusalOf(sparse(1600)),
                testing::AllOf(testing::HasSubstr("found 4096000000 bytes"),
                               testing::HasSubstr("expected values that a file of")));
}

// HDF5 has nought for what it does not find.
TEST(PlainHdf5, ValuesOfAFileThatIsNotThereAreNotMadeUp) {
    const auto other =
        array<float>(H5T_NATIVE_FLOAT, {3, 4, 5}, std::nullopt, std::vector<float>(60, 1));
    const auto path = tests::testFolder() / "virtual.h5";
    const std::array<hsize_t, 3> size{3, 4, 5};
    const auto of = [&](const std::filesystem::path& source, const char* name) {
        const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
        const hid_t space = H5Screate_simple(3, size.data(), nullptr);
        const hid_t made = H5Pcreate(H5P_DATASET_CREATE);
        H5Pset_virtual(made, space, source.c_str(), name, space);
        const hid_t within = H5Gcreate2(file, "g", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
        H5Dclose(H5Dcreate2(within, "v", H5T_NATIVE_FLOAT, space, H5P_DEFAULT, made, H5P_DEFAULT));
        H5Lcreate_soft("v", within, "also", H5P_DEFAULT, H5P_DEFAULT);
        H5Gclose(within);
        H5Pclose(made);
        H5Sclose(space);
        H5Fclose(file);
        return open(path);
    };
    for (const std::filesystem::path& there :
         {other, other.filename(), "/nowhere" / other.filename()})
        EXPECT_EQ(std::get<std::vector<float>>(of(there, "v")->read(0, 0).values),
                  std::vector<float>(60, 1))
            << there;
    const auto refusal = [&](const std::filesystem::path& source, const char* name) {
        const auto reader = of(source, name);
        std::string all;
        for (std::size_t i = 0; i < reader->variables().size(); ++i) try {
                reader->read(i, 0);
                ADD_FAILURE() << reader->variables()[i].name;
            } catch (const FileError& error) {
                all += error.what() + std::string("\n");
            }
        return all;
    };
    EXPECT_THAT(refusal("gone.h5", "v"),
                testing::HasSubstr("virtual.h5: variable 'g/v': expected values of 'v' of gone.h5, "
                                   "which is not there\n"));
    EXPECT_THAT(refusal(other, "w"), testing::HasSubstr("expected values of 'w' of " +
                                                        other.string() + ", which is not there\n"));
}

// As HDF5 locks what it writes.
TEST(PlainHdf5, AFileThatIsWrittenIsToldAndOneThatIsReadCanBeWritten) {
    const auto path =
        array<float>(H5T_NATIVE_FLOAT, {3, 4, 5}, std::nullopt, std::vector<float>(60, 1));
    if (std::getenv("HDF5_USE_FILE_LOCKING") != std::string("FALSE"))
        GTEST_SKIP() << "somebody wants HDF5 to lock";
    const int writer = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
    ASSERT_EQ(flock(writer, LOCK_EX | LOCK_NB), 0);
    EXPECT_THAT(tests::refusalOf(path), testing::HasSubstr("a program has it locked"));
    ASSERT_EQ(flock(writer, LOCK_UN), 0);
    const auto reader = open(path);
    EXPECT_EQ(reader->read(0, 0).values.index(), static_cast<std::size_t>(ValueType::F32));
    EXPECT_EQ(flock(writer, LOCK_EX | LOCK_NB), 0) << "while it is open";
    ::close(writer);
}

// As solvers write velocities: no axis is three points wide for that.
TEST(PlainHdf5, AVectorOfEachPointIsNoAxis) {
    const auto path =
        array<float>(H5T_NATIVE_FLOAT, {3, 4, 5}, std::nullopt, std::vector<float>(60, 1));
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const std::array<hsize_t, 4> size{3, 4, 5, 3};
    const hid_t space = H5Screate_simple(4, size.data(), nullptr);
    const hid_t data =
        H5Dcreate2(file, "U", H5T_NATIVE_FLOAT, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    const std::vector<float> values(180, 2);
    EXPECT_GE(H5Dwrite(data, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
    H5Dclose(data);
    H5Sclose(space);
    H5Fclose(file);
    const auto reader = open(path);
    std::vector<std::string> found;
    for (const Variable& variable : reader->variables()) {
        found.push_back(variable.name);
        EXPECT_EQ(variable.grid->size(), (std::array<std::size_t, 3>{5, 4, 3}));
    }
    EXPECT_THAT(found, testing::UnorderedElementsAre("v", "U:0", "U:1", "U:2"));
}

TEST(PlainHdf5, ArraysThatMayGrowHaveNoTimes) {
    std::vector<float> values(60);
    std::iota(values.begin(), values.end(), 0.0f);
    constexpr hsize_t kAny = H5S_UNLIMITED;
    for (const std::array<hsize_t, 3> most :
         {std::array<hsize_t, 3>{3, 4, 5}, {kAny, 4, 5}, {3, 4, kAny}, {kAny, kAny, kAny}}) {
        const auto reader = open(array<float>(H5T_NATIVE_FLOAT, most, std::nullopt, values));
        const Variable& variable = reader->variables()[0];
        EXPECT_EQ(variable.time->points.size(), 1u);
        EXPECT_EQ(variable.grid->size(), (std::array<std::size_t, 3>{5, 4, 3}));
        EXPECT_EQ(std::get<std::vector<float>>(reader->read(0, 0).values), values);
    }
}

}  // namespace
}  // namespace timeseries
