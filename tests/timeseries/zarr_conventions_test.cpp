// What the conventions of xarray (CF) say of Zarr arrays.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "tests/support/read_variables.h"
#include "tests/support/zarr_store.h"
#include "timeseries/readers/series_files.h"

namespace timeseries::zarr_conventions {
namespace {

using namespace tests;
using namespace tests::zarr;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

const Layout kVolume{.shape = {3, 2, 3, 4}, .chunk = {1, 2, 3, 4}};

// As xarray's to_zarr() writes a dataset.
TEST(ZarrConventions, DimensionsOfXarrayHaveTheirCoordinates) {
    const auto store = v2Group();
    putCoordinate(store, "lon", {10, 20, 40, 70}, R"("units": "degrees_east")");
    putCoordinate(store, "lat", {-5, 0, 5}, R"("units": "degrees_north")");
    putCoordinate(store, "depth", {100, 500}, R"("units": "m", "positive": "down")");
    putCoordinate(store, "time", {0, 1.5, 2},
                  R"("units": "days since 2000-02-28", "calendar": "noleap")");
    put(store / "temp/.zarray", v2Array(kVolume, "<f4"));
    put(store / "temp/.zattrs",
        R"({"_ARRAY_DIMENSIONS": ["time", "depth", "lat", "lon"], "units": "degC",)"
        R"( "long_name": "temperature"})");
    writeChunks<float>(store / "temp", kVolume, digitsOf<float>);
    const auto reader = open(store);
    ASSERT_THAT(namesOf(*reader), ElementsAre("temp"));
    const Variable& variable = reader->variables()[0];
    EXPECT_EQ(variable.longName, "temperature");
    EXPECT_EQ(variable.units, "degC");
    EXPECT_THAT(variable.notes, IsEmpty());
    const auto& axes = variable.grid->axes();
    EXPECT_EQ(axes[0], (Axis{"lon", "degrees_east", {10, 20, 40, 70}, false}));
    EXPECT_EQ(axes[1], (Axis{"lat", "degrees_north", {-5, 0, 5}, false}));
    EXPECT_EQ(axes[2], (Axis{"depth", "m", {100, 500}, true}));
    // Named alone, it has the coordinates of its group.
    EXPECT_EQ(open(store / "temp")->variables()[0].grid->axes()[0], axes[0]);
    EXPECT_EQ(variable.time->calendar, "noleap");
    EXPECT_EQ(variable.time->points[1].date, "2000-03-01 12:00:00");  // without a 29th
    EXPECT_THAT(
        valuesOf<float>(*reader, "temp", 2),
        ElementsAre(2000, 2001, 2002, 2003, 2010, 2011, 2012, 2013, 2020, 2021, 2022, 2023, 2100,
                    2101, 2102, 2103, 2110, 2111, 2112, 2113, 2120, 2121, 2122, 2123));
}

// NumPy's own, as its arrays are stored without xarray. Seconds from 1970 to 2000-01-01:
// 30 years of 365 days and 7 leap days.
TEST(ZarrConventions, DatesOfNumPyAreDates) {
    constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::min();
    constexpr std::int64_t k2000 = (30 * 365 + 7) * std::int64_t{86400};
    struct Case {
        const char *dtype, *dataType;
        std::int64_t first, second;
    };
    for (const Case& each : std::vector<Case>{
             {"<M8[ns]", R"({"name": "numpy.datetime64", "configuration": {"unit": "ns"}})",
              k2000 * 1'000'000'000, (k2000 + 90) * 1'000'000'000},
             {"<M8[s]",
              R"({"name": "numpy.datetime64", "configuration": {"unit": "s", )"
              R"("scale_factor": 1}})",
              k2000, k2000 + 90},
             {"<M8[30s]",
              R"({"name": "numpy.datetime64", "configuration": {"unit": "s", )"
              R"("scale_factor": 30}})",
              k2000 / 30, k2000 / 30 + 3}}) {
        const Layout times{.shape = {3}, .chunk = {3}};
        const auto write = [&](const std::filesystem::path& folder, const Layout& layout) {
            writeChunks<std::int64_t>(folder, layout, [&](const Lengths& at) {
                return std::array{each.first, each.second, kNone}[at[0]];
            });
        };
        const auto v2 = v2Group();
        put(v2 / "v/.zarray", v2Array(kVolume, "<f4"));
        put(v2 / "v/.zattrs", R"({"_ARRAY_DIMENSIONS": ["time", "z", "y", "x"]})");
        writeChunks<float>(v2 / "v", kVolume, digitsOf<float>);
        put(v2 / "time/.zarray", v2Array(times, each.dtype));
        put(v2 / "time/.zattrs", R"({"_ARRAY_DIMENSIONS": ["time"]})");
        write(v2 / "time", times);

        const auto v3 = v3Group();
        Layout volume = kVolume, own = times;
        volume.keyStart = own.keyStart = "c";
        volume.separator = own.separator = "/";
        put(v3 / "v/zarr.json",
            v3Array(volume, "float32", {{"dimension_names", R"(["time", "z", "y", "x"])"}}));
        writeChunks<float>(v3 / "v", volume, digitsOf<float>);
        put(v3 / "time/zarr.json", v3Array(own, "int64",
                                           {{"data_type", each.dataType},
                                            {"dimension_names", R"(["time"])"},
                                            {"fill_value", "\"NaT\""}}));
        write(v3 / "time", own);

        for (const auto& store : {v2, v3}) {
            const auto reader = open(store);
            ASSERT_THAT(namesOf(*reader), ElementsAre("v"));
            const auto& points = reader->variables()[0].time->points;
            EXPECT_EQ(points[0].date, "2000-01-01 00:00:00") << each.dtype;
            EXPECT_EQ(points[1].date, "2000-01-01 00:01:30") << each.dtype;
            EXPECT_EQ(points[2].date, "") << each.dtype;
            EXPECT_TRUE(std::isnan(points[2].value)) << each.dtype;
        }
    }
}

TEST(ZarrConventions, DimensionsOfAnyOrderAreTurned) {
    const auto store = v3Group();
    const Layout layout{.shape = {4, 3, 2}, .chunk = {3, 2, 2}, .keyStart = "c", .separator = "/"};
    put(store / "v/zarr.json",
        v3Array(layout, "int32", {{"dimension_names", R"(["lon", "lat", "lev"])"}}));
    writeChunks<std::int32_t>(store / "v", layout, digitsOf<std::int32_t>);
    const auto reader = open(store);
    EXPECT_EQ(reader->variables()[0].grid->size(), (std::array<std::size_t, 3>{4, 3, 2}));
    EXPECT_THAT(valuesOf<std::int32_t>(*reader, "v"),
                ElementsAre(0, 100, 200, 300, 10, 110, 210, 310, 20, 120, 220, 320, 1, 101, 201,
                            301, 11, 111, 211, 311, 21, 121, 221, 321));
}

TEST(ZarrConventions, PackedNumbersAreUnpacked) {
    const auto store = v2Group();
    const Layout layout{.shape = {2, 2, 2}, .chunk = {2, 2, 2}};
    put(store / "v/.zarray", v2Array(layout, "<i2", {{"fill_value", "-1"}}));
    put(store / "v/.zattrs",
        R"({"_ARRAY_DIMENSIONS": ["z", "y", "x"], "scale_factor": 0.5, "add_offset": 100, )"
        R"("long_name": "Infinity"})");
    writeChunks<std::int16_t>(store / "v", layout, [](const Lengths& at) {
        const auto n = digitsOf<std::int16_t>(at);
        return static_cast<std::int16_t>(n == 11 ? -1 : n);
    });
    const auto reader = open(store);
    EXPECT_EQ(reader->variables()[0].storedAs, "int16 packed, scale 0.5, offset 100");
    EXPECT_EQ(reader->variables()[0].missing, "_FillValue -1");
    EXPECT_EQ(reader->variables()[0].longName, "Infinity");
    const Field field = reader->read(0, 0);
    EXPECT_THAT(std::get<std::vector<double>>(field.values),
                ElementsAre(100, 100.5, 105, 99.5, 150, 150.5, 155, 155.5));
    EXPECT_THAT(field.missing, ElementsAre(false, false, false, true, false, false, false, false));
}

// Values 0 to 7; which are missing?
std::vector<bool> missingOf(bool isV3, const std::string& fill, const std::string& attributes) {
    const Layout layout{.shape = {2, 2, 2},
                        .chunk = {2, 2, 2},
                        .keyStart = isV3 ? "c" : "",
                        .separator = isV3 ? "/" : "."};
    const auto store = isV3 ? v3Group() : v2Group();
    if (isV3) {
        put(store / "v/zarr.json",
            v3Array(layout, "float64", {{"fill_value", fill}, {"attributes", attributes}}));
    } else {
        put(store / "v/.zarray", v2Array(layout, "<f8", {{"fill_value", fill}}));
        put(store / "v/.zattrs", attributes);
    }
    writeChunks<double>(store / "v", layout, [](const Lengths& at) {
        return static_cast<double>(4 * at[0] + 2 * at[1] + at[2]);
    });
    return open(store)->read(0, 0).missing;
}

TEST(ZarrConventions, WhatIsMissingIsWhatXarrayCallsSo) {
    const auto only = [](std::size_t which) {
        std::vector<bool> missing(8, false);
        missing[which] = true;
        return missing;
    };
    const std::string dimensions = R"("_ARRAY_DIMENSIONS": ["z", "y", "x"])";
    // xarray puts _FillValue of version 2 nowhere but there.
    EXPECT_EQ(missingOf(false, "3", "{" + dimensions + "}"), only(3));
    // Others' fill is a value, like zarr's own 0.
    EXPECT_THAT(missingOf(false, "0", "{}"), IsEmpty());
    EXPECT_THAT(missingOf(true, "3", "{}"), IsEmpty());
    EXPECT_EQ(missingOf(false, "0", R"({"_FillValue": 5})"), only(5));
    EXPECT_EQ(missingOf(false, "3", "{" + dimensions + R"(, "_FillValue": 5})"), only(5));
    EXPECT_EQ(missingOf(true, "0", R"({"_FillValue": 5.0, "missing_value": 5})"), only(5));
    EXPECT_EQ(missingOf(true, "0", R"({"missing_value": [2]})"), only(2));
    // 6.0 as xarray writes it for version 3: its bytes in base64.
    EXPECT_EQ(missingOf(true, "0", R"({"_FillValue": "AAAAAAAAGEA="})"), only(6));
    // Python's words are no JSON, and all the same there.
    EXPECT_THAT(missingOf(false, "NaN",
                          "{" + dimensions +
                              R"(, "missing_value": NaN, "a": "NaN)"
                              R"( \" NaN", "range": [-Infinity, Infinity]})"),
                IsEmpty());
    EXPECT_EQ(missingOf(false, "\"NaN\"", R"({"valid_range": [-Infinity, 6]})"), only(7));
}

