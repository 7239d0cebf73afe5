// Output of SCHISM as it combines it (its combine_output, "schout_1.nc"): UGRID, but that values
// say by `data_horizontal_center` where on the mesh they are, and heights stand in zcor.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/netcdf_builder.h"
#include "tests/support/read_variables.h"
#include "tests/support/unstructured.h"
#include "timeseries/readers/reader.h"

namespace timeseries::netcdf_schism {
namespace {

using tests::NetcdfBuilder;

// Two squares side by side, of which one is two triangles; nodes are counted from one.
constexpr double kSide = 100;
constexpr int kNodes = 6, kFaces = 3, kEdges = 8, kLayers = 4, kSteps = 2;
constexpr std::int32_t kNone = -99999;
const std::vector<std::int32_t> kFaceNodes{1, 2, 5, 4, 2, 3, 6, kNone, 2, 6, 5, kNone};
const std::vector<std::int32_t> kEdgeNodes{1, 2, 2, 3, 4, 5, 5, 6, 1, 4, 2, 5, 3, 6, 2, 6};

glm::dvec2 nodeAt(int node) { return kSide * glm::dvec2(node % 3, node / 3); }
double depthOf(int node) { return 10 + node; }
double surfaceOf(int step, int node) { return 0.5 * step + 0.1 * node; }
// Layers as deep as each other, above the floor.
double heightOf(int step, int node, int layer) {
    const double eta = surfaceOf(step, node);
    return eta + (double(layer) / (kLayers - 1) - 1) * (depthOf(node) + eta);
}
// Below the floor of one node is nothing.
bool isThere(int node, int layer) { return node != 4 || layer > 0; }
float valueOf(int step, int place, int layer) {
    return static_cast<float>(100 * step + 10 * place + layer);
}

struct Declared {
    NetcdfBuilder file{"schout_1.nc"};
    int time = file.dimension("time", NC_UNLIMITED),
        node = file.dimension("nSCHISM_hgrid_node", kNodes),
        face = file.dimension("nSCHISM_hgrid_face", kFaces),
        edge = file.dimension("nSCHISM_hgrid_edge", kEdges),
        four = file.dimension("nMaxSCHISM_hgrid_face_nodes", 4),
        layer = file.dimension("nSCHISM_vgrid_layers", kLayers), one = file.dimension("one", 1),
        two = file.dimension("two", 2);

