// OpenFOAM cases for tests: meshes made of cells that name their corners, files as text and as
// binary lists of each width, packed or not.
#pragma once

#include <algorithm>
#include <array>
#include <cstring>
#include <initializer_list>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "tests/support/array_builder.h"
#include "tests/support/files.h"
#include "tests/support/unstructured.h"

namespace tests::foam {

// How the files of a case are written.
struct Writing {
    bool isBinary = false, isPacked = false;
    int label = 32, scalar = 64;
};

inline void put(const std::filesystem::path& file, const std::string& text,
                const Writing& how = {}) {
    std::filesystem::create_directories(file.parent_path());
    if (how.isPacked)
        writeBytes(file.string() + ".gz", byGzip(text));
    else
        writeBytes(file, text);
}

inline std::string header(const std::string& className, const Writing& how = {}) {
    return fmt::format(
        "/* OpenFOAM */\nFoamFile\n{{\n    version 2.0;\n    format {};\n{}    class {};\n"
        "    object x;\n}}\n// * * //\n\n",
        how.isBinary ? "binary" : "ascii",
        how.isBinary ? fmt::format("    arch \"LSB;label={};scalar={}\";\n", how.label, how.scalar)
                     : "",
        className);
}

inline std::string labels(const std::vector<std::int64_t>& numbers, const Writing& how = {}) {
    if (!how.isBinary)
        return fmt::format("{}\n(\n{}\n)\n", numbers.size(), fmt::join(numbers, "\n"));
    return fmt::format("{}\n({})\n", numbers.size(),
                       how.label == 64
                           ? bytesOf(numbers)
                           : bytesOf(std::vector<std::int32_t>(numbers.begin(), numbers.end())));
}

// Rows of so many numbers, to the last digit.
inline std::string rows(const std::vector<double>& numbers, std::size_t components,
                        const Writing& how = {}) {
    std::string list = fmt::format("{}\n(", numbers.size() / components);
    if (how.isBinary)
        return list +
               (how.scalar == 64 ? bytesOf(numbers)
                                 : bytesOf(std::vector<float>(numbers.begin(), numbers.end()))) +
               ")\n";
    for (std::size_t i = 0; i < numbers.size(); i += components) {
        const std::vector<double> row(numbers.begin() + std::ptrdiff_t(i),
                                      numbers.begin() + std::ptrdiff_t(i + components));
        list += components == 1 ? fmt::format("\n{}", row[0])
                                : fmt::format("\n({})", fmt::join(row, " "));
    }
    return list + "\n)\n";
}

// A mesh as OpenFOAM lists it: faces between two cells come before those of one.
struct FoamLists {
    std::vector<std::vector<std::int64_t>> faces;
    std::vector<std::int64_t> owner, neighbour;
};

using CellFaces = std::vector<std::vector<std::uint32_t>>;

// The faces of a cell, of the types that have them in cell_types.h, and of polyhedra.
inline CellFaces facesOf(const timeseries::UnstructuredGrid& grid, std::size_t cell) {
    CellFaces faces;
    if (grid.types[cell] == timeseries::kPolyhedron) {
        std::size_t at = cell == 0 ? 0 : grid.faceEnds[cell - 1];
        for (std::uint32_t left = grid.faces[at++]; left > 0; --left) {
            const std::uint32_t count = grid.faces[at++];
            faces.emplace_back(grid.faces.begin() + std::ptrdiff_t(at),
                               grid.faces.begin() + std::ptrdiff_t(at + count));
            at += count;
        }
        return faces;
    }
    const auto& type = *timeseries::cellTypeOf(grid.types[cell]);
    const std::size_t first = cell == 0 ? 0 : grid.ends[cell - 1];
    std::size_t at = 0;
    for (const std::uint8_t size : type.faceSizes) {
        faces.emplace_back();
        for (std::uint8_t i = 0; i < size; ++i)
            faces.back().push_back(grid.corners[first + type.faces[at++]]);
    }
    return faces;
}

inline FoamLists listsOf(const timeseries::UnstructuredGrid& grid) {
    struct Between {
        std::vector<std::uint32_t> corners;
        std::vector<std::int64_t> cells;
    };
    std::map<std::vector<std::uint32_t>, Between> all;  // by their points, sorted
    for (std::size_t cell = 0; cell < grid.types.size(); ++cell)
        for (auto& face : facesOf(grid, cell)) {
            auto key = face;
            std::ranges::sort(key);
            Between& between = all[key];
            if (between.cells.empty()) between.corners = face;
            between.cells.push_back(std::int64_t(cell));
        }
    FoamLists lists;
    for (const std::size_t sides : {2u, 1u})
        for (const auto& [key, between] : all) {
            if (between.cells.size() != sides) continue;
            lists.faces.emplace_back(between.corners.begin(), between.corners.end());
            lists.owner.push_back(between.cells[0]);
            if (sides == 2) lists.neighbour.push_back(between.cells[1]);
        }
    return lists;
}

inline void putPoints(const std::filesystem::path& polyMesh, std::span<const glm::dvec3> points,
                      const Writing& how = {}) {
    std::vector<double> numbers;
    for (const glm::dvec3& at : points) numbers.insert(numbers.end(), {at.x, at.y, at.z});
    put(polyMesh / "points", header("vectorField", how) + rows(numbers, 3, how), how);
}

inline void putFaces(const std::filesystem::path& polyMesh, const FoamLists& lists,
                     const Writing& how = {}) {
    std::string faces;
    if (how.isBinary) {
        std::vector<std::int64_t> begins{0}, corners;
        for (const auto& face : lists.faces) {
            corners.insert(corners.end(), face.begin(), face.end());
            begins.push_back(std::int64_t(corners.size()));
        }
        faces = header("faceCompactList", how) + labels(begins, how) + labels(corners, how);
    } else {
        faces = header("faceList") + fmt::format("{}\n(\n", lists.faces.size());
        for (const auto& face : lists.faces)
            faces += fmt::format("{}({})\n", face.size(), fmt::join(face, " "));
        faces += ")\n";
    }
    put(polyMesh / "faces", faces, how);
    put(polyMesh / "owner", header("labelList", how) + labels(lists.owner, how), how);
    put(polyMesh / "neighbour", header("labelList", how) + labels(lists.neighbour, how), how);
}

inline void putMesh(const std::filesystem::path& polyMesh, const timeseries::UnstructuredGrid& grid,
                    const Writing& how = {}) {
    putPoints(polyMesh, grid.points, how);
    putFaces(polyMesh, listsOf(grid), how);
}

// A field's file, whose values inside are what follows the keyword.
inline std::string field(const std::string& className, const std::string& values,
                         const Writing& how = {}, const std::string& dimensions = "0 0 0 0 0 0 0") {
    return header(className, how) + fmt::format("dimensions [{}];\n\ninternalField ", dimensions) +
           values + ";\n\nboundaryField\n{\n    walls { type zeroGradient; }\n}\n";
}

inline std::string scalars(const std::vector<double>& values, const Writing& how = {}) {
    return field("volScalarField", "nonuniform List<scalar> " + rows(values, 1, how), how);
}

// A case with a mesh and nothing else.
inline std::filesystem::path caseOf(const timeseries::UnstructuredGrid& grid,
                                    const Writing& how = {}) {
    const std::filesystem::path folder = freshFolder() / "case";
    put(folder / "system/controlDict", header("dictionary"));
    putMesh(folder / "constant/polyMesh", grid, how);
    return folder;
}

// A row of unit cubes from x on.
inline timeseries::UnstructuredGrid cubes(std::uint32_t count, double x = 0) {
    return bricks({count + 1, 2, 2}, Cut::Hexahedra,
                  [x](double i, double j, double k) { return glm::dvec3(x + i, j, k); });
}

}  // namespace tests::foam
