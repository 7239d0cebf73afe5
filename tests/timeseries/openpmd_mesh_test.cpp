// openPMD meshes: where they lie, whatever order their dimensions have, their units and iterations.
// netCDF writes HDF5 that has the standard's groups.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/array_builder.h"
#include "tests/support/openpmd_file.h"
#include "tests/support/read_variables.h"
#include "tests/support/selection_oracle.h"
#include "tests/support/shared_data.h"
#include "timeseries/index/sorted_step.h"

namespace timeseries {
namespace {

using namespace tests;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::array<std::size_t, 3> kSize{2, 3, 4};  // of x, y, z
constexpr std::array<double, 3> kSpacing{0.5, 0.25, 2}, kOffset{-1, 10, 100},
    kPosition{0.5, 0, 0.25};

// Of each label, in their order.
template <typename T>
std::vector<T> along(const std::string& labels, const std::array<T, 3>& ofAxes) {
    std::vector<T> all;
    for (const char label : labels) all.push_back(ofAxes[std::size_t(label - 'x')]);
    return all;
}

// 100 ix + 10 iy + iz, where the index of the first label runs slowest ("C") or fastest ("F").
void putPlaces(OpenPmdFile& file, const std::string& name, const std::string& labels,
               const std::string& order) {
    std::string slowestFirst = labels;
    if (order == "F") std::ranges::reverse(slowestFirst);
    const auto lengths = along(slowestFirst, kSize);
    std::vector<std::int32_t> values;
    for (std::size_t i = 0; i < lengths[0]; ++i)
        for (std::size_t j = 0; j < lengths[1]; ++j)
            for (std::size_t k = 0; k < lengths[2]; ++k) {
                std::int32_t value = 0;
                for (const auto& [label, index] :
                     {std::pair(slowestFirst[0], i), std::pair(slowestFirst[1], j),
                      std::pair(slowestFirst[2], k)})
                    value += std::int32_t(index) * (label == 'x' ? 100 : label == 'y' ? 10 : 1);
                values.push_back(value);
            }
    file.put(name, values, lengths);
    file.place(name, labels, along(labels, kSpacing), along(labels, kOffset));
    file.say(name, "dataOrder", order);
    file.say(name, "gridUnitSI", 1e-6);
    file.say(name, "position", along(labels, kPosition));
}

TEST(OpenPmd, MeshesLieWhereTheirLabelsSayInAnyOrder) {
    std::string labels = "xyz";
    do {
        for (const std::string order : {"C", "F"}) {
            OpenPmdFile file;
            file.iteration(7, 0);
            putPlaces(file, "data/7/fields/rho", labels, order);
            const auto reader = open(file.close());
            EXPECT_EQ(reader->format(), "openPMD");
            const Field field = reader->read(indexOf(*reader, "rho"), 0);
            ASSERT_EQ(field.grid->size(), kSize) << labels << order;
            const auto& values = std::get<std::vector<std::int32_t>>(field.values);
            for (std::uint64_t n = 0; n < values.size(); ++n) {
                const auto at = field.grid->indices(n);
                EXPECT_EQ(values[n], 100 * at.x + 10 * at.y + at.z) << labels << order;
                for (int a = 0; a < 3; ++a) {
                    const auto i = std::size_t(a);
                    EXPECT_NEAR(field.grid->position(n)[a],
                                1e-6 * (kOffset[i] + (double(at[a]) + kPosition[i]) * kSpacing[i]),
                                1e-18)
                        << labels << order << a;
                }
            }
            for (std::size_t a = 0; a < 3; ++a) {
                EXPECT_EQ(field.grid->axes()[a].name, std::string(1, "xyz"[a]));
                EXPECT_EQ(field.grid->axes()[a].units, "m");
            }
        }
    } while (std::ranges::next_permutation(labels).found);
}

// As numbers of the file's own, exactly: what they count in SI is told beside them.
TEST(OpenPmd, ValuesAreNotScaled) {
    OpenPmdFile file;
    file.iteration(0, 0);
    std::vector<float> values;
    for (int i = 0; i < 60; ++i) values.push_back(0.1f * float(i % 17) - 0.4f);
    file.put("data/0/fields/B/z", values, std::vector<std::size_t>{3, 4, 5});
    file.say("data/0/fields/B/z", "unitSI", 2.5e9);
    file.place("data/0/fields/B", "zyx", {1, 1, 1}, {0, 0, 0});
    file.say("data/0/fields/B", "unitDimension", std::vector<double>{0, 1, -2, -1, 0, 0, 0});
    file.say("data/0/fields/B", "timeOffset", 0.5);
    const auto reader = open(file.close());
    const Variable& variable = reader->variables()[0];
    EXPECT_EQ(variable.name, "B/z");
    EXPECT_EQ(variable.units, "2500000000 kg s-2 A-1");
    EXPECT_EQ(variable.type, ValueType::F32);
    EXPECT_THAT(variable.notes, ElementsAre(HasSubstr("0.5 of the file's units of time after")));
    EXPECT_EQ(valuesOf<float>(*reader, "B/z"), values);
    const auto sorted = SortedStep::build(reader->read(0, 0));
    for (const char* text : {"0.1:0.5", "(0.1:0.5)", "-0.4:-0.2,0.9:2", "0.3", "5:6"}) {
        const RangeSet set = RangeSet::parse(text);
        const auto expected = std::ranges::count_if(
            values, [&](float v) { return oracle::holds(std::span(set.ranges()), v); });
        EXPECT_EQ(sorted.count(set), std::uint64_t(expected)) << text;
    }
}

TEST(OpenPmd, AConstantComponentIsItsValueEverywhere) {
    for (const std::string order : {"C", "F"}) {
        OpenPmdFile file;
        file.iteration(0, 0);
        file.constant("data/0/fields/E/x", -2.5f, {3, 4, 5});
        file.place("data/0/fields/E", "xyz", {1, 2, 3}, {0, 0, 0});
        file.say("data/0/fields/E", "dataOrder", order);
        file.constant("data/0/fields/T", std::uint64_t{1} << 60, {2, 2, 2});
        file.place("data/0/fields/T", "xyz", {1, 2, 3}, {0, 0, 0});
        file.put("data/0/fields/rho", ramp<double>(8), std::vector<std::size_t>{2, 2, 2});
        file.place("data/0/fields/rho", "xyz", {1, 2, 3}, {0, 0, 0});
        const auto reader = open(file.close());
        EXPECT_EQ(reader->variables()[0].name, "rho");  // what is not constant is first
        EXPECT_EQ(valuesOf<float>(*reader, "E/x"), std::vector<float>(60, -2.5f));
        EXPECT_EQ(reader->variables()[indexOf(*reader, "E/x")].grid->size(),
                  (std::array<std::size_t, 3>{3, 4, 5}))
            << order;
        EXPECT_EQ(valuesOf<std::uint64_t>(*reader, "T"),
                  std::vector<std::uint64_t>(8, std::uint64_t{1} << 60));
    }
}

// By their numbers, not their names; each variable has those in which it is.
TEST(OpenPmd, IterationsAreSteps) {
    OpenPmdFile file;
    for (const int n : {100, 9, 20}) {
        file.iteration(n, 0.5 * n, 1e-15);
        for (const std::string name : {"a", "b"}) {
            if (name == "b" && n == 20) continue;
            const std::string path = fmt::format("data/{}/fields/{}", n, name);
            file.put(path, std::vector<double>(8, n), std::vector<std::size_t>{2, 2, 2});
            file.place(path, "zyx", {1, 1, 1}, {0, 0, 0});
        }
    }
    const auto reader = open(file.close());
    const Variable &a = reader->variables()[indexOf(*reader, "a")],
                   &b = reader->variables()[indexOf(*reader, "b")];
    EXPECT_EQ(a.time->name, "time");
    EXPECT_EQ(a.time->units, "s");
    ASSERT_EQ(a.time->points.size(), 3u);
    EXPECT_DOUBLE_EQ(a.time->points[1].value, 10e-15);
    ASSERT_EQ(b.time->points.size(), 2u);
    EXPECT_DOUBLE_EQ(b.time->points[1].value, 50e-15);
    EXPECT_EQ(a.grid, b.grid);
    EXPECT_EQ(valuesOf<double>(*reader, "a", 0)[0], 9);
    EXPECT_EQ(valuesOf<double>(*reader, "a", 1)[0], 20);
    EXPECT_EQ(valuesOf<double>(*reader, "a", 2)[0], 100);
    EXPECT_EQ(valuesOf<double>(*reader, "b", 1)[0], 100);
}

TEST(OpenPmd, IterationsWithoutTimesAreNumbered) {
    OpenPmdFile file;
    for (const int n : {3, 5}) file.mesh(fmt::format("data/{}/fields/a", n));
    const auto reader = open(file.close());
    EXPECT_EQ(reader->variables()[0].time->name, "iteration");
    EXPECT_FALSE(reader->variables()[0].time->counted);
    EXPECT_THAT(timesOf(*reader), ElementsAre(3, 5));
}

TEST(OpenPmd, AWindowThatMovesIsDrawnWhereItBegan) {
    OpenPmdFile file;
    for (const int n : {0, 1}) {
        file.iteration(n, n);
        const std::string name = fmt::format("data/{}/fields/a", n);
        file.put(name, std::vector<double>(8, n), std::vector<std::size_t>{2, 2, 2});
        file.place(name, "zyx", {1, 1, 1}, {30.0 * n, 0, 0});
    }
    const auto reader = open(file.close());
    EXPECT_THAT(reader->variables()[0].notes,
                ElementsAre(HasSubstr("drawn where it lies in iteration 0")));
    EXPECT_EQ(reader->read(0, 1).grid->position(0).z, 0);
}

TEST(OpenPmd, MeshesOfTwoDimensionsAreDrawn) {
    OpenPmdFile file;
    file.iteration(0, 0);
    file.put("data/0/fields/a", ramp<float>(6), std::vector<std::size_t>{2, 3});
    file.place("data/0/fields/a", "xz", {0.5, 2}, {1, 7});
    const auto reader = open(file.close());
    const Grid& grid = *reader->variables()[0].grid;
    EXPECT_EQ(grid.size(), (std::array<std::size_t, 3>{2, 1, 3}));
    EXPECT_EQ(grid.axes()[1].name, "y");
    EXPECT_EQ(grid.position(5), glm::dvec3(1.5, 0, 11));
    EXPECT_THAT(valuesOf<float>(*reader, "a"), ElementsAre(0, 3, 1, 4, 2, 5));
}

TEST(OpenPmd, OtherGeometriesAreDrawnByIndex) {
    OpenPmdFile file;
    file.iteration(0, 0);
    file.mesh("data/0/fields/a");
    file.say("data/0/fields/a", "geometry", std::string("spherical"));
    file.say("data/0/fields/a", "axisLabels", std::vector<std::string>{"phi", "theta", "r"});
    file.mesh("data/0/fields/b");
    file.say("data/0/fields/b", "geometry", std::string("thetaMode"));
    const auto reader = open(file.close());
    ASSERT_EQ(reader->variables().size(), 1u);
    EXPECT_THAT(reader->variables()[0].notes,
                ElementsAre("drawn by index: its geometry is spherical"));
    const auto& axes = reader->variables()[0].grid->axes();
    EXPECT_EQ(axes[0].name, "r");
    EXPECT_EQ(axes[0].units, "index");
    EXPECT_THAT(axes[2].coordinates, ElementsAre(0, 1));
    ASSERT_EQ(reader->damaged().size(), 1u);
    EXPECT_THAT(reader->damaged()[0].why, HasSubstr("iteration 0: record component 'b': expected"));
    EXPECT_THAT(reader->damaged()[0].why, HasSubstr("thetaMode"));
}

TEST(OpenPmd, FilesOfOneIterationMakeASeries) {
    std::vector<std::filesystem::path> paths;
    for (const int n : {10, 20}) {
        OpenPmdFile file(fmt::format("run_{}.h5", n));
        file.iteration(n, n, 2);
        file.mesh(fmt::format("data/{}/fields/a", n));
        paths.push_back(file.close());
    }
    const auto reader = openReader(paths);
    EXPECT_THAT(timesOf(*reader), ElementsAre(20, 40));
    EXPECT_EQ(valuesOf<double>(*reader, "a", 1), ramp<double>(8));
}

TEST(OpenPmd, BesideAGridIsNoStepOfIt) {
    NetcdfBuilder grid("run_1.nc");
    const std::vector<int> dimensions{grid.dimension("z", 2), grid.dimension("y", 2),
                                      grid.dimension("x", 2)};
    grid.write(grid.variable("a", NC_DOUBLE, dimensions), ramp<double>(8));
    OpenPmdFile file("run_2.nc");
    file.mesh("data/2/fields/a");
    const std::vector paths{grid.close(), file.close()};
    EXPECT_THAT(refusalOf(paths),
                HasSubstr("expected a grid as in the files beside it, found an openPMD file"));
}

// Each a whole file but for one thing.
TEST(OpenPmd, WhatIsNotOfTheStandardIsRefused) {
    const auto told = [](const auto& change) {
        OpenPmdFile file;
        file.iteration(1, 0);
        file.mesh("data/1/fields/a");
        return refusalAfter(file, change);
    };
    using File = OpenPmdFile&;
    using Numbers = std::vector<double>;
    const std::string a = "data/1/fields/a";
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(told([](File) {}), "");
    EXPECT_THAT(told([](File f) { f.say("", "openPMD", std::string("2.0.0")); }),
                HasSubstr("attribute 'openPMD': expected version 1, found 2.0.0"));
    EXPECT_THAT(told([](File f) { f.say("", "basePath", std::string("/data/")); }),
                HasSubstr("attribute 'basePath': expected /data/%T/, found '/data/'"));
    EXPECT_THAT(told([](File f) { f.say("", "meshesPath", std::string("meshes/")); }),
                HasSubstr("data: expected an iteration with records"));
    EXPECT_THAT(
        told([](File f) { f.say("data/1", "time", std::numeric_limits<double>::infinity()); }),
        HasSubstr("group 'data/1': expected time and timeUnitSI"));
    const std::string component = "iteration 1: record component 'a': ";
    EXPECT_THAT(told([&](File f) {
                    f.say(a, "axisLabels", std::vector<std::string>{"x", "y"});
                }),
                HasSubstr(component + "expected axisLabels of 3 dimensions, found 2"));
    EXPECT_THAT(told([&](File f) {
                    f.say(a, "gridSpacing", Numbers{1, 1});
                }),
                HasSubstr(component + "expected gridSpacing, 3 numbers that are finite, found 2"));
    EXPECT_THAT(told([&](File f) {
                    f.say(a, "gridSpacing", Numbers{1, 1, nan});
                }),
                HasSubstr("expected gridSpacing"));
    EXPECT_THAT(told([&](File f) {
                    f.say(a, "gridSpacing", Numbers{1, 0, 1});
                }),
                HasSubstr("expected an axis y that places points"));
    EXPECT_THAT(told([&](File f) {
                    f.say(a, "gridGlobalOffset", Numbers{1e300, 0, 0});
                }),
                HasSubstr("expected an axis z that places points"));
    EXPECT_THAT(told([&](File f) { f.say(a, "gridGlobalOffset", std::string("0 0 0")); }),
                HasSubstr("expected gridGlobalOffset"));
    EXPECT_THAT(told([&](File f) { f.say(a, "position", Numbers{0.5}); }),
                HasSubstr("expected position"));
    EXPECT_THAT(told([&](File f) { f.say(a, "gridUnitSI", nan); }),
                HasSubstr("expected gridUnitSI, one number that is finite"));
    EXPECT_THAT(told([&](File f) {
                    f.say(a, "unitSI", Numbers{1, 2});
                }),
                HasSubstr("expected unitSI"));
    EXPECT_THAT(told([&](File f) {
                    f.mesh("data/2/fields/a", {1, 2, 4});
                }),
                HasSubstr("iteration 2: record component 'a': expected the type, spacing and "
                          "number of points of iteration 1"));
}

// A header of a few bytes can say any shape.
TEST(OpenPmd, ConstantsThatNoFileCouldHoldAreRefused) {
    const auto told = [](const std::vector<std::int64_t>& shape, const std::vector<float>& value) {
        OpenPmdFile file;
        file.say("data/1/fields/a", "value", value);
        file.say("data/1/fields/a", "shape", shape);
        file.place("data/1/fields/a", "zyx", {1, 1, 1}, {0, 0, 0});
        return refusalOf(file.close());
    };
    EXPECT_EQ(told({4, 5, 6}, {1}), "");
    EXPECT_THAT(told({4, 5}, {1}), HasSubstr("expected axisLabels of 2 dimensions, found 3"));
    EXPECT_THAT(told({4, 0, 6}, {1}), HasSubstr("expected values, found a mesh without points"));
    EXPECT_THAT(told({1 << 12, 1 << 12, 1 << 7}, {1}), HasSubstr("expected values that a file of"));
    EXPECT_THAT(told({std::int64_t{1} << 40, 1 << 20, 1 << 20}, {1}),
                HasSubstr("expected at most 2^32 points"));
    EXPECT_THAT(told({4, -5, 6}, {1}), HasSubstr("expected a shape of lengths of 0 or more"));
    EXPECT_THAT(told({4}, {1}), HasSubstr("expected a mesh of two or three dimensions, found 1"));
    EXPECT_THAT(told({4, 5, 6}, {1, 2}), HasSubstr("expected one number as its value"));
}

TEST(RealOpenPmd, TheFieldOfAMagnetLiesWhereItsAttributesSay) {
    const auto path = sharedData("grids/openpmd_femm_3d.h5");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no real data at " << path;
    const auto reader = open(path);
    EXPECT_EQ(reader->variables().size(), 6u);
    const Variable& variable = reader->variables()[indexOf(*reader, "B/z")];
    EXPECT_EQ(variable.units, "kg s-2 A-1");
    EXPECT_EQ(variable.grid->size(), (std::array<std::size_t, 3>{47, 47, 47}));
    // gridGlobalOffset -1.15 -1.15 -0.375, gridSpacing 0.05 0.05 0.125
    EXPECT_DOUBLE_EQ(variable.grid->position(0).x, -1.15);
    EXPECT_DOUBLE_EQ(variable.grid->position(1).x, -1.1);
    EXPECT_DOUBLE_EQ(variable.grid->position(47).y, -1.1);
    EXPECT_DOUBLE_EQ(variable.grid->position(47 * 47).z, -0.25);
    EXPECT_DOUBLE_EQ(variable.grid->position(47 * 47 * 47 - 1).z, -0.375 + 46 * 0.125);
    EXPECT_EQ(valuesOf<double>(*reader, "E/y"), std::vector<double>(47 * 47 * 47, 0));
    // The file has x slowest.
    const auto values = valuesOf<double>(*reader, "B/z");
    EXPECT_NE(values[1], values[47 * 47]);
}

}  // namespace
}  // namespace timeseries
