// Arrays of HDF5 that no netCDF wrote: what they say by HDF5's own means.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdlib>
#include <numeric>
#include <string>

#include "tests/support/files.h"
#include "tests/support/read_variables.h"

namespace timeseries {
namespace {

using testing::Each;
using tests::open;

// 3 x 4 x 5, 0 to 59, in an array that may grow, and says what is where nothing was written.
template <typename T>
std::filesystem::path array(hid_t type, std::array<hsize_t, 3> most, std::optional<T> fill,
                            std::vector<T> values) {
    const auto path = tests::testFolder() / "array.h5";
    const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    const std::array<hsize_t, 3> size{3, 4, 5};
    const hid_t space = H5Screate_simple(3, size.data(), most.data());
    const hid_t made = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(made, 3, size.data());
    if (fill) H5Pset_fill_value(made, type, &*fill);
    const hid_t data = H5Dcreate2(file, "v", type, space, H5P_DEFAULT, made, H5P_DEFAULT);
    EXPECT_GE(H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
    H5Dclose(data);
    H5Pclose(made);
    H5Sclose(space);
    H5Fclose(file);
    return path;
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