    int onMesh(const std::string& name, nc_type type, const std::vector<int>& dimensions) {
        const int variable = file.variable(name, type, dimensions);
        file.text(variable, "mesh", "SCHISM_hgrid");
        return variable;
    }
    int values(const std::string& name, const char* center, const std::vector<int>& dimensions) {
        const int variable = onMesh(name, NC_FLOAT, dimensions);
        file.number(variable, "missing_value", NC_FILL_FLOAT);
        file.text(variable, "data_horizontal_center", center);
        file.text(variable, "data_vertical_center", "full");
        return variable;
    }
};

void addMesh(Declared& d) {
    NetcdfBuilder& file = d.file;
    const int mesh = file.variable("SCHISM_hgrid", NC_INT, {d.one});
    file.text(mesh, "long_name", "Topology data of 2d unstructured mesh");
    file.number(mesh, "topology_dimension", std::int32_t{2});
    file.text(mesh, "cf_role", "mesh_topology");
    file.text(mesh, "node_coordinates", "SCHISM_hgrid_node_x SCHISM_hgrid_node_y");
    file.text(mesh, "face_node_connectivity", "SCHISM_hgrid_face_nodes");
    file.text(mesh, "edge_node_connectivity", "SCHISM_hgrid_edge_nodes");
    const int faces = file.variable("SCHISM_hgrid_face_nodes", NC_INT, {d.face, d.four}),
              edges = file.variable("SCHISM_hgrid_edge_nodes", NC_INT, {d.edge, d.two});
    file.text(faces, "cf_role", "face_node_connectivity");
    file.number(faces, "_FillValue", kNone);
    file.text(edges, "cf_role", "edge_node_connectivity");
    for (const int list : {faces, edges}) file.number(list, "start_index", std::int32_t{1});
    std::vector<int> at;
    for (const std::string axis : {"x", "y"}) {
        at.push_back(d.onMesh("SCHISM_hgrid_node_" + axis, NC_FLOAT, {d.node}));
        file.text(at.back(), "standard_name", "projection_" + axis + "_coordinate");
        file.text(at.back(), "units", "m");
    }
    const int depth = d.onMesh("depth", NC_FLOAT, {d.node});
    file.text(depth, "units", "meters");
    file.text(depth, "positive", "down");
    file.text(depth, "location", "node");
    const int bottom = d.onMesh("ele_bottom_index", NC_INT, {d.face});
    file.text(bottom, "location", "elem");
    file.write(faces, kFaceNodes);
    file.write(edges, kEdgeNodes);
    std::vector<float> depths;
    std::array<std::vector<float>, 2> places;
    for (int n = 0; n < kNodes; ++n) {
        depths.push_back(static_cast<float>(depthOf(n)));
        for (int a = 0; a < 2; ++a)
            places[std::size_t(a)].push_back(static_cast<float>(nodeAt(n)[a]));
    }
    file.write(depth, depths);
    file.write(bottom, std::vector<std::int32_t>{1, 2, 3});
    for (std::size_t a = 0; a < 2; ++a) file.write(at[a], places[a]);
}

// [time][place][layer]
template <typename Value>
void fill(NetcdfBuilder& file, int variable, std::size_t places, std::size_t layers,
          const Value& value) {
    std::vector<float> all;
    for (int s = 0; s < kSteps; ++s)
        for (int p = 0; p < int(places); ++p)
            for (int k = 0; k < int(layers); ++k) all.push_back(static_cast<float>(value(s, p, k)));
    std::vector<std::size_t> count{kSteps, places};
    if (layers > 1) count.push_back(layers);
    file.write(variable, std::vector<std::size_t>(count.size(), 0), count, all);
}

std::filesystem::path written() {
    Declared d;
    NetcdfBuilder& file = d.file;
    const int time = file.variable("time", NC_DOUBLE, {d.time});
    file.text(time, "standard_name", "time");
    file.text(time, "units", "seconds since 2011-08-01 00:00:00 +0000");
    file.text(time, "base_date", " 2011  8  1       0.00       0.00");
    const int elev = d.values("elev", "node", {d.time, d.node}),
              dry = d.values("wetdry_elem", "elem", {d.time, d.face}),
              side = d.values("wetdry_side", "side", {d.time, d.edge}),
              zcor = d.values("zcor", "node", {d.time, d.node, d.layer}),
              temp = d.values("temp", "node", {d.time, d.node, d.layer});
    addMesh(d);
    file.write(time, {0}, {kSteps}, std::vector<double>{3600, 7200});
    fill(file, elev, kNodes, 1, [](int s, int n, int) { return surfaceOf(s, n); });
    fill(file, dry, kFaces, 1, valueOf);
    fill(file, side, kEdges, 1, valueOf);
    fill(file, zcor, kNodes, kLayers, [](int s, int n, int k) {
        return isThere(n, k) ? heightOf(s, n, k) : double(NC_FILL_FLOAT);
    });
    fill(file, temp, kNodes, kLayers, valueOf);
    return file.close();
}

TEST(NetcdfSchism, ValuesAreAtNodesInElementsAndAtSides) {
    const auto reader = tests::open(written());
    EXPECT_TRUE(reader->damaged().empty());
    EXPECT_THAT(tests::namesOf(*reader),
                testing::UnorderedElementsAre("elev", "wetdry_elem", "wetdry_side", "zcor", "temp",
                                              "depth", "ele_bottom_index"));
    const auto expectAt = [&](const char* name, int place, const glm::dvec2& at) {
        const Grid& grid = *reader->variables()[tests::indexOf(*reader, name)].grid;
        const glm::dvec3 found = grid.position(std::uint64_t(place));
        EXPECT_NEAR(found.x, at.x, 1e-4) << name << ' ' << place;
        EXPECT_NEAR(found.y, at.y, 1e-4) << name << ' ' << place;
    };
    for (int n = 0; n < kNodes; ++n)
        for (const char* name : {"elev", "depth"}) expectAt(name, n, nodeAt(n));
    for (int f = 0; f < kFaces; ++f) {
        glm::dvec2 sum(0);
        double corners = 0;
        for (int i = 0; i < 4; ++i)
            if (const int node = kFaceNodes[std::size_t(4 * f + i)]; node != kNone)
                sum += nodeAt(node - 1), ++corners;
        for (const char* name : {"wetdry_elem", "ele_bottom_index"})
            expectAt(name, f, sum / corners);
    }
    for (std::size_t e = 0; e < kEdges; ++e)
        expectAt("wetdry_side", int(e),
                 0.5 * (nodeAt(kEdgeNodes[2 * e] - 1) + nodeAt(kEdgeNodes[2 * e + 1] - 1)));
    for (const auto& [name, places] : {std::pair("wetdry_elem", kFaces), {"wetdry_side", kEdges}}) {
        const auto values = tests::valuesOf<float>(*reader, name, 1);
        for (int p = 0; p < places; ++p) EXPECT_EQ(values[std::size_t(p)], valueOf(1, p, 0));
    }
    EXPECT_EQ(reader->variables()[0].time->points[1].date, "2011-08-01 02:00:00");
}

TEST(NetcdfSchism, LayersAreAtTheHeightsOfTheirStep) {
    const auto reader = tests::open(written());
    const std::size_t v = tests::indexOf(*reader, "temp");
    for (const int step : {1, 0}) {
        const Field field = reader->read(v, std::size_t(step));
        const Mesh& mesh = *field.grid->mesh();
        ASSERT_EQ(mesh.size(), (std::array<std::size_t, 3>{kNodes, 1, kLayers}));
        const auto& values = std::get<std::vector<float>>(field.values);
        for (int k = 0; k < kLayers; ++k)
            for (int n = 0; n < kNodes; ++n) {
                const auto index = std::size_t(k * kNodes + n);
                EXPECT_EQ(values[index], valueOf(step, n, k));
                const double height = mesh.position(index).z;
                if (isThere(n, k)) {
                    EXPECT_NEAR(height, heightOf(step, n, k), 1e-5) << n << ' ' << k;
                } else {
                    EXPECT_TRUE(std::isnan(height));
                }
            }
    }
}

}  // namespace
}  // namespace timeseries::netcdf_schism
