// Values at the edges of a mesh (UGRID), about a sphere's belt of 12 x 5 cells of 30 by 24 degrees,
// which cross the seam.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "tests/support/array_builder.h"
#include "tests/support/lon_lat_belt.h"
#include "tests/support/netcdf_builder.h"
#include "tests/support/read_variables.h"
#include "tests/support/unstructured.h"

namespace timeseries::netcdf_edges {
namespace {

using namespace tests;
using testing::HasSubstr;

struct Edge {
    int from, to;  // nodes
    double lon, lat;
    int faces;  // of which it is a side
};

// Along circles of latitude, then across them.
std::vector<Edge> edges() {
    std::vector<Edge> all;
    for (int j = 0; j <= kUp; ++j)
        for (int i = 0; i < kAround; ++i)
            all.push_back({i + kAround * j, (i + 1) % kAround + kAround * j, lonOf(i + 0.5),
                           latOf(j), j == 0 || j == kUp ? 1 : 2});
    for (int j = 0; j < kUp; ++j)
        for (int i = 0; i < kAround; ++i)
            all.push_back({i + kAround * j, i + kAround * (j + 1), lonOf(i), latOf(j + 0.5), 2});
    return all;
}

struct Form {
    bool turned = false;
    int first = 0;
    int beyond = 0;      // added to an edge's node
    bool apart = false;  // an edge more, of nodes that no face has beside each other
    bool hasEdges = true;
};

std::filesystem::path written(const Form& form) {
    NetcdfBuilder file("edges.nc");
    std::vector<Edge> all = edges();
    if (form.apart) all.push_back({0, 2 * kAround + 5, 0, 0, 0});
    const int nodes = file.dimension("node", kNodes), faces = file.dimension("face", kCells),
              list = file.dimension("edge", all.size()), four = file.dimension("four", 4),
              two = file.dimension("two", 2), levels = file.dimension("level", 3);
    const int mesh = file.variable("mesh", NC_INT, {});
    file.text(mesh, "cf_role", "mesh_topology");
    file.text(mesh, "node_coordinates", "x y");
    file.text(mesh, "face_node_connectivity", "face_nodes");
    if (form.hasEdges) file.text(mesh, "edge_node_connectivity", "edge_nodes");
    if (form.turned) file.text(mesh, "edge_dimension", "edge");
    const int x = file.variable("x", NC_DOUBLE, {nodes}),
              y = file.variable("y", NC_DOUBLE, {nodes});
    file.text(x, "units", "degrees_east");
    file.text(y, "units", "degrees_north");
    const int ofFaces = file.variable("face_nodes", NC_INT, {faces, four}),
              ofEdges =
                  file.variable("edge_nodes", NC_INT,
                                form.turned ? std::vector{two, list} : std::vector{list, two});
    for (const int each : {ofFaces, ofEdges}) {
        file.text(each, "cf_role",
                  each == ofFaces ? "face_node_connectivity" : "edge_node_connectivity");
        file.number(each, "start_index", std::int32_t{form.first});
    }
    const int field = file.variable("flux", NC_INT, {levels, list});
    file.text(field, "mesh", "mesh");
    file.text(field, "location", "edge");
    std::vector<double> lon, lat;
    for (int n = 0; n < kNodes; ++n) {
        lon.push_back(lonOf(n % kAround));
        lat.push_back(latOf(n / kAround));
    }
    std::vector<std::int32_t> corners, ends;
    for (int j = 0; j < kUp; ++j)
        for (int i = 0; i < kAround; ++i)
            for (const auto& [di, dj] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
                corners.push_back(form.first + (i + di) % kAround + kAround * (j + dj));
    for (std::size_t n = 0; n < 2 * all.size(); ++n) {
        const std::size_t end = form.turned ? n / all.size() : n % 2;
        const Edge& edge = all[form.turned ? n % all.size() : n / 2];
        ends.push_back(form.first + (end == 0 ? edge.from : edge.to));
    }
    ends[3] += form.beyond;
    file.write(x, lon);
    file.write(y, lat);
    file.write(ofFaces, corners);
    file.write(ofEdges, ends);
    file.write(field, ramp<std::int32_t>(3 * all.size()));
    return file.close();
}

// A face gives a quarter of itself to each of its sides.
TEST(NetcdfEdges, TakeTheTrianglesToTheMiddlesOfTheFacesBesideThem) {
    for (const bool turned : {false, true})
        for (const int first : {0, 1}) {
            const auto reader = open(written({.turned = turned, .first = first}));
            const Variable& variable = reader->variables()[indexOf(*reader, "flux")];
            const Mesh& mesh = *variable.grid->mesh();
            const std::vector<Edge> all = edges();
            ASSERT_EQ(mesh.count(), 3 * all.size());
            double sum = 0;
            for (std::size_t k = 0; k < 3; ++k)
                for (std::size_t e = 0; e < all.size(); ++e) {
                    const std::uint64_t i = k * all.size() + e;
                    const glm::dvec3 at = mesh.position(i);
                    EXPECT_NEAR(wrapped(at.x - all[e].lon), 0, 1e-4) << e;
                    EXPECT_NEAR(at.y, all[e].lat, 1e-4) << e;
                    EXPECT_NEAR(at.z, double(k), 1e-6) << e;
                    EXPECT_NEAR(tests::volume(mesh, i), all[e].faces * kWide * kHigh / 4, 1e-3)
                        << e;
                    sum += tests::volume(mesh, i);
                }
            EXPECT_NEAR(sum, 3 * kCells * kWide * kHigh, 1);
            EXPECT_EQ(valuesOf<std::int32_t>(*reader, "flux"), ramp<std::int32_t>(3 * all.size()));
        }
}

TEST(NetcdfEdges, ThatAreNoSideOfAFaceTakeNothing) {
    const auto reader = open(written({.apart = true}));
    const Mesh& mesh = *reader->variables()[0].grid->mesh();
    EXPECT_EQ(mesh.absent() + mesh.flat(), 3u);
    EXPECT_NEAR(tests::volume(mesh, kAround), kWide * kHigh / 2, 1e-3);
}

TEST(NetcdfEdges, OfNodesThatThereAreNotAreRefused) {
    EXPECT_THAT(tests::refusalOf(written({.beyond = 1000})), HasSubstr("has node 1002 of 72"));
    EXPECT_THAT(tests::refusalOf(written({.hasEdges = false})),
                HasSubstr("on an unstructured mesh"));
}

}  // namespace
}  // namespace timeseries::netcdf_edges
