// FESOM's values, and their mesh in a second file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "tests/support/damage.h"
#include "tests/support/netcdf_builder.h"
#include "tests/support/read_variables.h"
#include "tests/support/unstructured.h"

namespace timeseries::netcdf_fesom {
namespace {

using namespace tests;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using Path = std::filesystem::path;

// 4 x 3 nodes, two triangles between each four of them; three layers between four levels.
constexpr int kAlong = 4, kUp = 3, kNodes = kAlong * kUp, kTriangles = 2 * 3 * 2, kLayers = 3;
const std::vector<double> kLevelsAt{0, 10, 30, 60}, kLayersAt{5, 20, 45};
// Each reaches half way to its neighbours, the first and the last as far beyond.
const std::array<double, kLayers> kThick{20 - 5, (45 - 5) / 2, 45 - 20};

double lonOf(int node) { return 10 + 2 * (node % kAlong); }
double latOf(int node) { return 50 + node / kAlong; }

std::vector<std::array<int, 3>> triangles() {
    std::vector<std::array<int, 3>> all;
    for (int j = 0; j + 1 < kUp; ++j)
        for (int i = 0; i + 1 < kAlong; ++i) {
            const int n = j * kAlong + i;
            all.push_back({n, n + 1, n + kAlong});
            all.push_back({n + 1, n + kAlong + 1, n + kAlong});
        }
    return all;
}

// Levels of a place, both of nodes and of triangles: 2, 3 or 4, and the first.
int levelsOf(int place) { return 2 + place % 3; }
int firstOf(int place) { return place == 5 ? 2 : 1; }

struct MeshForm {
    bool older = false;  // nodes(n2, nod_n), elem(n3, elem_n), heights
    bool hasLevels = true, hasCeilings = false;
    int first = 1;  // node
    int nodes = kNodes;
};

Path writeMesh(const MeshForm& form = {}, const std::string& name = "fesom.mesh.diag.nc") {
    NetcdfBuilder file(name);
    const int nodes = file.dimension(form.older ? "nod_n" : "nod2", form.nodes),
              faces = file.dimension(form.older ? "elem_n" : "elem", kTriangles),
              nz = file.dimension("nz", 4), nz1 = file.dimension("nz1", 3),
              three = file.dimension("n3", 3), two = file.dimension("n2", 2);
    const int connectivity =
        file.variable(form.older ? "elem" : "face_nodes", NC_INT, {three, faces});
    const int levels = file.variable("nz", NC_DOUBLE, {nz}),
              layers = file.variable("nz1", NC_DOUBLE, {nz1});
    std::vector<int> lists;
    for (const char* const each : {"nlevels_nod2D", "nlevels", "ulevels_nod2D", "ulevels"}) {
        const bool isFirst = each[0] == 'u';
        if (isFirst ? !form.hasCeilings : !form.hasLevels) continue;
        const bool atNodes = std::string(each).ends_with("nod2D");
        lists.push_back(file.variable(each, NC_INT, {atNodes ? nodes : faces}));
    }
    std::vector<double> lons, lats;
    for (int n = 0; n < form.nodes; ++n) lons.push_back(lonOf(n)), lats.push_back(latOf(n));
    if (form.older) {
        const int both = file.variable("nodes", NC_DOUBLE, {two, nodes});
        std::vector<double> all = lons;
        all.insert(all.end(), lats.begin(), lats.end());
        file.write(both, all);
    } else {
        const int lon = file.variable("lon", NC_DOUBLE, {nodes}),
                  lat = file.variable("lat", NC_DOUBLE, {nodes});
        file.write(lon, lons);
        file.write(lat, lats);
    }
    std::vector<std::int32_t> corners;
    for (std::size_t c = 0; c < 3; ++c)
        for (const auto& each : triangles()) corners.push_back(each[c] + form.first);
    file.write(connectivity, corners);
    const auto heights = [&](std::vector<double> depths) {
        for (double& each : depths) each *= form.older ? -1 : 1;
        return depths;
    };
    file.write(levels, heights(kLevelsAt));
    file.write(layers, heights(kLayersAt));
    for (std::size_t i = 0; i < lists.size(); ++i) {
        std::vector<std::int32_t> numbers;
        const bool isFirst = form.hasCeilings && i >= lists.size() - 2;
        const int count = i % 2 == 0 ? form.nodes : kTriangles;
        for (int n = 0; n < count; ++n) numbers.push_back(isFirst ? firstOf(n) : levelsOf(n));
        file.write(lists[i], numbers);
    }
    return file.close();
}

float valueOf(int step, int level, int place) {
    return float(1000 * step + 100 * level + place) + 0.5f;
}

struct ValuesForm {
    const char *along = "nod2", *vertical = "nz1";
    bool placesFirst = false;  // (time, nod2, nz1)
    bool ownDepths = true;
    int first = 0;  // step
};

// Two steps.
Path writeValues(const ValuesForm& form = {}, const std::string& name = "temp.fesom.1948.nc") {
    NetcdfBuilder file(name);
    const int count = form.along == std::string("nod2") ? kNodes : kTriangles;
    const int levels = form.vertical == std::string("nz1") ? 3 : 4;
    const auto time = file.coordinate("time", 2, "seconds since 1948-01-01 00:00:00");
    const int list = file.dimension(form.along, count),
              vertical = file.dimension(form.vertical, levels);
    int depths = -1;
    if (form.ownDepths) depths = file.variable(form.vertical, NC_DOUBLE, {vertical});
    const int v = form.placesFirst
                      ? file.variable("temp", NC_FLOAT, {time.dimension, list, vertical})
                      : file.variable("temp", NC_FLOAT, {time.dimension, vertical, list});
    file.variable("ssh", NC_FLOAT, {time.dimension, list});
    file.write(time.variable, std::vector<double>{3600.0 * form.first, 3600.0 * (form.first + 1)});
    if (form.ownDepths) file.write(depths, levels == 3 ? kLayersAt : kLevelsAt);
    std::vector<float> values;
    for (int t = form.first; t < form.first + 2; ++t)
        for (int a = 0; a < (form.placesFirst ? count : levels); ++a)
            for (int b = 0; b < (form.placesFirst ? levels : count); ++b)
                values.push_back(form.placesFirst ? valueOf(t, b, a) : valueOf(t, a, b));
    file.write(v, values);
    return file.close();
}

// Whether a value is in the water: between so many levels lie one fewer layers.
bool isThere(const ValuesForm& form, const MeshForm& mesh, int level, int place) {
    const bool areLayers = form.vertical == std::string("nz1");
    const bool above = mesh.hasCeilings && level + 1 < firstOf(place);
    return !above && (!mesh.hasLevels || level < levelsOf(place) - (areLayers ? 1 : 0));
}

void expectLevels(const std::vector<float>& values, const ValuesForm& form, const MeshForm& mesh,
                  int step, int first, int levels) {
    const int count = form.along == std::string("nod2") ? kNodes : kTriangles;
    ASSERT_EQ(values.size(), std::size_t(count * levels));
    for (int k = 0; k < levels; ++k)
        for (int p = 0; p < count; ++p) {
            const float value = values[std::size_t(k * count + p)];
            const bool isValue = value == valueOf(step, first + k, p);
            EXPECT_TRUE(isThere(form, mesh, first + k, p) ? isValue : std::isnan(value))
                << first + k << ' ' << p << ": " << value;
        }
}

void expectValues(const ValuesForm& form, const MeshForm& mesh) {
    freshFolder();
    const Path meshPath = writeMesh(mesh), path = writeValues(form);
    const auto reader = open(path);
    const std::size_t v = indexOf(*reader, "temp");
    const int levels = form.vertical == std::string("nz1") ? 3 : 4;
    for (const int step : {0, 1}) {
        const Field field = reader->read(v, std::size_t(step));
        expectLevels(std::get<std::vector<float>>(field.values), form, mesh, step, 0, levels);
    }
    // A part of it is the same part.
    const Field slab = reader->slab(v, 1, {2, 1, 2});
    expectLevels(std::get<std::vector<float>>(slab.values), form, mesh, 1, 1, 2);
    EXPECT_EQ(reader->sources(v, 1).files, (std::vector<Path>{path, meshPath}));
    EXPECT_EQ(reader->variables()[indexOf(*reader, "ssh")].grid->count(),
              std::uint64_t(form.along == std::string("nod2") ? kNodes : kTriangles));
}

TEST(NetcdfFesom, ValuesAreTheFilesAboveTheSeaFloor) {
    for (const bool older : {false, true})
        for (const bool placesFirst : {false, true})
            for (const char* const along : {"nod2", "elem"})
                for (const char* const vertical : {"nz1", "nz"}) {
                    const ValuesForm form{
                        .along = along, .vertical = vertical, .placesFirst = placesFirst};
                    expectValues(form, {.older = older});
                }
    expectValues({}, {.hasCeilings = true});
    expectValues({.along = "elem"}, {.hasCeilings = true});
    expectValues({}, {.hasLevels = false});
}

TEST(NetcdfFesom, NodesStandForAThirdOfTheTrianglesAboutThem) {
    for (const bool older : {false, true})
        for (const bool ownDepths : {false, true}) {
            freshFolder();
            writeMesh({.older = older});
            const auto reader = open(writeValues({.ownDepths = ownDepths}));
            const Grid& grid = *reader->variables()[indexOf(*reader, "temp")].grid;
            EXPECT_EQ(grid.axes()[0].units, "degrees_east");
            // Heights where the mesh alone has them and counts from the surface down.
            const bool down = ownDepths || !older;
            EXPECT_EQ(grid.axes()[2].down, down);
            const Mesh& mesh = *grid.mesh();
            ASSERT_EQ(mesh.count(), std::uint64_t(kNodes * kLayers));
            std::array<int, kNodes> about{};
            for (const auto& each : triangles())
                for (const int node : each) ++about[std::size_t(node)];
            for (int k = 0; k < kLayers; ++k)
                for (int n = 0; n < kNodes; ++n) {
                    const auto i = std::uint64_t(k * kNodes + n);
                    const glm::dvec3 at = mesh.position(i);
                    EXPECT_NEAR(at.x, lonOf(n), 1e-4);
                    EXPECT_NEAR(at.y, latOf(n), 1e-4);
                    EXPECT_NEAR(at.z, (down ? 1 : -1) * kLayersAt[std::size_t(k)], 1e-4);
                    // A triangle has an area of 1.
                    EXPECT_NEAR(tests::volume(mesh, i),
                                about[std::size_t(n)] / 3.0 * kThick[std::size_t(k)], 1e-3)
                        << k << ' ' << n;
                }
        }
}

// Of values, and of the mesh beside them.
TEST(NetcdfFesom, FilesCutOrDamagedAnywhereAreReadOrRefused) {
    freshFolder();
    const Path mesh = writeMesh(), path = writeValues();
    tests::damageInRounds(path, path, 30);
    tests::damageInRounds(mesh, path, 30);
}

TEST(NetcdfFesom, TrianglesStandForThemselves) {
    freshFolder();
    writeMesh();
    const auto reader = open(writeValues({.along = "elem"}));
    const Mesh& mesh = *reader->variables()[indexOf(*reader, "temp")].grid->mesh();
    const auto all = triangles();
    ASSERT_EQ(mesh.count(), all.size() * kLayers);
    for (std::size_t k = 0; k < kLayers; ++k)
        for (std::size_t e = 0; e < all.size(); ++e) {
            double lon = 0, lat = 0;
            for (const int node : all[e]) lon += lonOf(node) / 3, lat += latOf(node) / 3;
            const auto i = std::uint64_t(k * all.size() + e);
            EXPECT_NEAR(mesh.position(i).x, lon, 1e-4) << e;
            EXPECT_NEAR(mesh.position(i).y, lat, 1e-4) << e;
            EXPECT_NEAR(mesh.position(i).z, kLayersAt[k], 1e-4) << e;
            EXPECT_NEAR(tests::volume(mesh, i), kThick[k], 1e-3) << e;
        }
}

TEST(NetcdfFesom, FilesAreASeries) {
    freshFolder();
    writeMesh();
    const std::vector<Path> paths{writeValues(), writeValues({.first = 2}, "temp.fesom.1949.nc")};
    const auto reader = openReader(paths);
    EXPECT_THAT(timesOf(*reader), ElementsAre(0, 3600, 7200, 10800));
    EXPECT_EQ(valuesOf<float>(*reader, "temp", 3)[2], valueOf(3, 0, 2));
}

TEST(NetcdfFesom, TheMeshMayBeCalledAsTheRun) {
    freshFolder();
    writeMesh({}, "awicm3.mesh.diag.nc");
    EXPECT_EQ(valuesOf<float>(*open(writeValues({}, "temp.awicm3.1948.nc")), "temp")[0],
              valueOf(0, 0, 0));
}

TEST(NetcdfFesom, AMeshThatIsNotThereIsNamed) {
    freshFolder();
    const Path path = writeValues();
    EXPECT_EQ(tests::refusalOf(path),
              path.string() +
                  ": expected the mesh of FESOM's values beside them, but there is no "
                  "fesom.mesh.diag.nc");
    EXPECT_THAT(tests::refusalOf(writeValues({}, "temp.run.1.nc")),
                HasSubstr("no fesom.mesh.diag.nc nor run.mesh.diag.nc"));
}

TEST(NetcdfFesom, AMeshOfOtherValuesIsRefused) {
    freshFolder();
    writeMesh({.nodes = kNodes + 1});
    EXPECT_THAT(
        tests::refusalOf(writeValues()),
        AllOf(HasSubstr("fesom.mesh.diag.nc: expected a mesh of 12 nodes"), HasSubstr("found 13")));
    // Nodes are counted from 1: none is 0.
    writeMesh({.first = 0});
    EXPECT_THAT(tests::refusalOf(writeValues()), HasSubstr("node 0"));
    writeMesh({.first = 2});
    EXPECT_THAT(tests::refusalOf(writeValues()), HasSubstr("has node 13 of 12"));
    NetcdfBuilder empty("fesom.mesh.diag.nc");
    empty.dimension("nod2", kNodes);
    empty.close();
    EXPECT_THAT(tests::refusalOf(writeValues()),
                HasSubstr("expected the triangles of FESOM's mesh"));
}

// As post-processing packs them.
TEST(NetcdfFesom, IntegersNeedAFillForWhatIsBelowTheSeaFloor) {
    freshFolder();
    writeMesh();
    const auto written = [](bool hasFill) {
        NetcdfBuilder file("temp.fesom.1948.nc");
        const int nodes = file.dimension("nod2", kNodes), layers = file.dimension("nz1", kLayers);
        const int v = file.variable("temp", NC_SHORT, {layers, nodes});
        if (hasFill) file.number(v, "_FillValue", std::int16_t{-7});
        file.write(v, std::vector<std::int16_t>(kNodes * kLayers, 4));
        return file.close();
    };
    const Field field = open(written(true))->read(0, 0);
    ASSERT_EQ(field.missing.size(), std::size_t(kNodes * kLayers));
    for (int k = 0; k < kLayers; ++k)
        for (int n = 0; n < kNodes; ++n) {
            const auto i = std::size_t(k * kNodes + n);
            EXPECT_EQ(field.missing[i], !isThere({}, {}, k, n)) << k << ' ' << n;
            if (!field.missing[i]) {
                EXPECT_EQ(std::get<std::vector<std::int16_t>>(field.values)[i], 4);
            }
        }
    EXPECT_THAT(refusalOfRead(written(false)), HasSubstr("below the sea floor"));
}

}  // namespace
}  // namespace timeseries::netcdf_fesom
