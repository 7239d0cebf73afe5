#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "tests/support/netcdf_builder.h"
#include "timeseries/reader.h"

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
    }
    EXPECT_EQ(reader->variables()[0].time->points[4].value, 4.0) << "counted";
    EXPECT_THAT(reader->variables()[0].notes,
                testing::Contains("dd is placed by index: the file has no coordinates for it"));
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
