// VTK's readers against real files; tests/app/ranges_csv_test.cpp compares their counts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/read_variables.h"
#include "tests/support/shared_data.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

using tests::indexOf;
class RealVtk : public testing::Test {
 protected:
    void SetUp() override {
        if (!std::filesystem::exists(tests::sharedData("ranges.csv")))
            GTEST_SKIP() << "no real data at " << tests::sharedData("ranges.csv");
    }
};

std::unique_ptr<Reader> openShared(const std::string& name) {
    const std::filesystem::path path = tests::sharedData(name);
    return openReader(std::span(&path, 1));
}

// The same run as pool_fire_T.nc: the cells' values at eight of its times.
TEST_F(RealVtk, TheFireAgreesWithItsNetcdfAtUnevenTimes) {
    const auto fire = openShared("pool_fire_vti/fire.pvd");
    const auto netcdf = openShared("pool_fire_T.nc");
    const std::size_t T = indexOf(*fire, "T"), other = indexOf(*netcdf, "T");
    const auto& times = fire->variables()[T].time->points;
    const auto& all = netcdf->variables()[other].time->points;
    ASSERT_EQ(times.size(), 8u);
    EXPECT_EQ(fire->variables()[T].grid->size(), netcdf->variables()[other].grid->size());
    for (std::size_t step = 0; step < times.size(); ++step) {
        const auto same = std::ranges::find_if(
            all, [&](const TimePoint& t) { return std::abs(t.value - times[step].value) < 1e-6; });
        ASSERT_NE(same, all.end()) << times[step].value;
        EXPECT_EQ(fire->read(T, step).values,
                  netcdf->read(other, static_cast<std::size_t>(same - all.begin())).values)
            << times[step].value;
    }
}

// The NetCDF file keeps 12 bits of the mantissa of the collection's values.
TEST_F(RealVtk, TheFingersAgreeWithTheirNetcdf) {
    const auto fingers = openShared("viscous_fingers/vf_run01.pvd");
    const auto netcdf = openShared("viscous_fingers_demo.nc");
    const std::size_t density = indexOf(*netcdf, "density");
    const auto& all = netcdf->variables()[density].time->points;
    const auto& times = fingers->variables()[0].time->points;
    for (std::size_t step = 0; step < times.size(); ++step) {
        const auto same = std::ranges::find(all, times[step].value, &TimePoint::value);
        ASSERT_NE(same, all.end()) << times[step].value;
        const Field mine = fingers->read(0, step);
        const Field other = netcdf->read(density, static_cast<std::size_t>(same - all.begin()));
        const auto& exact = std::get<std::vector<float>>(mine.values);
        const auto& rounded = std::get<std::vector<float>>(other.values);
        ASSERT_EQ(exact.size(), rounded.size());
        for (std::size_t i = 0; i < exact.size(); ++i)
            ASSERT_NEAR(exact[i], rounded[i], std::abs(exact[i]) / 4096) << step << ' ' << i;
    }
}

TEST_F(RealVtk, NamesGridsAndTimesAreThoseOfTheFiles) {
    const auto impact = openShared("cth_impact.vtr");
    EXPECT_EQ(impact->variables().size(), 9u);
    EXPECT_EQ(impact->variables()[8].name, "Mass for Body, Nose");
    EXPECT_EQ(impact->variables()[0].grid->count(), 524288u);

    const auto isabel = openShared("isabel_30_raw_f64.vti");
    EXPECT_EQ(isabel->variables()[0].type, ValueType::F64);
    EXPECT_EQ(isabel->variables()[0].time->name, "TimeStep");
    EXPECT_EQ(isabel->variables()[0].time->points[0].value, 30);

    const auto fingers = openShared("viscous_fingers/vf_run01.pvd");
    const auto& times = fingers->variables()[0].time->points;
    ASSERT_EQ(times.size(), 3u);
    EXPECT_EQ(times[0].value, 1);
    EXPECT_EQ(times[1].value, 41);
    EXPECT_EQ(times[2].value, 81);
    EXPECT_EQ(fingers->variables()[0].grid->count(), 64u * 64 * 64);
}

}  // namespace
}  // namespace timeseries
