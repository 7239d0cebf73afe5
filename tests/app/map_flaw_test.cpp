#include "app/choices/map_flaw.h"

#include <gtest/gtest.h>

#include "tests/support/measured_axis.h"

namespace app {
namespace {

using tests::measuredAxis;
using timeseries::Grid;

std::string flaw(const timeseries::Axis& x, const timeseries::Axis& y) {
    return globeFlaw(Grid({x, y, measuredAxis("depth", "m", 0, 10, 3, true)}));
}

TEST(GlobeFlaw, IsNoneOfLongitudesAndLatitudes) {
    EXPECT_EQ(flaw(measuredAxis("lon", "degrees_east", 0, 359, 90),
                   measuredAxis("lat", "degrees_north", -90, 90, 45)),
              "");
}

TEST(GlobeFlaw, SaysWhatTheAxesAreInstead) {
    EXPECT_EQ(flaw(measuredAxis("x", "m", 0, 9, 10), measuredAxis("y", "", 0, 9, 10)),
              "a globe is drawn of longitudes and latitudes in degrees, not of x (m) and y");
    EXPECT_EQ(flaw(measuredAxis("grid_longitude", "degrees", 0, 9, 10),
                   measuredAxis("grid_latitude", "degrees", 0, 9, 10)),
              "a globe is drawn of longitudes and latitudes in degrees, not of grid_longitude "
              "(degrees) and grid_latitude (degrees)");
    EXPECT_EQ(flaw(measuredAxis("lon", "degrees_east", 0, 9, 10),
                   measuredAxis("lat", "degrees_north", 0, 100, 11)),
              "a globe is drawn of latitudes from -90 to 90, not from 0 to 100");
    EXPECT_EQ(flaw(measuredAxis("lon", "degrees_east", 0, 710, 72),
                   measuredAxis("lat", "degrees_north", 0, 90, 10)),
              "a globe is drawn of longitudes that go around it once, not from 0 to 710");
    // 2^13 x 2^13 x 3 points.
    EXPECT_EQ(flaw(measuredAxis("lon", "degrees_east", 0, 359, 1 << 13),
                   measuredAxis("lat", "degrees_north", -89, 89, 1 << 13)),
              "a globe is drawn of at most 67108864 points, not of 201326592");
}

TEST(GlobeFlaw, IsNoneOfOtherAxesWhoseLongitudesAndLatitudesAreTold) {
    const Grid grid({measuredAxis("x", "m", 0, 9, 2), measuredAxis("y", "m", 0, 9, 2),
                     measuredAxis("depth", "m", 0, 10, 3, true)});
    const auto told = [&](const std::vector<glm::dvec2>& columns) {
        return globeFlaw(grid.withEarth(std::make_shared<const timeseries::EarthPlaces>(columns)));
    };
    EXPECT_EQ(told({{1, 2}, {3, 2}, {1, 4}, {3, 4}}), "");
    EXPECT_EQ(told({{1, 2}, {1, 2}, {1, 2}, {1, 2}}),
              "a globe is drawn of more than one place, and of heights that are told apart");
}

}  // namespace
}  // namespace app
