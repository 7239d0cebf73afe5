#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "tests/support/netcdf_builder.h"
#include "timeseries/readers/cf_axes.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using tests::NetcdfBuilder;
using Path = std::filesystem::path;

std::unique_ptr<Reader> open(const Path& path) { return openReader(std::span(&path, 1)); }

std::vector<double> ramp(std::size_t n, double first, double step) {
    std::vector<double> values(n);
    for (std::size_t i = 0; i < n; ++i) values[i] = first + step * static_cast<double>(i);
    return values;
}

std::vector<std::string> names(const Reader& reader) {
    std::vector<std::string> found;
    for (const Variable& v : reader.variables()) found.push_back(v.name);
    return found;
}

TEST(NetcdfAxes, AttributesTellTheAxesOfDimensionsWithoutTellingNames) {
    // Each time in another way; stored as v(a, b, c, d) = (x, t, z, y).
    struct Words {
        const char *attribute, *x, *y, *z, *t;
    };
    const std::vector<Words> ways{
        {"axis", "X", "Y", "Z", "T"},
        {"standard_name", "longitude", "latitude", "height", "time"},
        {"standard_name", "grid_longitude", "grid_latitude",
         "atmosphere_hybrid_sigma_pressure_coordinate", "time"},
        {"standard_name", "projection_x_coordinate", "projection_y_coordinate", "depth", "time"},
        {"units", "degrees_east", "degrees_north", "hPa", "days since 2000-01-01"},
        {"units", "degreeE", "degree_N", "level", "Seconds Since 1970-1-1"},
    };
    for (const Words& way : ways) {
        NetcdfBuilder file("a.nc");
        const auto a = file.coordinate("a", 2, ""), b = file.coordinate("b", 3, ""),
                   c = file.coordinate("c", 4, ""), d = file.coordinate("d", 5, "");
        file.text(a.variable, way.attribute, way.x);
        file.text(b.variable, way.attribute, way.t);
        file.text(c.variable, way.attribute, way.z);
        file.text(d.variable, way.attribute, way.y);
        file.variable("v", NC_FLOAT, {a.dimension, b.dimension, c.dimension, d.dimension});
        file.write(a.variable, ramp(2, 0, 1));
        file.write(b.variable, ramp(3, 0, 1));
        file.write(c.variable, ramp(4, 0, 1));
        file.write(d.variable, ramp(5, 0, 1));
        const auto reader = open(file.close());
        const Variable& v = reader->variables()[0];
        EXPECT_EQ(v.grid->size(), (std::array<std::size_t, 3>{2, 5, 4})) << way.x;
        EXPECT_EQ(v.time->points.size(), 3u) << way.x;
        EXPECT_EQ(v.grid->axes()[0].name, "a");
    }
}

// CF 1.10, chapter 4 and appendix B; E is that of GrADS.
TEST(NetcdfAxes, EachWordOfTheConventionsTellsItsAxis) {
    using enum AxisKind;
    struct Words {
        std::optional<AxisKind> kind;
        const char* attribute;
        std::vector<const char*> values;
    };
    const std::vector<Words> all{
        {X, "axis", {"X", "x"}},
        {Y, "axis", {"Y"}},
        {Z, "axis", {"Z"}},
        {T, "axis", {"T"}},
        {Other, "axis", {"E"}},
        {X,
         "standard_name",
         {"longitude", "grid_longitude", "projection_x_coordinate",
          "projection_x_angular_coordinate", "longitude status_flag"}},
        {Y,
         "standard_name",
         {"latitude", "grid_latitude", "projection_y_coordinate",
          "projection_y_angular_coordinate"}},
        {Z,
         "standard_name",
         {"depth", "altitude", "height", "air_pressure", "air_potential_temperature",
          "model_level_number", "sea_water_pressure", "geopotential_height",
          "atmosphere_sigma_coordinate", "ocean_s_coordinate_g1", "ocean_sigma_z_coordinate",
          "ocean_double_sigma_coordinate", "height_above_mean_sea_level", "depth_below_geoid"}},
        {T, "standard_name", {"time"}},
        {Other,
         "standard_name",
         {"realization", "radiation_wavelength", "radiation_frequency", "forecast_period",
          "forecast_reference_time"}},
        {X, "units", {"degrees_east", "degree_east", "degree_E", "degrees_E", "degreeE"}},
        {Y, "units", {"degrees_north", "degree_north", "degree_N", "degrees_N", "degreeN"}},
        {Z, "units", {"level", "layer", "sigma_level", "hybrid_sigma_pressure", "hPa", "dbar"}},
        {T, "units", {"days since 2000-01-01"}},
        {Z, "positive", {"up", "Down"}},
        {std::nullopt, "axis", {"", "W"}},
        {std::nullopt, "standard_name", {"air_temperature", "longitudes"}},
        {std::nullopt, "units", {"", "K", "m", "degrees"}},
        {std::nullopt, "positive", {"", "sideways"}},
    };
    for (const Words& words : all)
        for (const char* value : words.values) {
            NcVariable variable;
            variable.dimensions = {0};
            variable.attributes = {{words.attribute, std::string(value), std::nullopt}};
            EXPECT_EQ(kindByAttributes(variable), words.kind) << words.attribute << ' ' << value;
            // A height of several dimensions is a field, and tells no axis; a longitude still does.
            variable.dimensions = {0, 1};
            const bool height = words.kind == Z && words.attribute == std::string("standard_name");
            EXPECT_EQ(kindByAttributes(variable), height ? std::nullopt : words.kind)
                << words.attribute << ' ' << value << " of two dimensions";
        }
}

