// What a file has beside the variables that are read, and what was guessed of these, is told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "tests/support/netcdf_builder.h"
#include "tests/support/read_variables.h"

namespace timeseries {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using testing::Pair;
using tests::NetcdfBuilder;
using tests::open;

// What is left out beside others, and why; and what was taken for time with no word of it.
TEST(NetcdfLeftOut, WhatIsPassedOverOrGuessedIsToldBesideOthers) {
    NetcdfBuilder file("a.nc");
    const int ens = file.dimension("ens", 300), comp = file.dimension("comp", 3),
              band = file.dimension("band", 5), z = file.dimension("z", 4),
              y = file.dimension("y", 2), x = file.dimension("x", 2);
    file.variable("a", NC_FLOAT, {ens, z, y, x});
    file.variable("b", NC_FLOAT, {band, z, y, x});
    file.variable("u", NC_FLOAT, {comp, z, y, x});
    file.variable("w", NC_FLOAT, {z, y, x, comp});
    const std::filesystem::path path = file.close();
    const auto reader = open(path);
    ASSERT_EQ(reader->variables().size(), 7u);
    EXPECT_EQ(reader->variables()[0].name, "b");
    EXPECT_EQ(reader->variables()[3].name, "u:comp=2");
    EXPECT_EQ(reader->variables()[4].name, "w:comp=0");
    EXPECT_EQ(reader->variables()[0].time->points.size(), 5u);
    EXPECT_THAT(reader->variables()[0].notes,
                Contains("band is taken for time: the file does not say what it is, and it comes "
                         "before the others"));
    std::map<std::string, std::string> leftOut;
    for (const DamagedVariable& each : reader->damaged()) leftOut[each.name] = each.why;
    const auto why = [&](const std::string& name, const std::string& dimension) {
        return path.string() + ": variable '" + name + "': the dimension " + dimension +
               " is none of x, y, z and time, and a variable is shown as 256 at most";
    };
    EXPECT_THAT(leftOut, testing::ElementsAre(Pair("a", why("a", "ens of 300"))));
}

TEST(NetcdfLeftOut, TimeThatIsToldIsNotCalledAGuess) {
    for (const char* name : {"time", "t", "record"}) {
        NetcdfBuilder file("a.nc");
        const int t = file.dimension(name, 5), z = file.dimension("z", 4),
                  y = file.dimension("y", 2), x = file.dimension("x", 2);
        file.variable("b", NC_FLOAT, {t, z, y, x});
        EXPECT_THAT(open(file.close())->variables()[0].notes,
                    Not(Contains(HasSubstr("taken for time"))));
    }
}

}  // namespace
}  // namespace timeseries
