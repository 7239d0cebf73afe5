// An array of HDF5 that no netCDF writes.
#pragma once

#include <gtest/gtest.h>
#include <hdf5.h>

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include "tests/support/files.h"

namespace tests::plain_hdf5 {

// 3 x 4 x 5, 0 to 59, in an array that may grow, and says what is where nothing was written.
template <typename T>
std::filesystem::path array(hid_t type, std::array<hsize_t, 3> most, std::optional<T> fill,
                            std::vector<T> values) {
    const auto path = testFolder() / "array.h5";
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

}  // namespace tests::plain_hdf5