// Of ROMS, NEMO, WRF, POP, CICE, MOM, CESM, ECHAM, FESOM, ICON and what GRIB becomes.
TEST(NetcdfAxes, NamesThatModelsUseTellTheAxis) {
    using enum AxisKind;
    struct Names {
        AxisKind kind;
        std::vector<std::string> whole, begun;  // the latter with anything behind them
    };
    const std::vector<Names> all{
        {T, {"t", "ocean_time", "record"}, {"time", "Time", "time_counter"}},
        {Other,
         {"bnds", "bounds", "nv", "nb2", "bound", "tbnds", "axis_nbounds", "vertices",
          "realization", "number"},
         {"nbnd", "ncorners", "corners", "nvertex", "members", "ensemble"}},
        {List,
         {"cell", "cells", "node", "nodes", "nodes_2d", "nodes_3d", "elem"},
         {"ncells", "nod2", "nod3"}},
        {X,
         {"rlon", "x", "ni", "nx", "nlon", "i", "xc", "xh", "xq", "grid_longitude"},
         {"lon", "longitude", "west_east_stag", "xi_rho"}},
        {Y,
         {"rlat", "y", "eta_rho", "eta_u", "eta_v", "eta_psi", "nj", "ny", "nlat", "j", "yc", "yh",
          "yq", "grid_latitude"},
         {"lat", "latitude", "south_north_stag"}},
        {Z,
         {"ilev", "mlev", "z", "zt", "zl", "zi", "alt", "altitude", "s_rho", "s_w", "nz", "k"},
         {"lev", "level", "plev19", "z_t", "deptht", "height", "pressure", "isobaric1", "sigma",
          "bottom_top_stag", "model_level_number", "layers"}},
    };
    for (const Names& names : all) {
        for (const std::string& name : names.whole) {
            EXPECT_EQ(kindByName(name), names.kind) << name;
            EXPECT_EQ(kindByName(name + "qq"), std::nullopt) << name;
        }
        for (const std::string& name : names.begun) {
            EXPECT_EQ(kindByName(name), names.kind) << name;
            EXPECT_EQ(kindByName(name + "qq"), names.kind) << name;
        }
    }
}

TEST(NetcdfAxes, PositionDecidesWhatNothingElseTells) {
    NetcdfBuilder file("a.nc");
    const int a = file.dimension("aa", NC_UNLIMITED), b = file.dimension("bb", 2),
              c = file.dimension("cc", 3), d = file.dimension("dd", 4);
    const int v = file.variable("v", NC_FLOAT, {a, b, c, d});
    file.variable("fixed", NC_FLOAT, {b, c, d});
    file.variable("records", NC_FLOAT, {a, c, d});
    file.write(v, {0, 0, 0, 0}, {5, 2, 3, 4}, std::vector<float>(120, 1));
    const auto reader = open(file.close());
    ASSERT_THAT(names(*reader), ElementsAre("v", "fixed", "records"));
    for (const Variable& each : reader->variables()) {
        const bool layer = each.name == "records";
        EXPECT_EQ(each.grid->size(), (std::array<std::size_t, 3>{4, 3, layer ? 1u : 2u}));
        EXPECT_EQ(each.time->points.size(), each.name == "fixed" ? 1u : 5u) << each.name;
        EXPECT_EQ(each.time->name, "step");
        EXPECT_EQ(each.grid->axes()[0].units, "index");
        for (const Axis& axis : each.grid->axes()) EXPECT_FALSE(axis.down) << axis.name;
    }
    EXPECT_EQ(reader->variables()[0].time->points[4].value, 4.0) << "counted";
    EXPECT_THAT(reader->variables()[0].notes,
                testing::Contains("dd is placed by index: the file has no coordinates for it"));
}

std::string refusalOf(const Path& path) {
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
        write(lat.variable, ramp(4, 0, 1));
        write(lon.variable, ramp(5, 0, 1));
        return close();
    }
};

