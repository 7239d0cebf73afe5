// What the elements of Exodus II's blocks take: beside closed forms, and of real meshes beside the
// integral of the trilinear hexahedron, whose corners netCDF's library reads here.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <netcdf.h>

#include <cmath>
#include <glm/matrix.hpp>
#include <string>
#include <vector>

#include "tests/support/netcdf_builder.h"
#include "tests/support/read_variables.h"
#include "tests/support/shared_data.h"
#include "tests/support/trilinear.h"
#include "tests/support/unstructured.h"

namespace timeseries::exodus_volumes {
namespace {

using Path = std::filesystem::path;
using tests::NetcdfBuilder;
constexpr double kError = 1e-6;  // cells are kept in floats

struct Block {
    std::string name;
    std::size_t nodes;
    std::vector<glm::dvec3> corners;  // the first nodes
    double volume;
};

const std::vector<glm::dvec3> kCube{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                    {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
const std::vector<glm::dvec3> kTet{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const std::vector<glm::dvec3> kWedge{{0, 0, 0}, {1, 0, 0}, {0, 1, 0},
                                     {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
const std::vector<glm::dvec3> kPyramid{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.3, 0.4, 1}};
const std::vector<Block> kBlocks{
    {"HEX8", 8, kCube, 1},
    {"HEX20", 20, kCube, 1},
    {"HEX27", 27, kCube, 1},
    {"TETRA", 4, kTet, 1.0 / 6},
    {"TETRA10", 10, kTet, 1.0 / 6},
    {"WEDGE", 6, kWedge, 0.5},
    {"WEDGE15", 15, kWedge, 0.5},
    {"PYRAMID", 5, kPyramid, 1.0 / 3},
    {"PYRAMID13", 13, kPyramid, 1.0 / 3},
};

const glm::dmat3 kLean(1.1, 0.2, 0.1, -0.3, 0.9, 0.2, 0.15, -0.1, 1.3);

// An element a block, one beside the other; nodes beyond the corners are in its middle.
Path written() {
    NetcdfBuilder file("blocks.e");
    std::vector<glm::dvec3> nodes;
    std::vector<std::vector<std::int32_t>> connect;
    for (std::size_t b = 0; b < kBlocks.size(); ++b) {
        const auto& corners = kBlocks[b].corners;
        glm::dvec3 middle(0);
        for (const glm::dvec3& corner : corners) middle += corner / double(corners.size());
        connect.emplace_back();
        for (std::size_t i = 0; i < kBlocks[b].nodes; ++i) {
            nodes.push_back(kLean * (i < corners.size() ? corners[i] : middle) +
                            glm::dvec3(4.0 * double(b), 0, 0));
            connect.back().push_back(static_cast<std::int32_t>(nodes.size()));
        }
    }
    const int line = file.dimension("len_string", 33), step = file.dimension("time_step", 1),
              count = file.dimension("num_nodes", nodes.size()),
              one = file.dimension("num_elem_var", 1);
    file.dimension("num_dim", 3);
    file.dimension("num_el_blk", kBlocks.size());
    const int time = file.variable("time_whole", NC_DOUBLE, {step}),
              names = file.variable("name_elem_var", NC_CHAR, {one, line});
    std::vector<int> at, lists;
    for (const char* name : {"coordx", "coordy", "coordz"})
        at.push_back(file.variable(name, NC_DOUBLE, {count}));
    for (std::size_t b = 1; b <= kBlocks.size(); ++b) {
        const int elements = file.dimension(fmt::format("num_el_in_blk{}", b), 1),
                  each = file.dimension(fmt::format("num_nod_per_el{}", b), kBlocks[b - 1].nodes);
        lists.push_back(file.variable(fmt::format("connect{}", b), NC_INT, {elements, each}));
        file.text(lists.back(), "elem_type", kBlocks[b - 1].name);
        file.variable(fmt::format("vals_elem_var1eb{}", b), NC_DOUBLE, {step, elements});
    }
    file.write(time, std::vector<double>{0});
    std::string name = "w";
    name.resize(33);
    file.writeText(names, name);
    for (int a = 0; a < 3; ++a) {
        std::vector<double> own;
        for (const glm::dvec3& node : nodes) own.push_back(node[a]);
        file.write(at[std::size_t(a)], own);
    }
    for (std::size_t b = 0; b < kBlocks.size(); ++b) file.write(lists[b], connect[b]);
    return file.close();
}

TEST(ExodusVolumes, OfEachKindOfElement) {
    const auto reader = tests::open(written());
    const Mesh& mesh = *reader->variables()[tests::indexOf(*reader, "w")].grid->mesh();
    ASSERT_EQ(mesh.count(), kBlocks.size());
    double all = 0;
    for (std::size_t b = 0; b < kBlocks.size(); ++b) {
        const double expected = glm::determinant(kLean) * kBlocks[b].volume;
        EXPECT_NEAR(tests::volume(mesh, b), expected, kError * expected) << kBlocks[b].name;
        all += expected;
    }
    EXPECT_NEAR(tests::volume(mesh), all, kError * all);
}

class Opened {
 public:
    explicit Opened(const Path& path) { NetcdfBuilder::check(nc_open(path.c_str(), 0, &id_)); }
    ~Opened() { nc_close(id_); }
    Opened(const Opened&) = delete;
    Opened& operator=(const Opened&) = delete;
    std::vector<double> numbers(const std::string& name) const {
        int variable = 0, rank = 0;
        NetcdfBuilder::check(nc_inq_varid(id_, name.c_str(), &variable));
        NetcdfBuilder::check(nc_inq_varndims(id_, variable, &rank));
        std::vector<int> dimensions(std::size_t(rank), 0);
        NetcdfBuilder::check(nc_inq_vardimid(id_, variable, dimensions.data()));
        std::size_t count = 1;
        for (const int dimension : dimensions) {
            std::size_t length = 0;
            NetcdfBuilder::check(nc_inq_dimlen(id_, dimension, &length));
            count *= length;
        }
        std::vector<double> all(count);
        NetcdfBuilder::check(nc_get_var_double(id_, variable, all.data()));
        return all;
    }

 private:
    int id_ = -1;
};

// All elements, which are hexahedra of eight nodes in so many blocks, of the first step; nodes lie
// where these variables say, one coordinate after the other.
double volumeOf(const Path& path, const std::vector<std::string>& coordinates, int blocks) {
    const Opened file(path);
    std::vector<double> at;
    for (const std::string& name : coordinates) {
        const auto own = file.numbers(name);
        at.insert(at.end(), own.begin(), own.end());
    }
    const std::size_t nodes = at.size() / 3;
    double sum = 0;
    for (int b = 1; b <= blocks; ++b) {
        const auto connect = file.numbers(fmt::format("connect{}", b));
        for (std::size_t element = 0; element < connect.size() / 8; ++element) {
            std::vector<glm::dvec3> corners;
            for (std::size_t i = 0; i < 8; ++i) {
                const auto node = static_cast<std::size_t>(connect[8 * element + i]) - 1;
                corners.emplace_back(at[node], at[nodes + node], at[2 * nodes + node]);
            }
            sum += std::abs(tests::trilinearVolume(corners));
        }
    }
    return sum;
}

// Nodes together stand for what the elements take.
void expectWhole(const Path& path, double expected) {
    const auto reader = tests::open(path);
    for (const Variable& variable : reader->variables())
        EXPECT_NEAR(tests::volume(*variable.grid->mesh()), expected, kError * expected)
            << variable.name;
}

TEST(ExodusVolumes, OfADisk) {
    const Path path = tests::sharedData("disk_out_ref.ex2");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no real data at " << path;
    expectWhole(path, volumeOf(path, {"coord"}, 1));
}

TEST(ExodusVolumes, OfAMug) {
    const Path path = tests::sharedData("mug_transient.e");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no real data at " << path;
    expectWhole(path, volumeOf(path, {"coordx", "coordy", "coordz"}, 2));
}

}  // namespace
}  // namespace timeseries::exodus_volumes
