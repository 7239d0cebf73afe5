// VTK's readers against real files, with shares that were counted by other software (numpy).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/shared_data.h"
#include "timeseries/range_set.h"
#include "timeseries/reader.h"
#include "timeseries/sorted_step.h"

namespace timeseries {
namespace {

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

std::size_t indexOf(const Reader& reader, const std::string& name) {
    for (std::size_t i = 0; i < reader.variables().size(); ++i)
        if (reader.variables()[i].name == name) return i;
    throw std::runtime_error("no variable " + name);
}

double percentInside(Reader& reader, const std::string& variable, std::size_t step,
                     const std::string& range) {
    const auto sorted = SortedStep::build(reader.read(indexOf(reader, variable), step));
    return 100.0 * static_cast<double>(sorted.count(RangeSet::parse(range))) /
           static_cast<double>(sorted.statistics().points);
}

// Rows of ranges.csv.
TEST_F(RealVtk, SharesInsideRangesAgreeWithNumpy) {
    struct Row {
        std::string file, variable, range;
        double percent;
    };
    for (const Row& row : {Row{"cth_impact.vtr", "Pressure", "1e9:1.2e11", 1.82},
                           Row{"cth_impact.vtr", "Pressure", "-2.4e10:-1e8", 1.90},
                           Row{"hipip_ironProt_68.vtk", "scalars", "64:255", 6.50},
                           Row{"hipip_ironProt_68.vtk", "scalars", "128:255", 2.97},
                           Row{"aneurism_256_u8.vti", "ImageFile", "30:255", 0.65}}) {
        const auto reader = openShared(row.file);
        EXPECT_NEAR(percentInside(*reader, row.variable, 0, row.range), row.percent, 0.005 + 1e-9)
            << row.file << ' ' << row.range;
    }
}

// The same run as pool_fire_T.nc: the cells' shares at eight of its times (ranges.csv).
TEST_F(RealVtk, TheFireAgreesWithItsNetcdfAtUnevenTimes) {
    const auto fire = openShared("pool_fire_vti/fire.pvd");
    const auto netcdf = openShared("pool_fire_T.nc");
    const std::size_t T = indexOf(*fire, "T"), other = indexOf(*netcdf, "T");
    const auto& times = fire->variables()[T].time->points;
    const auto& all = netcdf->variables()[other].time->points;
    ASSERT_EQ(times.size(), 8u);
    EXPECT_EQ(fire->variables()[T].grid->size(), netcdf->variables()[other].grid->size());
    for (std::size_t step = 0; step < times.size(); ++step)
        for (std::size_t s = 0; s < all.size(); ++s) {
            if (std::abs(all[s].value - times[step].value) > 1e-6) continue;
            EXPECT_EQ(fire->read(T, step).values, netcdf->read(other, s).values)
                << times[step].value;
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