TEST(NetcdfAxes, WhatIsTimeForOneVariableIsNoHeightForAnother) {
    for (const bool flatFirst : {false, true}) {
        Globe file("a.nc");
        const int time = file.dimension("frtime", 3), level = file.dimension("level", 2);
        const std::vector<int> flat{time, file.lat.dimension, file.lon.dimension},
            full{time, level, file.lat.dimension, file.lon.dimension};
        file.variable(flatFirst ? "Psl" : "T", NC_FLOAT, flatFirst ? flat : full);
        file.variable(flatFirst ? "T" : "Psl", NC_FLOAT, flatFirst ? full : flat);
        const auto reader = open(file.closed());
        ASSERT_EQ(reader->variables().size(), 2u);
        for (const Variable& each : reader->variables()) {
            EXPECT_EQ(each.time->points.size(), 3u) << each.name;
            EXPECT_EQ(each.grid->size(),
                      (std::array<std::size_t, 3>{5, 4, each.name == "T" ? 2u : 1u}));
        }
        EXPECT_EQ(reader->variables()[0].time, reader->variables()[1].time);
    }
}

TEST(NetcdfAxes, ACoordinateThatOneVariableNamesIsThatOfAll) {
    Globe file("a.nc");
    const int step = file.dimension("step", 2), layer = file.dimension("deep", 3);
    const int when = file.variable("when", NC_DOUBLE, {step}),
              depth = file.variable("below", NC_DOUBLE, {layer});
    file.text(when, "units", "hours since 2000-01-01");
    file.text(depth, "standard_name", "depth");
    const int t =
        file.variable("T", NC_FLOAT, {step, layer, file.lat.dimension, file.lon.dimension});
    file.text(t, "coordinates", "when below");
    file.variable("ssh", NC_FLOAT, {step, file.lat.dimension, file.lon.dimension});
    file.variable("mask", NC_FLOAT, {layer, file.lat.dimension, file.lon.dimension});
    file.write(when, std::vector<double>{6, 12});
    file.write(depth, std::vector<double>{5, 15, 40});
    const auto reader = open(file.closed());
    ASSERT_THAT(names(*reader), ElementsAre("T", "ssh", "mask"));
    const auto& all = reader->variables();
    EXPECT_EQ(all[1].time, all[0].time);
    EXPECT_EQ(all[1].time->points[1].date, "2000-01-01 12:00:00");
    EXPECT_EQ(all[2].time->points.size(), 1u);
    EXPECT_EQ(all[2].grid, all[0].grid);
    EXPECT_THAT(all[2].grid->axes()[2].coordinates, ElementsAre(5, 15, 40));
}

// Its own words are worth more than another's.
TEST(NetcdfAxes, VariablesThatNameDifferentTimesKeepThem) {
    Globe file("a.nc");
    const int step = file.dimension("step", 2);
    for (const char* name : {"noon", "night"}) {
        const int when = file.variable(name, NC_DOUBLE, {step});
        file.text(when, "units", "hours since 2000-01-01");
        const int v = file.variable(std::string("at_") + name, NC_FLOAT,
                                    {step, file.lat.dimension, file.lon.dimension});
        file.text(v, "coordinates", name);
    }
    file.variable("other", NC_FLOAT, {step, file.lat.dimension, file.lon.dimension});
    file.write(2, std::vector<double>{12, 36});
    file.write(4, std::vector<double>{0, 24});
    const auto reader = open(file.closed());
    ASSERT_EQ(reader->variables().size(), 3u);
    for (const Variable& each : reader->variables())
        EXPECT_EQ(each.time->points.size(), 2u) << each.name;
    EXPECT_EQ(reader->variables()[0].time->name, "noon");
    EXPECT_EQ(reader->variables()[1].time->name, "night");
    EXPECT_EQ(reader->variables()[2].time->name, "step") << "it says neither";
}

TEST(NetcdfAxes, TimesThatNobodyNamesTellWhatTheirDimensionIs) {
    Globe file("a.nc");
    const int step = file.dimension("frtime", 2);
    const int when = file.variable("valtime", NC_DOUBLE, {step});
    file.text(when, "units", "hours since 2000-01-01");
    file.variable("Psl", NC_FLOAT, {step, file.lat.dimension, file.lon.dimension});
    file.write(when, std::vector<double>{6, 12});
    const auto reader = open(file.closed());
    EXPECT_EQ(reader->variables()[0].time->points[0].date, "2000-01-01 06:00:00");
    // Scans have times too, but lie along y.
    NetcdfBuilder swath("b.nc");
    const int y = swath.dimension("y", 4), x = swath.dimension("x", 3), z = swath.dimension("z", 2);
    const int scanned = swath.variable("scanned", NC_DOUBLE, {y});
    swath.text(scanned, "units", "seconds since 2000-01-01");
    swath.variable("v", NC_FLOAT, {y, x, z});
    swath.write(scanned, ramp(4, 0, 1));
    EXPECT_EQ(open(swath.close())->variables()[0].grid->size(),
              (std::array<std::size_t, 3>{3, 4, 2}));
}

