// Whole numbers of HDF5 and netCDF that have names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <string>

#include "tests/support/netcdf_builder.h"
#include "tests/support/plain_hdf5.h"
#include "tests/support/read_variables.h"

namespace timeseries {
namespace {

using testing::Each;
using tests::NetcdfBuilder;
using tests::open;
using tests::plain_hdf5::array;

// A type of these whole numbers, of which 0 and 1 have names.
hid_t named(hid_t base) {
    const hid_t type = H5Tenum_create(base);
    for (const int value : {0, 1}) {
        std::int64_t stored = value;
        H5Tconvert(H5T_NATIVE_INT64, base, 1, &stored, nullptr, H5P_DEFAULT);
        H5Tenum_insert(type, value == 0 ? "FALSE" : "TRUE", &stored);
    }
    return type;
}

// As h5py has truth values: also those that have no name.
template <typename T>
void expectNumbers(hid_t base, bool turned) {
    std::vector<T> values(60), stored;
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = T(i % 3 == 0);
    values[7] = T(-2);
    values[8] = std::numeric_limits<T>::max();
    for (const T value : values) {
        std::array<char, sizeof(T)> bytes;
        std::memcpy(bytes.data(), &value, sizeof(T));
        if (turned) std::ranges::reverse(bytes);
        std::memcpy(&stored.emplace_back(), bytes.data(), sizeof(T));
    }
    const hid_t type = named(base);
    const auto reader = open(array<T>(type, {3, 4, 5}, std::nullopt, stored));
    H5Tclose(type);
    const Variable& variable = reader->variables()[0];
    EXPECT_EQ(variable.name, "v");
    EXPECT_EQ(variable.grid->size(), (std::array<std::size_t, 3>{5, 4, 3}));
    const Field field = reader->read(0, 0);
    EXPECT_EQ(std::get<std::vector<T>>(field.values), values);
    EXPECT_THAT(field.missing, Each(false));
    const Field slab = reader->slab(0, 0, {2, 1, 2});
    EXPECT_EQ(std::get<std::vector<T>>(slab.values),
              std::vector<T>(values.begin() + 20, values.end()));
}

TEST(Hdf5Enums, AreNumbers) {
    expectNumbers<std::int8_t>(H5T_STD_I8LE, false);
    expectNumbers<std::uint8_t>(H5T_STD_U8LE, false);
    expectNumbers<std::int16_t>(H5T_STD_I16BE, true);
    expectNumbers<std::uint32_t>(H5T_STD_U32LE, false);
    expectNumbers<std::int64_t>(H5T_STD_I64BE, true);
}

// Beside other numbers, in a group; and as netCDF has them.
TEST(Hdf5Enums, LieAsOtherNumbersDo) {
    const auto path =
        array<float>(H5T_NATIVE_FLOAT, {3, 4, 5}, std::nullopt, std::vector<float>(60, 1));
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const std::array<hsize_t, 3> size{3, 4, 5};
    const hid_t space = H5Screate_simple(3, size.data(), nullptr),
                group = H5Gcreate2(file, "g", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                type = named(H5T_NATIVE_INT8),
                data =
                    H5Dcreate2(group, "mask", type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    std::vector<std::int8_t> values(60, 1);
    values[5] = 0;
    EXPECT_GE(H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
    H5Dclose(data);
    H5Tclose(type);
    H5Gclose(group);
    H5Sclose(space);
    H5Fclose(file);
    const auto reader = open(path);
    const std::size_t mask = tests::indexOf(*reader, "g/mask");
    EXPECT_EQ(tests::valuesOf<std::int8_t>(*reader, "g/mask"), values);
    EXPECT_EQ(reader->variables()[mask].grid,
              reader->variables()[tests::indexOf(*reader, "v")].grid);

    NetcdfBuilder own("own.nc");
    nc_type kind = 0;
    NetcdfBuilder::check(nc_def_enum(own.id(), NC_SHORT, "kind_t", &kind));
    for (const auto& [name, value] : {std::pair<const char*, short>{"air", 0}, {"rock", -300}})
        NetcdfBuilder::check(nc_insert_enum(own.id(), kind, name, &value));
    const int y = own.coordinate("y", 2, "m").dimension, x = own.coordinate("x", 3, "m").dimension;
    const int kinds = own.variable("kind", kind, {y, x});
    own.write(0, std::vector<double>{1, 2});
    own.write(1, std::vector<double>{5, 6, 7});
    own.write(kinds, std::vector<std::int16_t>{0, -300, 0, -300, 0, 0});
    const auto netcdf = open(own.close());
    EXPECT_EQ(tests::valuesOf<std::int16_t>(*netcdf, "kind"),
              (std::vector<std::int16_t>{0, -300, 0, -300, 0, 0}));
    EXPECT_EQ(netcdf->variables()[0].grid->axes()[0].coordinates, (std::vector<double>{5, 6, 7}));
}

// An attribute of that type: which of them stands for nothing.
TEST(Hdf5Enums, MayBeMissing) {
    NetcdfBuilder own("own.nc");
    nc_type kind = 0;
    const std::uint8_t clear = 0, missing = 255;
    NetcdfBuilder::check(nc_def_enum(own.id(), NC_UBYTE, "cloud_t", &kind));
    NetcdfBuilder::check(nc_insert_enum(own.id(), kind, "clear", &clear));
    NetcdfBuilder::check(nc_insert_enum(own.id(), kind, "missing", &missing));
    const int y = own.coordinate("y", 2, "m").dimension, x = own.coordinate("x", 2, "m").dimension;
    const int clouds = own.variable("cloud", kind, {y, x});
    NetcdfBuilder::check(nc_put_att(own.id(), clouds, "_FillValue", kind, 1, &missing));
    own.write(0, std::vector<double>{1, 2});
    own.write(1, std::vector<double>{5, 6});
    own.write(clouds, std::vector<std::uint8_t>{0, 255, 0, 255});
    const auto reader = open(own.close());
    const Field field = reader->read(0, 0);
    EXPECT_EQ(field.missing, (std::vector<bool>{false, true, false, true}));
    EXPECT_EQ(reader->variables()[0].missing, "_FillValue 255");
}

}  // namespace
}  // namespace timeseries
