// Results of finite elements at nodes and elements, in files as Exodus II's library writes them.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>
#include <set>
#include <sstream>

#include "tests/support/damage.h"
#include "tests/support/kept_steps.h"
#include "tests/support/netcdf_builder.h"
#include "tests/support/read_variables.h"
#include "tests/support/shared_data.h"
#include "tests/support/unstructured.h"
#include "timeseries/grid/cell_types.h"
#include "timeseries/readers/netcdf/netcdf_file.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

using testing::HasSubstr;
using tests::NetcdfBuilder;
using tests::open;
using tests::refusalOf;
using Path = std::filesystem::path;

// Two unit cubes beside each other, of 12 nodes: a block of one hexahedron, one of two wedges.
struct Written {
    bool together = false;  // coordinates, and nodes' values, in one variable
    std::vector<double> times{0.5, 2};
    std::vector<std::int32_t> cube{1, 2, 5, 4, 7, 8, 11, 10};
    std::string kind = "HEX8";
    std::vector<std::string> atNodes{"T", "p"};
};

// Of a node, an element's corner.
float valueOf(std::size_t step, std::size_t variable, std::size_t node) {
    return static_cast<float>(1000 * step + 100 * variable + node);
}
// What is added to each of its coordinates.
float displacementOf(std::size_t step, std::size_t node) {
    return 0.25f * static_cast<float>(step * node);
}

void names(NetcdfBuilder& file, int variable, const std::vector<std::string>& all) {
    std::string text;
    for (std::string name : all) {
        name.resize(33);
        text += name;
    }
    file.writeText(variable, text);
}

Path write(const Written& what, const std::string& name = "a.e") {
    NetcdfBuilder file(name, what.together ? 0 : NC_NETCDF4);
    const int line = file.dimension("len_string", 33),
              steps = file.dimension("time_step", what.times.size()),
              dims = file.dimension("num_dim", 3), nodes = file.dimension("num_nodes", 12);
    file.dimension("num_elem", 3);
    file.dimension("num_el_blk", 2);
    const int one = file.dimension("num_el_in_blk1", 1),
              eight = file.dimension("num_nod_per_el1", 8),
              two = file.dimension("num_el_in_blk2", 2), six = file.dimension("num_nod_per_el2", 6),
              ofNodes = file.dimension("num_nod_var", what.atNodes.size()),
              ofElements = file.dimension("num_elem_var", 2);
    const int time = file.variable("time_whole", NC_DOUBLE, {steps});
    std::vector<int> coordinates;
    if (what.together)
        coordinates = {file.variable("coord", NC_DOUBLE, {dims, nodes})};
    else
        for (const char* each : {"coordx", "coordy", "coordz"})
            coordinates.push_back(file.variable(each, NC_FLOAT, {nodes}));
    const int cube = file.variable("connect1", NC_INT, {one, eight});
    file.text(cube, "elem_type", what.kind);
    const int wedges = file.variable("connect2", NC_INT, {two, six});
    file.text(wedges, "elem_type", "wedge");
    const int nodeNames = file.variable("name_nod_var", NC_CHAR, {ofNodes, line}),
              elementNames = file.variable("name_elem_var", NC_CHAR, {ofElements, line});
    std::vector<int> values;
    if (what.together)
        values = {file.variable("vals_nod_var", NC_FLOAT, {steps, ofNodes, nodes})};
    else
        for (std::size_t v = 0; v < what.atNodes.size(); ++v)
            values.push_back(
                file.variable(fmt::format("vals_nod_var{}", v + 1), NC_FLOAT, {steps, nodes}));
    const int first = file.variable("vals_elem_var1eb1", NC_DOUBLE, {steps, one}),
              second = file.variable("vals_elem_var1eb2", NC_DOUBLE, {steps, two}),
              other = file.variable("vals_elem_var2eb2", NC_DOUBLE, {steps, two});

    file.write(time, what.times);
    const auto at = [](std::size_t axis, std::size_t n) {
        return std::array{double(n % 3), double(n / 3 % 2), double(n / 6)}[axis];
    };
    std::vector<double> all;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::vector<float> own;
        for (std::size_t n = 0; n < 12; ++n) {
            all.push_back(at(axis, n));
            own.push_back(static_cast<float>(at(axis, n)));
        }
        if (!what.together) file.write(coordinates[axis], own);
    }
    if (what.together) file.write(coordinates[0], all);
    file.write(cube, what.cube);
    file.write(wedges, std::vector<std::int32_t>{2, 3, 5, 8, 9, 11, 3, 6, 5, 9, 12, 11});
    names(file, nodeNames, what.atNodes);
    names(file, elementNames, {"p", "q"});
    const auto atNode = [&](std::size_t step, std::size_t v, std::size_t n) {
        return v < 2 ? valueOf(step, v, n) : displacementOf(step, n);
    };
    std::vector<float> together;
    for (std::size_t step = 0; step < what.times.size(); ++step)
        for (std::size_t v = 0; v < what.atNodes.size(); ++v)
            for (std::size_t n = 0; n < 12; ++n) together.push_back(atNode(step, v, n));
    if (what.together) file.write(values[0], together);
    for (std::size_t v = 0; !what.together && v < what.atNodes.size(); ++v) {
        std::vector<float> own;
        for (std::size_t step = 0; step < what.times.size(); ++step)
            for (std::size_t n = 0; n < 12; ++n) own.push_back(atNode(step, v, n));
        file.write(values[v], own);
    }
    // 5, 6, ...; 7, 8, ...; 1, 2, ...: of so many elements in each step.
    const auto from = [&](double begin, std::size_t elements) {
        std::vector<double> counted(elements * what.times.size());
        std::iota(counted.begin(), counted.end(), begin);
        return counted;
    };
    file.write(first, from(5, 1));
    file.write(second, from(7, 2));
    file.write(other, from(1, 2));
    return file.close();
}