// "b" is time for the first, but for the second it stands among the axes of space.
TEST(NetcdfAxes, AVariableWhoseDimensionsStandOtherwiseGoesByItsOwnPositions) {
    NetcdfBuilder file("a.nc");
    std::vector<int> d;
    for (int i = 0; i < 5; ++i)
        d.push_back(file.dimension(std::string("d") + static_cast<char>('a' + i),
                                   static_cast<std::size_t>(i) + 2));
    file.variable("first", NC_FLOAT, {d[1], d[2], d[3], d[4]});
    file.variable("second", NC_FLOAT, {d[0], d[1], d[2]});
    const auto reader = open(file.close());
    EXPECT_EQ(reader->variables()[0].time->points.size(), 3u);
    EXPECT_EQ(reader->variables()[1].time->points.size(), 1u);
    EXPECT_EQ(reader->variables()[1].grid->size(), (std::array<std::size_t, 3>{4, 3, 2}));
}

TEST(NetcdfAxes, ASecondTimeIsNoHeight) {
    Globe file("a.nc");
    const auto time = file.coordinate("time", 2, "hours since 2000-01-01"),
               run = file.coordinate("run", 3, "hours since 2000-01-01");
    file.variable("v", NC_FLOAT,
                  {run.dimension, time.dimension, file.lat.dimension, file.lon.dimension});
    file.write(time.variable, ramp(2, 0, 1));
    file.write(run.variable, ramp(3, 0, 1));
    EXPECT_THAT(refusalOf(file.closed()),
                HasSubstr("the dimension run of 3 is none of x, y, z and time"));
}

// Each in the words of another writer.
TEST(NetcdfAxes, ValuesOnAMeshAreToldAndRefused) {
    const auto written = [](bool radians, const char* along, auto&& more) {
        NetcdfBuilder file("a.nc");
        const auto z = file.coordinate("depth", 3, "m");
        const int cells = file.dimension(along, 40);
        const int lon = file.variable("clon", NC_DOUBLE, {cells}),
                  lat = file.variable("clat", NC_DOUBLE, {cells});
        if (radians) {
            file.text(lon, "standard_name", "longitude");
            file.text(lat, "standard_name", "latitude");
        }
        const int v = file.variable("S", NC_FLOAT, {z.dimension, cells});
        file.text(v, "coordinates", "clon clat");
        more(file, v);
        file.write(z.variable, ramp(3, 0, 1));
        return file.close();
    };
    const auto nothing = [](NetcdfBuilder&, int) {};
    const std::string told =
        ": variable 'S': expected values on a grid, found them on an unstructured mesh (40 places "
        "listed along ";
    for (const char* along : {"c", "ncells", "nod2"}) {  // by coordinates, of ICON, of FESOM
        const Path path = written(along == std::string("c"), along, nothing);
        EXPECT_EQ(refusalOf(path), path.string() + told + along + "), which is not read yet");
    }
    const auto ugrid = [](NetcdfBuilder& file, int v) {
        file.text(v, "mesh", "m");
        file.text(v, "location", "face");
    };
    const auto cdi = [](NetcdfBuilder& file, int v) {
        file.text(v, "CDI_grid_type", "unstructured");
    };
    EXPECT_THAT(refusalOf(written(false, "c", ugrid)), HasSubstr("on an unstructured mesh, which"));
    EXPECT_THAT(refusalOf(written(false, "c", cdi)), HasSubstr("on an unstructured mesh, which"));
}

TEST(NetcdfAxes, BesideValuesOnAMeshAGridIsRead) {
    Globe file("a.nc");
    const int cells = file.dimension("ncells", 7), z = file.dimension("z", 2);
    file.variable("S", NC_FLOAT, {z, cells});
    file.variable("T", NC_FLOAT, {z, file.lat.dimension, file.lon.dimension});
    const auto reader = open(file.closed());
    EXPECT_THAT(names(*reader), ElementsAre("T"));
    ASSERT_EQ(reader->damaged().size(), 1u);
    EXPECT_EQ(reader->damaged()[0].name, "S");
    EXPECT_THAT(reader->damaged()[0].why, HasSubstr("on an unstructured mesh"));
}

