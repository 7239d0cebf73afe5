// Files that name blocks of one whole: each block's own points, and of adaptive meshes only what no
// finer level covers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/support/read_variables.h"
#include "tests/support/shared_data.h"
#include "tests/support/unstructured.h"
#include "tests/support/vtk_grids.h"
#include "timeseries/grid/cell_types.h"

namespace timeseries::vtk_multiblock {
namespace {

using namespace tests;
using testing::ElementsAre;
using testing::HasSubstr;
using Path = std::filesystem::path;

void writeList(const Path& path, const std::string& type, const std::string& inside) {
    writeBytes(path, fmt::format("<VTKFile type=\"{0}\" version=\"1.0\"><{0}>{1}</{0}></VTKFile>",
                                 type, inside));
}

std::string set(const std::string& name, const std::string& attributes = "index=\"0\"") {
    return fmt::format("<DataSet {} file=\"{}\"/>", attributes, name);
}

double volumeOf(const Grid& grid) { return volume(*grid.mesh()); }

TEST(VtkMultiBlock, PointsAndCellsOfAllBlocksStandBehindEachOther) {
    const auto folder = freshFolder();
    const std::vector<std::string> types{"ImageData", "RectilinearGrid", "StructuredGrid"};
    std::map<std::array<double, 3>, double> expected[2];
    std::string inside;
    double size = 0;
    const auto take = [&](const std::string& name) {
        for (const int cells : {0, 1})
            expected[cells].merge(byPlace(folder / name, cells ? "c" : "p"));
    };
    for (const auto& type : types) {
        writeGrid(folder / type, type, {1, 4, 0, 3, 0, 2});
        inside += "<Block index=\"0\" name=\"inner\">" + set(type) + "</Block>";
        take(type);
    }
    // Unit cubes elsewhere, and one of what the list says that it is nothing.
    std::string cells = cubes(0, 2, "");
    writeBytes(folder / "cubes", cells);
    take("cubes");
    writeList(folder / "all.vtm", "vtkMultiBlockDataSet",
              inside + set("cubes") + "<DataSet index=\"9\"/>");
    const auto reader = open(folder / "all.vtm");
    EXPECT_EQ(reader->format(), "VTK multi-block data, 4 blocks");
    for (const int at : {0, 1}) {
        const auto found = byPlace(folder / "all.vtm", at ? "c" : "p");
        EXPECT_EQ(found, expected[at]) << at;
        EXPECT_GT(found.size(), at ? 50u : 110u);
    }
    // Image 3 x 3 x 2 cells of 1; rectilinear of steps s + (2 i + 1) / 10 for each axis of steps s.
    size = 2 + 3 * (0.5 * 1 * 2) * 3 * 2;
    const auto steps = [](double step, int from, int to) {
        return step * (to - from) + 0.1 * (to * to - from * from);
    };
    size += steps(1, 1, 4) * steps(2, 0, 3) * steps(3, 0, 2);
    // (i + 0.2 j, j - 0.1 k, k + 0.05 i): a parallelepiped of this determinant for each cell.
    size += 18 * (1 - 0.2 * (0 + 0.1 * 0.05));
    EXPECT_NEAR(volumeOf(*reader->variables()[0].grid), size, 1e-5 * size);
}

// Coarse cells of 1, of which the middle ones are covered by cells of a half, the middle ones of
// these by cells of a quarter.
TEST(VtkMultiBlock, OfAdaptiveMeshesTheLeavesStay) {
    const auto folder = freshFolder();
    const auto level = [&](const std::string& name, int cells, double origin, double spacing,
                           double base) {
        std::vector<double> c, p;
        for (int i = 0; i < cells * cells * cells; ++i) c.push_back(base + i);
        for (int i = 0; i < (cells + 1) * (cells + 1) * (cells + 1); ++i) p.push_back(base + i);
        writeBytes(folder / name, imageText({.extent = fmt::format("0 {0} 0 {0} 0 {0}", cells),
                                             .attributes = fmt::format("Origin=\"{0} {0} {0}\" "
                                                                       "Spacing=\"{1} {1} {1}\"",
                                                                       origin, spacing),
                                             .points = dataArray("Float64", "p", p),
                                             .cells = dataArray("Float64", "c", c)}));
    };
    level("coarse.vti", 6, 0, 1, 0);
    level("middle.vti", 6, 1, 0.5, 1000);   // [1, 4]
    level("fine.vti", 4, 2, 0.25, 2000);    // [2, 3]
    level("another.vti", 2, 5, 0.5, 3000);  // [5, 6]
    // What is covered, by its definition: its middle, or all cells about a point, within a finer.
    std::map<std::array<double, 3>, double> leaves;
    const std::vector<std::array<double, 4>> all{
        {6, 0, 1, 0}, {6, 1, 0.5, 1000}, {4, 2, 0.25, 2000}, {2, 5, 0.5, 3000}};
    for (const auto& [cells, origin, spacing, base] : all)
        for (int n = 0; n < int(cells * cells * cells); ++n) {
            const int e = int(cells);
            const glm::dvec3 at =
                origin + spacing * (glm::dvec3(n % e, n / e % e, n / e / e) + 0.5);
            const auto within = [&](double lo, double hi) {
                return glm::all(glm::greaterThan(at, glm::dvec3(lo))) &&
                       glm::all(glm::lessThan(at, glm::dvec3(hi)));
            };
            if (spacing > 0.5 && (within(1, 4) || within(5, 6))) continue;
            if (spacing == 0.5 && base == 1000 && within(2, 3)) continue;
            leaves[{at.x * 1e4, at.y * 1e4, at.z * 1e4}] = base + n;
        }
    ASSERT_EQ(leaves.size(), 216u - 27 - 1 + 216 - 8 + 64 + 8);
    const std::vector<std::pair<std::string, std::string>> ways{
        {"vtkOverlappingAMR", "<Block level=\"0\">" + set("coarse.vti") +
                                  "</Block><Block level=\"1\">" + set("middle.vti") +
                                  set("another.vti", "index=\"1\"") +
                                  "</Block><Block level=\"2\">" + set("fine.vti") + "</Block>"},
        {"vtkHierarchicalBoxDataSet",
         "<RefinementRatio level=\"0\" refinement=\"2\"/>" + set("coarse.vti", "group=\"0\"") +
             set("middle.vti", "group=\"1\"") + set("another.vti", "group=\"1\"") +
             set("fine.vti", "group=\"2\"")}};
    for (const auto& [type, inside] : ways) {
        writeList(folder / "levels.vthb", type, inside);
        EXPECT_EQ(byPlace(folder / "levels.vthb", "c"), leaves) << type;
        const auto reader = open(folder / "levels.vthb");
        EXPECT_EQ(reader->format(), "VTK adaptive mesh, 3 levels, 4 blocks");
        const std::size_t c = indexOf(*reader, "c"), p = indexOf(*reader, "p");
        EXPECT_NEAR(volumeOf(*reader->variables()[c].grid), 216, 216e-6);
        EXPECT_NEAR(volumeOf(*reader->variables()[p].grid), 216, 216e-6);
        for (const std::size_t variable : {c, p}) {
            const MeshAbout& about = reader->variables()[variable].grid->mesh()->about();
            EXPECT_EQ(about.levels, 3u);
            EXPECT_THAT(about.cells, ElementsAre(MeshAbout::Kind{kVoxelCell, leaves.size()}));
        }
        // Points that nothing but covered cells has about it: within the middle 2 x 2 x 2 of 3, and
        // the one of the fine block's own middle; none at the corner that [5, 6] takes but its own.
        const Field field = reader->read(p, 0);
        std::set<double> missing;
        for (std::size_t i = 0; i < field.missing.size(); ++i)
            if (field.missing[i]) {
                const glm::dvec3 at = field.grid->position(i);
                missing.insert(at.x * 100 + at.y * 10 + at.z);
            }
        std::set<double> expected{666, 222, 223, 232, 233, 322, 323, 332, 333};
        expected.insert(250 + 25 + 2.5);
        EXPECT_EQ(missing, expected);
    }
}

TEST(VtkMultiBlock, WhatABlockHasNotIsMissingThere) {
    const auto folder = freshFolder();
    std::string other = cubes(2, 3, "");
    other.replace(other.find("Name=\"p\""), 8, "Name=\"q\"");
    writeBytes(folder / "a.vtu", cubes(0, 2, ""));
    writeBytes(folder / "b.vtu", other);
    writeList(folder / "all.vtm", "vtkPartitionedDataSetCollection",
              "<Partitions index=\"0\">" + set("a.vtu") + "</Partitions>" + set("b.vtu"));
    EXPECT_EQ(byPlace(folder / "all.vtm", "p"), byPlace(folder / "a.vtu", "p"));
    EXPECT_EQ(byPlace(folder / "all.vtm", "q"), byPlace(folder / "b.vtu", "q"));
    const auto reader = open(folder / "all.vtm");
    EXPECT_EQ(reader->variables()[indexOf(*reader, "q")].missing, "blocks without it");
    EXPECT_EQ(reader->variables()[indexOf(*reader, "c")].missing, "");
}

TEST(VtkMultiBlock, OneBlockIsAGridLikeAnyOther) {
    const auto folder = freshFolder();
    for (const std::string type : {"ImageData", "RectilinearGrid", "StructuredGrid"}) {
        writeGrid(folder / type, type, {1, 4, 0, 3, 0, 2});
        writeList(folder / "one.vtm", "vtkMultiBlockDataSet", set(type));
        const auto one = open(folder / "one.vtm"), alone = open(folder / type);
        EXPECT_EQ(*one->variables()[0].grid, *alone->variables()[0].grid) << type;
        EXPECT_EQ(byPlace(folder / "one.vtm", "p"), byPlace(folder / type, "p")) << type;
        // So that a change of either is noticed.
        EXPECT_THAT(one->sources(0, 0).files, ElementsAre(folder / "one.vtm", folder / type));
    }
}

TEST(VtkMultiBlock, WhatIsWrongIsNamed) {
    const auto folder = freshFolder();
    writeBytes(folder / "a.vtu", cubes(0, 2, ""));
    writeGrid(folder / "image.vti", "ImageData", {0, 2, 0, 2, 0, 2});
    writeGrid(folder / "bent.vts", "StructuredGrid", {0, 2, 0, 2, 0, 2});
    const auto told = [&](const std::string& inside,
                          const std::string& type = "vtkMultiBlockDataSet") {
        writeList(folder / "all.vtm", type, inside);
        return refusalOfRead(folder / "all.vtm");
    };
    EXPECT_THAT(told(""), HasSubstr("expected a DataSet with a file that holds points"));
    EXPECT_THAT(told("<DataSet index=\"0\"/>"), HasSubstr("expected a DataSet with a file"));
    EXPECT_THAT(told(set("none.vtu")), HasSubstr("none.vtu: expected a file"));
    EXPECT_THAT(told(set("a.vtu") + set("./a.vtu")), HasSubstr("found a.vtu again"));
    EXPECT_THAT(told(set("all.vtm")), HasSubstr("all.vtm"));
    EXPECT_THAT(told("<Block level=\"low\">" + set("image.vti") + "</Block>", "vtkOverlappingAMR"),
                HasSubstr("Block level: expected a count, found \"low\""));
    EXPECT_THAT(told(set("image.vti") + set("bent.vts"), "vtkOverlappingAMR"),
                HasSubstr("bent.vts: VTKFile: expected image data along the axes of space"));
}

// The others are read: in ParaView, too, a block may have another p than its neighbours.
TEST(VtkMultiBlock, AnArrayThatIsAnotherKindInSomeBlockIsLeftOutAndTold) {
    const auto folder = freshFolder();
    std::string other = cubes(2, 3, "");
    for (std::size_t at; (at = other.find("Float64\" Name=\"p\"")) != other.npos;)
        other.replace(at, 7, "Float32");
    writeBytes(folder / "a.vtu", cubes(0, 2, ""));
    writeBytes(folder / "b.vtu", other);
    writeBytes(folder / "c.vtu", other);
    writeList(folder / "all.vtm", "vtkMultiBlockDataSet",
              set("a.vtu") + set("b.vtu") + set("c.vtu"));
    const auto reader = open(folder / "all.vtm");
    EXPECT_THAT(tests::namesOf(*reader), testing::Not(testing::Contains("p")));
    EXPECT_EQ(reader->variables()[indexOf(*reader, "c")].missing, "");
    ASSERT_EQ(reader->damaged().size(), 1u);
    EXPECT_EQ(reader->damaged()[0].name, "p");
    EXPECT_THAT(reader->damaged()[0].why,
                HasSubstr("b.vtu: 'p': expected float64 of 1 components, as in another block"));
}

// Leaves by brute force of the blocks' own files.
TEST(VtkMultiBlock, TheChomboMeshIsItsLeaves) {
    const Path folder = sharedData("grids/chombo3d");
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no real data at " << folder;
    struct Block {
        glm::dvec3 lo, hi;
        double spacing;
        std::map<std::array<double, 3>, double> values;
    };
    std::vector<Block> blocks;
    for (int i = 0; i < 16; ++i) {
        const Path file = folder / fmt::format("chombo3d_{}.vti", i);
        const auto axes = open(file)->variables()[0].grid->axes();
        Block block{{}, {}, axes[0].coordinates[1] - axes[0].coordinates[0], byPlace(file, "phi")};
        for (int a = 0; a < 3; ++a) {
            block.lo[a] = axes[a].coordinates.front() - block.spacing / 2;
            block.hi[a] = axes[a].coordinates.back() + block.spacing / 2;
        }
        blocks.push_back(std::move(block));
    }
    std::map<std::array<double, 3>, double> leaves;
    for (const Block& block : blocks)
        for (const auto& [place, value] : block.values) {
            const glm::dvec3 at = 1e-4 * glm::dvec3(place[0], place[1], place[2]);
            if (std::ranges::none_of(blocks, [&](const Block& finer) {
                    return finer.spacing < block.spacing &&
                           glm::all(glm::greaterThan(at, finer.lo)) &&
                           glm::all(glm::lessThan(at, finer.hi));
                }))
                leaves[place] = value;
        }
    EXPECT_EQ(leaves.size(), 8968u);  // of 10,176, as numpy counts them, too
    EXPECT_EQ(byPlace(folder / "chombo3d.vtm", "phi"), leaves);
    const auto reader = open(folder / "chombo3d.vtm");
    EXPECT_NEAR(volumeOf(*reader->variables()[0].grid), 512, 1e-5);
}

}  // namespace
}  // namespace timeseries::vtk_multiblock