TEST(ZarrConventions, LongitudesOfTwoDimensionsPlaceColumns) {
    const auto store = v2Group();
    const Layout flat{.shape = {3, 4}, .chunk = {3, 4}},
        volume{.shape = {2, 3, 4}, .chunk = {2, 3, 4}};
    for (const std::string name : {"lon", "lat"}) {
        put(store / name / ".zarray", v2Array(flat, "<f8"));
        put(store / name / ".zattrs",
            fmt::format(R"({{"_ARRAY_DIMENSIONS": ["j", "i"], "units": "degrees_{}"}})",
                        name == "lon" ? "east" : "north"));
        writeChunks<double>(store / name, flat, [&](const Lengths& at) {
            const auto j = static_cast<double>(at[0]), i = static_cast<double>(at[1]);
            return name == "lon" ? i + 0.25 * j : j - 0.125 * i;
        });
    }
    put(store / "v/.zarray", v2Array(volume, "<f4"));
    put(store / "v/.zattrs",
        R"({"_ARRAY_DIMENSIONS": ["lev", "j", "i"], "coordinates": "lon lat"})");
    for (const auto& path : {store, store / "v"}) {
        const auto reader = open(path);
        ASSERT_THAT(namesOf(*reader), ElementsAre("v"));
        const Grid& grid = *reader->variables()[0].grid;
        ASSERT_TRUE(grid.mesh()) << path;
        EXPECT_LT(glm::distance(grid.position(12 + 2 * 4 + 3), glm::dvec3(3.5, 1.625, 1)), 1e-6);
    }
}