NcVariable declared(const std::string& group, const std::string& name,
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

TEST(NetcdfAxes, OfTwoDimensionsOfOneKindTheBetterToldTheLongerTheLastIsTheAxis) {
    // Of v(first, second): which is x.
    const auto x = [](std::vector<NcDimension> dimensions, bool firstSays, bool secondSays) {
        NcHeader header;
        header.dimensions = std::move(dimensions);
        for (std::size_t d = 0; d < 2; ++d)
            if (d == 0 ? firstSays : secondSays)
                header.variables.push_back(
                    declared("", header.dimensions[d].name, {d}, {{"axis", "X"}}));
        header.variables.push_back(declared("", "v", {0, 1}));
        return FileAxes(header, {}).rolesOf(header.variables.back()).x;
    };
    EXPECT_EQ(x({{"a", 4}, {"x", 5}}, true, false), 0u) << "by its attributes, not by its name";
    EXPECT_EQ(x({{"a", 1}, {"x", 5}}, true, false), 0u) << "however short";
    EXPECT_EQ(x({{"x", 4}, {"a", 5}}, false, true), 1u);
    for (const bool said : {false, true}) {  // else by their names
        EXPECT_EQ(x({{"x", 5}, {"lon", 4}}, said, said), 1u);
        EXPECT_EQ(x({{"x", 2}, {"lon", 1}}, said, said), 0u);
        EXPECT_EQ(x({{"x", 1}, {"lon", 1}}, said, said), 1u);
    }
}

TEST(NetcdfAxes, ALongitudeAndALatitudeAlongOneDimensionAreAMesh) {
    // Of v(two, `along`) beside these variables: where its places are listed.
    const auto listedAt = [](std::vector<NcVariable> variables, const char* along = "c") {
        NcHeader header;
        header.dimensions = {{"two", 2}, {along, 9}};
        header.variables = std::move(variables);
        header.variables.push_back(declared("", "v", {0, 1}));
        return FileAxes(header, {}).rolesOf(header.variables.back()).list;
    };
    const auto kind = [](const char* name, std::vector<std::size_t> dimensions,
                         const char* standardName) {
        return declared("", name, std::move(dimensions), {{"standard_name", standardName}});
    };
    const NcVariable lon = kind("clon", {1}, "longitude"), lat = kind("clat", {1}, "latitude");
    EXPECT_EQ(listedAt({lon, lat}), 1u);
    EXPECT_EQ(listedAt({declared("", "area", {0, 1}), lon, lat}), 1u);
    EXPECT_EQ(listedAt({lon}), std::nullopt);
    EXPECT_EQ(listedAt({lat}), std::nullopt);
    EXPECT_EQ(listedAt({lon, kind("below", {1}, "depth")}), std::nullopt);
    EXPECT_EQ(listedAt({lat, kind("below", {1}, "depth")}), std::nullopt);
    EXPECT_EQ(listedAt({lon, kind("rows", {0}, "latitude")}), std::nullopt);
    EXPECT_EQ(listedAt({lon, kind("clat", {0, 1}, "latitude")}), std::nullopt);
    EXPECT_EQ(listedAt({lon, lat, kind("c", {1}, "")}), std::nullopt) << "an axis of its own";
    // The places of something that moves.
    EXPECT_EQ(listedAt({lon, lat}, "time"), std::nullopt);
    const NcVariable when = declared("", "when", {1}, {{"units", "days since 2000-01-01"}});
    EXPECT_EQ(listedAt({lon, lat, when}), std::nullopt);
}

// A box that moves: its middle has a longitude and a latitude at each time.
TEST(NetcdfAxes, PlacesInTimeAreNoMesh) {
    NetcdfBuilder file("a.nc");
    const auto time = file.coordinate("time", 3, "hours since 2000-01-01");
    const int y = file.dimension("y", 2), x = file.dimension("x", 2);
    const int lon = file.variable("lon", NC_DOUBLE, {time.dimension}),
              lat = file.variable("lat", NC_DOUBLE, {time.dimension});
    file.text(lon, "units", "degrees_east");
    file.text(lat, "units", "degrees_north");
    file.variable("v", NC_FLOAT, {time.dimension, y, x});
    file.write(time.variable, ramp(3, 0, 1));
    EXPECT_EQ(open(file.close())->variables()[0].time->points.size(), 3u);
}

TEST(NetcdfAxes, CoordinatesBoundsAndLinesAreNotListed) {
    NetcdfBuilder file("a.nc");
    const auto y = file.coordinate("lat", 2, "degrees_north"),
               x = file.coordinate("lon", 3, "degrees_east");
    const int bounds = file.dimension("bnds", 2), members = file.dimension("member", 4);
    file.text(y.variable, "bounds", "lat_bnds");
    file.variable("lat_bnds", NC_DOUBLE, {y.dimension, bounds});
    file.variable("corner", NC_DOUBLE, {y.dimension, x.dimension});
    file.variable("line", NC_DOUBLE, {x.dimension});
    file.variable("scalar", NC_DOUBLE, {});
    file.variable("name", NC_CHAR, {y.dimension, x.dimension});
    file.variable("ensemble", NC_FLOAT, {members, y.dimension, x.dimension});
    const int v = file.variable("v", NC_FLOAT, {y.dimension, x.dimension});
    file.text(v, "coordinates", "corner");
    file.text(v, "long_name", "what is drawn");
    file.write(y.variable, ramp(2, 0, 1));
    file.write(x.variable, ramp(3, 0, 1));
    const auto reader = open(file.close());
    EXPECT_THAT(names(*reader), ElementsAre("v"));
    EXPECT_EQ(reader->variables()[0].longName, "what is drawn");
    EXPECT_THAT(reader->variables()[0].notes, IsEmpty());
}

TEST(NetcdfAxes, WhatIsPassedOverIsToldWhenNothingIsLeft) {
    NetcdfBuilder file("a.nc");
    const int m = file.dimension("member", 4), y = file.dimension("y", 2),
              x = file.dimension("x", 2);
    file.variable("v", NC_FLOAT, {m, y, x});
    const Path path = file.close();
    try {
        open(path);
        FAIL();
    } catch (const FileError& error) {
        EXPECT_EQ(std::string(error.what()),
                  path.string() +
                      ": expected a numeric variable with at least two spatial "
                      "dimensions, found none; v(member, y, x): the dimension member "
                      "of 4 is none of x, y, z and time");
    }
}

TEST(NetcdfAxes, UnevenLevelsAreRectilinearAndDownIsToldByPositiveOrPressure) {
    struct Case {
        const char *units, *positive, *standardName;
        bool down;
    };
    const std::vector<Case> cases{
        {"m", "down", "", true},    {"m", "Down", "", true},  {"m", "up", "", false},
        {"m", "", "", false},       {"m", "", "depth", true}, {"Pa", "", "", true},
        {"millibar", "", "", true}, {"hPa", "up", "", false}, {"1", "down", "", true}};
    const std::vector<double> levels{0, 1, 10, 100, 1000};
    for (const Case& c : cases) {
        NetcdfBuilder file("a.nc");
        const auto z = file.coordinate("lev", 5, c.units);
        if (*c.positive) file.text(z.variable, "positive", c.positive);
        if (*c.standardName) file.text(z.variable, "standard_name", c.standardName);
        const auto y = file.coordinate("y", 2, "m"), x = file.coordinate("x", 2, "m");
        file.variable("v", NC_FLOAT, {z.dimension, y.dimension, x.dimension});
        file.write(z.variable, levels);
        file.write(y.variable, ramp(2, 1, -1));
        file.write(x.variable, ramp(2, 0, 1));
        const auto reader = open(file.close());
        const Axis& axis = reader->variables()[0].grid->axes()[2];
        EXPECT_EQ(axis.coordinates, levels);
        EXPECT_EQ(axis.down, c.down) << c.units << ' ' << c.positive;
        EXPECT_EQ(axis.units, c.units);
        EXPECT_FALSE(reader->variables()[0].grid->axes()[1].down);
        EXPECT_THAT(reader->variables()[0].grid->axes()[1].coordinates, ElementsAre(1, 0))
            << "descending as stored";
    }
}

TEST(NetcdfAxes, CoordinatesThatCannotPlacePointsAreCountedAndTold) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const std::vector<double>& bad : {std::vector<double>{0, 1, 1},
                                           {0, 2, 1},
                                           {0, nan, 2},
                                           {0, NC_FILL_DOUBLE, 2},
                                           {0, 1, NC_FILL_DOUBLE},
                                           {0, 1, HUGE_VAL}}) {
        NetcdfBuilder file("a.nc");
        const auto y = file.coordinate("y", 2, "m"), x = file.coordinate("x", 3, "m");
        file.variable("v", NC_FLOAT, {y.dimension, x.dimension});
        file.write(y.variable, ramp(2, 5, 1));
        file.write(x.variable, bad);
        const auto reader = open(file.close());
        const Variable& v = reader->variables()[0];
        EXPECT_THAT(v.grid->axes()[0].coordinates, ElementsAre(0, 1, 2));
        EXPECT_EQ(v.grid->axes()[0].units, "index");
        EXPECT_THAT(v.grid->axes()[1].coordinates, ElementsAre(5, 6));
        ASSERT_EQ(v.notes.size(), 1u);
        EXPECT_THAT(v.notes[0], HasSubstr("x is placed by index: its coordinates are not"));
    }
}

