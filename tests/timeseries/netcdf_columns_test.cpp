// Longitudes and latitudes of two dimensions: where points of a file lie, at each time.
#include <cmath>

#include "tests/support/netcdf_axes.h"

namespace timeseries {
namespace {

using namespace netcdf_axes;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::size_t kNi = 5, kNj = 4, kNk = 3, kTimes = 2;

// Leaning over each other, and farther east at each time.
double lonAt(std::size_t i, std::size_t j, std::size_t t = 0) {
    return 10 + 2.0 * double(i) - 0.5 * double(j) + 3 * double(t);
}
double latAt(std::size_t i, std::size_t j) { return 50 + 1.5 * double(j) + 0.25 * double(i); }

std::vector<double> longitudes(std::size_t t = 0) {
    std::vector<double> all;
    for (std::size_t j = 0; j < kNj; ++j)
        for (std::size_t i = 0; i < kNi; ++i) all.push_back(lonAt(i, j, t));
    return all;
}
std::vector<double> latitudes() {
    std::vector<double> all;
    for (std::size_t j = 0; j < kNj; ++j)
        for (std::size_t i = 0; i < kNi; ++i) all.push_back(latAt(i, j));
    return all;
}

struct Region : NetcdfBuilder {
    int t = dimension("time", kTimes);
    Coordinate k = coordinate("depth", kNk, "m");
    int j = dimension("j", kNj), i = dimension("i", kNi);

