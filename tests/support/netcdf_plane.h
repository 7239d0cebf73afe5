// NetCDF files of one small variable, and its values as they are read.
#pragma once

#include <string>
#include <vector>

#include "tests/support/netcdf_builder.h"
#include "timeseries/grid/field.h"

namespace tests {

template <typename T>
std::vector<T> asValues(const timeseries::Field& field) {
    return std::get<std::vector<T>>(field.values);
}

// v(y = 2, x = 3) with what the test puts on it.
template <typename T, typename Attributes>
std::filesystem::path plane(const std::string& name, const std::vector<T>& values,
                            Attributes attributes, int mode = NC_NETCDF4) {
    NetcdfBuilder file(name, mode);
    const int y = file.dimension("y", 2), x = file.dimension("x", values.size() / 2);
    const int v = file.variable("v", ncType<T>(), {y, x});
    attributes(file, v);
    file.write(v, values);
    return file.close();
}

}  // namespace tests
