// Output of the Met Office's LFRic as its server, XIOS, writes it: UGRID, a mesh for each kind of
// levels, of a cubed sphere, lists of neighbours that no mesh names, and winds at the edges of a
// mesh without faces.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "render/points/globe.h"
#include "tests/support/cubed_sphere.h"
#include "tests/support/netcdf_builder.h"
#include "tests/support/read_variables.h"
#include "tests/support/unstructured.h"
#include "timeseries/index/sorted_step.h"
#include "timeseries/readers/reader.h"

namespace timeseries::netcdf_lfric {
namespace {

using tests::CubedSphere;
using tests::NetcdfBuilder;

constexpr std::size_t kSteps = 2, kHalf = 4, kFull = kHalf + 1;
const CubedSphere kSphere(4);
const std::size_t kFaces = kSphere.faces.size();

double valueOf(std::size_t step, std::size_t level, std::size_t place) {
    return 1000.0 * double(step) + 200.0 * double(level) + double(place);
}

template <std::size_t N>
std::vector<std::int32_t> flat(const std::vector<std::array<std::int32_t, N>>& lists) {
    std::vector<std::int32_t> all;
    for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
    return all;
}

// "Mesh2d_half_levels" and its kind; what is written once all is declared.
class LfricMesh {
 public:
    LfricMesh(NetcdfBuilder& file, const std::string& name, int two, bool hasFaces)
        : file_(file), name_(name), hasFaces_(hasFaces) {
        node_ = file.dimension("n" + name + "_node", kSphere.nodes.size());
        edge_ = file.dimension("n" + name + "_edge", kSphere.edges.size());
        const int mesh = file.variable(name, NC_INT, {});
        say(mesh, {{"cf_role", "mesh_topology"},
                   {"long_name", "Topology data of 2D unstructured mesh"},
                   {"node_coordinates", name + "_node_x " + name + "_node_y"},
                   {"edge_coordinates", name + "_edge_x " + name + "_edge_y"},
                   {"edge_node_connectivity", name + "_edge_nodes"}});
        file.number(mesh, "topology_dimension", std::int32_t{2});
        nodes_ = places("node", node_);
        edgePlaces_ = places("edge", edge_);
        edgeNodes_ = list("edge_nodes", "edge_node_connectivity", edge_, two);
        if (!hasFaces) return;
        say(mesh, {{"face_coordinates", name + "_face_x " + name + "_face_y"},
                   {"face_node_connectivity", name + "_face_nodes"}});
        face_ = file.dimension("n" + name + "_face", kFaces);
        const int vertex = file.dimension("n" + name + "_vertex", 4);
        facePlaces_ = places("face", face_);
        faceNodes_ = list("face_nodes", "face_node_connectivity", face_, vertex);
        // No mesh names these, and some roles are none of UGRID's.
        orphans_ = {list("face_edges", "face_edge_connectivity", face_, vertex),
                    list("edge_face_links", "edge_face connectivity", edge_, two),
                    list("face_links", "face_face connectivity", face_, vertex)};
    }
    int place(const std::string& location) const { return location == "edge" ? edge_ : face_; }
    const std::string& name() const { return name_; }
    void write() {
        writePlaces(nodes_, kSphere.nodes);
        std::vector<glm::dvec3> middles;
        for (const auto& [a, b] : kSphere.edges)
            middles.push_back(
                glm::normalize(kSphere.nodes[std::size_t(a)] + kSphere.nodes[std::size_t(b)]));
        writePlaces(edgePlaces_, middles);
        file_.write(edgeNodes_, flat(kSphere.edges));
        if (!hasFaces_) return;
        writePlaces(facePlaces_, kSphere.middles);
        file_.write(faceNodes_, flat(kSphere.faces));
        for (const int orphan : orphans_) file_.write(orphan, std::vector<std::int32_t>(400, 7));
    }

 private:
    void say(int variable, const std::vector<std::pair<std::string, std::string>>& texts) {
        for (const auto& [name, text] : texts) file_.text(variable, name, text);
    }
    std::array<int, 2> places(const std::string& location, int along) {
        std::array<int, 2> both{};
        for (const std::size_t a : {0u, 1u}) {
            both[a] =
                file_.variable(name_ + "_" + location + (a == 0 ? "_x" : "_y"), NC_FLOAT, {along});
            say(both[a], {{"standard_name", a == 0 ? "longitude" : "latitude"},
                          {"units", a == 0 ? "degrees_east" : "degrees_north"}});
        }
        return both;
    }
    int list(const std::string& name, const std::string& role, int of, int each) {
        const int variable = file_.variable(name_ + "_" + name, NC_INT, {of, each});
        say(variable, {{"cf_role", role}});
        file_.number(variable, "start_index", std::int32_t{0});
        return variable;
    }
    void writePlaces(const std::array<int, 2>& variables, const std::vector<glm::dvec3>& all) {
        for (const int a : {0, 1}) {
            std::vector<float> own;
            for (const glm::dvec3& at : all)
                own.push_back(static_cast<float>(tests::lonLatOf(at)[a]));
            file_.write(variables[std::size_t(a)], own);
        }
    }

