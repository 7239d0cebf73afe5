// Heights of variables that lie between the columns that a formula's terms lie in.
#include <cmath>
#include <vector>

#include "tests/support/netcdf_axes.h"

namespace timeseries::netcdf_staggered {
namespace {

using namespace netcdf_axes;

constexpr std::size_t kTimes = 2, kLevels = 3, kRows = 4, kColumns = 5;  // of rho
double level(std::size_t k) { return 0.25 + 0.25 * static_cast<double>(k); }

// ROMS's: depth and surface stand at rho points, between which are those of u and v, and of psi.
struct Staggered {
    // Of the points' rows and columns, beside 4 x 5 of rho.
    std::size_t rows = 4, columns = 4;
    bool turned = false;      // depth(x, y)
    bool otherTime = false;   // of the surface
    bool atFaces = false;     // s_w
    std::string along = "u";  // eta_u, xi_u
};
constexpr double kGone = -999, kCritical = 50;
double seaDepth(double j, double i) { return 4000 + 100 * j + 10 * i; }
double seaSurface(double t, double j, double i) { return 0.5 * t + 0.25 * j - 0.125 * i; }

std::filesystem::path staggered(const Staggered& how) {
    NetcdfBuilder file("roms.nc");
    const auto time = file.coordinate("ocean_time", kTimes, "seconds since 2000-01-01");
    const int y = file.dimension("eta_rho", kRows), x = file.dimension("xi_rho", kColumns),
              eta = file.dimension("eta_" + how.along, how.rows),
              xi = file.dimension("xi_" + how.along, how.columns);
    const std::string name = how.atFaces ? "s_w" : "s_rho", stretching = "Cs" + name.substr(1);
    const auto s = file.coordinate(name, kLevels, "1");
    const int other = how.otherTime ? file.dimension("zeta_time", kTimes) : time.dimension;
    file.text(s.variable, "standard_name", "ocean_s_coordinate_g2");
    file.text(s.variable, "positive", "up");
    file.text(s.variable, "formula_terms",
              "s: " + name + " C: " + stretching + " eta: zeta depth: h depth_c: hc");
    const int c = file.variable(stretching, NC_DOUBLE, {s.dimension}),
              critical = file.variable("hc", NC_DOUBLE, {}),
              h = file.variable("h", NC_DOUBLE, how.turned ? std::vector{x, y} : std::vector{y, x}),
              zeta = file.variable("zeta", NC_DOUBLE, {other, y, x}),
              lon = file.variable("lon", NC_DOUBLE, {eta, xi}),
              lat = file.variable("lat", NC_DOUBLE, {eta, xi}),
              speed = file.variable("speed", NC_FLOAT, {time.dimension, s.dimension, eta, xi});
    for (const int each : {h, critical, zeta}) file.text(each, "units", "m");
    file.number(zeta, "_FillValue", kGone);
    file.text(lon, "units", "degrees_east");
    file.text(lat, "units", "degrees_north");
    file.text(speed, "coordinates", "lon lat");
    file.write(time.variable, std::vector<double>{0, 1});
    std::vector<double> levels, stretched, depths, surfaces, lons, lats;
    for (std::size_t k = 0; k < kLevels; ++k) {
        levels.push_back(level(k) - 1);
        stretched.push_back(0.5 * level(k) - 1);
    }
    for (std::size_t n = 0; n < kRows * kColumns; ++n) {
        const std::size_t rows = how.turned ? n % kRows : n / kColumns,
                          columns = how.turned ? n / kRows : n % kColumns;
        depths.push_back(seaDepth(double(rows), double(columns)));
    }
    for (std::size_t t = 0; t < kTimes; ++t)
        for (std::size_t j = 0; j < kRows; ++j)
            for (std::size_t i = 0; i < kColumns; ++i)
                surfaces.push_back(i == 0 && j == 2 ? kGone
                                                    : seaSurface(double(t), double(j), double(i)));
    for (std::size_t j = 0; j < how.rows; ++j)
        for (std::size_t i = 0; i < how.columns; ++i) {
            lons.push_back(double(i));
            lats.push_back(double(j));
        }
    file.write(s.variable, levels);
    file.write(c, stretched);
    file.write(critical, std::vector{kCritical});
    file.write(h, depths);
    file.write(zeta, surfaces);
    file.write(lon, lons);
    file.write(lat, lats);
    file.write(speed, std::vector<float>(kTimes * kLevels * how.rows * how.columns, 7));
    return file.close();
}

// The mean of what is there at rho points beside a place: of 4 along rows, and 5 along columns.
double besideOf(const Staggered& how, std::size_t j, std::size_t i,
                const std::function<double(std::size_t, std::size_t)>& of) {
    const auto from = [](std::size_t own, std::size_t its, std::size_t at) {
        std::vector<std::size_t> places;
        if (own == its)
            places = {at};
        else if (own + 1 == its)
            places = {at, at + 1};
        else if (at == 0 || at == its)
            places = {at == 0 ? 0 : its - 1};
        else
            places = {at - 1, at};
        return places;
    };
    double sum = 0, count = 0;
    for (const std::size_t y : from(how.rows, kRows, j))
        for (const std::size_t x : from(how.columns, kColumns, i))
            if (const double value = of(y, x); value != kGone) {
                sum += value;
                ++count;
            }
    return sum / count;
}

TEST(NetcdfStaggered, HeightsAreOfTheMeanOfTermsBesideThem) {
    for (const Staggered& how :
         {Staggered{}, Staggered{.rows = 3, .columns = 5, .along = "v"},
          Staggered{.rows = 3, .columns = 4, .along = "psi"}, Staggered{.atFaces = true},
          Staggered{.rows = 4, .columns = 6}, Staggered{.rows = 5, .columns = 6}}) {
        const auto reader = open(staggered(how));
        const std::size_t v = tests::indexOf(*reader, "speed");
        const Variable& variable = reader->variables()[v];
        EXPECT_THAT(variable.notes,
                    testing::Contains(testing::HasSubstr(
                        "of h and zeta, which other columns have, it takes the mean")));
        const Axis& z = variable.grid->axes()[2];
        EXPECT_EQ(z.name, "height");
        EXPECT_EQ(z.units, "m");
        for (std::size_t t = 0; t < kTimes; ++t) {
            const Field field = reader->read(v, t);
            ASSERT_EQ(field.grid->count(), kLevels * how.rows * how.columns);
            for (std::size_t n = 0; n < field.grid->count(); ++n) {
                const std::size_t i = n % how.columns, j = n / how.columns % how.rows,
                                  k = n / how.columns / how.rows;
                const double h = besideOf(how, j, i,
                                          [](std::size_t y, std::size_t x) {
                                              return seaDepth(double(y), double(x));
                                          }),
                             eta = besideOf(how, j, i, [&](std::size_t y, std::size_t x) {
                                 return x == 0 && y == 2
                                            ? kGone
                                            : seaSurface(double(t), double(y), double(x));
                             });
                const double still =
                    (kCritical * (level(k) - 1) + h * (0.5 * level(k) - 1)) / (kCritical + h);
                // Beyond an outermost one that is none there is no height.
                if (std::isnan(eta))
                    EXPECT_FALSE(std::isfinite(field.grid->position(n).z)) << how.along << ' ' << n;
                else
                    EXPECT_NEAR(field.grid->position(n).z, eta + (eta + h) * still, 2e-3)
                        << how.along << ' ' << n;
            }
        }
    }
}

TEST(NetcdfStaggered, TermsThatAreNotBesideTheVariableGiveNoHeights) {
    for (const Staggered& how :
         {Staggered{.rows = 4, .columns = 3}, Staggered{.rows = 4, .columns = 7},
          Staggered{.rows = 4, .columns = 5}, Staggered{.rows = 5, .columns = 4, .turned = true},
          Staggered{.turned = true}, Staggered{.otherTime = true}}) {
        const auto reader = open(staggered(how));
        const Variable& variable = reader->variables()[tests::indexOf(*reader, "speed")];
        EXPECT_EQ(variable.grid->axes()[2].name, "s_rho");
        EXPECT_THAT(variable.notes, testing::ElementsAre(testing::HasSubstr(
                                        "s_rho is a level, not a height: used as it is")));
    }
}

}  // namespace
}  // namespace timeseries::netcdf_staggered
