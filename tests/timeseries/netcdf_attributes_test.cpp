// What a NetCDF file says of its variables: what is wrong with it, and whom that costs what.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "tests/support/netcdf_plane.h"
#include "tests/support/read_variables.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using tests::asValues;
using tests::namesOf;
using tests::NetcdfBuilder;
using tests::open;
using tests::plane;
using tests::refusalOf;

TEST(NetcdfAttributes, MalformedAttributesAreOneSentence) {
    struct Case {
        std::string name, expected;
        std::function<void(NetcdfBuilder&, int)> attributes;
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<Case> cases{
        {"nan_scale", "scale_factor: expected a finite number, found nan",
         [&](auto& f, int v) { f.number(v, "scale_factor", nan); }},
        {"text_scale", "scale_factor: expected a number, found the text \"two\"",
         [](auto& f, int v) { f.text(v, "scale_factor", "two"); }},
        {"two_offsets", "add_offset: expected 1 number, found 2",
         [](auto& f, int v) {
             f.number(v, "add_offset", std::vector<double>{1, 2});
         }},
        {"text_missing", "missing_value: expected a number, found the text \"none\"",
         [](auto& f, int v) { f.text(v, "missing_value", "none"); }},
        {"text_valid", "valid_min: expected a number",
         [](auto& f, int v) { f.text(v, "valid_min", "0"); }},
        {"one_range", "valid_range: expected 2 numbers, found 1",
         [](auto& f, int v) { f.number(v, "valid_range", 1.0); }},
    };
    for (const Case& c : cases) {
        const auto path = plane<std::int16_t>(c.name, {1, 2, 3, 4}, c.attributes);
        const std::string what = refusalOf(path);
        EXPECT_THAT(what, HasSubstr(path.string() + ": variable 'v': " + c.expected)) << c.name;
    }
}

TEST(NetcdfAttributes, WhatIsSaidOfAVariableIsOneLine) {
    const auto path = plane<float>("a.nc", {1, 2, 3, 4}, [](auto& file, int v) {
        file.text(v, "units", "m\tper\ns \n");
        file.text(v, "long_name", "way\r\nin a second");
    });
    const auto reader = open(path);
    const Variable& variable = reader->variables()[0];
    EXPECT_EQ(variable.units, "m per s");
    EXPECT_EQ(variable.longName, "way  in a second");
}

// good(y, x), bad(y, x) and level(z, y, x), with attributes of bad and of the coordinate z.
std::filesystem::path threeVariables(const std::string& name, const std::string& badScale,
                                     double zScale) {
    NetcdfBuilder file(name);
    const auto z = file.coordinate("z", 2, "m");
    const int y = file.dimension("y", 2), x = file.dimension("x", 2);
    const int bad = file.variable("bad", NC_FLOAT, {y, x});
    const int good = file.variable("good", NC_FLOAT, {y, x});
    const int level = file.variable("level", NC_FLOAT, {z.dimension, y, x});
    if (!badScale.empty()) file.text(bad, "scale_factor", badScale);
    file.number(z.variable, "scale_factor", zScale);
    file.write(z.variable, std::vector<double>{1, 2});
    file.write(bad, std::vector<float>{1, 2, 3, 4});
    file.write(good, std::vector<float>{5, 6, 7, 8});
    file.write(level, std::vector<float>(8, 9));
    return file.close();
}

TEST(NetcdfAttributes, AMalformedAttributeCostsTheVariablesThatNeedIt) {
    const auto path = threeVariables("a.nc", "two", std::numeric_limits<double>::infinity());
    const auto reader = open(path);
    EXPECT_THAT(namesOf(*reader), ElementsAre("good"));
    EXPECT_EQ(asValues<float>(reader->read(0, 0)), (std::vector<float>{5, 6, 7, 8}));
    ASSERT_EQ(reader->damaged().size(), 2u);
    EXPECT_EQ(reader->damaged()[0].name, "bad");
    EXPECT_EQ(reader->damaged()[0].why,
              path.string() +
                  ": variable 'bad': scale_factor: expected a number, found the text \"two\"");
    EXPECT_EQ(reader->damaged()[1].name, "level");
    EXPECT_EQ(reader->damaged()[1].why,
              path.string() + ": variable 'z': scale_factor: expected a finite number, found inf");
    EXPECT_TRUE(open(threeVariables("whole.nc", "", 1))->damaged().empty());
}

TEST(NetcdfAttributes, AVariableThatIsDamagedInOneFileOfASeriesIsLeftOutOfAll) {
    const std::vector<std::filesystem::path> paths{threeVariables("a_1.nc", "", 1),
                                                   threeVariables("a_2.nc", "two", 1),
                                                   threeVariables("a_3.nc", "three", 1)};
    const auto reader = openReader(paths);
    EXPECT_THAT(namesOf(*reader), ElementsAre("good", "level"));
    EXPECT_EQ(reader->variables()[0].time->points.size(), 3u);
    EXPECT_EQ(asValues<float>(reader->read(1, 2)), std::vector<float>(8, 9));
    ASSERT_EQ(reader->damaged().size(), 1u);
    EXPECT_EQ(reader->damaged()[0].name, "bad");
    EXPECT_THAT(reader->damaged()[0].why,
                HasSubstr(paths[1].string() + ": variable 'bad': scale_factor: expected a number, "
                                              "found the text \"two\""));
}

}  // namespace
}  // namespace timeseries
