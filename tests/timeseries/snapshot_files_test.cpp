// Snapshots of particles in several files, and series of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "tests/support/hdf_file.h"
#include "tests/support/read_variables.h"
#include "timeseries/readers/series_files.h"

namespace timeseries::snapshot_files {
namespace {

using namespace tests;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using Path = std::filesystem::path;

// Of particle i of a snapshot: gas or dark matter.
float placeOf(int snapshot, std::size_t i, int c) {
    return float(i * (c == 0 ? 1 : c == 1 ? i % 3 : i % 2)) + 0.25f * float(snapshot);
}
float massOf(int snapshot, std::size_t i) { return float(10 * snapshot) + 1 + float(i) / 8; }

// Three files of 5, 0 and 4 particles of gas; the first and the last have 2 and 3 of dark matter.
constexpr std::array<std::uint32_t, 3> kGas{5, 0, 4}, kDark{2, 0, 3};

struct Part {
    int snapshot = 10;
    std::size_t number = 0;
    std::vector<std::int32_t> files{3};
    std::vector<std::uint32_t> totals{9, 5, 0, 0, 0, 0}, high{0, 0, 0, 0, 0, 0};
    double time = 2.5;
    bool hasMasses = true;
};

Path write(const Part& part) {
    HdfFile file(fmt::format("snap_{:03}.{}.hdf5", part.snapshot, part.number));
    const std::uint32_t gas = kGas[part.number], dark = kDark[part.number];
    file.say("Header", "Time", part.time);
    file.say("Header", "NumFilesPerSnapshot", part.files);
    file.say("Header", "NumPart_ThisFile", std::vector<std::uint32_t>{gas, dark, 0, 0, 0, 0});
    file.say("Header", "NumPart_Total", part.totals);
    file.say("Header", "NumPart_Total_HighWord", part.high);
    file.say("Header", "MassTable", std::vector<double>(6, 0));
    std::size_t first = 0;
    for (std::size_t before = 0; before < part.number; ++before) first += kGas[before];
    const auto put = [&](const std::string& type, std::size_t count, std::size_t from) {
        std::vector<float> at, masses;
        for (std::size_t i = from; i < from + count; ++i) {
            for (int c = 0; c < 3; ++c) at.push_back(placeOf(part.snapshot, i, c));
            masses.push_back(massOf(part.snapshot, i));
        }
        file.put(type + "/Coordinates", at, 3);
        if (part.hasMasses) file.put(type + "/Masses", masses);
    };
    if (gas > 0) put("PartType0", gas, first);
    if (dark > 0) put("PartType1", dark, 100 + part.number);
    return file.close();
}

std::vector<Path> writeSnapshot(Part part) {
    std::vector<Path> paths;
    for (part.number = 0; part.number < 3; ++part.number) paths.push_back(write(part));
    return paths;
}

std::unique_ptr<Reader> openSeries(const Path& path) {
    return openReader(expandSeries(std::span(&path, 1)).files);
}

std::vector<float> masses(int snapshot) {
    std::vector<float> all;
    for (std::size_t i = 0; i < 9; ++i) all.push_back(massOf(snapshot, i));
    return all;
}

TEST(SnapshotFiles, AreOneStepByWhicheverTheyAreOpened) {
    freshFolder();
    const auto paths = writeSnapshot({});
    std::vector<Path> names = paths;
    names.push_back(testFolder());
    names.push_back(testFolder() / "snap_*.hdf5");
    for (const Path& path : names) {
        const auto reader = openSeries(path);
        EXPECT_THAT(timesOf(*reader), ElementsAre(2.5)) << path;
        EXPECT_EQ(valuesOf<float>(*reader, "PartType0/Masses"), masses(10)) << path;
        const Grid& grid = *reader->variables()[indexOf(*reader, "PartType0/Masses")].grid;
        ASSERT_EQ(grid.count(), 9u);
        for (std::uint64_t i = 0; i < 9; ++i)
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(grid.position(i)[c], double(placeOf(10, i, c)), 1e-6) << i;
        EXPECT_EQ(valuesOf<float>(*reader, "PartType1/Masses").size(), 5u);
        EXPECT_EQ(reader->sources(0, 0).files, paths);
        EXPECT_THAT(reader->format(), HasSubstr("in 3 files"));
    }
    // Without looking for others.
    EXPECT_EQ(valuesOf<float>(*open(paths[2]), "PartType0/Masses"), masses(10));
}

TEST(SnapshotFiles, SnapshotsAreTheStepsOfASeries) {
    freshFolder();
    const auto first = writeSnapshot({.snapshot = 9, .time = 0.5});
    const auto second = writeSnapshot({.snapshot = 10, .time = 1.5});
    for (const Path& path : {first[0], first[2], second[1], testFolder()}) {
        const auto expanded = expandSeries(std::span(&path, 1));
        EXPECT_THAT(expanded.files, ElementsAre(first[0], second[0])) << path;
        const auto reader = openReader(expanded.files);
        EXPECT_THAT(timesOf(*reader), ElementsAre(0.5, 1.5)) << path;
        EXPECT_EQ(valuesOf<float>(*reader, "PartType0/Masses", 0), masses(9)) << path;
        EXPECT_EQ(valuesOf<float>(*reader, "PartType0/Masses", 1), masses(10)) << path;
    }
    const Path named = second[1];
    EXPECT_EQ(expandSeries(std::span(&named, 1)).here, 1u);
    // All that are named, too.
    std::vector<Path> all = first;
    all.insert(all.end(), second.begin(), second.end());
    EXPECT_THAT(expandSeries(all).files, ElementsAre(first[0], second[0]));
}

// SWIFT's, whose arrays are those of the others; here without them.
TEST(SnapshotFiles, WhatRefersToThemStandsForThem) {
    freshFolder();
    HdfFile file("snap_010.hdf5");
    file.say("Header", "NumFilesPerSnapshot", std::vector<std::int32_t>{1});
    file.say("Header", "Virtual", std::vector<std::int32_t>{1});
    file.say("Header", "NumPart_ThisFile", std::vector<std::uint32_t>{9, 5, 0, 0, 0, 0});
    file.put("PartType0/Coordinates", std::vector<float>(27, 0), 3);
    file.put("PartType0/Masses", std::vector<float>(9, 0));
    const Path path = file.close();
    EXPECT_THAT(tests::refusalOf(path),
                AllOf(HasSubstr("snap_010.hdf5: Header: expected the files"),
                      HasSubstr("there is no " + (testFolder() / "snap_010.0.hdf5").string())));
    const auto paths = writeSnapshot({});
    for (const Path& each : {path, testFolder(), paths[1]}) {
        const auto reader = openSeries(each);
        EXPECT_EQ(valuesOf<float>(*reader, "PartType0/Masses"), masses(10)) << each;
        EXPECT_EQ(timesOf(*reader).size(), 1u);
    }
    EXPECT_EQ(open(path)->sources(0, 0).files, paths);
}

TEST(SnapshotFiles, OneThatIsMissingIsNamed) {
    for (const std::size_t missing : {0u, 1u, 2u}) {
        freshFolder();
        const auto paths = writeSnapshot({});
        std::filesystem::remove(paths[missing]);
        for (const Path& path : {paths[missing == 0 ? 1 : 0], testFolder()})
            EXPECT_THAT(tests::refusalOf(expandSeries(std::span(&path, 1)).files),
                        HasSubstr("Header: expected the 3 files of the snapshot beside it, but "
                                  "there is no " +
                                  paths[missing].string()));
    }
}

// Whichever it is, the others tell that it is one of several.
TEST(SnapshotFiles, OneThatIsCutShortLeavesTheOthersParts) {
    for (std::size_t cut = 0; cut < 6; ++cut) {
        freshFolder();
        std::vector<Path> all = writeSnapshot({.snapshot = 9, .time = 0.5});
        const auto second = writeSnapshot({.snapshot = 10, .time = 1.5});
        all.insert(all.end(), second.begin(), second.end());
        std::filesystem::resize_file(all[cut], 300);
        for (const Path& path : {all[1], second[0], testFolder()})
            EXPECT_THAT(expandSeries(std::span(&path, 1)).files, ElementsAre(all[0], second[0]))
                << path << " beside " << all[cut];
        EXPECT_THAT(expandSeries(all).files, ElementsAre(all[0], second[0])) << all[cut];
    }
}

TEST(SnapshotFiles, ThatAreNotOfOneSnapshotAreRefused) {
    const auto refusal = [](std::size_t which, const std::function<void(Part&)>& change) {
        freshFolder();
        const auto paths = writeSnapshot({});
        Part part{.number = which};
        change(part);
        write(part);
        return tests::refusalOf(paths[0]);
    };
    EXPECT_EQ(refusal(2, [](Part&) {}), "");
    EXPECT_THAT(refusal(2, [](Part& p) { p.time = 3; }),
                AllOf(HasSubstr("snap_010.2.hdf5: Header: expected the Time of"),
                      HasSubstr("snap_010.0.hdf5")));
    EXPECT_THAT(refusal(1, [](Part& p) { p.files = {4}; }),
                HasSubstr("snap_010.1.hdf5: Header: expected the NumFilesPerSnapshot of"));
    EXPECT_THAT(refusal(2, [](Part& p) { p.hasMasses = false; }),
                HasSubstr("snap_010.2.hdf5: variable 'PartType0/Masses': expected it as in"));
    EXPECT_THAT(refusal(0, [](Part& p) { p.totals[0] = 8; }),
                HasSubstr("expected of NumPart_Total the 9 particles of PartType0 in the "
                          "snapshot's 3 files, found 8"));
    EXPECT_THAT(refusal(0, [](Part& p) { p.high[1] = 1; }),
                HasSubstr("the 5 particles of PartType1 in the snapshot's 3 files, found "
                          "4294967301"));
    EXPECT_THAT(refusal(0, [](Part& p) { p.files = {1000000000}; }),
                HasSubstr("there is no " + (testFolder() / "snap_010.3.hdf5").string()));
    EXPECT_THAT(refusal(0, [](Part& p) { p.files = {2}; }), HasSubstr("NumPart_Total"));
    // A name that tells no number.
    freshFolder();
    const auto paths = writeSnapshot({});
    const Path other = testFolder() / "snap.hdf5";
    std::filesystem::rename(paths[0], other);
    EXPECT_THAT(tests::refusalOf(other),
                HasSubstr("expected a file named as one of 3 of a snapshot"));
}

}  // namespace
}  // namespace timeseries::snapshot_files