TEST(ZarrConventions, GroupsSeeTheCoordinatesAroundThem) {
    const auto store = v3Group();
    const auto array = [&](const std::string& name, const Layout& layout,
                           const std::string& dimensions) {
        put(store / name / "zarr.json",
            v3Array(layout, "float32", {{"dimension_names", dimensions}}));
        writeChunks<float>(store / name, layout, digitsOf<float>);
    };
    Layout line{.shape = {4}, .chunk = {4}, .keyStart = "c", .separator = "/"};
    array("x", line, R"(["x"])");
    put(store / "runs/zarr.json", R"({"zarr_format": 3, "node_type": "group"})");
    put(store / "runs/a/zarr.json", R"({"zarr_format": 3, "node_type": "group"})");
    Layout layout{.shape = {2, 3, 4}, .chunk = {2, 3, 4}, .keyStart = "c", .separator = "/"};
    array("runs/a/v", layout, R"(["z", "y", "x"])");
    const auto reader = open(store);
    ASSERT_THAT(namesOf(*reader), ElementsAre("runs/a/v"));
    EXPECT_EQ(reader->variables()[0].grid->axes()[0], (Axis{"x", "", {0, 1, 2, 3}, false}));
    EXPECT_EQ(reader->variables()[0].grid->axes()[1].units, "index");
    // From within, nobody sees them.
    EXPECT_THAT(namesOf(*open(store / "runs")), ElementsAre("a/v"));
}