    explicit Region(const std::string& name = "a.nc") : NetcdfBuilder(name) {}
    int place(const char* name, const char* units, const std::vector<int>& dimensions,
              nc_type type = NC_DOUBLE) {
        const int id = variable(name, type, dimensions);
        text(id, "units", units);
        return id;
    }
    Path closed() {
        write(k.variable, std::vector<double>{0, 10, 30});
        return close();
    }
};

// To what floats hold of 10 degrees.
void expectPlaces(const Grid& grid, std::size_t t = 0) {
    ASSERT_TRUE(grid.mesh());
    ASSERT_EQ(grid.size(), (std::array{kNi, kNj, kNk}));
    constexpr std::array kDepths{0.0, 10.0, 30.0};
    for (std::uint64_t n = 0; n < grid.count(); ++n) {
        const auto at = grid.indices(n);
        const glm::dvec3 place = grid.position(n);
        EXPECT_NEAR(place.x, lonAt(at.x, at.y, t), 1e-6);
        EXPECT_NEAR(place.y, latAt(at.x, at.y), 1e-6);
        EXPECT_EQ(place.z, kDepths[at.z]);
    }
}

TEST(NetcdfColumns, PointsLieWhereTheirColumnsSay) {
    Region file;
    const int lon = file.place("nav_lon", "degrees_east", {file.j, file.i}),
              lat = file.place("nav_lat", "degrees_north", {file.j, file.i});
    file.variable("v", NC_FLOAT, {file.t, file.k.dimension, file.j, file.i});
    file.text(file.k.variable, "positive", "down");
    file.write(lon, longitudes());
    file.write(lat, latitudes());
    const auto reader = open(file.closed());
    const Variable& v = reader->variables()[0];
    expectPlaces(*v.grid);
    EXPECT_THAT(v.notes, IsEmpty());
    const auto& axes = v.grid->axes();
    EXPECT_EQ(axes[0].name, "nav_lon");
    EXPECT_EQ(axes[0].units, "degrees_east");
    EXPECT_NEAR(axes[0].coordinates[0], lonAt(0, kNj - 1), 1e-12);
    EXPECT_NEAR(axes[0].coordinates[1], lonAt(kNi - 1, 0), 1e-12);
    EXPECT_EQ(axes[1].name, "nav_lat");
    EXPECT_TRUE(axes[2].down);
    EXPECT_EQ(reader->read(0, 1).grid, v.grid) << "the same at every time";
}

TEST(NetcdfColumns, MayBeWrittenInAnyOrderAndPacked) {
    Region file;
    const int lon = file.place("lon", "degrees_east", {file.i, file.j}),
              lat = file.place("lat", "degrees_north", {file.j, file.i}, NC_INT);
    file.number(lat, "scale_factor", 0.25);
    file.variable("v", NC_FLOAT, {file.k.dimension, file.j, file.i});
    std::vector<double> turned;
    for (std::size_t i = 0; i < kNi; ++i)
        for (std::size_t j = 0; j < kNj; ++j) turned.push_back(lonAt(i, j));
    file.write(lon, turned);
    std::vector<int> quarters;
    for (const double y : latitudes()) quarters.push_back(static_cast<int>(std::lround(4 * y)));
    file.write(lat, quarters);
    expectPlaces(*open(file.closed())->variables()[0].grid);
}

// A nest that moves: each step lies where its own columns say, in the box of the first and last.
TEST(NetcdfColumns, MoveInTime) {
    Region file;
    const int lon = file.place("XLONG", "degree_east", {file.t, file.j, file.i}),
              lat = file.place("XLAT", "degree_north", {file.t, file.j, file.i});
    file.variable("v", NC_FLOAT, {file.t, file.k.dimension, file.j, file.i});
    for (std::size_t t = 0; t < kTimes; ++t) {
        file.write(lon, {t, 0, 0}, {1, kNj, kNi}, longitudes(t));
        file.write(lat, {t, 0, 0}, {1, kNj, kNi}, latitudes());
    }
    const auto reader = open(file.closed());
    const Variable& v = reader->variables()[0];
    expectPlaces(*v.grid);
    EXPECT_NEAR(v.grid->axes()[0].coordinates[1], lonAt(kNi - 1, 0, kTimes - 1), 1e-12);
    EXPECT_EQ(reader->read(0, 0).grid, v.grid);
    const auto moved = reader->read(0, 1).grid;
    expectPlaces(*moved, 1);
    EXPECT_EQ(moved->axes(), v.grid->axes()) << "the same box";
}

// Places that a file gives for each time, and are the same at all.
TEST(NetcdfColumns, ThatMoveNowhereAreThoseThatStand) {
    std::vector<std::shared_ptr<const Grid>> grids;
    for (const bool moves : {false, true}) {
        Region file(moves ? "moves.nc" : "stands.nc");
        std::vector<int> along{file.j, file.i};
        if (moves) along.insert(along.begin(), file.t);
        const int lon = file.place("XLONG", "degree_east", along),
                  lat = file.place("XLAT", "degree_north", along);
        file.variable("v", NC_FLOAT, {file.t, file.k.dimension, file.j, file.i});
        for (std::size_t t = 0; t < (moves ? kTimes : 1); ++t) {
            std::vector<std::size_t> first(along.size(), 0), count{kNj, kNi};
            first[0] = moves ? t : 0;
            if (moves) count.insert(count.begin(), 1);
            file.write(lon, first, count, longitudes());
            file.write(lat, first, count, latitudes());
        }
        const auto reader = open(file.closed());
        for (std::size_t t = 0; t < kTimes; ++t) grids.push_back(reader->read(0, t).grid);
        EXPECT_EQ(grids.back(), reader->variables()[0].grid) << "kept once";
    }
    for (const auto& grid : grids) EXPECT_EQ(*grid, *grids[0]);
}

TEST(NetcdfColumns, OfEachFileOfASeriesAreItsOwn) {
    std::vector<Path> paths;
    for (std::size_t t = 0; t < 2; ++t) {
        Region file("run_" + std::to_string(t) + ".nc");
        const int lon = file.place("lon", "degrees_east", {file.j, file.i}),
                  lat = file.place("lat", "degrees_north", {file.j, file.i});
        file.variable("v", NC_FLOAT, {file.k.dimension, file.j, file.i});
        file.write(lon, longitudes(t));
        file.write(lat, latitudes());
        paths.push_back(file.closed());
    }
    const auto reader = openReader(paths);
    ASSERT_EQ(reader->variables()[0].time->points.size(), 2u);
    expectPlaces(*reader->read(0, 1).grid, 1);
    expectPlaces(*reader->read(0, 0).grid, 0);
}

TEST(NetcdfColumns, AreThoseThatTheVariableNames) {
    Region file;
    const int lon = file.place("lon_t", "degrees_east", {file.j, file.i}),
              lat = file.place("lat_t", "degrees_north", {file.j, file.i}),
              other = file.place("lon_u", "degrees_east", {file.j, file.i}),
              otherLat = file.place("lat_u", "degrees_north", {file.j, file.i});
    file.text(file.variable("v", NC_FLOAT, {file.k.dimension, file.j, file.i}), "coordinates",
              "lon_t lat_t");
    file.variable("w", NC_FLOAT, {file.k.dimension, file.j, file.i});
    file.write(lon, longitudes());
    file.write(lat, latitudes());
    file.write(other, longitudes(1));
    file.write(otherLat, latitudes());
    const auto reader = open(file.closed());
    ASSERT_THAT(names(*reader), ElementsAre("v", "w"));
    expectPlaces(*reader->variables()[0].grid);
    EXPECT_FALSE(reader->variables()[1].grid->mesh()) << "which of the two?";
    EXPECT_THAT(reader->variables()[1].notes,
                ElementsAre("drawn in index space: 2-D coordinates lon_t(j, i) and lat_t(j, i) and "
                            "lon_u(j, i) and lat_u(j, i)"));
}

TEST(NetcdfColumns, WithoutAPlaceAreNotDrawn) {
    Region file;
    const int lon = file.place("lon", "degrees_east", {file.j, file.i}),
              lat = file.place("lat", "degrees_north", {file.j, file.i});
    file.number(lon, "_FillValue", -999.0);
    file.variable("v", NC_FLOAT, {file.k.dimension, file.j, file.i});
    std::vector<double> some = longitudes();
    some[2 + kNi * 1] = -999;
    file.write(lon, some);
    file.write(lat, latitudes());
    const auto reader = open(file.closed());
    const Variable& v = reader->variables()[0];
    ASSERT_TRUE(v.grid->mesh());
    for (std::size_t k = 0; k < kNk; ++k)
        EXPECT_TRUE(std::isnan(v.grid->position(2 + kNi * (1 + kNj * k)).x));
    EXPECT_THAT(v.notes, ElementsAre(HasSubstr("3 of 60 points are not drawn: the file gives them "
                                               "no place"),
                                     HasSubstr("3 of 60 points are not drawn: their cells have no "
                                               "volume"),
                                     HasSubstr("9 of 60 points have a neighbour without a place")))
        << "at j = 0 the only neighbour along j is the one without a place";
}

// A header may declare any size: nothing is made for more than the file can hold.
TEST(NetcdfColumns, ThatTheFileCannotHoldPlaceNothing) {
    NetcdfBuilder file("a.nc", NC_NETCDF4);
    const int j = file.dimension("j", 6000), i = file.dimension("i", 6000);
    for (const auto& [name, units] : {std::pair("lon", "degrees_east"), {"lat", "degrees_north"}})
        file.text(file.variable(name, NC_DOUBLE, {j, i}), "units", units);
    file.variable("v", NC_BYTE, {j, i});  // an eighth of that
    const auto reader = open(file.close());
    const Variable& v = reader->variables()[0];
    EXPECT_FALSE(v.grid->mesh());
    EXPECT_EQ(v.grid->count(), 36'000'000u);
    ASSERT_EQ(v.notes.size(), 1u);
    EXPECT_THAT(v.notes[0], HasSubstr("drawn in index space: of its 2-D coordinates lon and lat, "
                                      "expected values that a file of"));
}

TEST(NetcdfColumns, GoRoundTheEarth) {
    Region file;
    const int lon = file.place("lon", "degrees_east", {file.j, file.i}),
              lat = file.place("lat", "degrees_north", {file.j, file.i});
    file.variable("v", NC_FLOAT, {file.k.dimension, file.j, file.i});
    std::vector<double> across;
    for (std::size_t j = 0; j < kNj; ++j)
        for (std::size_t i = 0; i < kNi; ++i) {
            const double at = 176 + 2.0 * double(i);
            across.push_back(at < 180 ? at : at - 360);
        }
    file.write(lon, across);
    file.write(lat, latitudes());
    const auto grid = open(file.closed())->variables()[0].grid;
    for (std::uint64_t n = 0; n < grid->count(); ++n)
        EXPECT_NEAR(grid->mesh()->cell(n).diagonal.x, 2, 1e-4);
}

}  // namespace
}  // namespace timeseries
