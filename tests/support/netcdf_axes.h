// NetCDF files as tests of their axes read them.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/netcdf_builder.h"
#include "tests/support/read_variables.h"
#include "timeseries/readers/cf/cf_axes.h"
#include "timeseries/readers/reader.h"

namespace timeseries::netcdf_axes {

using testing::ElementsAre;
using tests::NetcdfBuilder;
using Path = std::filesystem::path;

using tests::open;

inline std::vector<double> evenly(std::size_t n, double first, double step) {
    std::vector<double> values(n);
    for (std::size_t i = 0; i < n; ++i) values[i] = first + step * static_cast<double>(i);
    return values;
}

inline std::vector<std::string> names(const Reader& reader) {
    std::vector<std::string> found;
    for (const Variable& v : reader.variables()) found.push_back(v.name);
    return found;
}

inline std::string refusalOf(const Path& path) {
    try {
        open(path);
    } catch (const FileError& error) {
        return error.what();
    }
    return "";
}

// Latitudes and longitudes, and more, as dimensions of their own.
struct Globe : NetcdfBuilder {
    Coordinate lat = coordinate("lat", 4, "degrees_north"),
               lon = coordinate("lon", 5, "degrees_east");
    explicit Globe(const std::string& name) : NetcdfBuilder(name) {}
    Path closed() {
        write(lat.variable, evenly(4, 0, 1));
        write(lon.variable, evenly(5, 0, 1));
        return close();
    }
};

inline NcVariable declared(const std::string& group, const std::string& name,
                           std::vector<std::size_t> dimensions,
                           const std::vector<std::pair<std::string, std::string>>& texts = {}) {
    NcVariable variable;
    variable.group = group;
    variable.name = group.empty() ? name : group + '/' + name;
    variable.type = ValueType::F64;
    variable.dimensions = std::move(dimensions);
    for (const auto& [attribute, text] : texts)
        variable.attributes.push_back({attribute, text, std::nullopt});
    return variable;
}

// field(j, i) with lon(j, i), lat(j, i); the 1-D coordinates i and j in the given units or none.
inline std::vector<std::string> notesOfCurvilinear(const char* units) {
    NetcdfBuilder file("a.nc");
    const bool has = *units;
    const int j = has ? file.coordinate("j", 2, units).dimension : file.dimension("j", 2);
    const int i = has ? file.coordinate("i", 3, units).dimension : file.dimension("i", 3);
    const int lon = file.variable("lon", NC_DOUBLE, {j, i}),
              lat = file.variable("lat", NC_DOUBLE, {j, i});
    file.text(lon, "units", "degrees_east");
    file.text(lat, "standard_name", "latitude");
    const int v = file.variable("v", NC_FLOAT, {j, i});
    file.text(v, "coordinates", "lon lat");
    if (has) {
        int id = 0;
        NetcdfBuilder::check(nc_inq_varid(file.id(), "i", &id));
        file.write(id, evenly(3, 1, 1));
        NetcdfBuilder::check(nc_inq_varid(file.id(), "j", &id));
        file.write(id, evenly(2, 1, 1));
    }
    const auto reader = open(file.close());
    EXPECT_THAT(names(*reader), ElementsAre("v"));
    const auto& axes = reader->variables()[0].grid->axes();
    const bool index = !has || std::string(units) == "1";
    EXPECT_EQ(axes[0].units, index ? "index" : units);
    EXPECT_THAT(axes[0].coordinates, index ? ElementsAre(0, 1, 2) : ElementsAre(1, 2, 3));
    return reader->variables()[0].notes;
}

}  // namespace timeseries::netcdf_axes