// field(j, i) with lon(j, i), lat(j, i); the 1-D coordinates i and j in the given units or none.
std::vector<std::string> notesOfCurvilinear(const char* units) {
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
        file.write(id, ramp(3, 1, 1));
        NetcdfBuilder::check(nc_inq_varid(file.id(), "j", &id));
        file.write(id, ramp(2, 1, 1));
    }
    const auto reader = open(file.close());
    EXPECT_THAT(names(*reader), ElementsAre("v"));
    const auto& axes = reader->variables()[0].grid->axes();
    const bool index = !has || std::string(units) == "1";
    EXPECT_EQ(axes[0].units, index ? "index" : units);
    EXPECT_THAT(axes[0].coordinates, index ? ElementsAre(0, 1, 2) : ElementsAre(1, 2, 3));
    return reader->variables()[0].notes;
}

TEST(NetcdfAxes, TwoDimensionalLongitudesAreToldUnlessMeasuredAxesExist) {
    const std::string note = "drawn in index space: 2-D coordinates lon(j, i) and lat(j, i)";
    EXPECT_THAT(notesOfCurvilinear(""), ElementsAre(note));
    EXPECT_THAT(notesOfCurvilinear("1"), ElementsAre(note)) << "cell numbers place nothing";
    EXPECT_THAT(notesOfCurvilinear("degrees"), IsEmpty()) << "a rotated pole";
    EXPECT_THAT(notesOfCurvilinear("km"), IsEmpty()) << "a map projection";
}

