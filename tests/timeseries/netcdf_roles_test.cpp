// Which dimension is which axis, of one variable and of all in a file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "tests/support/netcdf_axes.h"
#include "tests/support/netcdf_builder.h"
#include "timeseries/readers/cf/cf_axes.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using tests::NetcdfBuilder;
using namespace timeseries::netcdf_axes;

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
        file.write(a.variable, evenly(2, 0, 1));
        file.write(b.variable, evenly(3, 0, 1));
        file.write(c.variable, evenly(4, 0, 1));
        file.write(d.variable, evenly(5, 0, 1));
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
                testing::Contains("dd, cc and bb are placed by index: "
                                  "the file has no coordinates for them"));
}

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
    swath.write(scanned, evenly(4, 0, 1));
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
    file.write(time.variable, evenly(2, 0, 1));
    file.write(run.variable, evenly(3, 0, 1));
    const auto reader = open(file.closed());
    ASSERT_EQ(reader->variables().size(), 3u);
    EXPECT_EQ(reader->variables()[2].name, "v:run=2");
    EXPECT_EQ(reader->variables()[2].time->points.size(), 2u);
    EXPECT_EQ(reader->variables()[2].grid->size()[2], 1u);
}

// As cfgrib has them: the valid times, where there are such along the steps.
TEST(NetcdfAxes, ForecastsGoByTheirTimes) {
    for (const bool isValid : {false, true}) {
        Globe file("a.nc");
        const auto step = file.coordinate("step", 3, "hours");
        file.text(step.variable, "standard_name", "forecast_period");
        const int valid = file.variable("valid_time", NC_DOUBLE, {step.dimension});
        file.text(valid, "standard_name", isValid ? "time" : "air_temperature");
        file.text(valid, "units", isValid ? "hours since 2000-01-01" : "K");
        const int run = file.variable("time", NC_DOUBLE, {});
        file.text(run, "standard_name", "forecast_reference_time");
        file.text(run, "units", "hours since 1999-12-31");
        const int t =
            file.variable("t", NC_FLOAT, {step.dimension, file.lat.dimension, file.lon.dimension});
        file.text(t, "coordinates", "time step latitude longitude valid_time");
        file.write(step.variable, std::vector<double>{3, 6, 12});
        file.write(valid, std::vector<double>{27, 30, 36});
        const auto reader = open(file.closed());
        ASSERT_THAT(names(*reader), ElementsAre("t"));
        const TimeAxis& time = *reader->variables()[0].time;
        ASSERT_EQ(time.points.size(), 3u);
        EXPECT_EQ(time.points[2].value, isValid ? 36 : 12);
        EXPECT_EQ(time.points[2].date, isValid ? "2000-01-02 12:00:00" : "");
        EXPECT_EQ(time.units, isValid ? "hours since 2000-01-01" : "hours");
    }
}

// Of when forecasts began and how long before, the latter; beside a time that is told, members.
TEST(NetcdfAxes, ForecastsOfSeveralRunsAreMembers) {
    for (const char* other : {"forecast_reference_time", "time", ""}) {
        Globe file("a.nc");
        const auto run = file.coordinate("time", 2, "hours since 2000-01-01"),
                   step = file.coordinate("step", 3, "hours");
        if (*other != '\0') file.text(run.variable, "standard_name", other);
        file.text(step.variable, "standard_name", "forecast_period");
        file.variable("t", NC_FLOAT,
                      {run.dimension, step.dimension, file.lat.dimension, file.lon.dimension});
        file.write(run.variable, std::vector<double>{0, 24});
        file.write(step.variable, std::vector<double>{3, 6, 12});
        const auto reader = open(file.closed());
        const bool areRuns = std::string_view(other) == "forecast_reference_time";
        ASSERT_EQ(reader->variables().size(), areRuns ? 2u : 3u) << other;
        EXPECT_EQ(reader->variables()[1].name, areRuns ? "t:time=24" : "t:step=6");
        EXPECT_EQ(reader->variables()[1].time->points.size(), areRuns ? 3u : 2u);
    }
    Globe alone("b.nc");
    const auto began = alone.coordinate("initial", 3, "hours since 2000-01-01");
    alone.text(began.variable, "standard_name", "forecast_reference_time");
    alone.variable("t", NC_FLOAT, {began.dimension, alone.lat.dimension, alone.lon.dimension});
    alone.write(began.variable, std::vector<double>{0, 6, 12});
    const auto reader = open(alone.closed());
    ASSERT_THAT(names(*reader), ElementsAre("t"));
    EXPECT_EQ(reader->variables()[0].time->points[1].date, "2000-01-01 06:00:00");
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

}  // namespace
}  // namespace timeseries
