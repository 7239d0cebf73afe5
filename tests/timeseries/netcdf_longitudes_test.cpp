// Longitudes along an axis, and of two dimensions.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "tests/support/netcdf_axes.h"
#include "tests/support/netcdf_builder.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using tests::NetcdfBuilder;
using namespace timeseries::netcdf_axes;

// A region about Greenwich, or the Pacific's seam, in either direction.
TEST(NetcdfLongitudes, ThatBeginAnewGoOn) {
    const std::pair<std::vector<double>, std::vector<double>> cases[] = {
        {{300, 320, 340, 0, 20, 40}, {-60, -40, -20, 0, 20, 40}},
        {{170, 175, -180, -175}, {170, 175, 180, 185}},
        {{40, 20, 0, 340, 320}, {40, 20, 0, -20, -40}},
        {{0, 120, 240, 359.5}, {0, 120, 240, 359.5}},
        // Twice, all around, or no longitudes: by index.
        {{300, 0, 300, 0}, {0, 1, 2, 3}},
        {{0, 120, 240, 0}, {0, 1, 2, 3}},
        {{10, 10, 20}, {0, 1, 2}},
    };
    for (const auto& [longitudes, placed] : cases)
        for (const char* units : {"degrees_east", "m"}) {
            NetcdfBuilder file("a.nc");
            const auto y = file.coordinate("lat", 2, "degrees_north"),
                       x = file.coordinate("lon", longitudes.size(), units);
            file.variable("v", NC_FLOAT, {y.dimension, x.dimension});
            file.write(y.variable, evenly(2, 0, 1));
            file.write(x.variable, longitudes);
            const auto reader = open(file.close());
            const bool runs = std::ranges::is_sorted(longitudes, std::less_equal());
            if (units == std::string("degrees_east") || runs) {
                EXPECT_EQ(reader->variables()[0].grid->axes()[0].coordinates, placed);
            } else {
                EXPECT_EQ(reader->variables()[0].grid->axes()[0].units, "index") << longitudes[1];
            }
        }
}

TEST(NetcdfLongitudes, OfTwoDimensionsAreToldUnlessMeasuredAxesExist) {
    const std::string note =
        "drawn in index space: of its 2-D coordinates lon and lat, no point has a place that is "
        "finite";  // nobody has written them
    EXPECT_THAT(notesOfCurvilinear(""), ElementsAre(note));
    EXPECT_THAT(notesOfCurvilinear("1"), ElementsAre(note)) << "cell numbers place nothing";
    const std::string noGlobe =
        "no globe by its longitudes and latitudes: none of them is a longitude and latitude in "
        "degrees";
    EXPECT_THAT(notesOfCurvilinear("degrees"), ElementsAre(noGlobe)) << "a rotated pole";
    EXPECT_THAT(notesOfCurvilinear("km"), ElementsAre(noGlobe)) << "a map projection";
}

// lon(j, i) and lat(j, i), and what spans other dimensions, or more than one in time.
TEST(NetcdfLongitudes, OfTwoDimensionsConcernWhatSpansBothOfTheirDimensions) {
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

TEST(NetcdfLongitudes, OfManyOfTwoDimensionsEightAreTold) {
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

}  // namespace
}  // namespace timeseries