// lon(j, i) and lat(j, i), and what spans other dimensions, or more than one in time.
TEST(NetcdfAxes, TwoDimensionalLongitudesConcernWhatSpansBothOfTheirDimensions) {
    NetcdfBuilder file("a.nc");
    const int t = file.dimension("time", 2), m = file.dimension("member", 1),
              i = file.dimension("i", 5), j = file.dimension("j", 4);
    const auto k = file.coordinate("k", 3, "m");
    const auto longitude = [&](const char* name, const std::vector<int>& dimensions) {
        file.text(file.variable(name, NC_DOUBLE, dimensions), "units", "degrees_east");
    };
    longitude("across", {k.dimension, i});
    longitude("lon", {j, i});
    longitude("moving", {t, j, i});
    longitude("members", {m, t, j, i});
    longitude("along", {j, k.dimension});
    file.variable("v", NC_FLOAT, {k.dimension, j, i});
    file.variable("west", NC_FLOAT, {j, k.dimension});
    file.variable("south", NC_FLOAT, {i, k.dimension});
    file.write(k.variable, std::vector<double>{5, 6, 8});
    const auto reader = open(file.close());
    ASSERT_THAT(names(*reader), ElementsAre("v", "west", "south"));
    const Variable &v = reader->variables()[0], &west = reader->variables()[1],
                   &south = reader->variables()[2];
    EXPECT_THAT(v.notes, ElementsAre("drawn in index space: 2-D coordinates lon(j, i) and "
                                     "moving(time, j, i)"));
    EXPECT_THAT(v.grid->axes()[2].coordinates, ElementsAre(5, 6, 8)) << "heights stay";
    EXPECT_FALSE(v.grid->axes()[0].down || v.grid->axes()[1].down);
    EXPECT_THAT(west.grid->axes()[0].coordinates, ElementsAre(0));
    EXPECT_THAT(west.notes, ElementsAre(HasSubstr("j is placed by index")));
    EXPECT_EQ(west.grid->size(), (std::array<std::size_t, 3>{1, 4, 3}));
    EXPECT_THAT(south.notes, ElementsAre(HasSubstr("i is placed by index")));
    EXPECT_EQ(south.grid->size(), (std::array<std::size_t, 3>{5, 1, 3}));
}

TEST(NetcdfAxes, OfManyTwoDimensionalLongitudesEightAreTold) {
    for (const int count : {8, 9}) {
        NetcdfBuilder file("a.nc");
        const int j = file.dimension("j", 4), i = file.dimension("i", 5);
        std::vector<std::string> told;
        for (int n = 1; n <= count; ++n) {
            const std::string name = fmt::format("lon{}", n);
            file.text(file.variable(name, NC_DOUBLE, {j, i}), "units", "degrees_east");
            if (n <= 8) told.push_back(name + "(j, i)");
        }
        file.variable("v", NC_FLOAT, {j, i});
        EXPECT_THAT(
            open(file.close())->variables()[0].notes,
            ElementsAre(fmt::format("drawn in index space: 2-D coordinates {}{}",
                                    fmt::join(told, " and "), count > 8 ? " and others" : "")));
    }
}

TEST(NetcdfAxes, AnAxisLongerThanAnyGridIsRefused) {
    NetcdfBuilder file("a.nc", NC_CDF5);
    const std::size_t length = (std::size_t{1} << 24) + 1;
    const int y = file.dimension("y", 1), x = file.dimension("x", length);
    const int v = file.variable("v", NC_BYTE, {y, x});
    int before = 0;
    NetcdfBuilder::check(nc_set_fill(file.id(), NC_NOFILL, &before));
    file.write(v, {0, length - 1}, {1, 1}, std::vector<std::int8_t>{1});  // a file with a hole
    EXPECT_THAT(refusalOf(file.close()),
                HasSubstr("expected at most 2^24 points along an axis, found 16777217"));
}

TEST(NetcdfAxes, FourUnknownDimensionsAreTimeAndSpaceAndNoFifth) {
    NcHeader header;
    for (const char* name : {"aa", "bb", "cc", "dd", "ee"}) header.dimensions.push_back({name, 2});
    header.variables = {declared("", "five", {0, 1, 2, 3, 4}), declared("", "four", {1, 2, 3, 4})};
    const FileAxes axes(header, {});
    const Roles five = axes.rolesOf(header.variables[0]), four = axes.rolesOf(header.variables[1]);
    EXPECT_THAT(five.extra, ElementsAre(1));
    EXPECT_EQ(five.t, 0u);
    EXPECT_THAT(four.extra, IsEmpty());
    EXPECT_EQ(four.t, 0u);
}

