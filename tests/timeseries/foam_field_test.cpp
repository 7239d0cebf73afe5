// Fields of OpenFOAM cases: values and their writings, units, times, how a case is named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/foam_case.h"
#include "tests/support/read_variables.h"
#include "timeseries/index/sorted_step.h"
#include "timeseries/readers/foam/foam_field.h"
#include "timeseries/readers/series_files.h"

namespace timeseries::foam_field {
namespace {

using namespace tests;
using namespace tests::foam;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using Doubles = std::vector<double>;

// T of a row of so many cubes, with these values.
std::unique_ptr<Reader> withT(std::uint32_t count, const std::string& values,
                              const std::string& className = "volScalarField") {
    const auto folder = caseOf(cubes(count));
    put(folder / "0/T", field(className, values));
    return open(folder);
}

TEST(FoamField, ListsOfAllFormsAreRead) {
    EXPECT_EQ(valuesOf<double>(*withT(3, "uniform 2.5e-3"), "T"), Doubles(3, 2.5e-3));
    for (const char* list :
         {"List<scalar> 3(1 -2 1e3)", "3(1 -2 1e3)", "List<scalar> 3\n(\n1\n-2\n+1000\n)\n",
          "List<scalar> 3 ( 1 /* one ) */ -2 // ( two\n1000.0)", "(1 -2 1e3)"})
        EXPECT_EQ(valuesOf<double>(*withT(3, std::string("nonuniform ") + list), "T"),
                  (Doubles{1, -2, 1000}))
            << list;
    EXPECT_EQ(valuesOf<double>(*withT(3, "nonuniform List<scalar> 3{7}"), "T"), Doubles(3, 7));
    EXPECT_EQ(
        valuesOf<double>(*withT(2, "nonuniform List<vector> 2{(1 2 3)}", "volVectorField"), "T[2]"),
        Doubles(2, 3));
}

TEST(FoamField, NumbersAreTheNearestOfTheirText) {
    const auto values = valuesOf<double>(
        *withT(4, "nonuniform List<scalar> 4(0.1 16777217.123 4.9e-324 nan)"), "T");
    EXPECT_EQ(values[0], 0.1);
    EXPECT_EQ(values[1], 16777217.123);
    EXPECT_EQ(values[2], 4.9e-324);
    EXPECT_TRUE(std::isnan(values[3]));
}

TEST(FoamField, VectorsAndTensorsAreMagnitudesAndComponents) {
    const auto folder = caseOf(cubes(2));
    put(folder / "0/U", field("volVectorField", "nonuniform List<vector> 2((1 2 2) (0 -3 4))", {},
                              "0 1 -1 0 0 0 0"));
    put(folder / "0/S", field("volSymmTensorField", "uniform (1 2 3 4 5 6)"));
    put(folder / "0/G", field("volTensorField", "uniform (1 2 3 4 5 6 7 8 9)"));
    put(folder / "0/H", field("volSphericalTensorField", "uniform 3"));
    put(folder / "0/V",
        header("volScalarField::Internal") + "dimensions [0 3 0 0 0 0 0];\nvalue uniform 1;\n");
    const auto reader = open(folder);
    EXPECT_EQ(valuesOf<double>(*reader, "U magnitude"), (Doubles{3, 5}));
    EXPECT_EQ(valuesOf<double>(*reader, "U[1]"), (Doubles{2, -3}));
    EXPECT_EQ(reader->variables()[indexOf(*reader, "U[1]")].units, "m/s");
    EXPECT_EQ(valuesOf<double>(*reader, "S[5]"), Doubles(2, 6));
    EXPECT_EQ(valuesOf<double>(*reader, "G[8]"), Doubles(2, 9));
    EXPECT_EQ(valuesOf<double>(*reader, "H"), Doubles(2, 3));
    EXPECT_EQ(valuesOf<double>(*reader, "V"), Doubles(2, 1));
}

TEST(FoamField, DimensionsAreUnits) {
    const auto units = [](std::vector<std::string> words) { return foamUnitsOf(words); };
    EXPECT_EQ(units({"0", "1", "-1", "0", "0", "0", "0"}), "m/s");
    EXPECT_EQ(units({"0", "2", "-2", "0", "0"}), "m^2/s^2");
    EXPECT_EQ(units({"1", "-1", "-2", "0", "0", "0", "0"}), "Pa");
    EXPECT_EQ(units({"1", "-3", "0", "0", "0", "0", "0"}), "kg/m^3");
    EXPECT_EQ(units({"0", "0", "-1", "0", "0", "0", "0"}), "1/s");
    EXPECT_EQ(units({"0", "0.5", "0", "1", "0", "0", "0"}), "m^0.5 K");
    EXPECT_EQ(units({"0", "0", "0", "0", "0", "0", "0"}), "");
    EXPECT_EQ(units({"m^2/s^2"}), "m^2/s^2");
}

TEST(FoamField, HeadersMayHoldDictionariesAndLists) {
    const std::string line = "    version 2.0;\n";
    for (const char* entry :
         {"meta { names (p U); inner { class x; } note \"};\"; }", "meta { format binary; };",
          "meta named { class x; }", "list (1 (2 3));", "empty;"}) {
        std::string file = field("volScalarField", "uniform 4", {}, "0 1 -1 0 0 0 0");
        file.replace(file.find(line), line.size(), std::string(entry) + "\n");
        const auto folder = caseOf(cubes(2));
        put(folder / "0/T", file);
        const auto reader = open(folder);
        EXPECT_EQ(valuesOf<double>(*reader, "T"), Doubles(2, 4)) << entry;
        EXPECT_EQ(reader->variables()[0].units, "m/s") << entry;
    }
}

// A text has no order of bytes, whatever machine wrote it.
TEST(FoamField, TextOfOtherMachinesIsRead) {
    std::string file = scalars({1, 2});
    const std::string format = "    format ascii;\n";
    file.replace(file.find(format), format.size(),
                 "    arch \"MSB;label=32;scalar=64\";\n" + format);
    const auto folder = caseOf(cubes(2));
    put(folder / "0/T", file);
    EXPECT_EQ(valuesOf<double>(*open(folder), "T"), (Doubles{1, 2}));
}

TEST(FoamField, TimesAreTheNumbersOfTheirFolders) {
    const auto folder = caseOf(cubes(1));
    for (const char* time : {"10", "0", "1e-05", "0.5", "2", "0.10", "-3"})
        put(folder / time / "T", scalars({std::stod(time)}));
    put(folder / "0.1/T", scalars({5}));
    put(folder / "0.orig/T", scalars({6}));
    put(folder / "4/uniform/time", header("dictionary"));  // no field
    const auto reader = open(folder);
    const Doubles times{-3, 0, 1e-05, 0.1, 0.5, 2, 10};
    EXPECT_EQ(timesOf(*reader), times);
    EXPECT_THAT(reader->variables()[0].notes,
                Contains("0.10 is left out: its time is that of 0.1"));
    for (std::size_t step = 0; step < times.size(); ++step)
        EXPECT_EQ(valuesOf<double>(*reader, "T", step), Doubles{step == 3 ? 5 : times[step]});
}

TEST(FoamField, AFieldHasTheTimesAtWhichItIs) {
    const auto folder = caseOf(cubes(1));
    for (const char* time : {"0", "1", "2"}) put(folder / time / "T", scalars({std::stod(time)}));
    for (const char* time : {"1", "2"}) put(folder / time / "k", scalars({10 + std::stod(time)}));
    const auto reader = open(folder);
    const auto& k = reader->variables()[indexOf(*reader, "k")];
    ASSERT_EQ(k.time->points.size(), 2u);
    EXPECT_EQ(k.time->points[0].value, 1);
    EXPECT_EQ(valuesOf<double>(*reader, "k", 0), Doubles{11});
    EXPECT_EQ(reader->variables()[indexOf(*reader, "T")].time->points.size(), 3u);
}

// Text by hand says no type; what a solver wrote does.
TEST(FoamField, ScalarsHaveTheWidthThatTheSolverWrote) {
    const Writing narrow{.isBinary = true, .scalar = 32};
    const auto folder = caseOf(cubes(2));
    put(folder / "0/T", scalars({0.1, 0.2}));
    put(folder / "1/T", scalars({0.1, 0.2}, narrow));
    EXPECT_EQ(valuesOf<float>(*open(folder), "T", 0), (std::vector<float>{0.1f, 0.2f}));
    put(folder / "2/T", scalars({0.1, 0.2}, {.isBinary = true}));
    const auto reader = open(folder);
    EXPECT_EQ(valuesOf<double>(*reader, "T", 1), (Doubles{double{0.1f}, double{0.2f}}));
    EXPECT_EQ(valuesOf<double>(*reader, "T", 2), (Doubles{0.1, 0.2}));
}

TEST(FoamField, ValuesOfFacesAreTold) {
    const auto folder = caseOf(cubes(1));
    put(folder / "0/T", scalars({1}));
    put(folder / "0/phi", field("surfaceScalarField", "nonuniform List<scalar> 0()"));
    put(folder / "0/Uf", field("surfaceVectorField", "uniform (1 2 3)"));
    put(folder / "0/T~", "left by an editor");
    const auto reader = open(folder);
    EXPECT_EQ(reader->variables().size(), 1u);
    EXPECT_THAT(reader->variables()[0].notes, Contains("fields of faces are left out: Uf, phi"));
    EXPECT_TRUE(reader->damaged().empty());
}

TEST(FoamField, ACaseIsNamedByItsFolderOrAFileInIt) {
    const auto folder = caseOf(cubes(1));
    put(folder / "0/T", scalars({1}));
    put(folder / "run1.foam", "");
    put(folder / "run2.OpenFOAM", "");
    for (const auto& path : {folder, folder / "", folder / "system/controlDict",
                             folder / "run1.foam", folder / "run2.OpenFOAM"}) {
        EXPECT_TRUE(isReadable(path)) << path;
        EXPECT_EQ(expandSeries(std::span(&path, 1)).files, std::vector{path});
        const auto reader = open(path);
        EXPECT_EQ(reader->format(), "OpenFOAM case");
        EXPECT_EQ(valuesOf<double>(*reader, "T"), Doubles{1});
    }
    EXPECT_FALSE(isReadable(folder / "0"));
    EXPECT_FALSE(isReadable(folder.parent_path()));
}

TEST(FoamField, ASelectionIsWhatAFilterFinds) {
    constexpr std::uint32_t kCount = 5000;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1, 1);
    Doubles values(kCount);
    for (double& value : values) value = any(random);
    values[17] = 0.25;
    const auto folder = caseOf(cubes(kCount));
    put(folder / "0/T", scalars(values));
    const auto reader = open(folder);
    const SortedStep step = SortedStep::build(reader->read(0, 0));
    std::uint64_t expected = 0;
    for (const double v : values) expected += (v >= -0.5 && v <= 0.25) || v > 0.75;
    EXPECT_EQ(step.count(RangeSet::parse("-0.5:0.25, > 0.75")), expected);
}

}  // namespace
}  // namespace timeseries::foam_field
