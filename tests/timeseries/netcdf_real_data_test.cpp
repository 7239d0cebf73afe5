// The readers against real files, with counts that were made by other software (numpy).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "tests/support/read_variables.h"
#include "tests/support/shared_data.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

using tests::indexOf;
struct Row {
    std::string file, variable;
    double lo, hi;
    std::vector<std::string> percent;  // per step, as printed
};

std::vector<Row> netcdfRows() {
    std::ifstream in(tests::sharedData("ranges.csv"));
    std::vector<Row> rows;
    for (std::string line; std::getline(in, line);) {
        std::vector<std::string> cells;
        std::istringstream cut(line);
        for (std::string cell; std::getline(cut, cell, ',');) cells.push_back(cell);
        if (cells.size() != 8 || !cells[0].ends_with(".nc")) continue;
        Row row{cells[0], cells[1], std::stod(cells[2]), std::stod(cells[3]), {}};
        std::istringstream percents(cells[7]);
        for (std::string one; percents >> one;) row.percent.push_back(one);
        rows.push_back(std::move(row));
    }
    return rows;
}

std::unique_ptr<Reader> openShared(const std::string& name) {
    const std::filesystem::path path = tests::sharedData(name);
    return openReader(std::span(&path, 1));
}

// Of the points that are neither missing nor NaN, in percent with two decimals.
std::string percentInside(const Field& field, double lo, double hi) {
    return std::visit(
        [&](const auto& values) {
            using T = std::decay_t<decltype(values[0])>;
            const T a = static_cast<T>(lo), b = static_cast<T>(hi);
            std::uint64_t valid = 0, inside = 0;
            for (std::size_t i = 0; i < values.size(); ++i) {
                if ((!field.missing.empty() && field.missing[i]) || values[i] != values[i])
                    continue;
                ++valid;
                inside += a <= values[i] && values[i] <= b;
            }
            return fmt::format("{:.2f}",
                               100.0 * static_cast<double>(inside) / static_cast<double>(valid));
        },
        field.values);
}

class RealNetcdf : public testing::Test {
 protected:
    void SetUp() override {
        if (!std::filesystem::exists(tests::sharedData("ranges.csv")))
            GTEST_SKIP() << "no real data at " << tests::sharedData("ranges.csv");
    }
};

TEST_F(RealNetcdf, SharesInsideRangesAgreeWithNumpyInEveryStep) {
    const std::vector<Row> rows = netcdfRows();
    std::set<std::string> files;
    for (const Row& row : rows) {
        files.insert(row.file);
        const auto reader = openShared(row.file);
        const std::size_t variable = indexOf(*reader, row.variable);
        ASSERT_EQ(reader->variables()[variable].time->points.size(), row.percent.size())
            << row.file;
        for (std::size_t step = 0; step < row.percent.size(); ++step) {
            const Field field = reader->read(variable, step);
            EXPECT_EQ(percentInside(field, row.lo, row.hi), row.percent[step])
                << row.file << ' ' << row.variable << " [" << row.lo << ", " << row.hi << "] step "
                << step;
        }
    }
    EXPECT_EQ(files.size(), 8u) << "of the shared NetCDF files";
}

std::string describe(const Variable& v) {
    const auto n = v.grid->size();
    return fmt::format("{} [{}] {}x{}x{} {}", v.name, v.units, n[0], n[1], n[2],
                       v.time->points.size());
}

TEST_F(RealNetcdf, VariablesGridsAndStepsAreThoseOfTheFiles) {
    const std::map<std::string, std::vector<std::string>> expected{
        {"pool_fire_T.nc", {"T [K] 60x60x60 31"}},
        {"viscous_fingers_demo.nc", {"density [1] 64x64x64 20"}},
        {"woa_temp_monthly_f32.nc", {"temp [degC] 180x90x19 12"}},
        {"woa_pacific_packed_i16.nc", {"temp [degC] 85x60x19 12"}},
        {"nemo_northsea_u.nc", {"uo [m/s] 151x201x75 4"}},
        {"colpex_theta_rotpole_hybridheight.nc", {"air_potential_temperature [K] 83x83x10 6"}},
        {"ccm_hybrid_T_2times.nc", {"T [K] 128x64x18 2", "PS [Pa] 128x64x1 2"}},
        {"echam_rhumidity_gaussian_3d.nc", {"rhumidity [] 192x96x17 1", "t [K] 192x96x17 1"}},
    };
    for (const auto& [file, variables] : expected) {
        const auto reader = openShared(file);
        std::vector<std::string> found;
        for (const Variable& v : reader->variables()) found.push_back(describe(v));
        EXPECT_EQ(found, variables) << file;
    }
}

