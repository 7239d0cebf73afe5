// Meshes of OpenFOAM cases: cells found between faces, meshes that move and change, parts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/foam_case.h"
#include "tests/support/read_variables.h"
#include "timeseries/grid/solid_cells.h"

namespace timeseries::foam_mesh {
namespace {

using namespace tests;
using namespace tests::foam;
using testing::ElementsAre;
using testing::HasSubstr;

const Mesh& meshAt(const Reader& reader, std::string_view name = "T") {
    return *reader.variables()[indexOf(reader, name)].grid->mesh();
}

// The points as so many bits hold them.
UnstructuredGrid narrowed(UnstructuredGrid grid, const Writing& how) {
    if (how.isBinary && how.scalar == 32)
        for (glm::dvec3& at : grid.points) at = glm::vec3(at);
    return grid;
}

void expectSame(const Mesh& found, const Mesh& expected) {
    ASSERT_EQ(found.count(), expected.count());
    EXPECT_EQ(found.spread(), expected.spread());
    EXPECT_EQ(found.folded() + found.flat() + found.absent(), 0u);
    for (std::uint64_t i = 0; i < found.count(); ++i) {
        EXPECT_LT(glm::distance(found.position(i), expected.position(i)), 1e-6) << i;
        EXPECT_NEAR(volume(found, i), volume(expected, i), 1e-6 * volume(expected, i)) << i;
    }
}

std::vector<double> countedTo(std::size_t count) {
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = double(i);
    return values;
}

// The cells name their corners in the oracle, and are found between faces by the reader.
TEST(FoamMesh, CellsOfAllShapesAreWhatTheirFacesBound) {
    for (const Cut cut : {Cut::Hexahedra, Cut::Tetrahedra, Cut::Wedges}) {
        const UnstructuredGrid grid = bentBricks(cut);
        const auto folder = caseOf(grid);
        put(folder / "0/T", scalars(countedTo(grid.types.size())));
        put(folder / "0/Tp", field("pointScalarField", "uniform 1"));
        const auto reader = open(folder);
        expectSame(meshAt(*reader), atCells(grid));
        expectSame(meshAt(*reader, "Tp"), atPoints(grid));
        EXPECT_NEAR(volume(meshAt(*reader)), 4 * 3 * 5, 1e-5);  // of the box
        EXPECT_EQ(valuesOf<double>(*reader, "T"), countedTo(grid.types.size()));
    }
}

// Beside a cube, the six pyramids of another about its centre, and a prism over a pentagon.
TEST(FoamMesh, PyramidsAndPolyhedraAreMeasured) {
    UnstructuredGrid grid = cubes(2);
    const UnstructuredGrid both = grid;
    grid.types.resize(1);
    grid.ends.resize(1);
    grid.corners.resize(8);
    const auto centre = static_cast<std::uint32_t>(grid.points.size());
    grid.points.emplace_back(1.5, 0.5, 0.5);
    for (const auto& face : tests::foam::facesOf(both, 1))
        addCell(grid, 14, {face[0], face[1], face[2], face[3], centre});
    // Of the shoelace formula: 1 by 1, and a roof of 1/2.
    const auto prism = static_cast<std::uint32_t>(grid.points.size());
    for (const double z : {3.0, 5.0})
        for (const auto& [x, y] : {std::pair{0., 0.}, {1., 0.}, {1., 1.}, {.5, 2.}, {0., 1.}})
            grid.points.emplace_back(x, y, z);
    const auto p = [&](std::uint32_t i) { return prism + i; };
    addCell(grid, 15, {p(0), p(1), p(2), p(3), p(4), p(5), p(6), p(7), p(8), p(9)});
    const auto folder = caseOf(grid);
    put(folder / "0/T", field("volScalarField", "uniform 1"));
    put(folder / "0/Tp", field("pointScalarField", "uniform 1"));
    const auto reader = open(folder);
    const Mesh& mesh = meshAt(*reader);
    expectSame(mesh, atCells(grid));
    EXPECT_NEAR(volume(mesh, 3), 1. / 6, 1e-6);
    EXPECT_NEAR(volume(mesh, 7), (1 + 0.5) * (5 - 3), 1e-5);
    expectSame(meshAt(*reader, "Tp"), atPoints(grid));
    ASSERT_TRUE(meshAt(*reader, "Tp").solids());
    EXPECT_EQ(meshAt(*reader, "Tp").solids()->count(), 1u + 6 + 1);
}

TEST(FoamMesh, FilesOfAllWritingsAreTheSame) {
    const UnstructuredGrid grid = bentBricks(Cut::Wedges);
    const std::vector<double> values = countedTo(grid.types.size());
    for (const bool isBinary : {false, true})
        for (const bool isPacked : {false, true})
            for (const int label : {32, 64})
                for (const int scalar : {32, 64}) {
                    const Writing how{isBinary, isPacked, label, scalar};
                    const auto folder = caseOf(grid, how);
                    put(folder / "0.5/T", scalars(values, how), how);
                    const auto reader = open(folder);
                    expectSame(meshAt(*reader), atCells(narrowed(grid, how)));
                    if (isBinary && scalar == 32) {
                        EXPECT_EQ(valuesOf<float>(*reader, "T"),
                                  std::vector<float>(values.begin(), values.end()));
                    } else {
                        EXPECT_EQ(valuesOf<double>(*reader, "T"), values);
                    }
                }
}

TEST(FoamMesh, PointsThatMoveCountFromTheirTimeOn) {
    const auto folder = caseOf(cubes(2));
    for (const char* time : {"0", "1", "2", "10"}) put(folder / time / "T", scalars({1, 2}));
    putPoints(folder / "2/polyMesh", cubes(2, 5).points);
    putPoints(folder / "9/polyMesh", cubes(2, 7).points);  // a time without fields
    const auto reader = open(folder);
    std::vector<double> x;
    for (std::size_t step = 0; step < 4; ++step)
        x.push_back(reader->read(0, step).grid->position(0).x);
    EXPECT_THAT(x, ElementsAre(0.5, 0.5, 5.5, 7.5));
    // And backwards.
    EXPECT_EQ(reader->read(0, 1).grid, reader->variables()[0].grid);
    EXPECT_FALSE(reader->sources(0, 1).files.empty());
    EXPECT_TRUE(reader->sources(0, 2).files.empty());
}

TEST(FoamMesh, CellsComeAndGoWithTheFacesOfATime) {
    const auto folder = caseOf(cubes(2));
    put(folder / "0/T", scalars({1, 2}));
    put(folder / "1/T", scalars({1, 2, 3}));
    putMesh(folder / "1/polyMesh", cubes(3));
    const auto reader = open(folder);
    EXPECT_EQ(reader->read(0, 1).grid->count(), 3u);
    EXPECT_EQ(valuesOf<double>(*reader, "T", 1), (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(valuesOf<double>(*reader, "T", 0), (std::vector<double>{1, 2}));
}

TEST(FoamMesh, ProcessorsAreOneCase) {
    const auto folder = caseOf(cubes(3));
    put(folder / "0/T", scalars({1, 2, 3}));
    for (const char* time : {"0", "0.1"}) {
        put(folder / "processor0" / time / "T", scalars({1, 2}));
        put(folder / "processor1" / time / "T", scalars({3}));
        put(folder / "processor0" / time / "Tp", field("pointScalarField", "uniform 4"));
        put(folder / "processor1" / time / "Tp", field("pointScalarField", "uniform 5"));
    }
    put(folder / "processor0/0.2/T", scalars({1, 2}));  // not yet of all
    putMesh(folder / "processor0/constant/polyMesh", cubes(2));
    putMesh(folder / "processor1/constant/polyMesh", cubes(1, 2));
    {
        const auto reader = open(folder);
        EXPECT_THAT(timesOf(*reader), ElementsAre(0, 0.1));
        EXPECT_EQ(valuesOf<double>(*reader, "T", 1), (std::vector<double>{1, 2, 3}));
        EXPECT_EQ(meshAt(*reader).position(2).x, 2.5);
        EXPECT_EQ(tests::nodesOf(meshAt(*reader)), 16u) << "where they meet";
        EXPECT_NEAR(volume(meshAt(*reader, "Tp")), 3, 1e-6);
        std::vector<double> atPoints(12, 4);
        atPoints.resize(20, 5);
        EXPECT_EQ(valuesOf<double>(*reader, "Tp"), atPoints);
        EXPECT_THAT(reader->variables()[0].notes, testing::Contains(HasSubstr("2 processor")));
        EXPECT_THAT(reader->variables()[0].notes,
                    testing::Contains("0.2 is left out: 1 of 2 processor folders have it"));
    }
    // Reconstructed.
    put(folder / "0.1/T", scalars({7, 8, 9}));
    EXPECT_EQ(valuesOf<double>(*open(folder), "T", 1), (std::vector<double>{7, 8, 9}));
}

TEST(FoamMesh, CollatedCasesAreReadWhenTheyAreReconstructed) {
    const auto folder = caseOf(cubes(1));
    put(folder / "0/T", scalars({1}));
    put(folder / "processors2/0/T", header("decomposedBlockData"));
    put(folder / "processors2/0.1/T", header("decomposedBlockData"));
    EXPECT_THAT(refusalOf(folder),
                testing::AllOf(HasSubstr("processors2"), HasSubstr("reconstructPar")));
    put(folder / "0.1/T", scalars({2}));
    EXPECT_EQ(valuesOf<double>(*open(folder), "T", 1), std::vector<double>{2});
}

}  // namespace
}  // namespace timeseries::foam_mesh
