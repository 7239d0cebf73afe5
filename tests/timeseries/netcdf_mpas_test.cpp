// Meshes of MPAS, told by the names of their variables.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/array_builder.h"
#include "tests/support/lon_lat_belt.h"
#include "tests/support/netcdf_builder.h"
#include "tests/support/read_variables.h"
#include "tests/support/unstructured.h"

namespace timeseries::netcdf_mpas {
namespace {

using namespace tests;
using testing::HasSubstr;

// Nothing, the interfaces of levels, their middles, or of the ocean how deep they reach, or their
// middles, in all columns alike.
enum class Tells { Nothing, Interfaces, Middles, Depths, AllMiddles };

double interfaceAt(int cell, int level) { return 10 * cell + 100 * level * (level + 1); }
double middleAt(int step, int cell, int level) { return -7 * step - cell - 20 * level * level; }
double bottomOf(int level) { return 10 * (level + 1) * (level + 2); }

// As MPAS writes it: levels before places, vertices counted from 1, with what is none behind them,
// angles that do not say that they are radians.
std::filesystem::path withMpas(bool withUnits, Tells tells = Tells::Nothing) {
    NetcdfBuilder file("mpas.nc");
    constexpr double kRadian = std::numbers::pi / 180;
    const int time = file.dimension("Time", 2), cells = file.dimension("nCells", kCells),
              vertices = file.dimension("nVertices", kNodes), most = file.dimension("maxEdges", 6),
              levels = file.dimension("nVertLevels", 3), three = file.dimension("vertexDegree", 3),
              edges = file.dimension("nEdges", 7);
    const auto angles = [&](const char* name, int list, double add) {
        const int lon = file.variable(std::string("lon") + name, NC_DOUBLE, {list}),
                  lat = file.variable(std::string("lat") + name, NC_DOUBLE, {list});
        if (withUnits) file.text(lon, "units", "rad"), file.text(lat, "units", "rad");
        return [&file, lon, lat, add](int count) {
            std::vector<double> lons, lats;
            for (int n = 0; n < count; ++n) {
                lons.push_back(kRadian * (180 + lonOf(n % kAround + add)));  // 0 to 2 pi
                lats.push_back(kRadian * latOf(n / kAround + add));
            }
            file.write(lon, lons);
            file.write(lat, lats);
        };
    };
    const auto writeCells = angles("Cell", cells, 0.5),
               writeVertices = angles("Vertex", vertices, 0);
    const int about = file.variable("verticesOnCell", NC_INT, {cells, most}),
              counts = file.variable("nEdgesOnCell", NC_INT, {cells}),
              dual = file.variable("cellsOnVertex", NC_INT, {vertices, three}),
              field = file.variable("theta", NC_INT, {time, cells, levels}),
              spin = file.variable("vorticity", NC_INT, {time, vertices, levels});
    file.variable("u", NC_INT, {time, edges, levels});
    std::vector<double> heights;
    int told = 0;
    if (tells != Tells::Nothing) {
        const int between = file.dimension("nVertLevelsP1", 4);
        file.variable("w", NC_INT, {time, cells, between});
        switch (tells) {
            case Tells::Interfaces:
                told = file.variable("zgrid", NC_DOUBLE, {cells, between});
                for (int n = 0; n < 4 * kCells; ++n) heights.push_back(interfaceAt(n / 4, n % 4));
                break;
            case Tells::Middles:
                told = file.variable("zMid", NC_DOUBLE, {time, cells, levels});
                for (int n = 0; n < 2 * 3 * kCells; ++n)
                    heights.push_back(middleAt(n / 3 / kCells, n / 3 % kCells, n % 3));
                break;
            default:
                told = file.variable(tells == Tells::Depths ? "refBottomDepth" : "refZMid",
                                     NC_DOUBLE, {levels});
                for (int n = 0; n < 3; ++n)
                    heights.push_back(tells == Tells::Depths ? bottomOf(n) : -bottomOf(n));
        }
    }
    std::vector<std::int32_t> corners, cellsAbout;
    for (int j = 0; j < kUp; ++j)
        for (int i = 0; i < kAround; ++i) {
            const auto vertex = [&](int di, int dj) {
                return 1 + (i + di) % kAround + kAround * (j + dj);
            };
            for (const int v : {vertex(0, 0), vertex(1, 0), vertex(1, 1), vertex(0, 1), 9, 0})
                corners.push_back(v);
        }
    for (int v = 0; v < kNodes; ++v) {
        const int i = v % kAround, j = v / kAround;
        const auto cell = [&](int di, int dj) {
            const bool isThere = j + dj >= 0 && j + dj < kUp;
            return isThere ? 1 + (i + di + kAround) % kAround + kAround * (j + dj) : 0;
        };
        for (const int c : {cell(-1, -1), cell(0, -1), cell(0, 0)}) cellsAbout.push_back(c);
    }
    writeCells(kCells);
    writeVertices(kNodes);
    file.write(about, corners);
    file.write(counts, std::vector<std::int32_t>(kCells, 4));
    file.write(dual, cellsAbout);
    file.write(field, ramp<std::int32_t>(2 * kCells * 3));
    file.write(spin, ramp<std::int32_t>(2 * kNodes * 3));
    if (tells != Tells::Nothing) file.write(told, heights);
    return file.close();
}

Axis levelsOf(const Reader& reader, const std::string& name) {
    return reader.variables()[tests::indexOf(reader, name)].grid->axes()[2];
}

TEST(NetcdfMpas, AreCellsAboutWhichVerticesStand) {
    for (const bool withUnits : {false, true}) {
        const auto reader = open(withMpas(withUnits));
        std::vector<std::string> names;
        for (const Variable& each : reader->variables()) names.push_back(each.name);
        ASSERT_THAT(names, testing::ElementsAre("theta", "vorticity"));
        const Grid& grid = *reader->variables()[0].grid;
        const Mesh& mesh = *grid.mesh();
        EXPECT_EQ(grid.axes()[0].units, "degrees_east");
        EXPECT_EQ(grid.axes()[1].units, "degrees_north");
        EXPECT_EQ(grid.axes()[0].name, "lonCell");
        EXPECT_EQ(grid.axes()[1].name, "latCell");
        EXPECT_EQ(reader->variables()[1].grid->axes()[0].name, "lonVertex");
        EXPECT_EQ(reader->variables()[1].grid->axes()[1].name, "latVertex");
        ASSERT_EQ(mesh.count(), 3u * kCells);
        const auto values = std::get<std::vector<std::int32_t>>(reader->read(0, 1).values);
        for (int k = 0; k < 3; ++k)
            for (int c = 0; c < kCells; ++c) {
                const auto index = static_cast<std::uint64_t>(k * kCells + c);
                const glm::dvec3 at = mesh.position(index);
                EXPECT_NEAR(wrapped(at.x - 180 - lonOf(c % kAround + 0.5)), 0, 1e-4) << c;
                EXPECT_NEAR(at.y, latOf(c / kAround + 0.5), 1e-4) << c;
                EXPECT_NEAR(at.z, k, 1e-6);
                EXPECT_NEAR(tests::volume(mesh, index), kWide * kHigh, 1e-3) << c;
                EXPECT_EQ(values[index], 3 * kCells + 3 * c + k);
            }
        // Triangles of three cells, half as large; none where the mesh ends.
        const Mesh& dual = *reader->variables()[1].grid->mesh();
        ASSERT_EQ(dual.count(), 3u * kNodes);
        EXPECT_NEAR(tests::volume(dual, kAround + 3), kWide * kHigh / 2, 1e-3);
        EXPECT_EQ(dual.absent() + dual.flat(), 3u * 2 * kAround);
        ASSERT_EQ(reader->damaged().size(), 1u);
        EXPECT_THAT(reader->damaged()[0].why, HasSubstr("'u': expected values on a grid"));
    }
}

// Of most variables between the interfaces, of the vertical wind at these.
TEST(NetcdfMpas, LevelsOfTheAtmosphereAreWhereItsInterfacesTell) {
    const auto reader = open(withMpas(false, Tells::Interfaces));
    for (const auto& [name, levels] : {std::pair{"theta", 3}, {"w", 4}}) {
        const std::size_t v = tests::indexOf(*reader, name);
        EXPECT_THAT(reader->variables()[v].notes, testing::IsEmpty()) << name;
        const Axis z = levelsOf(*reader, name);
        EXPECT_EQ(z.name, "zgrid");
        EXPECT_EQ(z.units, "m");
        EXPECT_FALSE(z.down);
        const Field field = reader->read(v, 1);
        ASSERT_EQ(field.grid->count(), std::uint64_t(levels * kCells));
        for (int n = 0; n < levels * kCells; ++n) {
            const int cell = n % kCells, k = n / kCells;
            const double below = interfaceAt(cell, k), above = interfaceAt(cell, k + 1);
            EXPECT_NEAR(field.grid->position(std::uint64_t(n)).z,
                        levels == 4 ? below : 0.5 * (below + above), 1e-3)
                << name << ' ' << n;
        }
    }
    // At vertices it does not tell.
    EXPECT_EQ(levelsOf(*reader, "vorticity").units, "index");
}

TEST(NetcdfMpas, LevelsAreWhereTheirMiddlesAreAtEachStep) {
    const auto reader = open(withMpas(false, Tells::Middles));
    EXPECT_EQ(levelsOf(*reader, "theta").name, "zMid");
    EXPECT_EQ(levelsOf(*reader, "w").units, "index");
    for (int step = 0; step < 2; ++step) {
        const Field field =
            reader->read(tests::indexOf(*reader, "theta"), static_cast<std::size_t>(step));
        for (int n = 0; n < 3 * kCells; ++n)
            EXPECT_NEAR(field.grid->position(std::uint64_t(n)).z,
                        middleAt(step, n % kCells, n / kCells), 1e-4)
                << n;
    }
}

std::vector<double> heightsAt(const Reader& reader, const std::string& name, int place) {
    const Mesh& mesh = *reader.variables()[tests::indexOf(reader, name)].grid->mesh();
    std::vector<double> heights;
    for (std::uint64_t k = 0; k < mesh.size()[2]; ++k)
        heights.push_back(mesh.position(std::uint64_t(place) + k * mesh.size()[0]).z);
    return heights;
}

TEST(NetcdfMpas, LevelsOfTheOceanAreTheMiddlesOfItsLayers) {
    const auto reader = open(withMpas(false, Tells::Depths));
    for (const char* name : {"theta", "vorticity"}) {
        const Axis z = levelsOf(*reader, name);
        EXPECT_EQ(z.name, "depth");
        EXPECT_EQ(z.units, "m");
        EXPECT_TRUE(z.down);
        EXPECT_THAT(heightsAt(*reader, name, kAround + 3),
                    testing::ElementsAre(bottomOf(0) / 2, (bottomOf(0) + bottomOf(1)) / 2,
                                         (bottomOf(1) + bottomOf(2)) / 2))
            << name;
    }
    EXPECT_THAT(heightsAt(*reader, "w", 7),
                testing::ElementsAre(0, bottomOf(0), bottomOf(1), bottomOf(2)));
    EXPECT_THAT(reader->variables()[0].notes, testing::IsEmpty());
}

TEST(NetcdfMpas, LevelsOfTheOceanAreTheMiddlesThatItTells) {
    const auto reader = open(withMpas(false, Tells::AllMiddles));
    const Axis z = levelsOf(*reader, "theta");
    EXPECT_EQ(z.name, "refZMid");
    EXPECT_FALSE(z.down);
    EXPECT_THAT(heightsAt(*reader, "theta", 7),
                testing::ElementsAre(-bottomOf(0), -bottomOf(1), -bottomOf(2)));
    EXPECT_EQ(levelsOf(*reader, "w").units, "index");
}

}  // namespace
}  // namespace timeseries::netcdf_mpas
