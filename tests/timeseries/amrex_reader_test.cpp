// AMReX's plotfiles: the leaves' values at their places, to the bit, whatever the numbers, their
// bytes, ghost cells, boxes and levels are.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <map>

#include "tests/support/plotfile.h"
#include "tests/support/read_variables.h"
#include "tests/support/unstructured.h"
#include "timeseries/grid/cell_types.h"
#include "timeseries/grid/solid_cells.h"
#include "timeseries/index/sorted_step.h"
#include "timeseries/readers/series_files.h"

namespace timeseries::amrex_reader {
namespace {

using namespace tests;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Path = std::filesystem::path;
using Box = IndexBox;

// Whether a finer level has the cell's middle, as the file's own boxes say.
bool isCovered(const Plotfile& file, std::size_t level, const Cell& cell) {
    const glm::dvec3 at = middleOf(file, level, cell);
    for (std::size_t l = level + 1; l < file.levels.size(); ++l)
        for (const Box& box : file.levels[l].boxes) {
            bool inside = true;
            for (int a = 0; a < file.dimensions; ++a)
                inside = inside && at[a] > middleOf(file, l, box.first)[a] - sideOf(file, l, a) &&
                         at[a] < middleOf(file, l, box.last)[a] + sideOf(file, l, a);
            if (inside) return true;
        }
    return false;
}

using Place = std::array<std::int64_t, 3>;
// To a 2^20th of a unit, as meshes keep places to a 2^24th of their extent.
Place rounded(const glm::dvec3& at) {
    return {std::llround(at.x * 65536), std::llround(at.y * 65536), std::llround(at.z * 65536)};
}

template <typename T>
std::map<Place, T> expectedOf(const Plotfile& file, std::size_t variable) {
    std::map<Place, T> leaves;
    for (std::size_t l = 0; l < file.levels.size(); ++l)
        for (const Box& box : file.levels[l].boxes)
            forEachCellIn(box, [&](const Cell& cell) {
                if (!isCovered(file, l, cell))
                    leaves[rounded(middleOf(file, l, cell))] =
                        static_cast<T>(file.value(variable, l, cell));
            });
    return leaves;
}

template <typename T>
std::map<Place, T> foundIn(Reader& reader, std::size_t variable) {
    const Field field = reader.read(variable, 0);
    const auto& values = std::get<std::vector<T>>(field.values);
    EXPECT_EQ(values.size(), field.grid->count());
    EXPECT_THAT(field.missing, IsEmpty());
    std::map<Place, T> found;
    for (std::uint64_t i = 0; i < values.size(); ++i)
        found[rounded(field.grid->position(i))] = values[i];
    EXPECT_EQ(found.size(), values.size());
    return found;
}

Path writtenAs(const Plotfile& file, const std::string& name = "plt00000") {
    const Path folder = testFolder() / name;
    std::filesystem::remove_all(folder);
    writePlotfile(folder, file);
    return folder;
}

TEST(Amrex, BoxesThatTileARectangleAreAnUprightGrid) {
    Plotfile file = threeLevels();
    file.levels.resize(1);
    for (const std::int64_t ghosts : {0, 2})
        for (const std::vector<std::int64_t>& order : std::vector<std::vector<std::int64_t>>{
                 {}, {1, 2, 3, 4, 5, 6, 7, 8}, {2, 1, 4, 3, 6, 5, 8, 7}}) {
            file.ghosts = ghosts;
            file.order = order;
            const Path folder = writtenAs(file);
            for (const Path& named : {folder, folder / "Header", folder / ""}) {
                const auto reader = open(named);
                EXPECT_EQ(reader->format(), "AMReX plotfile, 1 level, 3 boxes");
                ASSERT_EQ(reader->variables().size(), 2u);
                const Variable& variable = reader->variables()[1];
                EXPECT_EQ(variable.name, "Temp of it");
                EXPECT_EQ(variable.type, ValueType::F64);
                EXPECT_EQ(variable.storedAs, "float64, at cells");
                EXPECT_THAT(variable.notes, IsEmpty());
                EXPECT_EQ(variable.grid->mesh(), nullptr);
                EXPECT_THAT(variable.grid->size(), ElementsAre(8, 6, 4));
                EXPECT_TRUE(variable.grid->uniform());
                EXPECT_EQ(variable.time->name, "time");
                EXPECT_FALSE(variable.time->counted);
                EXPECT_THAT(timesOf(*reader), ElementsAre(0.1));
                for (const std::size_t v : {0u, 1u})
                    EXPECT_EQ(foundIn<double>(*reader, v), expectedOf<double>(file, v));
            }
        }
}

TEST(Amrex, OfLevelsTheLeavesStay) {
    for (const bool isSingle : {false, true})
        for (const std::int64_t ghosts : {0, 1})
            for (const bool isBig : {false, true}) {
                Plotfile file = threeLevels();
                file.isSingle = isSingle;
                file.ghosts = ghosts;
                if (isBig) file.order = {1, 2, 3, 4};
                if (isBig && !isSingle) file.order = {1, 2, 3, 4, 5, 6, 7, 8};
                const auto reader = open(writtenAs(file));
                EXPECT_EQ(reader->format(), "AMReX plotfile, 3 levels, 6 boxes");
                EXPECT_EQ(reader->variables()[0].type, isSingle ? ValueType::F32 : ValueType::F64);
                const Grid& grid = *reader->variables()[0].grid;
                // Of 192 cells 4 x 4 x 4 are refined, of their 512 halves 4 x 2 x 4 again.
                EXPECT_EQ(grid.count(), 192u - 64 + 512 - 32 + 256);
                EXPECT_NEAR(volume(*grid.mesh()), 8 * 3 * 4, 1e-5);
                EXPECT_EQ(grid.mesh()->about().levels, 3u);
                EXPECT_THAT(grid.mesh()->about().cells,
                            ElementsAre(MeshAbout::Kind{kVoxelCell, grid.count()}));
                for (const std::size_t v : {0u, 1u}) {
                    if (isSingle)
                        EXPECT_EQ(foundIn<float>(*reader, v), expectedOf<float>(file, v));
                    else
                        EXPECT_EQ(foundIn<double>(*reader, v), expectedOf<double>(file, v));
                }
            }
}

TEST(Amrex, EachLeafIsAsLargeAsItsCell) {
    const Plotfile file = threeLevels();
    const auto reader = open(writtenAs(file));
    const Field field = reader->read(0, 0);
    const auto& values = std::get<std::vector<double>>(field.values);
    EXPECT_EQ(field.grid->mesh()->spread(), 1);
    for (std::uint64_t i = 0; i < values.size(); ++i) {
        // The level is told by the value: 1e6 + 1e5 level + ...
        const auto level = static_cast<std::size_t>((values[i] - 1e6) / 1e5);
        const double side = 1 / double(1 << level);
        EXPECT_NEAR(volume(*field.grid->mesh(), i), side * 0.5 * side * side, 1e-6);
    }
}

TEST(Amrex, CountsAreThoseOfTheFilesOwnCells) {
    const Plotfile file = threeLevels();
    const auto reader = open(writtenAs(file));
    const SortedStep step = SortedStep::build(reader->read(0, 0));
    for (const auto& [lo, hi] : {std::pair{1e6, 1.1e6}, {1.1e6 + 5, 1.2e6 + 14}, {1.2e6, 2e6}}) {
        std::uint64_t expected = 0, found = 0;
        for (const auto& [place, value] : expectedOf<double>(file, 0))
            expected += lo <= value && value <= hi;
        const RangeSet range({Range{{lo}, {hi}}});
        for (const auto& run : step.select(range)) found += run.count;
        EXPECT_EQ(found, expected);
        EXPECT_GT(expected, 0u);
    }
}

// One level of boxes about a hole, one of indices that do not begin at 0, and cells that are
// refined along one axis alone.
TEST(Amrex, LatticesOfOtherShapes) {
    Plotfile file = threeLevels();
    file.levels.resize(1);
    file.levels[0].boxes.pop_back();
    const auto hole = open(writtenAs(file));
    EXPECT_EQ(hole->variables()[0].grid->count(), 192u - 48);
    EXPECT_EQ(foundIn<double>(*hole, 0), expectedOf<double>(file, 0));

    file.levels = {{{{-8, 100, 3}, {7, 107, 6}}, {Box{{-8, 100, 3}, {7, 107, 6}}}},
                   {{{-8, 200, 3}, {7, 215, 6}}, {Box{{-3, 202, 4}, {2, 205, 6}}}}};
    const auto along = open(writtenAs(file));
    EXPECT_EQ(along->variables()[0].grid->count(), 512u - 6 * 2 * 3 + 6 * 4 * 3);
    EXPECT_EQ(foundIn<double>(*along, 1), expectedOf<double>(file, 1));

    file.levels.resize(1);
    const auto shifted = open(writtenAs(file));
    EXPECT_EQ(shifted->variables()[0].grid->mesh(), nullptr);
    EXPECT_EQ(foundIn<double>(*shifted, 1), expectedOf<double>(file, 1));
}

TEST(Amrex, TwoDimensionsAreALayer) {
    Plotfile file;
    file.dimensions = 2;
    file.lo = {0, 0, 0};
    file.hi = {4, 2, 0};
    file.levels = {{{{0, 0, 0}, {7, 3, 0}}, {Box{{0, 0, 0}, {3, 3, 0}}, Box{{4, 0, 0}, {7, 3, 0}}}},
                   {{{0, 0, 0}, {15, 7, 0}}, {Box{{2, 2, 0}, {9, 5, 0}}}}};
    file.value = threeLevels().value;
    file.ghosts = 1;
    const auto two = open(writtenAs(file));
    EXPECT_EQ(foundIn<double>(*two, 1), expectedOf<double>(file, 1));
    const Mesh& mesh = *two->variables()[0].grid->mesh();
    EXPECT_EQ(mesh.count(), 32u - 8 + 32);
    EXPECT_THAT(mesh.about().cells, ElementsAre(MeshAbout::Kind{kPixelCell, 56}));
    // As thick as the cells are wide in the mean.
    EXPECT_NEAR(volume(mesh), 8 * std::sqrt(8.0 / 56), 1e-5);
    file.levels.resize(1);
    const auto one = open(writtenAs(file));
    EXPECT_THAT(one->variables()[0].grid->size(), ElementsAre(8, 4, 1));
    EXPECT_EQ(foundIn<double>(*one, 0), expectedOf<double>(file, 0));
}

TEST(Amrex, WhatStandsBesideTheCellsIsTold) {
    const Path folder = writtenAs(threeLevels());
    std::filesystem::create_directories(folder / "raw_fields" / "Level_0");
    std::filesystem::create_directories(folder / "electrons");
    writeBytes(folder / "Level_0" / "Nu_nd_H", "1\n");
    writeBytes(folder / "job_info", "");
    const auto reader = open(folder);
    EXPECT_THAT(reader->variables()[0].notes,
                testing::Contains("particles, raw fields and values at nodes or faces are not "
                                  "read: Level_0/Nu_nd, electrons, raw_fields"));
}

// Steps that are refined later on; a folder beside them is none.
TEST(Amrex, FoldersOfStepsAreASeries) {
    const Path run = freshFolder();
    std::vector<Plotfile> steps(3, threeLevels());
    steps[0].levels.resize(1);
    steps[1].levels.resize(2);
    for (std::size_t s = 0; s < 3; ++s) {
        steps[s].time = 0.25 * double(s * s);
        writePlotfile(run / fmt::format("plt{:05}", 10 * s), steps[s]);
    }
    std::filesystem::create_directories(run / "chk00010");
    writeBytes(run / "inputs", "");
    const std::vector<Path> all{run / "plt00000", run / "plt00010", run / "plt00020"};
    for (const Path& named : {run, run / "plt000*", run / "plt00010", run / "plt00010" / "",
                              run / "plt00010" / "Header"}) {
        const ExpandedSeries series = expandSeries(std::span(&named, 1));
        EXPECT_EQ(series.files, all) << named;
        EXPECT_THAT(series.recognised, HasSubstr("3 files plt00000 to plt00020")) << named;
        if (named.string().find("00010") != std::string::npos) {
            EXPECT_EQ(series.here, std::size_t{1});
        }
    }
    const auto reader = openReader(all);
    EXPECT_THAT(timesOf(*reader), ElementsAre(0, 0.25, 1));
    for (std::size_t s = 0; s < 3; ++s) {
        const Field field = reader->read(1, s);
        const auto& values = std::get<std::vector<double>>(field.values);
        std::map<Place, double> found;
        for (std::uint64_t i = 0; i < values.size(); ++i)
            found[rounded(field.grid->position(i))] = values[i];
        EXPECT_EQ(found, expectedOf<double>(steps[s], 1)) << s;
    }
    // Of one level all, they are upright.
    for (std::size_t s = 0; s < 3; ++s) {
        steps[s].levels.resize(1);
        std::filesystem::remove_all(all[s]);
        writePlotfile(all[s], steps[s]);
    }
    EXPECT_EQ(openReader(all)->variables()[0].grid->mesh(), nullptr);
}

TEST(Amrex, TwoSeriesInAFolderAreNotOne) {
    const Path run = freshFolder();
    for (const char* name : {"plt00000", "plt00010", "small00000", "small00010"})
        writePlotfile(run / name, threeLevels());
    try {
        expandSeries(std::span(&run, 1));
        ADD_FAILURE();
    } catch (const FileError& error) {
        EXPECT_THAT(error.what(), HasSubstr("expected a folder that holds one series"));
    }
}

// Where leaves meet, of one level or of two, they share corners.
TEST(Amrex, LeavesAreCellsBetweenTheirCorners) {
    const auto reader = open(writtenAs(threeLevels()));
    const Mesh& mesh = *reader->variables()[0].grid->mesh();
    ASSERT_TRUE(mesh.solids());
    const SolidCells& solids = *mesh.solids();
    ASSERT_EQ(solids.count(), mesh.count());
    std::map<Place, std::uint32_t> numbers;
    SolidCells::Room room;
    std::size_t shared = 0;
    for (std::uint64_t i = 0; i < mesh.count(); ++i) {
        glm::dvec3 lo(INFINITY), hi(-INFINITY);
        for (const std::uint32_t corner : solids.corners(i, room)) {
            if (corner < mesh.count()) continue;
            const glm::dvec3 at = mesh.cornerPosition(corner);
            lo = glm::min(lo, at);
            hi = glm::max(hi, at);
            const auto [first, isNew] = numbers.try_emplace(rounded(at), corner);
            EXPECT_EQ(first->second, corner);
            shared += !isNew;
        }
        EXPECT_EQ(rounded(0.5 * (lo + hi)), rounded(mesh.position(i)));
        const glm::dvec3 side = hi - lo;
        EXPECT_NEAR(side.x * side.y * side.z, mesh.volume(i), 1e-5 * mesh.volume(i));
    }
    EXPECT_GT(shared, mesh.count());
}

}  // namespace
}  // namespace timeseries::amrex_reader