    NetcdfBuilder& file_;
    std::string name_;
    bool hasFaces_;
    int node_ = 0, edge_ = 0, face_ = 0, edgeNodes_ = 0, faceNodes_ = 0;
    std::array<int, 2> nodes_{}, edgePlaces_{}, facePlaces_{};
    std::vector<int> orphans_;
};

std::filesystem::path written() {
    NetcdfBuilder file("lfric_diag.nc");
    const int time = file.dimension("time_counter", NC_UNLIMITED), two = file.dimension("Two", 2),
              bound = file.dimension("axis_nbounds", 2);
    LfricMesh full(file, "Mesh2d_full_levels", two, true),
        half(file, "Mesh2d_half_levels", two, true),
        edges(file, "Mesh2d_edge_half_levels", two, false);
    const auto levels = [&](const std::string& name, std::size_t count) {
        const auto axis = file.coordinate(name, count, "1");
        file.text(axis.variable, "axis", "Z");
        file.text(axis.variable, "positive", "up");
        return axis;
    };
    const auto halves = levels("half_levels", kHalf), fulls = levels("full_levels", kFull);
    const int instant = file.variable("time_instant", NC_DOUBLE, {time});
    file.text(instant, "standard_name", "time");
    file.text(instant, "calendar", "gregorian");
    file.text(instant, "units", "seconds since 2016-01-01 15:00:00");
    file.text(instant, "bounds", "time_instant_bounds");
    file.variable("time_instant_bounds", NC_DOUBLE, {time, bound});
    struct Written {
        int variable;
        std::size_t levels, places;
    };
    std::vector<Written> fields;
    const auto add = [&](const std::string& name, const LfricMesh& mesh,
                         const std::string& location, std::optional<NetcdfBuilder::Coordinate> on,
                         std::size_t count) {
        std::vector<int> dimensions{time};
        if (on) dimensions.push_back(on->dimension);
        dimensions.push_back(mesh.place(location));
        const int variable = file.variable(name, NC_DOUBLE, dimensions);
        file.text(variable, "mesh", mesh.name());
        file.text(variable, "location", location);
        file.text(variable, "coordinates",
                  fmt::format("time_instant {0}_{1}_y {0}_{1}_x", mesh.name(), location));
        fields.push_back({variable, count, location == "edge" ? kSphere.edges.size() : kFaces});
    };
    add("theta", full, "face", fulls, kFull);
    add("rho", half, "face", halves, kHalf);
    add("u_in_w2h", edges, "edge", halves, kHalf);
    add("conv_rain", half, "face", std::nullopt, 1);
    for (LfricMesh* mesh : {&full, &half, &edges}) mesh->write();
    file.write(halves.variable, std::vector<double>{0.5, 1.5, 2.5, 3.5});
    file.write(fulls.variable, std::vector<double>{0, 1, 2, 3, 4});
    file.write(instant, {0}, {kSteps}, std::vector<double>{3600, 7200});
    for (const Written& field : fields) {
        std::vector<double> values;
        for (std::size_t s = 0; s < kSteps; ++s)
            for (std::size_t k = 0; k < field.levels; ++k)
                for (std::size_t p = 0; p < field.places; ++p) values.push_back(valueOf(s, k, p));
        std::vector<std::size_t> count{kSteps, field.places};
        if (field.levels > 1) count.insert(count.begin() + 1, field.levels);
        file.write(field.variable, std::vector<std::size_t>(count.size(), 0), count, values);
    }
    return file.close();
}

struct Drawn {
    const char* name;
    std::size_t levels;
    double lowest;
};
const std::vector<Drawn> kDrawn{{"theta", kFull, 0}, {"rho", kHalf, 0.5}, {"conv_rain", 1, 0}};

TEST(NetcdfLfric, FieldsAreOfTheirOwnMeshAndLevelsAtTheTimesOfTheModel) {
    const auto reader = tests::open(written());
    EXPECT_THAT(tests::namesOf(*reader), testing::ElementsAre("theta", "rho", "conv_rain"));
    ASSERT_EQ(reader->damaged().size(), 1u);
    EXPECT_EQ(reader->damaged()[0].name, "u_in_w2h");
    EXPECT_THAT(reader->damaged()[0].why, testing::HasSubstr("nMesh2d_edge_half_levels_edge"));
    for (const Drawn& drawn : kDrawn) {
        const std::size_t v = tests::indexOf(*reader, drawn.name);
        const Variable& variable = reader->variables()[v];
        EXPECT_EQ(variable.time->points[0].date, "2016-01-01 16:00:00");
        EXPECT_EQ(variable.time->points[1].date, "2016-01-01 17:00:00");
        ASSERT_EQ(variable.grid->count(), drawn.levels * kFaces);
        for (const std::size_t step : {1u, 0u}) {
            const Field field = reader->read(v, step);
            const auto& values = std::get<std::vector<double>>(field.values);
            for (std::size_t k = 0; k < drawn.levels; ++k)
                for (std::size_t f = 0; f < kFaces; ++f) {
                    ASSERT_EQ(values[k * kFaces + f], valueOf(step, k, f));
                    EXPECT_EQ(field.grid->position(k * kFaces + f).z, drawn.lowest + double(k));
                }
        }
    }
}

TEST(NetcdfLfric, AsManyAreInARangeAsByBruteForce) {
    const auto reader = tests::open(written());
    for (const Drawn& drawn : kDrawn)
        for (std::size_t step = 0; step < kSteps; ++step) {
            const SortedStep sorted =
                SortedStep::build(reader->read(tests::indexOf(*reader, drawn.name), step));
            for (const double lo : {0.0, 90.0, 250.0, 1000.0, 1700.5}) {
                std::uint64_t expected = 0;
                for (std::size_t k = 0; k < drawn.levels; ++k)
                    for (std::size_t f = 0; f < kFaces; ++f)
                        if (const double value = valueOf(step, k, f); value >= lo && value <= 1710)
                            ++expected;
                EXPECT_EQ(sorted.count(RangeSet::parse(fmt::format("{}:1710", lo))), expected)
                    << drawn.name << ' ' << step << ' ' << lo;
            }
        }
}

// Of a flat polygon: its area and its centroid.
struct Polygon {
    double area;
    glm::dvec2 centroid;
};
Polygon polygonOf(const std::vector<glm::dvec2>& corners) {
    double twice = 0;
    glm::dvec2 sum(0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 a = corners[i], b = corners[(i + 1) % corners.size()];
        const double part = a.x * b.y - b.x * a.y;
        twice += part;
        sum += part * (a + b);
    }
    return {std::abs(twice) / 2, sum / (3 * twice)};
}

// Of faces off the poles, on the map: also where longitudes begin anew within them.
TEST(NetcdfLfric, FacesAreTheirPolygonsOnTheMap) {
    const auto reader = tests::open(written());
    int across = 0;
    for (std::size_t f = 0; f < kFaces; ++f) {
        const double middle = tests::lonLatOf(kSphere.middles[f]).x;
        std::vector<glm::dvec2> corners;
        bool isAtPole = false, isAcross = false;
        for (const std::int32_t node : kSphere.faces[f]) {
            glm::dvec2 at = tests::lonLatOf(kSphere.nodes[std::size_t(node)]);
            isAtPole = isAtPole || std::abs(at.y) > 89;
            const double turned = at.x + 360 * std::round((middle - at.x) / 360);
            isAcross = isAcross || turned != at.x;
            corners.emplace_back(turned, at.y);
        }
        if (isAtPole) continue;
        if (isAcross) ++across;
        const Polygon expected = polygonOf(corners);
        for (const Drawn& drawn : {kDrawn[0], kDrawn[1]}) {
            const Mesh& mesh =
                *reader->variables()[tests::indexOf(*reader, drawn.name)].grid->mesh();
            for (std::size_t k = 0; k < drawn.levels; ++k) {
                const glm::dvec3 at = mesh.position(k * kFaces + f);
                const double way = at.x - expected.centroid.x;
                EXPECT_NEAR(way, 360 * std::round(way / 360), 1e-3) << f;
                EXPECT_NEAR(at.y, expected.centroid.y, 1e-3) << f;
                // Levels are one apart.
                EXPECT_NEAR(mesh.volume(k * kFaces + f), expected.area, 1e-5 * expected.area) << f;
            }
        }
    }
    EXPECT_GE(across, 4);
}

// In each of its own, also at the poles, where four meet; levels are one above the other.
TEST(NetcdfLfric, FacesAreWhereTheyAreOnTheGlobe) {
    const auto reader = tests::open(written());
    const double quarter = 90.0 / 4 / 4 * render::kPerDegree;  // of a face's width
    for (const Drawn& drawn : kDrawn) {
        const Grid& grid = *reader->variables()[tests::indexOf(*reader, drawn.name)].grid;
        ASSERT_TRUE(render::isGeographic(grid)) << drawn.name;
        ASSERT_TRUE(render::Globe::shows(grid)) << drawn.name;
        const render::Globe globe(grid);
        EXPECT_TRUE(globe.isWhole());
        const auto mesh = globe.meshOf(grid);
        for (std::size_t k = 0; k < drawn.levels; ++k)
            for (std::size_t f = 0; f < kFaces; ++f) {
                const glm::dvec3 at = mesh->position(k * kFaces + f);
                EXPECT_NEAR(glm::length(at), globe.radius(drawn.lowest + double(k)), 1e-5);
                const double way =
                    std::acos(std::min(1.0, glm::dot(glm::normalize(at), kSphere.middles[f])));
                EXPECT_LT(way, quarter) << drawn.name << ' ' << f;
            }
    }
}

}  // namespace
}  // namespace timeseries::netcdf_lfric
