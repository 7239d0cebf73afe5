// Ghost cells: points of ghosts alone are missing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkIdList.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <array>
#include <random>
#include <vector>

#include "tests/support/array_builder.h"
#include "tests/support/read_variables.h"
#include "tests/support/unstructured.h"
#include "tests/support/vtk_files.h"
#include "tests/support/vtk_grids.h"
#include "timeseries/grid/solid_cells.h"
#include "timeseries/grid/without_cells.h"

namespace timeseries::vtk_ghosts {
namespace {

using namespace tests;
using Size = std::array<std::uint64_t, 3>;

// Each point's cells are looked at.
std::vector<bool> bruteForce(const std::vector<bool>& ghosts, const Size& points) {
    Size cells = points;
    for (std::uint64_t& each : cells) each = std::max<std::uint64_t>(each, 2) - 1;
    const auto touches = [](std::uint64_t cell, std::uint64_t point, std::uint64_t count) {
        return count == 1 || cell == point || cell + 1 == point;
    };
    std::vector<bool> alone;
    for (std::uint64_t z = 0; z < points[2]; ++z)
        for (std::uint64_t y = 0; y < points[1]; ++y)
            for (std::uint64_t x = 0; x < points[0]; ++x) {
                bool all = true;
                for (std::uint64_t n = 0; n < ghosts.size(); ++n)
                    if (touches(n % cells[0], x, points[0]) &&
                        touches(n / cells[0] % cells[1], y, points[1]) &&
                        touches(n / cells[0] / cells[1], z, points[2]))
                        all = all && ghosts[n];
                alone.push_back(all);
            }
    return alone;
}

Size pointsIn(const std::array<int, 6>& extent) {
    const auto along = [&](std::size_t a) {
        return std::uint64_t(extent[2 * a + 1] - extent[2 * a] + 1);
    };
    return {along(0), along(1), along(2)};
}

// That of gridOf(), whose cells have these flags.
vtkSmartPointer<vtkDataSet> flagged(const std::string& type, const std::array<int, 6>& extent,
                                    const std::vector<unsigned char>& flags) {
    const auto grid = gridOf(type, extent);
    const vtkNew<vtkUnsignedCharArray> array;
    array->SetName("vtkGhostType");
    for (const unsigned char flag : flags) array->InsertNextValue(flag);
    grid->GetCellData()->AddArray(array);
    return grid;
}

void writeFlagged(const std::filesystem::path& path, const std::string& type, vtkDataSet* grid) {
    if (type == "ImageData")
        writeWith<vtkXMLImageDataWriter>(path, grid);
    else if (type == "RectilinearGrid")
        writeWith<vtkXMLRectilinearGridWriter>(path, grid);
    else
        writeWith<vtkXMLStructuredGridWriter>(path, grid);
}

TEST(PointsOfGhosts, AreThoseWhoseEveryCellIsOne) {
    std::mt19937 random(7);
    for (const Size& points :
         std::vector<Size>{{4, 3, 5}, {1, 4, 3}, {5, 1, 1}, {3, 3, 1}, {1, 1, 1}, {2, 2, 2}})
        for (const unsigned most : {0u, 5u, 9u, 10u}) {
            std::uint64_t cells = 1;
            for (const std::uint64_t each : points) cells *= std::max<std::uint64_t>(each, 2) - 1;
            std::vector<bool> ghosts;
            for (std::uint64_t i = 0; i < cells; ++i) ghosts.push_back(random() % 10 < most);
            const bool any = std::ranges::find(ghosts, true) != ghosts.end();
            EXPECT_EQ(pointsOfGhosts(ghosts, points),
                      any ? bruteForce(ghosts, points) : std::vector<bool>());
        }
}

TEST(VtkGhosts, PointsOfGhostCellsAloneAreMissing) {
    // Duplicate 1, refined 8 and hidden 32 are ghosts; exterior 16 is shown.
    constexpr std::array<unsigned char, 5> kFlags{1, 8, 32, 16, 0};
    std::mt19937 random(11);
    for (const std::string type : {"ImageData", "RectilinearGrid", "StructuredGrid"})
        for (const std::array<int, 6>& extent :
             std::vector<std::array<int, 6>>{{0, 4, 0, 3, 0, 2}, {2, 5, -1, 3, 4, 5}}) {
            const Size points = pointsIn(extent);
            std::vector<unsigned char> flags;
            std::vector<bool> ghosts;
            for (std::uint64_t i = 0; i < (points[0] - 1) * (points[1] - 1) * (points[2] - 1);
                 ++i) {
                const bool edge = i < 4 || random() % 2 == 0;
                flags.push_back(edge ? kFlags[random() % 3] : kFlags[3 + random() % 2]);
                ghosts.push_back(edge);
            }
            const auto path = freshFolder() / "grid.vt";
            writeFlagged(path, type, flagged(type, extent, flags));
            const auto reader = open(path);
            const std::size_t p = indexOf(*reader, "p");
            const auto expected = bruteForce(ghosts, points);
            ASSERT_NE(std::ranges::find(expected, true), expected.end());
            EXPECT_EQ(reader->read(p, 0).missing, expected) << type;
            EXPECT_EQ(reader->read(indexOf(*reader, "c"), 0).missing, ghosts) << type;
            EXPECT_EQ(reader->variables()[p].missing, "ghost and blanked, by vtkGhostType");
        }
}

// Cell by cell they are the same as along indices.
TEST(VtkGhosts, PointsOfGhostCellsAloneAreMissingOfListedCells) {
    std::mt19937 random(13);
    const std::array<int, 6> extent{0, 4, 0, 3, 0, 2};
    std::vector<unsigned char> flags;
    std::vector<bool> ghosts;
    for (int i = 0; i < 4 * 3 * 2; ++i) {
        ghosts.push_back(i < 6 || random() % 2 == 0);
        flags.push_back(ghosts.back() ? 1 : 0);
    }
    const auto along = flagged("StructuredGrid", extent, flags);
    const vtkNew<vtkUnstructuredGrid> listed;
    const vtkNew<vtkPoints> points;
    for (vtkIdType i = 0; i < along->GetNumberOfPoints(); ++i)
        points->InsertNextPoint(along->GetPoint(i));
    listed->SetPoints(points);
    for (vtkIdType i = 0; i < along->GetNumberOfCells(); ++i) {
        const vtkNew<vtkIdList> corners;
        along->GetCellPoints(i, corners);
        listed->InsertNextCell(along->GetCellType(i), corners);
    }
    listed->GetPointData()->ShallowCopy(along->GetPointData());
    listed->GetCellData()->ShallowCopy(along->GetCellData());
    const auto expected = bruteForce(ghosts, pointsIn(extent));
    ASSERT_NE(std::ranges::find(expected, true), expected.end());
    for (const bool isLegacy : {false, true}) {
        const auto path = freshFolder() / (isLegacy ? "cells.vtk" : "cells.vtu");
        if (isLegacy)
            writeWith<vtkUnstructuredGridWriter>(path, listed);
        else
            writeWith<vtkXMLUnstructuredGridWriter>(path, listed);
        const auto reader = open(path);
        const std::size_t p = indexOf(*reader, "p");
        EXPECT_EQ(reader->read(p, 0).missing, expected) << isLegacy;
        EXPECT_EQ(reader->read(indexOf(*reader, "c"), 0).missing, ghosts);
        EXPECT_EQ(reader->variables()[p].missing, "ghost and blanked, by vtkGhostType");
    }
}

TEST(VtkGhosts, OfPointsAndOfCellsAreMissingAlsoInLegacyFiles) {
    const auto path = freshFolder() / "ghosts.vtk";
    writeBytes(
        path,
        "# vtk DataFile Version 3.0\nghosts\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 4 2 1\n"
        "SPACING 1 1 1\nORIGIN 0 0 0\nCELL_DATA 3\nFIELD cells 2\nc 1 3 float\n5 6 7\n"
        "vtkGhostType 1 3 unsigned_char\n1 0 0\nPOINT_DATA 8\nFIELD points 2\np 1 8 float\n"
        "0 1 2 3 4 5 6 7\nvtkGhostType 1 8 unsigned_char\n0 0 0 2 0 0 0 0\n");
    const auto reader = open(path);
    EXPECT_EQ(reader->read(indexOf(*reader, "p"), 0).missing,
              (std::vector<bool>{true, false, false, true, true, false, false, false}));
    EXPECT_EQ(reader->read(indexOf(*reader, "c"), 0).missing,
              (std::vector<bool>{true, false, false}));
}

// Each part has a layer of cells of the other's, and nonsense at the points beyond its own.
TEST(VtkGhosts, WhatPartsHaveOfEachOtherIsTheOthers) {
    const auto folder = freshFolder();
    for (const std::string type : {"ImageData", "RectilinearGrid", "StructuredGrid"}) {
        const std::vector<std::array<int, 6>> extents{{0, 3, 0, 3, 0, 2}, {1, 4, 0, 3, 0, 2}};
        std::string pieces;
        for (std::size_t part = 0; part < 2; ++part) {
            std::vector<unsigned char> flags;
            for (int i = 0; i < 18; ++i) flags.push_back(i % 3 == (part == 0 ? 2 : 0) ? 1 : 0);
            const auto grid = flagged(type, extents[part], flags);
            auto* points = vtkDoubleArray::SafeDownCast(grid->GetPointData()->GetArray("p"));
            for (vtkIdType i = 0; i < points->GetNumberOfTuples(); ++i)
                if (i % 4 == (part == 0 ? 3 : 0)) points->SetValue(i, -77);
            const std::string name = fmt::format("{} {}.vt", type, part);
            writeFlagged(folder / name, type, grid);
            pieces += fmt::format("<Piece Source=\"{}\"/>", name);
        }
        writeBytes(
            folder / "parts.pvt",
            fmt::format("<VTKFile type=\"P{0}\" version=\"0.1\"><P{0} WholeExtent=\"0 4 0 3 0 2\" "
                        "GhostLevel=\"1\">{1}</P{0}></VTKFile>",
                        type, pieces));
        writeGrid(folder / "whole.vt", type, {0, 4, 0, 3, 0, 2});
        for (const std::string name : {"p", "c"})
            EXPECT_EQ(byPlace(folder / "parts.pvt", name), byPlace(folder / "whole.vt", name))
                << type << ' ' << name;
    }
}

// As of cells that are listed.
TEST(VtkGhosts, OfBlocksTakeNoSpace) {
    const auto folder = freshFolder();
    std::vector<unsigned char> flags(4, 0);
    flags[3] = 1;
    writeFlagged(folder / "a.vti", "ImageData", flagged("ImageData", {0, 4, 0, 1, 0, 1}, flags));
    writeGrid(folder / "b.vti", "ImageData", {3, 6, 0, 1, 0, 1});
    writeBytes(folder / "all.vtm",
               "<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\"><vtkMultiBlockDataSet>"
               "<DataSet index=\"0\" file=\"a.vti\"/><DataSet index=\"1\" file=\"b.vti\"/>"
               "</vtkMultiBlockDataSet></VTKFile>");
    const auto reader = open(folder / "all.vtm");
    const std::size_t p = indexOf(*reader, "p");
    EXPECT_NEAR(tests::volume(*reader->variables()[p].grid->mesh()), 6, 1e-6)
        << "cells of 0.5 x 1 x 2";
    EXPECT_EQ(reader->variables()[p].grid->mesh()->solids()->count(), 6u);
    const Field field = reader->read(p, 0);
    for (std::size_t i = 0; i < field.missing.size(); ++i)
        EXPECT_EQ(field.missing[i], i < 20 && i % 5 == 4) << i;
}

}  // namespace
}  // namespace timeseries::vtk_ghosts