// CF 1.10, section 4.3.3.
TEST(NetcdfAxes, LevelsThatAreNoHeightsAreTold) {
    // The notes of a variable on levels with these attributes; `more` declares what stands beside.
    const auto notes = [](const std::vector<std::pair<const char*, const char*>>& attributes,
                          auto&& more) {
        Globe file("a.nc");
        const auto lev = file.coordinate("lev", 3, "");
        for (const auto& [name, value] : attributes) file.text(lev.variable, name, value);
        const int v =
            file.variable("v", NC_FLOAT, {lev.dimension, file.lat.dimension, file.lon.dimension});
        more(file, v, lev.dimension);
        file.write(lev.variable, ramp(3, 1, 1));
        const auto reader = open(file.closed());
        EXPECT_THAT(names(*reader), ElementsAre("v"));
        return reader->variables()[0].notes;
    };
    const auto nothing = [](Globe&, int, int) {};
    const std::string told = "lev is a level, not a height: used as it is";
    const char* const sigma = "atmosphere_sigma_coordinate";
    EXPECT_THAT(notes({{"units", "sigma_level"}}, nothing), ElementsAre(told));
    EXPECT_THAT(notes({{"units", "Hybrid_sigma_pressure"}}, nothing), ElementsAre(told));
    EXPECT_THAT(notes({{"standard_name", sigma}}, nothing), ElementsAre(told));
    EXPECT_THAT(notes({{"standard_name", "ocean_s_coordinate_g1"}}, nothing), ElementsAre(told));
    EXPECT_THAT(notes({{"standard_name", sigma}, {"formula_terms", "sigma: lev ps: ps"}}, nothing),
                ElementsAre(told + "; lev has formula terms sigma: lev ps: ps"));
    EXPECT_THAT(notes({{"units", "m"}}, nothing), IsEmpty());
    EXPECT_THAT(notes({{"standard_name", "height"}}, nothing), IsEmpty());
    EXPECT_THAT(notes({{"standard_name", "atmosphere_layer_number"}}, nothing), IsEmpty());
    // What the variable names beside the levels may tell it, if it lies along them.
    const auto beside = [&](bool named, bool along) {
        return notes({{"units", "1"}}, [&](Globe& file, int v, int lev) {
            const int term = file.variable("eta", NC_DOUBLE, {along ? lev : file.lat.dimension});
            file.text(term, "formula_terms", "a: a b: b");
            if (named) file.text(v, "coordinates", "nowhere lev eta");
        });
    };
    EXPECT_THAT(beside(true, true), ElementsAre(told + "; eta has formula terms a: a b: b"));
    EXPECT_THAT(beside(true, false), IsEmpty());
    EXPECT_THAT(beside(false, true), IsEmpty());
}

TEST(NetcdfAxes, VariablesOfOneGridShareIt) {
    NetcdfBuilder file("a.nc");
    const auto t = file.coordinate("time", 2, "s"), y = file.coordinate("y", 2, "m"),
               x = file.coordinate("x", 2, "m");
    file.variable("a", NC_FLOAT, {t.dimension, y.dimension, x.dimension});
    file.variable("b", NC_FLOAT, {t.dimension, y.dimension, x.dimension});
    file.write(t.variable, ramp(2, 0, 1));
    file.write(x.variable, ramp(2, 0, 1));
    file.write(y.variable, ramp(2, 0, 1));
    const auto reader = open(file.close());
    EXPECT_EQ(reader->variables()[0].grid, reader->variables()[1].grid);
    EXPECT_EQ(reader->variables()[0].time, reader->variables()[1].time);
    EXPECT_EQ(reader->read(1, 1).grid, reader->variables()[1].grid);
}

TEST(NetcdfAxes, TheNearestGroupAroundAVariableHasItsCoordinates) {
    NcHeader header;
    header.dimensions = {{"lev", 3}};
    header.variables = {declared("", "lev", {0}), declared("a", "lev", {0}),
                        declared("a/b/c", "lev", {0}), declared("a/b", "v", {0}),
                        declared("d/e", "v", {0})};
    const FileAxes axes(header, {});
    EXPECT_EQ(axes.coordinateOf(header.variables[3], 0), &header.variables[1]);
    EXPECT_EQ(axes.coordinateOf(header.variables[4], 0), &header.variables[0]);
}

TEST(NetcdfAxes, GroupsSeeTheDimensionsAroundThem) {
    NetcdfBuilder file("a.nc");
    const auto y = file.coordinate("lat", 2, "degrees_north"),
               x = file.coordinate("lon", 2, "degrees_east");
    int group = 0, v = 0;
    NetcdfBuilder::check(nc_def_grp(file.id(), "model", &group));
    const std::array<int, 2> dimensions{x.dimension, y.dimension};
    NetcdfBuilder::check(nc_def_var(group, "T", NC_INT, 2, dimensions.data(), &v));
    file.write(y.variable, ramp(2, 0, 1));
    file.write(x.variable, ramp(2, 10, 1));
    const std::array<int, 4> values{1, 2, 3, 4};
    NetcdfBuilder::check(nc_put_var_int(group, v, values.data()));
    const auto reader = open(file.close());
    EXPECT_THAT(names(*reader), ElementsAre("model/T"));
    EXPECT_THAT(reader->variables()[0].grid->axes()[0].coordinates, ElementsAre(10, 11));
    EXPECT_THAT(std::get<std::vector<std::int32_t>>(reader->read(0, 0).values),
                ElementsAre(1, 3, 2, 4));
}

}  // namespace
}  // namespace timeseries
