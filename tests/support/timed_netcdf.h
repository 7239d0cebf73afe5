// NetCDF files whose steps are told apart by their values.
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "tests/support/netcdf_builder.h"
#include "timeseries/readers/reader.h"

namespace tests {

// v(time, y = 2, x = 2), every value of step t being first + t.
template <typename T = double>
std::filesystem::path series(const std::string& name, const std::vector<T>& times,
                             const std::string& units, const std::string& calendar = "",
                             float first = 0) {
    NetcdfBuilder file(name, NC_NETCDF4);
    const int t = file.dimension("time", NC_UNLIMITED), y = file.dimension("y", 2),
              x = file.dimension("x", 2);
    const int time = file.variable("time", ncType<T>(), {t});
    if (!units.empty()) file.text(time, "units", units);
    if (!calendar.empty()) file.text(time, "calendar", calendar);
    const int v = file.variable("v", NC_FLOAT, {t, y, x});
    const int fixed = file.variable("orography", NC_FLOAT, {y, x});
    std::vector<float> values;
    for (std::size_t i = 0; i < times.size(); ++i)
        values.insert(values.end(), 4, first + static_cast<float>(i));
    file.write(time, {0}, {times.size()}, times);
    file.write(v, {0, 0, 0}, {times.size(), 2, 2}, values);
    file.write(fixed, std::vector<float>{1, 2, 3, 4});
    return file.close();
}

// The first value of every step.
inline std::vector<float> firstValues(timeseries::Reader& reader) {
    std::vector<float> values;
    for (std::size_t t = 0; t < reader.variables()[0].time->points.size(); ++t)
        values.push_back(std::get<std::vector<float>>(reader.read(0, t).values)[0]);
    return values;
}

}  // namespace tests
