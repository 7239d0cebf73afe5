#include "timeseries/readers/reader.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <thread>

#include "tests/support/netcdf_plane.h"
#include "tests/support/read_variables.h"
#include "timeseries/index/sorted_step.h"

namespace timeseries {
namespace {

using testing::ElementsAre;
using tests::asValues;
using tests::ncType;
using tests::NetcdfBuilder;
using tests::open;
using tests::plane;
using Path = std::filesystem::path;

// "x0 y1 z2" of each point, from a value that encodes its place in the file.
template <typename T>
void expectPlaces(NetcdfBuilder& file, std::mt19937& random, const std::string& message) {
    // Time, x, y, z and perhaps a dimension of one point, in any order.
    std::vector<std::string> names{"time", "z", "y", "x"};
    if (random() % 2) names.push_back("one");
    if (random() % 4 == 0) std::erase(names, "z");
    if (random() % 4 == 0) std::erase(names, "time");
    std::ranges::shuffle(names, random);
    std::vector<int> dimensions;
    std::map<std::string, std::size_t> length;
    for (const std::string& name : names) {
        length[name] = name == "one" ? 1 : 1 + random() % 4;
        dimensions.push_back(file.dimension(name, length[name]));
    }
    const int variable = file.variable("v", ncType<T>(), dimensions);
    std::size_t total = 1;
    for (const auto& [name, n] : length) total *= n;
    std::vector<T> stored(total);
    for (std::size_t i = 0; i < total; ++i) stored[i] = static_cast<T>(i % 120);
    file.write(variable, stored);
    const auto reader = open(file.close());

    ASSERT_EQ(reader->variables().size(), 1u) << message;
    const auto n = [&](const char* name) { return length.contains(name) ? length[name] : 1; };
    const Variable& v = reader->variables()[0];
    ASSERT_EQ(v.type, static_cast<ValueType>(Values(std::vector<T>{}).index())) << message;
    ASSERT_EQ(v.grid->size(), (std::array{n("x"), n("y"), n("z")})) << message;
    ASSERT_EQ(v.time->points.size(), n("time")) << message;
    for (std::size_t t = 0; t < n("time"); ++t) {
        const Field field = reader->read(0, t);
        EXPECT_TRUE(field.missing.empty()) << message;
        std::size_t point = 0;
        for (std::size_t z = 0; z < n("z"); ++z)
            for (std::size_t y = 0; y < n("y"); ++y)
                for (std::size_t x = 0; x < n("x"); ++x, ++point) {
                    const std::map<std::string, std::size_t> at{
                        {"time", t}, {"z", z}, {"y", y}, {"x", x}, {"one", 0}};
                    std::size_t offset = 0;
                    for (const std::string& name : names)
                        offset = offset * length[name] + at.at(name);
                    ASSERT_EQ(asValues<T>(field)[point], stored[offset])
                        << message
                        << fmt::format(" at x {} y {} z {} t {} of {}", x, y, z, t,
                                       fmt::join(names, ","));
                }
    }
}

TEST(NetcdfReader, EveryValueLandsInItsPlaceWhateverTheOrderOfDimensionsAndTheType) {
    std::mt19937 random(11);
    for (int i = 0; i < 60; ++i) {
        const std::string name = fmt::format("{}.nc", i);
        const std::string message = "case " + name;
        NetcdfBuilder file(name, i % 3 == 0 ? NC_CDF5 : NC_NETCDF4);
        switch (i % 10) {
            case 0:
                expectPlaces<std::int8_t>(file, random, message);
                break;
            case 1:
                expectPlaces<std::uint8_t>(file, random, message);
                break;
            case 2:
                expectPlaces<std::int16_t>(file, random, message);
                break;
            case 3:
                expectPlaces<std::uint16_t>(file, random, message);
                break;
            case 4:
                expectPlaces<std::int32_t>(file, random, message);
                break;
            case 5:
                expectPlaces<std::uint32_t>(file, random, message);
                break;
            case 6:
                expectPlaces<std::int64_t>(file, random, message);
                break;
            case 7:
                expectPlaces<std::uint64_t>(file, random, message);
                break;
            case 8:
                expectPlaces<float>(file, random, message);
                break;
            default:
                expectPlaces<double>(file, random, message);
                break;
        }
    }
}

TEST(NetcdfReader, PackedShortsAreComparedWithFillBeforeUnpacking) {
    // 20 unpacks to 22, 22 to 26: the fill is the stored 22.
    const auto path =
        plane<std::int16_t>("a.nc", {20, 22, 24, -1, 1000, 0}, [](NetcdfBuilder& file, int v) {
            file.number(v, "scale_factor", 2.0);
            file.number(v, "add_offset", -18.0);
            file.number<std::int16_t>(v, "_FillValue", 22);
        });
    const auto reader = open(path);
    EXPECT_EQ(reader->variables()[0].type, ValueType::F64);
    const Field field = reader->read(0, 0);
    EXPECT_THAT(asValues<double>(field), ElementsAre(22, 26, 30, -20, 1982, -18));
    EXPECT_THAT(field.missing, ElementsAre(false, true, false, false, false, false));
}

template <typename Stored, typename Scale>
ValueType unpackedType(const std::string& name) {
    const auto path = plane<Stored>(name, {1, 2, 3, 4}, [](NetcdfBuilder& file, int v) {
        file.number<Scale>(v, "scale_factor", 2);
    });
    const auto reader = open(path);
    const Field field = reader->read(0, 0);
    EXPECT_EQ(field.type(), reader->variables()[0].type);
    std::visit([&](const auto& v) { EXPECT_EQ(v[3], static_cast<decltype(v[3])>(8)) << name; },
               field.values);
    return field.type();
}

// CF 1.11, section 3.5: flags are names of classes, between which nothing lies.
TEST(NetcdfReader, FlagsAreCategories) {
    NetcdfBuilder file("flags.nc");
    const int d = file.dimension("x", 4), e = file.dimension("y", 3), f = file.dimension("z", 2);
    const int type = file.variable("type", NC_BYTE, {f, e, d});
    file.number(type, "flag_values", std::vector<std::int8_t>{0, 1, 2});
    file.text(type, "flag_meanings", "sea land lake_ice");
    const int height = file.variable("height", NC_BYTE, {f, e, d});
    for (const int variable : {type, height}) file.write(variable, std::vector<std::int8_t>(24, 1));
    const auto reader = open(file.close());
    ASSERT_EQ(reader->variables().size(), 2u);
    for (std::size_t v = 0; v < 2; ++v) {
        const bool expected = reader->variables()[v].name == "type";
        EXPECT_EQ(reader->variables()[v].categories, expected);
        EXPECT_EQ(reader->read(v, 0).categories, expected);
        EXPECT_EQ(SortedStep::build(reader->read(v, 0)).canHaveCells(), !expected);
        EXPECT_EQ(reader->variables()[v].classes,
                  expected ? (std::vector<ClassName>{{0, "sea"}, {1, "land"}, {2, "lake ice"}})
                           : std::vector<ClassName>());
    }
}

TEST(NetcdfReader, UnpackedTypeIsThatOfTheScaleAndNeverLosesIntegers) {
    // CF 1.10, section 8.1: float scales are for integers of at most 16 bits.
    EXPECT_EQ((unpackedType<std::int8_t, float>("1")), ValueType::F32);
    EXPECT_EQ((unpackedType<std::uint8_t, float>("2")), ValueType::F32);
    EXPECT_EQ((unpackedType<std::int16_t, float>("3")), ValueType::F32);
    EXPECT_EQ((unpackedType<std::uint16_t, float>("4")), ValueType::F32);
    EXPECT_EQ((unpackedType<std::int32_t, float>("5")), ValueType::F64);
    EXPECT_EQ((unpackedType<std::int16_t, double>("6")), ValueType::F64);
    EXPECT_EQ((unpackedType<float, double>("7")), ValueType::F64);
    EXPECT_EQ((unpackedType<float, float>("8")), ValueType::F32);
    EXPECT_EQ((unpackedType<double, float>("9")), ValueType::F64);
    EXPECT_EQ((unpackedType<std::int16_t, std::int16_t>("10")), ValueType::F64);
}

TEST(NetcdfReader, FloatScalesAreAppliedInFloatAsCfSays) {
    const auto path = plane<std::int16_t>("a.nc", {1234, -777, 31, 5}, [](auto& file, int v) {
        file.template number<float>(v, "scale_factor", 0.1f);
        file.template number<float>(v, "add_offset", 0.3f);
    });
    const Field field = open(path)->read(0, 0);
    const std::int16_t stored[] = {1234, -777, 31, 5};
    for (std::size_t i = 0; i < 4; ++i) {
        const float product = static_cast<float>(stored[i]) * 0.1f;
        EXPECT_EQ(asValues<float>(field)[i], product + 0.3f);
    }
}

TEST(NetcdfReader, SixtyFourBitIntegersStayExact) {
    const std::int64_t big = (std::int64_t{1} << 62) + 1;
    const auto path = plane<std::int64_t>("a.nc", {big, -big, 0, big - 1}, [](auto& file, int v) {
        file.number(v, "_FillValue", std::int64_t{1} << 62);
        file.number(v, "scale_factor", 1.0);  // a scale of one changes nothing
    });
    const Field field = open(path)->read(0, 0);
    EXPECT_THAT(asValues<std::int64_t>(field), ElementsAre(big, -big, 0, big - 1));
    EXPECT_THAT(field.missing, ElementsAre(false, false, false, true)) << "exactly the fill";

    const std::uint64_t top = std::numeric_limits<std::uint64_t>::max();
    const auto other = plane<std::uint64_t>("b.nc", {top, top - 1, 1, 0}, [&](auto& file, int v) {
        file.number(v, "_FillValue", top - 1);
    });
    const Field unsignedField = open(other)->read(0, 0);
    EXPECT_THAT(asValues<std::uint64_t>(unsignedField), ElementsAre(top, top - 1, 1, 0));
    EXPECT_THAT(unsignedField.missing, ElementsAre(false, true, false, false));
}

TEST(NetcdfReader, StorageIsToldInTheDigitsOfTheFile) {
    const auto path = plane<std::uint8_t>("a.nc", {1, 2, 3, 4}, [](auto& file, int v) {
        file.number(v, "scale_factor", 0.1f);
        file.template number<std::uint8_t>(v, "_FillValue", 255);
        file.number(v, "missing_value", std::vector<std::uint8_t>{255, 254});
    });
    const auto reader = open(path);
    EXPECT_EQ(reader->variables()[0].storedAs, "uint8 packed, scale 0.1, offset 0");
    EXPECT_EQ(reader->variables()[0].missing, "_FillValue 255, missing_value 254");
    const auto floats = plane<float>("b.nc", {1, 2, 3, 4}, [](auto& file, int v) {
        file.number(v, "_FillValue", -1e34f);
        file.number(v, "missing_value", 1e300);  // no float: it stands for none
    });
    EXPECT_EQ(open(floats)->variables()[0].missing, "_FillValue -1e+34");
}

TEST(NetcdfReader, FormatsAreNamed) {
    const std::vector<std::pair<int, std::string>> formats{
        {0, "NetCDF classic"},
        {NC_64BIT_OFFSET, "NetCDF 64-bit offset"},
        {NC_CDF5, "NetCDF-5 (CDF-5)"},
        {NC_NETCDF4, "NetCDF-4"},
        {NC_NETCDF4 | NC_CLASSIC_MODEL, "NetCDF-4 classic model"}};
    for (const auto& [mode, name] : formats) {
        const auto reader = open(plane<float>(
            "a.nc", {1, 2, 3, 4}, [](auto&, int) {}, mode));
        EXPECT_EQ(reader->format(), name);
        EXPECT_EQ(reader->variables()[0].storedAs, "float32");
        EXPECT_THAT(asValues<float>(reader->read(0, 0)), ElementsAre(1, 2, 3, 4));
    }
}

TEST(NetcdfReader, ReadersOnDifferentThreadsDoNotDisturbEachOther) {
    std::vector<Path> paths;
    for (int i = 0; i < 4; ++i)
        paths.push_back(plane<float>(
            fmt::format("{}.nc", i), std::vector<float>(2000, static_cast<float>(i)),
            [](auto&, int) {}, i % 2 ? NC_NETCDF4 : 0));
    std::vector<int> wrong(paths.size(), 0);
    {
        std::vector<std::jthread> threads;
        for (std::size_t i = 0; i < paths.size(); ++i)
            threads.emplace_back([&, i] {
                for (int round = 0; round < 30; ++round) {
                    const Field field = open(paths[i])->read(0, 0);
                    for (const float v : asValues<float>(field))
                        wrong[i] += v != static_cast<float>(i);
                }
            });
    }
    EXPECT_THAT(wrong, testing::Each(0));
}

TEST(NetcdfReader, EachFileOfASeriesHasItsOwnPacking) {
    const auto packed = [](const std::string& name, double time, double offset) {
        NetcdfBuilder file(name);
        const auto t = file.coordinate("time", 1, "s");
        const int y = file.dimension("y", 2), x = file.dimension("x", 2);
        const int v = file.variable("v", NC_SHORT, {t.dimension, y, x});
        file.number(v, "add_offset", offset);
        file.write(t.variable, std::vector<double>{time});
        file.write(v, std::vector<std::int16_t>{1, 2, 3, 4});
        return file.close();
    };
    const auto reader = openReader(
        std::vector<std::filesystem::path>{packed("a.nc", 0, 100), packed("b.nc", 1, 200)});
    EXPECT_THAT(std::get<std::vector<double>>(reader->read(0, 1).values),
                ElementsAre(201, 202, 203, 204));
    EXPECT_THAT(std::get<std::vector<double>>(reader->read(0, 0).values),
                ElementsAre(101, 102, 103, 104));
}

// The library takes a backslash for a slash.
TEST(NetcdfReader, ABackslashInANameIsNoSlash) {
    const Path folder = tests::freshFolder();
    std::filesystem::create_directory(folder / "a");
    for (const int mode : {NC_NETCDF4, NC_CLASSIC_MODEL, NC_64BIT_OFFSET}) {
        const auto withValue = [&](float value, const Path& name) {
            const Path made = plane(
                "made.nc", std::vector<float>(6, value), [](NetcdfBuilder&, int) {}, mode);
            std::filesystem::rename(made, folder / name);
        };
        const auto expectTwos = [&] {
            const auto reader = open(folder / "a\\h.nc");
            EXPECT_THAT(asValues<float>(reader->read(0, 0)), testing::Each(2)) << mode;
        };
        withValue(1, "a/h.nc");
        withValue(2, "a\\h.nc");
        expectTwos();
        std::filesystem::remove(folder / "a" / "h.nc");
        expectTwos();
    }
}

}  // namespace
}  // namespace timeseries
