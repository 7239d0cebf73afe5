// Axes about a rotated pole or on a projection, and what the file tells of the Earth beside them:
// points lie along the axes, and their longitudes and latitudes are known.
#include <cmath>

#include "tests/support/netcdf_axes.h"
#include "tests/support/rotated_pole.h"

namespace timeseries::netcdf_earth {
namespace {

using namespace netcdf_axes;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::size_t kNi = 6, kNj = 5, kNk = 3;
constexpr RotatedPole kPole{-162, 39.25, 0};

double eastOf(std::size_t i) { return -20 + 8.0 * double(i); }
double northOf(std::size_t j) { return -15 + 7.0 * double(j); }

// v(height, rlat, rlon).
struct Rotated : NetcdfBuilder {
    Coordinate height = coordinate("height", kNk, "m"), y, x;
    int pole = -1, lon = -1, lat = -1;

    explicit Rotated(const std::string& name = "a.nc", const char* units = "degrees")
        : NetcdfBuilder(name),
          y(coordinate("rlat", kNj, units)),
          x(coordinate("rlon", kNi, units)) {
        text(x.variable, "standard_name", "grid_longitude");
        text(y.variable, "standard_name", "grid_latitude");
    }
    void placeColumns(nc_type type = NC_DOUBLE) {
        lon = place("lon", "degrees_east", {y.dimension, x.dimension}, type);
        lat = place("lat", "degrees_north", {y.dimension, x.dimension}, type);
    }
    int place(const char* name, const char* units, const std::vector<int>& dimensions,
              nc_type type = NC_DOUBLE) {
        const int id = variable(name, type, dimensions);
        text(id, "units", units);
        return id;
    }
    void mapping(const RotatedPole& of = kPole) {
        pole = variable("rotated_pole", NC_CHAR, {});
        text(pole, "grid_mapping_name", "rotated_latitude_longitude");
        number(pole, "grid_north_pole_latitude", of.latitude);
        number(pole, "grid_north_pole_longitude", of.longitude);
        if (of.northPole != 0) number(pole, "north_pole_grid_longitude", of.northPole);
    }
    int field(const char* name = "v", const char* mapping = "") {
        const int v = variable(name, NC_FLOAT, {height.dimension, y.dimension, x.dimension});
        if (*mapping) text(v, "grid_mapping", mapping);
        return v;
    }
    Path closed() {
        write(x.variable, evenly(kNi, eastOf(0), 8));
        write(y.variable, evenly(kNj, northOf(0), 7));
        write(height.variable, evenly(kNk, 0, 100));
        return close();
    }
};

template <typename Of>
std::vector<double> ofColumns(const Of& of) {
    std::vector<double> all;
    for (std::size_t j = 0; j < kNj; ++j)
        for (std::size_t i = 0; i < kNi; ++i) all.push_back(of(double(i), double(j)));
    return all;
}
// Of a projection that nothing tells.
double lonAt(double i, double j) { return 3 + 2 * i - 0.5 * j; }
double latAt(double i, double j) { return 40 + 1.5 * j + 0.25 * i; }

void expectUpright(const Grid& grid) {
    EXPECT_FALSE(grid.mesh());
    ASSERT_EQ(grid.size(), (std::array{kNi, kNj, kNk}));
    for (std::size_t i = 0; i < kNi; ++i) EXPECT_EQ(grid.axes()[0].coordinates[i], eastOf(i));
    for (std::size_t j = 0; j < kNj; ++j) EXPECT_EQ(grid.axes()[1].coordinates[j], northOf(j));
}
template <typename At>
void expectOnEarth(const Grid& grid, const At& at) {
    ASSERT_TRUE(grid.earth());
    ASSERT_EQ(grid.earth()->count(), kNi * kNj);
    for (std::size_t j = 0; j < kNj; ++j)
        for (std::size_t i = 0; i < kNi; ++i)
            EXPECT_LT(glm::distance(tests::direction((*grid.earth())[i + kNi * j]), at(i, j)), 1e-9)
                << i << " " << j;
}
void expectByColumns(const Grid& grid) {
    expectOnEarth(grid, [](std::size_t i, std::size_t j) {
        return tests::direction({lonAt(double(i), double(j)), latAt(double(i), double(j))});
    });
}
void expectByPole(const Grid& grid, const RotatedPole& pole) {
    expectOnEarth(grid, [&](std::size_t i, std::size_t j) {
        return tests::onEarth(pole, {eastOf(i), northOf(j)});
    });
}

TEST(NetcdfEarth, ColumnsTellItBesideAxesInDegreesOrMetres) {
    for (const char* units : {"degrees", "m", "km"}) {
        Rotated file("a.nc", units);
        file.placeColumns();
        file.text(file.field(), "coordinates", "lon lat");
        file.write(file.lon, ofColumns(lonAt));
        file.write(file.lat, ofColumns(latAt));
        const auto reader = open(file.closed());
        EXPECT_THAT(names(*reader), ElementsAre("v"));
        const Variable& v = reader->variables()[0];
        expectUpright(*v.grid);
        expectByColumns(*v.grid);
        EXPECT_EQ(v.grid->axes()[0].units, units);
        EXPECT_THAT(v.notes, IsEmpty());
        EXPECT_EQ(reader->read(0, 0).grid, v.grid);
    }
}

TEST(NetcdfEarth, ColumnsMayBeWrittenInAnyOrderPackedAndInRadians) {
    Rotated file;
    file.lon = file.place("lon", "radians", {file.x.dimension, file.y.dimension});
    file.text(file.lon, "standard_name", "longitude");
    file.lat = file.place("lat", "degrees_north", {file.y.dimension, file.x.dimension}, NC_INT);
    file.number(file.lat, "scale_factor", 0.25);
    file.field();
    std::vector<double> turned;
    for (std::size_t i = 0; i < kNi; ++i)
        for (std::size_t j = 0; j < kNj; ++j)
            turned.push_back(glm::radians(lonAt(double(i), double(j))));
    file.write(file.lon, turned);
    std::vector<int> quarters;
    for (const double y : ofColumns(latAt))
        quarters.push_back(static_cast<int>(std::lround(4 * y)));
    file.write(file.lat, quarters);
    const auto reader = open(file.closed());
    expectUpright(*reader->variables()[0].grid);
    expectByColumns(*reader->variables()[0].grid);
}

TEST(NetcdfEarth, TheRotatedPoleTellsItWhereNoColumnsDo) {
    for (const RotatedPole& pole : {kPole, RotatedPole{10, -40, 25}})
        for (const char* mapping : {"rotated_pole", "rotated_pole: rlon rlat"}) {
            Rotated file;
            file.mapping(pole);
            file.field("v", mapping);
            const auto reader = open(file.closed());
            const Variable& v = reader->variables()[0];
            expectUpright(*v.grid);
            expectByPole(*v.grid, pole);
            EXPECT_THAT(v.notes, IsEmpty());
        }
}

TEST(NetcdfEarth, ColumnsComeBeforeThePole) {
    Rotated file;
    file.mapping();
    file.placeColumns();
    file.field("v", "rotated_pole");
    file.write(file.lon, ofColumns(lonAt));
    file.write(file.lat, ofColumns(latAt));
    expectByColumns(*open(file.closed())->variables()[0].grid);
}

TEST(NetcdfEarth, IsNotKnownWhereNothingTellsIt) {
    struct Case {
        const char* units;
        const char* mapping;
        const char* without;  // of the mapping's attributes
    };
    for (const auto& [units, mapping, without] :
         {Case{"degrees", "", ""},
          {"degrees", "another", ""},
          {"m", "rotated_pole", ""},
          {"degrees", "rotated_pole", "grid_north_pole_latitude"},
          {"degrees", "rotated_pole", "grid_mapping_name"}}) {
        Rotated file("a.nc", units);
        file.mapping();
        if (*without) NetcdfBuilder::check(nc_del_att(file.id(), file.pole, without));
        file.field("v", mapping);
        const auto reader = open(file.closed());
        expectUpright(*reader->variables()[0].grid);
        EXPECT_FALSE(reader->variables()[0].grid->earth()) << units << " " << mapping << without;
    }
}

// Between 170 and 190 degrees east, as files write it.
TEST(NetcdfEarth, LongitudesGoOnWhereTheyBeginAnew) {
    Rotated file;
    file.placeColumns();
    file.field();
    const auto across = [](double i, double j) { return lonAt(i, j) + 168; };
    file.write(file.lon, ofColumns([&](double i, double j) {
                   const double lon = across(i, j);
                   return lon < 180 ? lon : lon - 360;
               }));
    file.write(file.lat, ofColumns(latAt));
    const auto reader = open(file.closed());
    const EarthPlaces& earth = *reader->variables()[0].grid->earth();
    EXPECT_NEAR(earth.hi().x - earth.lo().x, across(kNi - 1, 0) - across(0, kNj - 1), 1e-9);
    for (std::size_t n = 0; n < earth.count(); ++n) {
        const double turns = (earth[n].x - across(double(n % kNi), double(n / kNi))) / 360;
        EXPECT_NEAR(turns, std::round(turns), 1e-12);
    }
}

// A model's tripolar grid: axes that are right but for the Arctic.
TEST(NetcdfEarth, LongitudesOfTheAxesAloneAreEnoughUnlessColumnsTellOthers) {
    for (const double other : {0.0, 0.001, 3.0}) {
        Rotated file;
        NetcdfBuilder::check(nc_del_att(file.id(), file.x.variable, "standard_name"));
        NetcdfBuilder::check(nc_del_att(file.id(), file.y.variable, "standard_name"));
        file.text(file.x.variable, "units", "degrees_east");
        file.text(file.y.variable, "units", "degrees_north");
        file.placeColumns();
        file.field();
        file.write(file.lon, ofColumns([&](double i, double j) {
                       return eastOf(std::size_t(i)) + 360 + (j > 2 ? other : 0);
                   }));
        file.write(file.lat, ofColumns([](double, double j) { return northOf(std::size_t(j)); }));
        const auto reader = open(file.closed());
        expectUpright(*reader->variables()[0].grid);
        EXPECT_EQ(reader->variables()[0].grid->earth() != nullptr, other > 1) << other;
    }
}

TEST(NetcdfEarth, VariablesShareIt) {
    Rotated file;
    file.placeColumns();
    file.field("u");
    file.field("v");
    file.variable("flat", NC_FLOAT, {file.y.dimension, file.x.dimension});
    file.write(file.lon, ofColumns(lonAt));
    file.write(file.lat, ofColumns(latAt));
    const auto reader = open(file.closed());
    const auto variables = reader->variables();
    ASSERT_EQ(variables.size(), 3u);
    EXPECT_EQ(variables[0].grid, variables[1].grid);
    EXPECT_NE(variables[0].grid, variables[2].grid);
    EXPECT_EQ(variables[0].grid->earth(), variables[2].grid->earth());
    EXPECT_TRUE(variables[2].grid->earth());
}

TEST(NetcdfEarth, ColumnsThatAreNoPlacesCostTheGlobeAlone) {
    Rotated file;
    file.placeColumns();
    file.field();
    file.write(file.lon, std::vector(kNi * kNj, 1e20));
    file.write(file.lat, std::vector(kNi * kNj, 1e20));
    const auto reader = open(file.closed());
    const Variable& v = reader->variables()[0];
    expectUpright(*v.grid);
    EXPECT_FALSE(v.grid->earth());
    EXPECT_THAT(v.notes, ElementsAre("no globe by its longitudes and latitudes: none of them "
                                     "is a longitude and latitude in degrees"));
}

// Of a nest that moves there would be others at each time.
TEST(NetcdfEarth, ColumnsThatMoveAreNotTaken) {
    Rotated file;
    const int t = file.dimension("time", 2);
    file.lon = file.place("lon", "degrees_east", {t, file.y.dimension, file.x.dimension});
    file.lat = file.place("lat", "degrees_north", {t, file.y.dimension, file.x.dimension});
    file.variable("v", NC_FLOAT, {t, file.height.dimension, file.y.dimension, file.x.dimension});
    for (std::size_t step = 0; step < 2; ++step) {
        file.write(file.lon, {step, 0, 0}, {1, kNj, kNi},
                   ofColumns([&](double i, double j) { return lonAt(i, j) + double(step); }));
        file.write(file.lat, {step, 0, 0}, {1, kNj, kNi}, ofColumns(latAt));
    }
    const auto reader = open(file.closed());
    expectUpright(*reader->variables()[0].grid);
    EXPECT_FALSE(reader->variables()[0].grid->earth());
}

// The columns stand where they do, whatever heights their points have.
TEST(NetcdfEarth, PointsAtHeightsOfTheirOwnHaveIt) {
    Rotated file;
    file.mapping();
    const int s = file.dimension("lev", kNk);
    const int sigma = file.variable("lev", NC_DOUBLE, {s});
    file.text(sigma, "standard_name", "atmosphere_hybrid_height_coordinate");
    file.text(sigma, "units", "m");
    file.text(sigma, "formula_terms", "a: lev b: b orog: orog");
    const int b = file.variable("b", NC_DOUBLE, {s}),
              orog = file.place("orog", "m", {file.y.dimension, file.x.dimension});
    const int v = file.variable("v", NC_FLOAT, {s, file.y.dimension, file.x.dimension});
    file.text(v, "grid_mapping", "rotated_pole");
    file.write(sigma, evenly(kNk, 0, 100));
    file.write(b, evenly(kNk, 1, -0.25));
    file.write(orog, ofColumns([](double i, double j) { return 10 * i + j; }));
    const auto reader = open(file.closed());
    const Grid& grid = *reader->variables()[tests::indexOf(*reader, "v")].grid;
    ASSERT_TRUE(grid.mesh());
    EXPECT_NEAR(grid.position(kNi * kNj + 2).z, 100 + 0.75 * 20, 1e-3);
    EXPECT_NEAR(grid.position(2).x, eastOf(2), 1e-5);
    expectByPole(grid, kPole);
}

}  // namespace
}  // namespace timeseries::netcdf_earth
