#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>

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
using Path = std::filesystem::path;
using namespace timeseries::netcdf_axes;

// Each in the words of another writer.
TEST(NetcdfAxes, ValuesOnAMeshWithoutPolygonsAreToldAndRefused) {
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
        file.write(z.variable, evenly(3, 0, 1));
        return file.close();
    };
    const auto nothing = [](NetcdfBuilder&, int) {};
    const std::string told =
        ": variable 'S': expected values on a grid, found them on an unstructured mesh (40 places "
        "listed along ";
    for (const char* along : {"c", "ncells"}) {  // by coordinates, of ICON
        const Path path = written(along == std::string("c"), along, nothing);
        EXPECT_EQ(refusalOf(path),
                  path.string() + told + along +
                      ") of which the file tells neither bounds (CF) nor faces (UGRID, MPAS)");
    }
    const auto ugrid = [](NetcdfBuilder& file, int v) {
        file.text(v, "mesh", "m");
        file.text(v, "location", "face");
    };
    const auto cdi = [](NetcdfBuilder& file, int v) {
        file.text(v, "CDI_grid_type", "unstructured");
    };
    EXPECT_THAT(refusalOf(written(false, "c", ugrid)),
                HasSubstr("on an unstructured mesh of which the file tells"));
    EXPECT_THAT(refusalOf(written(false, "c", cdi)),
                HasSubstr("on an unstructured mesh of which the file tells"));
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
    file.write(time.variable, evenly(3, 0, 1));
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
    file.write(y.variable, evenly(2, 0, 1));
    file.write(x.variable, evenly(3, 0, 1));
    const auto reader = open(file.close());
    EXPECT_THAT(names(*reader), ElementsAre("v", "ensemble:member=0", "ensemble:member=1",
                                            "ensemble:member=2", "ensemble:member=3"));
    EXPECT_EQ(reader->variables()[0].longName, "what is drawn");
    EXPECT_THAT(reader->variables()[0].notes, IsEmpty());
}

TEST(NetcdfAxes, WhatIsPassedOverIsToldWhenNothingIsLeft) {
    NetcdfBuilder file("a.nc");
    const int m = file.dimension("member", 400), y = file.dimension("y", 2),
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
                      "of 400 is none of x, y, z and time, and a variable is shown as 256 at "
                      "most");
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
        file.write(y.variable, evenly(2, 1, -1));
        file.write(x.variable, evenly(2, 0, 1));
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
        file.write(y.variable, evenly(2, 5, 1));
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
        file.write(lev.variable, evenly(3, 1, 1));
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
    file.write(t.variable, evenly(2, 0, 1));
    file.write(x.variable, evenly(2, 0, 1));
    file.write(y.variable, evenly(2, 0, 1));
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

TEST(NetcdfAxes, NamesAreLookedForWhereTheySay) {
    EXPECT_THAT(namesMeant("z", "a/b"), ElementsAre("a/b/z", "a/z", "z"));
    EXPECT_THAT(namesMeant("c/z", "a"), ElementsAre("a/c/z", "c/z"));
    EXPECT_THAT(namesMeant("z", ""), ElementsAre("z"));
    EXPECT_THAT(namesMeant("/z", "a/b"), ElementsAre("z"));
    EXPECT_THAT(namesMeant("/c/z", "a/b"), ElementsAre("c/z"));
    EXPECT_THAT(namesMeant("./z", "a/b"), ElementsAre("a/b/z"));
    EXPECT_THAT(namesMeant("../z", "a/b"), ElementsAre("a/z"));
    EXPECT_THAT(namesMeant("../../c/z", "a/b"), ElementsAre("c/z"));
    EXPECT_THAT(namesMeant("../../../z", "a/b"), IsEmpty());
}

// Another group's has the same dimension, and another height.
TEST(NetcdfAxes, CoordinatesMayBeNamedByTheirPaths) {
    NetcdfBuilder file("a.nc");
    const std::array dimensions{file.dimension("n", 2), file.dimension("y", 2),
                                file.dimension("x", 3)};
    const auto groupOf = [&](const char* name) {
        int id = 0;
        NetcdfBuilder::check(nc_def_grp(file.id(), name, &id));
        return id;
    };
    const auto variableIn = [&](int group, const char* name, int rank) {
        int id = 0;
        NetcdfBuilder::check(nc_def_var(group, name, NC_DOUBLE, rank, dimensions.data(), &id));
        return id;
    };
    const auto say = [](int group, int variable, const char* name, const std::string& text) {
        NetcdfBuilder::check(nc_put_att_text(group, variable, name, text.size(), text.data()));
    };
    for (const auto& [name, first] : {std::pair("A", 5.0), std::pair("B", 105.0)}) {
        const int group = groupOf(name), depth = variableIn(group, "depth", 1);
        say(group, depth, "standard_name", "depth");
        say(group, depth, "units", "m");
        const std::array<double, 2> at{first, first + 5};
        NetcdfBuilder::check(nc_put_var_double(group, depth, at.data()));
    }
    for (const auto& [name, coordinate] :
         {std::pair("absolute", "/B/depth"), std::pair("relative", "../B/depth")}) {
        const int group = groupOf(name);
        say(group, variableIn(group, "T", 3), "coordinates", coordinate);
    }
    const auto reader = open(file.close());
    ASSERT_EQ(reader->variables().size(), 2u);
    for (const Variable& variable : reader->variables())
        EXPECT_THAT(variable.grid->axes()[2].coordinates, ElementsAre(105, 110)) << variable.name;
}

TEST(NetcdfAxes, GroupsSeeTheDimensionsAroundThem) {
    NetcdfBuilder file("a.nc");
    const auto y = file.coordinate("lat", 2, "degrees_north"),
               x = file.coordinate("lon", 2, "degrees_east");
    int group = 0, v = 0;
    NetcdfBuilder::check(nc_def_grp(file.id(), "model", &group));
    const std::array<int, 2> dimensions{x.dimension, y.dimension};
    NetcdfBuilder::check(nc_def_var(group, "T", NC_INT, 2, dimensions.data(), &v));
    file.write(y.variable, evenly(2, 0, 1));
    file.write(x.variable, evenly(2, 10, 1));
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
