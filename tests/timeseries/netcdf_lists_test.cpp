// Places one after another, with polygons about them: by bounds (CF), and by the faces of a mesh
// (UGRID). All about a sphere's belt of 12 x 5 cells of 30 by 24 degrees, which cross the seam.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/array_builder.h"
#include "tests/support/lon_lat_belt.h"
#include "tests/support/netcdf_builder.h"
#include "tests/support/shared_data.h"
#include "tests/support/ugrid.h"
#include "tests/support/unstructured.h"

namespace timeseries {
namespace {

using namespace tests;
using testing::HasSubstr;

constexpr double kAllRound = 360;
constexpr double kAside = 2;  // of places from the middles of their bounds
const std::vector<double> kLevels{0, 10, 30};
const std::vector<double> kHeights{10, 15, 20};

// Values 0, 1, 2, ... at two times, three levels and so many places.
void addField(NetcdfBuilder& file, int places, int list,
              const std::vector<std::pair<std::string, std::string>>& attributes) {
    const auto time = file.coordinate("time", 2, "s");
    const auto depth = file.coordinate("depth", 3, "m");
    const int field = file.variable("T", NC_INT, {time.dimension, depth.dimension, list});
    for (const auto& [name, value] : attributes) file.text(field, name, value);
    const int surface = file.variable("eta", NC_INT, {time.dimension, list});
    for (const auto& [name, value] : attributes) file.text(surface, name, value);
    file.write(time.variable, std::vector<double>{5, 7});
    file.write(depth.variable, kLevels);
    file.write(field, ramp<std::int32_t>(static_cast<std::size_t>(6 * places)));
    file.write(surface, ramp<std::int32_t>(static_cast<std::size_t>(2 * places)));
}

// Each place its own corners, round it; longitudes from -180 to 180 whatever they belong to.
std::filesystem::path withBounds(const std::string& units, bool turned = false) {
    NetcdfBuilder file("bounds.nc");
    const bool radians = units == "radian";
    const double unit = radians ? std::numbers::pi / 180 : 1;
    const int list = file.dimension("ncells", kCells), corner = file.dimension("nv", 4);
    std::vector<double> lon, lat, lons, lats;
    for (int j = 0; j < kUp; ++j)
        for (int i = 0; i < kAround; ++i) {
            lon.push_back(unit * (lonOf(i) + kAside));
            lat.push_back(unit * (latOf(j + 0.5) - kAside));
            for (const auto& [di, dj] : {std::pair(-0.5, 0), {0.5, 0}, {0.5, 1}, {-0.5, 1}}) {
                lons.push_back(unit * wrapped(lonOf(i + di)));
                lats.push_back(unit * latOf(j + dj));
            }
        }
    const int x = file.variable("clon", NC_DOUBLE, {list}),
              y = file.variable("clat", NC_DOUBLE, {list});
    file.text(x, "standard_name", "longitude");
    file.text(y, "standard_name", "latitude");
    file.text(x, "units", units);
    file.text(y, "units", units);
    file.text(x, "bounds", "clon_vertices");
    file.text(y, "bounds", "clat_vertices");
    const std::vector<int> sides = turned ? std::vector{corner, list} : std::vector{list, corner};
    const int xs = file.variable("clon_vertices", NC_DOUBLE, sides),
              ys = file.variable("clat_vertices", NC_DOUBLE, sides);
    addField(file, kCells, list, {{"coordinates", "clon clat"}, {"grid_type", "unstructured"}});
    file.write(x, lon);
    file.write(y, lat);
    file.write(xs, lons);
    file.write(ys, lats);
    return file.close();
}

struct Ugrid {
    std::string location = "face";
    bool triangles = false, transposed = false;
    int first = 0;  // start_index
};

// Nodes once around: those at -180 are also those at 180.
std::filesystem::path withMesh(const Ugrid& what) {
    NetcdfBuilder file("mesh.nc");
    const int nodes = file.dimension("nMesh2_node", kNodes);
    const int count = what.triangles ? 2 * kCells : kCells;
    const int faces = file.dimension("nMesh2_face", static_cast<std::size_t>(count)),
              most = file.dimension("nMaxMesh2_face_nodes", 4);
    const int mesh = file.variable("Mesh2", NC_INT, {});
    file.text(mesh, "cf_role", "mesh_topology");
    file.number(mesh, "topology_dimension", std::int32_t{2});
    file.text(mesh, "node_coordinates", "Mesh2_node_x Mesh2_node_y");
    file.text(mesh, "face_node_connectivity", "Mesh2_face_nodes");
    if (what.transposed) file.text(mesh, "face_dimension", "nMesh2_face");
    const int x = file.variable("Mesh2_node_x", NC_DOUBLE, {nodes}),
              y = file.variable("Mesh2_node_y", NC_DOUBLE, {nodes});
    file.text(x, "units", "degrees_east");
    file.text(y, "units", "degrees_north");
    const int list =
        file.variable("Mesh2_face_nodes", NC_INT,
                      what.transposed ? std::vector{most, faces} : std::vector{faces, most});
    file.text(list, "cf_role", "face_node_connectivity");
    file.number(list, "_FillValue", std::int32_t{-999});
    file.number(list, "start_index", std::int32_t{what.first});
    const bool atFaces = what.location != "node";
    addField(file, atFaces ? count : kNodes, atFaces ? faces : nodes,
             {{"mesh", "Mesh2"}, {"location", what.location}});
    std::vector<double> lon, lat;
    for (int n = 0; n < kNodes; ++n) {
        lon.push_back(lonOf(n % kAround));
        lat.push_back(latOf(n / kAround));
    }
    std::vector<std::vector<std::int32_t>> rows;
    for (int j = 0; j < kUp; ++j)
        for (int i = 0; i < kAround; ++i) {
            const auto node = [&](int di, int dj) {
                return what.first + (i + di) % kAround + kAround * (j + dj);
            };
            if (what.triangles) {
                rows.push_back({node(0, 0), node(1, 0), node(1, 1), -999});
                rows.push_back({node(0, 0), node(1, 1), node(0, 1), -999});
            } else {
                rows.push_back({node(0, 0), node(1, 0), node(1, 1), node(0, 1)});
            }
        }
    std::vector<std::int32_t> connectivity;
    for (std::size_t i = 0; i < rows.size() * 4; ++i)
        connectivity.push_back(what.transposed ? rows[i % rows.size()][i / rows.size()]
                                               : rows[i / 4][i % 4]);
    file.write(x, lon);
    file.write(y, lat);
    file.write(list, connectivity);
    return file.close();
}

// The variable of three levels: at each place of each level `at(place)` and this area; between
// columns is so much of the area of all.
template <typename At, typename Area>
void expectPrisms(const std::filesystem::path& path, int places, double between, const At& at,
                  const Area& area) {
    const auto reader = open(path);
    const Variable& variable = reader->variables()[0];
    ASSERT_EQ(variable.name, "T");
    const Mesh& mesh = *variable.grid->mesh();
    ASSERT_EQ(mesh.count(), static_cast<std::uint64_t>(3 * places));
    double whole = 0;
    for (int k = 0; k < 3; ++k)
        for (int p = 0; p < places; ++p) {
            const auto index = static_cast<std::uint64_t>(k * places + p);
            const glm::dvec3 found = mesh.position(index), expected = at(p);
            EXPECT_NEAR(wrapped(found.x - expected.x), 0, 1e-4) << p;
            EXPECT_NEAR(found.y, expected.y, 1e-4) << p;
            EXPECT_NEAR(found.z, kLevels[std::size_t(k)], 1e-5);
            const double volume = area(p) * kHeights[std::size_t(k)];
            EXPECT_NEAR(tests::volume(mesh, index), volume, 1e-5 * volume) << p << ' ' << k;
            whole += volume;
        }
    const double height = kLevels.back() - kLevels.front();
    EXPECT_NEAR(tests::volumeBetween(mesh), between * height, 1e-6 * between * height);
    EXPECT_NEAR(double(mesh.meanVolume()), whole / (3 * places), 1e-6 * whole);
    for (const std::size_t step : {0u, 1u}) {
        std::vector<std::int32_t> expected(static_cast<std::size_t>(3 * places));
        for (std::size_t i = 0; i < expected.size(); ++i)
            expected[i] = static_cast<std::int32_t>(step * expected.size() + i);
        EXPECT_EQ(std::get<std::vector<std::int32_t>>(reader->read(0, step).values), expected);
    }
    EXPECT_EQ(variable.time->points[1].value, 7);
    EXPECT_TRUE(variable.notes.empty()) << variable.notes[0];
    // Without levels it is a sheet.
    const Variable& surface = reader->variables()[1];
    ASSERT_EQ(surface.name, "eta");
    EXPECT_EQ(surface.grid->count(), static_cast<std::uint64_t>(places));
    EXPECT_EQ(std::get<std::vector<std::int32_t>>(reader->read(1, 1).values)[0], places);
}

glm::dvec3 cellAt(int p) { return {lonOf(p % kAround), latOf(p / kAround + 0.5), 0}; }

TEST(NetcdfLists, BoundsAreTheCellsOfTheirPlaces) {
    for (const std::string units : {"degrees_east", "radian"}) {
        const auto path = withBounds(units);
        const auto at = [](int p) { return cellAt(p) + glm::dvec3(kAside, -kAside, 0); };
        expectPrisms(path, kCells, kAllRound * kHigh * (kUp - 1), at,
                     [](int) { return kWide * kHigh; });
        const auto reader = open(path);
        const auto& axes = reader->variables()[0].grid->axes();
        EXPECT_EQ(axes[0].name, "clon");
        // As they are read.
        EXPECT_EQ(axes[0].units, "degrees_east");
        EXPECT_EQ(axes[1].units, units == "radian" ? "degrees_north" : units);
        EXPECT_EQ(axes[2].name, "depth");
    }
}

TEST(NetcdfLists, FacesOfAMeshAreCells) {
    const auto at = [](int p) { return cellAt(p) + glm::dvec3(kWide / 2, 0, 0); };
    for (const Ugrid& what : {Ugrid{}, Ugrid{.first = 1}, Ugrid{.transposed = true}})
        expectPrisms(withMesh(what), kCells, kAllRound * kHigh * (kUp - 1), at,
                     [](int) { return kWide * kHigh; });
    // The lowest and the highest middles are a third of a row from its sides.
    expectPrisms(
        withMesh({.triangles = true}), 2 * kCells, kAllRound * kHigh * (kUp - 2.0 / 3),
        [&](int p) {
            const double side = p % 2 == 0 ? 1.0 / 6 : -1.0 / 6;
            return at(p / 2) + glm::dvec3(side * kWide, -side * kHigh, 0);
        },
        [](int) { return kWide * kHigh / 2; });
}

TEST(NetcdfLists, NodesOfAMeshHaveTheirSharesOfTheFacesAboutThem) {
    for (const bool triangles : {false, true})
        expectPrisms(
            withMesh({.location = "node", .triangles = triangles}), kNodes, kAllRound * kHigh * kUp,
            [](int p) { return glm::dvec3(lonOf(p % kAround), latOf(p / kAround), 0); },
            [](int p) {
                const int row = p / kAround;
                return kWide * kHigh * (row == 0 || row == kUp ? 0.5 : 1);
            });
}

// Readers hold the files before.
std::string nextName() {
    static int made = 0;
    return fmt::format("small{}.nc", ++made);
}

// Nodes and faces by hand; T at faces, and what else `more` writes.
template <typename More>
std::filesystem::path smallMesh(const std::vector<std::pair<double, double>>& nodes,
                                const std::vector<std::int32_t>& connectivity, const More& more,
                                const std::string& location = "face") {
    NetcdfBuilder file(nextName());
    const int n = file.dimension("node", nodes.size()),
              f = file.dimension("face", connectivity.size() / 3),
              three = file.dimension("three", 3);
    const auto [x, y, list] = declareUgrid(file, n, f, three, "degrees_east", "degrees_north");
    file.text(list, "cf_role", "face_node_connectivity");
    file.number(list, "_FillValue", std::int32_t{-1});
    const int t = file.variable("T", NC_FLOAT, {location == "node" ? n : f});
    file.text(t, "mesh", "mesh");
    file.text(t, "location", location);
    more(file, f);
    std::vector<double> xs, ys;
    for (const auto& [lon, lat] : nodes) xs.push_back(lon), ys.push_back(lat);
    file.write(x, xs);
    file.write(y, ys);
    file.write(list, connectivity);
    return file.close();
}
constexpr auto kNothing = [](NetcdfBuilder&, int) {};

// At a pole a longitude says nothing: a face there is about those of its other corners.
TEST(NetcdfLists, FacesAtAPoleLieAboutTheirOtherCorners) {
    for (const std::vector<std::int32_t>& face :
         {std::vector<std::int32_t>{0, 1, 2}, {1, 0, 2}, {2, 1, 0}}) {
        const auto path = smallMesh({{0, 90}, {170, 85}, {175, 85}}, face, kNothing);
        const auto reader = open(path);
        const Mesh& mesh = *reader->variables()[0].grid->mesh();
        EXPECT_NEAR(mesh.position(0).x, 172.5, 5.0 / 3 / 2 + 1e-4);
        EXPECT_NEAR(mesh.position(0).y, 260.0 / 3, 1e-4);
        EXPECT_NEAR(mesh.hi().x - mesh.lo().x, 0, 1e-4);
    }
    // At nodes they have no second copy: each of two neighbours has its third of one triangle.
    const auto path = smallMesh({{0, 90}, {170, 85}, {175, 85}}, {1, 2, 0}, kNothing, "node");
    const auto reader = open(path);
    const Mesh& mesh = *reader->variables()[0].grid->mesh();
    const double third = tests::volume(mesh, 1);
    EXPECT_GT(third, 0);
    EXPECT_NEAR(tests::volume(mesh, 2), third, 1e-5 * third);
}

TEST(NetcdfLists, FacesWithoutNodesLieNowhereAndThoseOfNodesThatThereAreNotAreRefused) {
    const std::vector<std::pair<double, double>> nodes{{10, 80}, {11, 80}, {11, 81}};
    const auto reader = open(smallMesh(nodes, {0, 1, 2, -1, -1, -1}, kNothing));
    const Mesh& mesh = *reader->variables()[0].grid->mesh();
    EXPECT_EQ(mesh.absent(), 1u);
    EXPECT_GT(mesh.lo().y, 80);
    EXPECT_THAT(refusalOf(smallMesh(nodes, {0, 1, 700}, kNothing)),
                HasSubstr("face 0 has node 700 of 3"));
}

// Found by the fuzzer: they had places, on one level.
TEST(NetcdfLists, NodesOfAMeshWithoutAnyFaceLieNowhere) {
    const auto path = smallMesh(
        {{10, 80}, {11, 80}, {11, 81}}, {-1, -1, -1},
        [](NetcdfBuilder& file, int) {
            const auto depth = file.coordinate("depth", 2, "m");
            const int node = 0;  // the first dimension
            const int v = file.variable("V", NC_FLOAT, {depth.dimension, node});
            file.text(v, "mesh", "mesh");
            file.text(v, "location", "node");
            file.write(depth.variable, std::vector<double>{0, 10});
        },
        "node");
    EXPECT_THAT(refusalOf(path), HasSubstr("expected cells that take space"));
}

TEST(NetcdfLists, WhatIsNoCoordinateOfSpaceIsNoLevel) {
    const auto path =
        smallMesh({{10, 80}, {11, 80}, {11, 81}}, {0, 1, 2}, [](NetcdfBuilder& file, int f) {
            const int member = file.dimension("member", 4);
            const int v = file.variable("V", NC_FLOAT, {member, f});
            file.text(v, "mesh", "mesh");
            file.text(v, "location", "face");
        });
    const auto reader = open(path);
    ASSERT_EQ(reader->variables().size(), 5u);
    EXPECT_EQ(reader->variables()[0].name, "T");
    for (std::size_t v = 1; v < 5; ++v) {
        EXPECT_EQ(reader->variables()[v].name, "V:member=" + std::to_string(v - 1));
        EXPECT_EQ(reader->variables()[v].grid, reader->variables()[0].grid);
    }
}

// One variable of cells that take no space costs no other.
TEST(NetcdfLists, AMeshWithoutAreaCostsItsOwnVariablesAlone) {
    const auto path =
        smallMesh({{10, 80}, {11, 80}, {12, 80}}, {0, 1, 2}, [](NetcdfBuilder& file, int) {
            const auto lat = file.coordinate("lat", 2, "degrees_north"),
                       lon = file.coordinate("lon", 3, "degrees_east");
            file.variable("G", NC_FLOAT, {lat.dimension, lon.dimension});
            file.write(lat.variable, std::vector<double>{1, 2});
            file.write(lon.variable, std::vector<double>{1, 2, 3});
        });
    const auto reader = open(path);
    ASSERT_EQ(reader->variables().size(), 1u);
    EXPECT_EQ(reader->variables()[0].name, "G");
    ASSERT_EQ(reader->damaged().size(), 1u);
    EXPECT_THAT(reader->damaged()[0].why, HasSubstr("expected cells that take space"));
    EXPECT_THAT(refusalOf(smallMesh({{10, 80}, {11, 80}, {12, 80}}, {0, 1, 2}, kNothing)),
                HasSubstr(".nc: variable 'T': expected cells that take space"));
}

TEST(NetcdfLists, WithoutPolygonsTheyAreRefused) {
    EXPECT_THAT(
        refusalOf(withBounds("degrees_east", true)),
        HasSubstr("(60 places listed along ncells) of which the file tells neither bounds (CF) "
                  "nor faces (UGRID, MPAS)"));
    EXPECT_THAT(refusalOf(withMesh({.location = "edge"})),
                HasSubstr("neither bounds (CF) nor faces"));
}

// Triangles of 20 faces that are cut again and again: in the plane of longitude and latitude they
// fill the whole, but for what lies about the poles.
TEST(RealLists, AnOceanOfTrianglesFillsTheGlobe) {
    const auto path = tests::sharedData("grids/icon_ocean_triangles.nc");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no real data at " << path;
    const auto reader = open(path);
    const auto variables = reader->variables();
    const auto found = std::ranges::find(variables, "S", &Variable::name);
    ASSERT_NE(found, variables.end());
    const Mesh& mesh = *found->grid->mesh();
    EXPECT_EQ(mesh.count(), 3u * 20480);
    EXPECT_EQ(mesh.folded(), 0u);
    double area = 0;
    for (std::uint64_t i = 0; i < 20480; ++i) area += tests::volume(mesh, i);
    area /= std::abs(mesh.position(20480).z - mesh.position(0).z);
    EXPECT_NEAR(area / (360 * 180), 1, 0.02);
}

}  // namespace
}  // namespace timeseries
