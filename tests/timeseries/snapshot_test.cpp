// Snapshots of particles as Gadget and SWIFT write them: what each stands for, splats as wide as
// kernels, and what is refused. netCDF writes HDF5 that has their groups.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/hdf_file.h"
#include "tests/support/read_variables.h"
#include "tests/support/selection_oracle.h"
#include "tests/support/unstructured.h"
#include "timeseries/grid/scattered.h"
#include "timeseries/index/sorted_step.h"

namespace timeseries {
namespace {

using namespace tests;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A lattice of 5 x 5 x 5, whose particles are the heavier and lie the thinner the later they stand.
struct Gas {
    std::vector<float> at;
    std::vector<float> masses, densities, lengths;
    explicit Gas(double lengthOverWidth) {
        for (int i = 0; i < 125; ++i) {
            for (const int c : {i % 5, i / 5 % 5, i / 25}) at.push_back(0.5f * float(c));
            masses.push_back(1 + 0.01f * float(i));
            densities.push_back(20 - 0.1f * float(i));
            lengths.push_back(float(lengthOverWidth * std::cbrt(volume(std::size_t(i)))));
        }
    }
    double volume(std::size_t i) const { return double(masses[i]) / double(densities[i]); }
};

class SnapshotFile : public HdfFile {
 public:
    explicit SnapshotFile(const std::string& name = "snap_000.hdf5") : HdfFile(name) {
        say("Header", "Time", 2.5);
        say("Header", "BoxSize", 2.5);
        say("Header", "NumFilesPerSnapshot", std::vector<std::int32_t>{1});
        masses({0, 0, 0, 0, 0, 0});
    }
    void masses(const std::vector<double>& table) { say("Header", "MassTable", table); }
    void counts(const std::vector<std::uint32_t>& each) { say("Header", "NumPart_ThisFile", each); }
    void gas(const Gas& gas, const std::string& lengths = "SmoothingLength") {
        counts({125, 0, 0, 0, 0, 0});
        put("PartType0/Coordinates", gas.at, 3);
        put("PartType0/Masses", gas.masses);
        put("PartType0/Density", gas.densities);
        if (!lengths.empty()) put("PartType0/" + lengths, gas.lengths);
    }
};

// The volumes are m / rho, and the sum of what splats take is theirs.
void expectVolumes(const Mesh& mesh, const Gas& gas) {
    double sum = 0, expected = 0;
    for (std::size_t i = 0; i < 125; ++i) {
        EXPECT_NEAR(tests::volume(mesh, i), gas.volume(i), 1e-5 * gas.volume(i)) << i;
        sum += tests::volume(mesh, i);
        expected += gas.volume(i);
    }
    EXPECT_NEAR(sum, expected, 1e-5 * expected);
    EXPECT_NEAR(double(mesh.meanVolume()), expected / 125, 1e-5 * expected);
}

// Of isotropic splats, how long a side of what they are made of is.
double sideOf(const Mesh& mesh, std::uint64_t i) { return std::cbrt(mesh.cell(i).determinant()); }

// A splat's density, (1 - r^2)^3.5 within 1.396 sides of its cell, has the variance 1.396^2 / 12.
// Gadget's lengths h reach to where the spline ends, twice as far as those of its formula, where
// sqrt(12) standard deviations are 1.897 (h / 2). SWIFT's are two standard deviations.
TEST(Snapshot, GasStandsForItsMassAndIsAsWideAsItsKernel) {
    for (const auto& [name, code, side] :
         {std::tuple("SmoothingLength", "", 1.897 / 2 / 1.396),
          std::tuple("SmoothingLengths", "", 1.7321 / 1.396),
          std::tuple("SmoothingLength", "SWIFT", 1.7321 / 1.396)}) {
        const Gas gas(2.3);
        SnapshotFile file;
        file.gas(gas, name);
        if (*code != '\0') file.say("Code", "Code", std::string(code));
        const auto reader = open(file.close());
        const Variable& density = reader->variables()[indexOf(*reader, "PartType0/Density")];
        const Mesh& mesh = *density.grid->mesh();
        expectVolumes(mesh, gas);
        for (const std::size_t i : {0u, 60u, 124u})
            EXPECT_NEAR(sideOf(mesh, i), side * double(gas.lengths[i]), 1e-3) << name << code;
        EXPECT_THAT(density.notes, IsEmpty());
        for (std::uint64_t i = 0; i < 125; ++i)
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(density.grid->position(i)[c], double(gas.at[3 * i + std::size_t(c)]),
                            1e-6);
    }
}

// As moving meshes write them, which have no kernels.
TEST(Snapshot, WithoutSmoothingLengthsVolumesAreKept) {
    const Gas gas(1);
    SnapshotFile file;
    file.gas(gas, "");
    const auto reader = open(file.close());
    const Mesh& mesh = *reader->variables()[0].grid->mesh();
    expectVolumes(mesh, gas);
    EXPECT_EQ(mesh.spread(), kScatteredSpread);
}

TEST(Snapshot, MassesMayStandInTheHeaderAlone) {
    Gas gas(2);
    gas.masses.assign(125, 3);
    SnapshotFile file;
    file.counts({125, 0, 0, 0, 0, 0});
    file.masses({3, 0, 0, 0, 0, 0});
    file.put("PartType0/Coordinates", gas.at, 3);
    file.put("PartType0/Densities", gas.densities);
    const auto reader = open(file.close());
    expectVolumes(*reader->variables()[0].grid->mesh(), gas);
}

// A tenth of them, which another floor held; then all.
TEST(Snapshot, LengthsBesideTheOthersAreTold) {
    Gas gas(2);
    for (std::size_t i = 0; i < 12; ++i) gas.lengths[10 * i] *= i < 6 ? 0.8f : 1.2f;
    SnapshotFile file;
    file.gas(gas);
    const auto reader = open(file.close());
    expectVolumes(*reader->variables()[0].grid->mesh(), gas);
    EXPECT_NEAR(reader->variables()[0].grid->mesh()->spread(), 1.897 / 1.396, 1e-3);
    EXPECT_THAT(reader->variables()[0].notes,
                ElementsAre(HasSubstr("those of 12 of 125 particles are more than 10 % longer")));

    SnapshotFile other("other.hdf5");
    other.gas(Gas(200));
    const auto unused = open(other.close());
    EXPECT_EQ(unused->variables()[0].grid->mesh()->spread(), kScatteredSpread);
    EXPECT_THAT(unused->variables()[0].notes,
                ElementsAre(HasSubstr("its smoothing lengths are not used")));
}

TEST(Snapshot, WhatHasNoVolumeOrPlaceIsNotDrawn) {
    Gas gas(2);
    gas.densities[3] = 0;
    gas.densities[4] = std::numeric_limits<float>::quiet_NaN();
    gas.masses[5] = -1;
    gas.at[3 * 6 + 1] = std::numeric_limits<float>::infinity();
    SnapshotFile file;
    file.gas(gas);
    const auto reader = open(file.close());
    const Mesh& mesh = *reader->variables()[0].grid->mesh();
    EXPECT_EQ(mesh.flat(), 3u);
    EXPECT_EQ(mesh.absent(), 1u);
    EXPECT_NEAR(tests::volume(mesh, 7), gas.volume(7), 1e-5);
    EXPECT_EQ(reader->variables()[0].notes.size(), 2u);
}

TEST(Snapshot, OthersStandForWhatTheirNeighboursLeave) {
    const Gas gas(2);
    SnapshotFile file;
    file.counts({0, 125, 0, 0, 4, 0});
    file.put("PartType1/Coordinates", gas.at, 3);
    file.put("PartType1/Masses", gas.masses);
    file.put("PartType1/SmoothingLength", gas.lengths);
    file.put("PartType4/Coordinates", std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, 3);
    file.put("PartType4/Age", std::vector<float>{1, 2, 3, 4});
    const auto reader = open(file.close());
    std::vector<glm::dvec3> places;
    for (std::size_t i = 0; i < 125; ++i)
        places.emplace_back(gas.at[3 * i], gas.at[3 * i + 1], gas.at[3 * i + 2]);
    EXPECT_EQ(*reader->variables()[indexOf(*reader, "PartType1/Masses")].grid->mesh(),
              meshOfScattered(places));
    EXPECT_EQ(reader->variables()[indexOf(*reader, "PartType4/Age")].grid->count(), 4u);
}

TEST(Snapshot, ArraysOfRowsAreTheirNumbers) {
    const Gas gas(2);
    SnapshotFile file;
    file.gas(gas);
    std::vector<float> velocities;
    for (int i = 0; i < 375; ++i) velocities.push_back(float(i * i % 41) - 20.5f);
    file.put("PartType0/Velocities", velocities, 3);
    file.put("PartType0/ParticleIDs",
             std::vector<std::uint64_t>(125, std::numeric_limits<std::uint64_t>::max() - 1));
    file.put("PartType0/Other", std::vector<float>{1, 2});
    file.say("PartType0/Density", "Expression for physical CGS units",
             std::string("a^-3 U_M U_L^-3  [ g cm^-3 ]"));
    file.say("PartType0/Density", "Description", std::string("Co-moving mass densities"));
    const auto reader = open(file.close());
    const Variable& density = reader->variables()[indexOf(*reader, "PartType0/Density")];
    EXPECT_EQ(density.units, "a^-3 U_M U_L^-3");
    EXPECT_EQ(density.longName, "Co-moving mass densities");
    EXPECT_EQ(reader->variables()[indexOf(*reader, "PartType0/Masses")].units, "");
    EXPECT_EQ(valuesOf<float>(*reader, "PartType0/Velocities[1]")[7], velocities[22]);
    EXPECT_DOUBLE_EQ(
        valuesOf<double>(*reader, "PartType0/Velocities magnitude")[0],
        std::hypot(double(velocities[0]), double(velocities[1]), double(velocities[2])));
    EXPECT_EQ(valuesOf<std::uint64_t>(*reader, "PartType0/ParticleIDs")[124],
              std::numeric_limits<std::uint64_t>::max() - 1);
    for (const Variable& variable : reader->variables())
        EXPECT_NE(variable.name, "PartType0/Other");
    EXPECT_EQ(reader->variables()[0].time->name, "time");
    EXPECT_THAT(timesOf(*reader), ElementsAre(2.5));

    const auto sorted =
        SortedStep::build(reader->read(indexOf(*reader, "PartType0/Velocities[1]"), 0));
    for (const char* text : {"-20.5", "(-3.5:4.5]", "-20.5:-10,0.5:7", "30:40"}) {
        const RangeSet set = RangeSet::parse(text);
        std::uint64_t expected = 0;
        for (std::size_t i = 1; i < velocities.size(); i += 3)
            expected += oracle::holds(std::span(set.ranges()), velocities[i]);
        EXPECT_EQ(sorted.count(set), expected) << text;
    }
}

TEST(Snapshot, FilesAreASeriesInWhichParticlesMove) {
    std::vector<std::filesystem::path> paths;
    for (const int n : {0, 1}) {
        Gas gas(2);
        for (float& each : gas.at) each += 0.25f * float(n);
        SnapshotFile file("snap_00" + std::to_string(n) + ".hdf5");
        file.gas(gas);
        file.say("Header", "Time", 0.5 + n);
        paths.push_back(file.close());
    }
    const auto reader = openReader(paths);
    EXPECT_THAT(timesOf(*reader), ElementsAre(0.5, 1.5));
    EXPECT_NEAR(reader->read(0, 1).grid->position(0).x, 0.25, 1e-6);
    EXPECT_NEAR(reader->read(0, 0).grid->position(0).x, 0, 1e-6);
}

TEST(Snapshot, WhatIsNoWholeSnapshotIsRefused) {
    const auto told = [](const auto& change) {
        SnapshotFile file;
        file.gas(Gas(2));
        return refusalAfter(file, change);
    };
    using File = SnapshotFile&;
    EXPECT_EQ(told([](File) {}), "");
    EXPECT_THAT(told([](File f) {
                    f.counts({124, 0, 0, 0, 0, 0});
                }),
                HasSubstr("expected of NumPart_ThisFile the 125 places of PartType0, found 124"));
    EXPECT_THAT(told([](File f) { f.put("PartType6/Coordinates", std::vector<float>(6, 1), 3); }),
                HasSubstr("the 2 places of PartType6, found 0"));
    const auto flat = [](const std::vector<float>& at, std::size_t columns) {
        SnapshotFile file;
        file.counts({0, std::uint32_t(at.size() / columns), 0, 0, 0, 0});
        file.put("PartType1/Coordinates", at, columns);
        file.put("PartType1/Masses", std::vector<float>(at.size() / columns, 1));
        return refusalOf(file.close());
    };
    EXPECT_THAT(flat({0, 0, 1, 1}, 2), HasSubstr("expected rows of 3 numbers"));
    EXPECT_THAT(flat(std::vector<float>(9, std::numeric_limits<float>::quiet_NaN()), 3),
                HasSubstr("PartType1: expected particles that take space"));
    SnapshotFile bare;
    bare.counts({2, 0, 0, 0, 0, 0});
    bare.put("PartType0/Coordinates", std::vector<float>(6, 1), 3);
    EXPECT_THAT(refusalOf(bare.close()), HasSubstr("expected"));
}

}  // namespace
}  // namespace timeseries