TEST_F(RealNetcdf, AxesPointTheWayTheFilesSay) {
    const auto woa = openShared("woa_temp_monthly_f32.nc");
    const auto& axes = woa->variables()[0].grid->axes();
    EXPECT_EQ(axes[0].units, "degrees_east");
    EXPECT_EQ(axes[0].coordinates.front(), 20.5);
    EXPECT_EQ(axes[0].coordinates.back(), 378.5);
    EXPECT_TRUE(axes[2].down);
    EXPECT_EQ(axes[2].coordinates.back(), 1000);

    const auto echam = openShared("echam_rhumidity_gaussian_3d.nc");
    EXPECT_TRUE(echam->variables()[0].grid->axes()[2].down) << "pressure in Pa";
    const auto colpex = openShared("colpex_theta_rotpole_hybridheight.nc");
    EXPECT_FALSE(colpex->variables()[0].grid->axes()[2].down);
    EXPECT_EQ(colpex->variables()[0].notes.size(), 0u);
    EXPECT_EQ(colpex->variables()[0].grid->axes()[2].name, "altitude");
    const auto ccm = openShared("ccm_hybrid_T_2times.nc");
    EXPECT_TRUE(ccm->variables()[0].grid->axes()[2].down);
    EXPECT_EQ(ccm->variables()[0].notes.size(), 1u) << "hybrid levels";
}

TEST_F(RealNetcdf, CurvilinearNemoLiesWhereItsColumnsSay) {
    const auto nemo = openShared("nemo_northsea_u.nc");
    const Variable& uo = nemo->variables()[0];
    EXPECT_EQ(uo.notes, std::vector<std::string>{});
    ASSERT_TRUE(uo.grid->mesh());
    EXPECT_EQ(uo.grid->size(), (std::array<std::size_t, 3>{151, 201, 75}));
    // As ncdump prints nav_lon(100, 70), nav_lat(100, 70) and depthu(3).
    const glm::dvec3 place = uo.grid->position(70 + 151 * (100 + 201 * 3));
    EXPECT_NEAR(place.x, -3.684161, 1e-5);
    EXPECT_NEAR(place.y, 60.81367, 1e-5);
    EXPECT_NEAR(place.z, 3.85628, 1e-5);
    EXPECT_EQ(uo.grid->axes()[2].units, "m");
    EXPECT_TRUE(uo.grid->axes()[2].down);
    // 3155803200 s are 36525.5 days, and 36524 days lie between 1900-01-01 and 2000-01-01. (The
    // file's title tells of January 4th: its times are a day and a half behind.)
    EXPECT_EQ(uo.time->points[0].date, "2000-01-02 12:00:00");
    EXPECT_EQ(uo.time->points[3].date, "2000-01-27 12:00:00");
}

TEST_F(RealNetcdf, TimesHaveTheDatesTheirUnitsMean) {
    const auto woa = openShared("woa_temp_monthly_f32.nc");
    const TimeAxis& months = *woa->variables()[0].time;
    ASSERT_EQ(months.points.size(), 12u);
    EXPECT_EQ(months.calendar, "standard");
    for (std::size_t i = 0; i < 12; ++i)
        EXPECT_EQ(months.points[i].date.substr(0, 8), fmt::format("0000-{:02}-", i + 1));

    const auto fire = openShared("pool_fire_T.nc");
    const TimeAxis& seconds = *fire->variables()[0].time;
    EXPECT_EQ(seconds.units, "s");
    EXPECT_EQ(seconds.calendar, "");
    EXPECT_EQ(seconds.points[0].value, 0.5);
    EXPECT_EQ(seconds.points[30].value, 2.0);
    EXPECT_EQ(seconds.points[0].date, "");

    // Ten minutes apart.
    const auto colpex = openShared("colpex_theta_rotpole_hybridheight.nc");
    const TimeAxis& tens = *colpex->variables()[0].time;
    for (std::size_t i = 1; i < tens.points.size(); ++i)
        EXPECT_NEAR(tens.points[i].value - tens.points[i - 1].value, 1.0 / 6, 1e-6);
    // Stored to about 20 microseconds, shown as meant.
    EXPECT_EQ(tens.points[0].date, "2009-09-09 17:10:00");
    EXPECT_EQ(tens.points[5].date, "2009-09-09 18:00:00");
}

TEST_F(RealNetcdf, PackedShortsTellHowTheyAreStored) {
    const auto reader = openShared("woa_pacific_packed_i16.nc");
    const Variable& temp = reader->variables()[0];
    EXPECT_EQ(temp.type, ValueType::F64);
    EXPECT_EQ(temp.storedAs, "int16 packed, scale 0.001, offset 15");
    EXPECT_EQ(temp.missing, "_FillValue -32768");
    EXPECT_EQ(reader->format(), "NetCDF classic");
}

}  // namespace
}  // namespace timeseries