TEST(ZarrConventions, StoresAreJoinedByTheirTimes) {
    const auto folder = freshFolder();
    std::vector<std::filesystem::path> stores;
    for (int i = 0; i < 3; ++i) {
        const auto store = folder / fmt::format("run{}.zarr", i);
        stores.push_back(store);
        put(store / ".zgroup", R"({"zarr_format": 2})");
        putCoordinate(store, "time", {i * 2.0, i * 2.0 + 1}, R"("units": "s", "axis": "T")");
        Layout layout{.shape = {2, 2, 2, 2}, .chunk = {1, 2, 2, 2}};
        put(store / "v/.zarray", v2Array(layout, "<i4"));
        put(store / "v/.zattrs", R"({"_ARRAY_DIMENSIONS": ["time", "z", "y", "x"]})");
        writeChunks<std::int32_t>(store / "v", layout, [&](const Lengths& at) {
            return static_cast<std::int32_t>(100 * i) + digitsOf<std::int32_t>(at);
        });
    }
    const auto reader = openReader(stores);
    EXPECT_THAT(timesOf(*reader), ElementsAre(0, 1, 2, 3, 4, 5));
    EXPECT_EQ(valuesOf<std::int32_t>(*reader, "v", 3)[0], 1100);
    EXPECT_EQ(valuesOf<std::int32_t>(*reader, "v", 4)[7], 311);
    // Named by any of them, or by their folder, as files are.
    put(folder / "readme.txt", "of three runs");
    for (const std::filesystem::path& named : {stores[1], stores[1] / "", folder})
        EXPECT_EQ(expandSeries(std::span(&named, 1)).files, stores) << named;
    const auto array = stores[1] / "v";
    EXPECT_THAT(expandSeries(std::span(&array, 1)).files, ElementsAre(array));
}

TEST(ZarrConventions, DimensionsWithoutNamesAreTimeAndSpace) {
    for (const auto& [shape, steps, size] :
         std::vector<std::tuple<Lengths, std::size_t, std::array<std::size_t, 3>>>{
             {{2, 3, 4}, 1, {4, 3, 2}},
             {{5, 2, 3, 4}, 5, {4, 3, 2}},
             {{5, 1, 3, 4}, 5, {4, 3, 1}},
             {{1, 2, 3, 4}, 1, {4, 3, 2}},
             {{5, 1, 2, 3, 4}, 5, {4, 3, 2}},
             {{1, 5, 2, 3, 4}, 5, {4, 3, 2}}}) {
        const Layout layout{.shape = shape, .chunk = shape};
        const auto store = v2Group();
        put(store / "v/.zarray", v2Array(layout, "<i4"));
        writeChunks<std::int32_t>(store / "v", layout, digitsOf<std::int32_t>);
        const auto reader = open(store);
        EXPECT_EQ(reader->variables()[0].grid->size(), size) << listed(shape);
        EXPECT_EQ(reader->variables()[0].time->points.size(), steps) << listed(shape);
        EXPECT_TRUE(reader->variables()[0].time->counted);
    }
    // Of two dimensions without names it is a table.
    auto store = v2Group();
    for (const Lengths& shape : {Lengths{6, 7}, Lengths{2, 3, 4}})
        put(store / std::to_string(shape.size()) / ".zarray",
            v2Array({.shape = shape, .chunk = shape}, "<i4"));
    EXPECT_THAT(namesOf(*open(store)), ElementsAre("3"));
    const Layout layout{.shape = {257, 2, 2, 3, 4}, .chunk = {1, 2, 2, 3, 4}};
    store = v2Group();
    put(store / "v/.zarray", v2Array(layout, "<i4"));
    EXPECT_THAT(refusalOf(store),
                HasSubstr("the dimension dim_0 of 257 is none of x, y, z and time"));
}

}  // namespace
}  // namespace timeseries::zarr_conventions