TEST(Exodus, ResultsAtNodesAndAtElementsInBothLayouts) {
    for (const bool together : {false, true}) {
        const auto reader = open(write({.together = together}));
        EXPECT_EQ(reader->format(), "Exodus II");
        const auto variables = reader->variables();
        ASSERT_EQ(variables.size(), 4u);
        EXPECT_EQ(variables[0].name, "T");
        EXPECT_EQ(variables[1].name, "p (points)");
        EXPECT_EQ(variables[2].name, "p (cells)");
        EXPECT_EQ(variables[3].name, "q");
        EXPECT_EQ(variables[0].time->points[1].value, 2);
        EXPECT_FALSE(variables[0].time->counted);
        EXPECT_EQ(variables[0].type, ValueType::F32);
        for (std::size_t v : {0u, 1u})
            for (std::size_t step : {1u, 0u}) {
                const auto values = std::get<std::vector<float>>(reader->read(v, step).values);
                ASSERT_EQ(values.size(), 12u);
                for (std::size_t n = 0; n < 12; ++n) EXPECT_EQ(values[n], valueOf(step, v, n));
            }
        EXPECT_EQ(std::get<std::vector<double>>(reader->read(2, 1).values),
                  (std::vector<double>{6, 9, 10}));
        const Field part = reader->read(3, 0);
        EXPECT_EQ(part.missing, (std::vector<bool>{true, false, false}));
        EXPECT_EQ(std::get<std::vector<double>>(part.values)[2], 2);
        EXPECT_EQ(variables[3].missing, "1 of 2 blocks have none");
    }
}

TEST(Exodus, NodesLieWhereTheFileSaysAndElementsInTheirMiddles) {
    for (const bool together : {false, true}) {
        const auto reader = open(write({.together = together}));
        const Grid& nodes = *reader->variables()[0].grid;
        for (std::size_t n = 0; n < 12; ++n)
            EXPECT_EQ(nodes.position(n), glm::dvec3(n % 3, n / 3 % 2, n / 6));
        const Mesh& elements = *reader->variables()[2].grid->mesh();
        ASSERT_EQ(elements.count(), 3u);
        const glm::dvec3 middles[] = {
            {0.5, 0.5, 0.5}, {4 / 3.0, 1 / 3.0, 0.5}, {5 / 3.0, 2 / 3.0, 0.5}};
        for (std::size_t i = 0; i < 3; ++i) {
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(elements.position(i)[c], middles[i][c], 1e-6);
            EXPECT_NEAR(tests::volume(elements, i), i == 0 ? 1 : 0.5, 1e-6);
        }
    }
}

