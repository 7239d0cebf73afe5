// Integers whose bits a file means as of the other signedness (_Unsigned), beside data:
// coordinates, times and classes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/netcdf_builder.h"
#include "tests/support/read_variables.h"
#include "tests/support/timed_netcdf.h"

namespace timeseries {
namespace {

using testing::ElementsAre;
using tests::NetcdfBuilder;
using tests::open;

// Below 2^16, from 2^15 on.
TEST(NetcdfSigns, CoordinatesAndTimesAreAsTheFileMeansThem) {
    for (const int mode : {0, NC_NETCDF4}) {
        NetcdfBuilder file("a.nc", mode);
        const int t = file.dimension("time", 2), y = file.dimension("y", 2),
                  x = file.dimension("x", 3);
        const auto unsignedShorts = [&](const char* name, int along) {
            const int variable = file.variable(name, NC_SHORT, {along});
            file.text(variable, "_Unsigned", "true");
            return variable;
        };
        const int times = unsignedShorts("time", t), places = unsignedShorts("x", x);
        file.text(times, "units", "days since 1900-01-01");
        const int v = file.variable("v", NC_FLOAT, {t, y, x});
        const auto bits = [](int value) { return static_cast<std::int16_t>(value - 65536); };
        file.write(times, std::vector{bits(36524), bits(36525)});
        file.write(places, std::vector{bits(40000), bits(40010), bits(65535)});
        file.write(v, std::vector<float>(12, 1));
        const auto reader = open(file.close());
        EXPECT_THAT(reader->read(0, 0).grid->axes()[0].coordinates,
                    ElementsAre(40000, 40010, 65535));
        EXPECT_THAT(tests::timesOf(*reader), ElementsAre(36524, 36525));
        // 100 years of which 24 have a day more: 1900 has not, 2000 begins.
        EXPECT_EQ(reader->variables()[0].time->points[0].date, "2000-01-01 00:00:00");
    }
}

TEST(NetcdfSigns, ClassesHaveTheNumbersThatTheirPointsHave) {
    NetcdfBuilder file("a.nc", 0);
    const int y = file.dimension("y", 2), x = file.dimension("x", 2);
    const int bytes = file.variable("bytes", NC_BYTE, {y, x}),
              packed = file.variable("packed", NC_SHORT, {y, x});
    file.text(bytes, "_Unsigned", "true");
    file.number(bytes, "flag_values", std::vector<std::int8_t>{0, 100, -56, -1});
    file.text(bytes, "flag_meanings", "none some more all");
    file.number(packed, "scale_factor", std::vector{0.5});
    file.number(packed, "flag_values", std::vector<std::int16_t>{1, 2});
    file.text(packed, "flag_meanings", "half whole");
    file.write(bytes, std::vector<std::int8_t>{0, 100, -56, -1});
    file.write(packed, std::vector<std::int16_t>{1, 1, 2, 2});
    const auto reader = open(file.close());
    const auto classesOf = [&](const char* name) {
        for (const Variable& variable : reader->variables())
            if (variable.name == name) return variable.classes;
        return std::vector<ClassName>();
    };
    EXPECT_EQ(classesOf("bytes"),
              (std::vector<ClassName>{{0, "none"}, {100, "some"}, {200, "more"}, {255, "all"}}));
    EXPECT_EQ(classesOf("packed"), (std::vector<ClassName>{{0.5, "half"}, {1, "whole"}}));
}

}  // namespace
}  // namespace timeseries
