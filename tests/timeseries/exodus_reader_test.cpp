// Results of finite elements at nodes and elements, in files as Exodus II's library writes them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "tests/support/damage.h"
#include "tests/support/netcdf_builder.h"
#include "tests/support/read_variables.h"
#include "tests/support/shared_data.h"
#include "tests/support/unstructured.h"
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
};

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
              ofNodes = file.dimension("num_nod_var", 2),
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
        for (const char* each : {"vals_nod_var1", "vals_nod_var2"})
            values.push_back(file.variable(each, NC_FLOAT, {steps, nodes}));
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
    names(file, nodeNames, {"T", "p"});
    names(file, elementNames, {"p", "q"});
    std::vector<float> both;
    for (std::size_t step = 0; step < what.times.size(); ++step)
        for (std::size_t v = 0; v < 2; ++v)
            for (std::size_t n = 0; n < 12; ++n)
                both.push_back(static_cast<float>(1000 * step + 100 * v + n));
    if (what.together) {
        file.write(values[0], both);
    } else {
        for (std::size_t v = 0; v < 2; ++v) {
            std::vector<float> own;
            for (std::size_t step = 0; step < what.times.size(); ++step)
                own.insert(own.end(), both.begin() + std::ptrdiff_t(24 * step + 12 * v),
                           both.begin() + std::ptrdiff_t(24 * step + 12 * v + 12));
            file.write(values[v], own);
        }
    }
    file.write(first, std::vector<double>{5, 6});
    file.write(second, std::vector<double>{7, 8, 9, 10});
    file.write(other, std::vector<double>{1, 2, 3, 4});
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
                for (std::size_t n = 0; n < 12; ++n)
                    EXPECT_EQ(values[n], static_cast<float>(1000 * step + 100 * v + n));
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

TEST(Exodus, KindsThatAreNotKnownAreTold) {
    const auto reader = open(write({.kind = "OCTOPUS"}));
    ASSERT_FALSE(reader->variables()[0].notes.empty());
    EXPECT_EQ(reader->variables()[0].notes[0], "1 elements of the kind \"OCTOPUS\" are not drawn");
}

TEST(Exodus, WhatDoesNotFitIsRefused) {
    EXPECT_THAT(refusalOf(write({.cube = {1, 2, 5, 4, 7, 8, 11, 13}})),
                HasSubstr("connect: expected elements of nodes that there are"));
    EXPECT_THAT(refusalOf(write({.cube = {0, 2, 5, 4, 7, 8, 11, 10}})),
                HasSubstr("cell 0 has point"));
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
    const Path path = write({.together = true, .times = {1, 2}});
    tests::damageInRounds(path, path);
}

}  // namespace
}  // namespace timeseries