// Each coordinate grows by step / 4 (x + 3 y + 6 z): of a volume, by det(I + step / 4 (1 1 1)^T (1
// 3 6)) = 1 + step / 4 * 10.
TEST(Exodus, DisplacementsMoveNodesAndElementsInEachStep) {
    for (const bool together : {false, true})
        for (const std::string name : {"DISPL", "disp_"}) {
            Written what{.together = together, .times = {0, 1, 2}};
            for (const char* axis : {"X", "Y", "Z"}) what.atNodes.push_back(name + axis);
            const auto reader = open(write(what));
            const auto variables = reader->variables();
            ASSERT_EQ(variables.size(), 7u);
            EXPECT_EQ(variables[0].notes[0],
                      fmt::format("nodes are moved by {0}X, {0}Y, {0}Z", name));
            const std::size_t elements = 5;  // p (cells)
            ASSERT_EQ(variables[elements].name, "p (cells)");
            for (const std::size_t step : {2u, 0u, 1u, 1u}) {
                const Field field = reader->read(0, step);
                EXPECT_EQ(std::get<std::vector<float>>(field.values)[7], valueOf(step, 0, 7));
                for (std::size_t n = 0; n < 12; ++n) {
                    const glm::dvec3 wanted = glm::dvec3(n % 3, n / 3 % 2, n / 6) +
                                              glm::dvec3(double(displacementOf(step, n)));
                    const glm::dvec3 is = field.grid->position(n);
                    for (int c = 0; c < 3; ++c) EXPECT_NEAR(is[c], wanted[c], 1e-5) << n;
                }
                const Field cells = reader->read(elements, step);
                EXPECT_NEAR(tests::volume(*cells.grid->mesh(), 0), 1 + 2.5 * double(step), 1e-4);
                EXPECT_EQ(field.grid == variables[0].grid, step == 0);
            }
        }
}

TEST(Exodus, NodesStandStillWithoutAWholeDisplacement) {
    Written what{.times = {0, 1}};
    what.atNodes.insert(what.atNodes.end(), {"DISPLX", "DISPLY", "distance"});
    const auto reader = open(write(what));
    EXPECT_EQ(reader->read(0, 1).grid, reader->variables()[0].grid);
    EXPECT_EQ(reader->variables()[0].grid->position(4), glm::dvec3(1, 1, 0));
}

// Those whose nodes move are not: the file on disk would not have their places.
TEST(Exodus, StepsAreKeptWhereTheNodesStandStill) {
    Written what;
    for (std::size_t v = 0; v < what.atNodes.size(); ++v) tests::expectKept({write(what)}, v);
    what.atNodes.insert(what.atNodes.end(), {"DISPLX", "DISPLY", "DISPLZ"});
    const auto moving = open(write(what));
    EXPECT_THAT(moving->sources(0, 0).files, testing::IsEmpty());
}

TEST(Exodus, KindsThatAreNotKnownAreTold) {
    const auto reader = open(write({.kind = "OCTOPUS"}));
    ASSERT_FALSE(reader->variables()[0].notes.empty());
    EXPECT_EQ(reader->variables()[0].notes[0], "1 elements of the kind \"OCTOPUS\" are not drawn");
    const MeshAbout* const about = [&]() -> const MeshAbout* {
        for (const Variable& each : reader->variables())
            if (each.grid->mesh() && each.grid->mesh()->about().points == MeshAbout::Points::Cells)
                return &each.grid->mesh()->about();
        return nullptr;
    }();
    ASSERT_NE(about, nullptr);
    EXPECT_EQ(cellName(*about->typeOf(0), 1), "cell of unknown shape");
}

TEST(Exodus, WhatDoesNotFitIsRefused) {
    EXPECT_THAT(refusalOf(write({.cube = {1, 2, 5, 4, 7, 8, 11, 13}})),
                HasSubstr("connect: expected elements of nodes that there are"));
    EXPECT_THAT(refusalOf(write({.cube = {0, 2, 5, 4, 7, 8, 11, 10}})),
                HasSubstr("cell 0 has point 0 of"));
    EXPECT_THAT(refusalOf(write({.cube = {1, 2, 5, 4, 7, 8, 11, -1}})),
                HasSubstr("cell 0 has point -1 of"));
    EXPECT_THAT(refusalOf(write({.times = {0.5, std::nan("")}})),
                HasSubstr("expected times that are finite"));
    // Elements that no list names are not counted, however many a dimension says.
    NetcdfBuilder many("many.e", NC_NETCDF4);
    const int some = many.dimension("num_nodes", 8), three = many.dimension("num_dim", 3);
    many.dimension("num_el_blk", 1);
    many.dimension("num_el_in_blk1", std::size_t{1} << 40);
    many.dimension("num_nod_per_el1", 8);
    many.variable("coord", NC_DOUBLE, {three, some});
    EXPECT_THAT(refusalOf(many.close()),
                HasSubstr("expected the variable connect1 of 1099511627776"));
    NetcdfBuilder file("bare.e", 0);
    const int dims = file.dimension("num_dim", 3), nodes = file.dimension("num_nodes", 8);
    file.dimension("num_el_blk", 1);
    file.variable("coord", NC_DOUBLE, {nodes, dims});
    EXPECT_THAT(refusalOf(file.close()),
                HasSubstr("variable 'coord': expected numbers of the dimensions "
                          "3 x 8, found 8 x 3"));
}

// VTK's reader, of which the shares in ranges.csv are, gives each block nodes of its own: those
// that two blocks share count twice there, and once here.
TEST(RealExodus, SharesAreThoseOfTheNodesOfEachBlock) {
    const Path path = tests::sharedData("mug_transient.e");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no real data at " << path;
    std::ifstream csv(tests::sharedData("ranges.csv"));
    const std::string wanted = "mug_transient.e,diffused,0.5,1.5,21,0.00,21.24,";
    std::string line;
    while (std::getline(csv, line) && !line.starts_with(wanted)) {
    }
    ASSERT_TRUE(line.starts_with(wanted));
    std::istringstream shares(line.substr(wanted.size()));

    const NetcdfFile file(path, NetcdfFile::Header::New);
    std::vector<std::size_t> nodes;  // of each block, from 0
    for (const char* block : {"connect1", "connect2"}) {
        std::set<std::size_t> own;
        for (const Number& node : file.numbers(*file.header().find(block, "")))
            own.insert(static_cast<std::size_t>(toDouble(node)) - 1);
        nodes.insert(nodes.end(), own.begin(), own.end());
    }
    const auto reader = open(path);
    const auto variables = reader->variables();
    const auto diffused = std::ranges::find(variables, "diffused", &Variable::name);
    ASSERT_NE(diffused, variables.end());
    for (std::size_t step = 0; step < 21; ++step) {
        const Field field = reader->read(std::size_t(diffused - variables.begin()), step);
        const auto& values = std::get<std::vector<double>>(field.values);
        const auto inside = std::ranges::count_if(
            nodes, [&](std::size_t n) { return values[n] >= 0.5 && values[n] <= 1.5; });
        double share = 0;
        shares >> share;
        EXPECT_NEAR(100.0 * double(inside) / double(nodes.size()), share, 0.005 + 1e-9) << step;
    }
}

TEST(Exodus, VariablesOfOneNameAreToldApart) {
    const auto reader = open(write({.atNodes = {"T", "T"}}));
    const auto first = tests::valuesOf<float>(*reader, "T"),
               second = tests::valuesOf<float>(*reader, "T (2)");
    EXPECT_EQ(first[3], valueOf(0, 0, 3));
    EXPECT_EQ(second[3], valueOf(0, 1, 3));
}

// A file a step, whose times are its own.
TEST(Exodus, FilesMakeASeries) {
    const std::vector<Path> paths{write({.times = {1, 2}}, "a1.e"),
                                  write({.times = {3, 4}}, "a2.e")};
    const auto reader = openReader(paths);
    ASSERT_EQ(reader->variables()[0].time->points.size(), 4u);
    EXPECT_EQ(reader->variables()[0].time->points[2].value, 3);
    EXPECT_EQ(std::get<std::vector<float>>(reader->read(0, 3).values)[0], 1000);
}

// Of the classic format: netCDF 4.9.0 does not free what it has of an HDF5 file that it refuses.
TEST(Exodus, FilesCutOrDamagedAnywhereAreReadOrRefused) {
    for (const auto& more : {std::vector<std::string>{}, {"DISPLX", "DISPLY", "DISPLZ"}}) {
        Written what{.together = true, .times = {1, 2}};
        what.atNodes.insert(what.atNodes.end(), more.begin(), more.end());
        const Path path = write(what);
        tests::damageInRounds(path, path);
    }
}

}  // namespace
}  // namespace timeseries
