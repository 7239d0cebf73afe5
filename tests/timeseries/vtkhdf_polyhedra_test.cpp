// VTKHDF files of polyhedra, whose faces stand in tables: the same cubes as hexahedra would be.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "tests/support/hdf_file.h"
#include "tests/support/read_variables.h"
#include "tests/support/unstructured.h"
#include "timeseries/grid/solid_cells.h"

namespace timeseries::vtkhdf_polyhedra {
namespace {

using namespace tests;
using testing::HasSubstr;
using Numbers = std::vector<std::int64_t>;

// Parts of unit cubes along x, every second one a polyhedron: the walls between them, then the four
// other sides of each, are the faces.
struct Parts {
    std::vector<double> points, x;  // x: the middle of each cube
    Numbers connectivity, offsets, corners, ends, faces, cellEnds;
    std::vector<std::uint8_t> types;
    Numbers nPoints, nCells, nIds, nFaces, nCorners, nToFaces;

    void add(double from, int count) {
        for (int i = 0; i <= count; ++i)
            for (int n = 0; n < 4; ++n)
                for (const double c : {from + i, double(n & 1), double(n >> 1)})
                    points.push_back(c);
        Numbers own, toFaces;  // of this part
        const auto face = [&](int a, int b, int c, int d) { own.insert(own.end(), {a, b, c, d}); };
        for (int i = 0; i <= count; ++i) face(4 * i, 4 * i + 1, 4 * i + 3, 4 * i + 2);
        for (int i = 0; i < count; ++i)
            for (const auto& [a, b] : {std::pair{0, 1}, {1, 3}, {3, 2}, {2, 0}})
                face(4 * i + a, 4 * i + b, 4 * i + 4 + b, 4 * i + 4 + a);
        offsets.push_back(0);
        cellEnds.push_back(0);
        for (int i = 0; i < count; ++i) {
            for (const int n : {0, 4, 5, 1, 2, 6, 7, 3}) connectivity.push_back(4 * i + n);
            offsets.push_back(8 * (i + 1));
            const bool isPolyhedron = types.size() % 2 == 0;
            types.push_back(isPolyhedron ? 42 : 12);
            x.push_back(from + i + 0.5);
            if (isPolyhedron) {
                toFaces.insert(toFaces.end(), {i, i + 1});
                for (int n = 0; n < 4; ++n) toFaces.push_back(count + 1 + 4 * i + n);
            }
            cellEnds.push_back(std::int64_t(toFaces.size()));
        }
        for (std::size_t end = 0; end <= own.size(); end += 4) ends.push_back(std::int64_t(end));
        nPoints.push_back(4 * (count + 1));
        nCells.push_back(count);
        nIds.push_back(8 * count);
        nFaces.push_back(std::int64_t(own.size() / 4));
        nCorners.push_back(std::int64_t(own.size()));
        nToFaces.push_back(std::int64_t(toFaces.size()));
        corners.insert(corners.end(), own.begin(), own.end());
        faces.insert(faces.end(), toFaces.begin(), toFaces.end());
    }
    void put(HdfFile& file) const {
        file.put("VTKHDF/Points", points, 3);
        file.put("VTKHDF/Connectivity", connectivity);
        file.put("VTKHDF/Offsets", offsets);
        file.put("VTKHDF/Types", types);
        file.put("VTKHDF/NumberOfPoints", nPoints);
        file.put("VTKHDF/NumberOfCells", nCells);
        file.put("VTKHDF/NumberOfConnectivityIds", nIds);
        file.put("VTKHDF/FaceConnectivity", corners);
        file.put("VTKHDF/FaceOffsets", ends);
        file.put("VTKHDF/PolyhedronToFaces", faces);
        file.put("VTKHDF/PolyhedronOffsets", cellEnds);
        file.put("VTKHDF/NumberOfFaces", nFaces);
        file.put("VTKHDF/NumberOfFaceConnectivityIds", nCorners);
        file.put("VTKHDF/NumberOfPolyhedronToFaceIds", nToFaces);
        file.put("VTKHDF/CellData/x", x);
        std::vector<double> atPoints;
        for (std::size_t i = 0; i < points.size(); i += 3) atPoints.push_back(points[i]);
        file.put("VTKHDF/PointData/p", atPoints);
    }
};

// So many cubes, each of volume 1 about its x, and the points between them at theirs.
void expectCubes(Reader& reader, std::size_t step, std::size_t cubes) {
    for (const std::string name : {"x", "p"}) {
        const Field field = reader.read(indexOf(reader, name), step);
        const auto& x = std::get<std::vector<double>>(field.values);
        for (std::size_t i = 0; i < x.size(); ++i) {
            EXPECT_NEAR(field.grid->position(i).x, x[i], 1e-6) << name << i;
            if (name == "x") {
                EXPECT_NEAR(tests::volume(*field.grid->mesh(), i), 1, 1e-6) << i;
            }
        }
        EXPECT_NEAR(tests::volume(*field.grid->mesh()), double(cubes), 1e-5) << name;
        if (name == "x") {
            EXPECT_EQ(x.size(), cubes);
        } else {
            EXPECT_EQ(field.grid->mesh()->solids()->count(), cubes);
        }
    }
}

TEST(VtkHdfPolyhedra, OfPartsAreWhatTheirFacesBound) {
    Parts parts;
    parts.add(0, 3);
    parts.add(3, 2);
    HdfFile file;
    parts.put(file);
    const auto reader = open(file.close());
    expectCubes(*reader, 0, 5);
    const TypeCounts kinds =
        countTypes(reader->variables()[indexOf(*reader, "x")].grid->mesh()->about().types);
    EXPECT_EQ(kinds[42], 3u);
    EXPECT_EQ(kinds[12], 2u);
}

// `what` the steps say where the faces of each begin: the truth, nothing, or, as VTK's writer may,
// without the last part of the step before.
TEST(VtkHdfPolyhedra, EachStepHasItsOwnFaces) {
    for (const std::string what : {"truth", "nothing", "less"}) {
        Parts parts;
        parts.add(0, 3);
        parts.add(3, 2);
        parts.add(10, 2);
        parts.add(12, 2);
        HdfFile file;
        parts.put(file);
        file.put("VTKHDF/Steps/Values", std::vector<double>{1, 2});
        file.put("VTKHDF/Steps/NumberOfParts", Numbers{2, 2});
        file.put("VTKHDF/Steps/PartOffsets", Numbers{0, 2});
        file.put("VTKHDF/Steps/PointOffsets", Numbers{0, 28});
        file.put("VTKHDF/Steps/CellOffsets", Numbers{0, 5});
        file.put("VTKHDF/Steps/ConnectivityIdOffsets", Numbers{0, 40});
        const auto offset = [&](const Numbers& counts) {
            return Numbers{0, counts[0] + (what == "less" ? 0 : counts[1])};
        };
        if (what != "nothing") {
            file.put("VTKHDF/Steps/FaceOffsetsOffsets", offset(parts.nFaces));
            file.put("VTKHDF/Steps/FaceConnectivityOffsets", offset(parts.nCorners));
            file.put("VTKHDF/Steps/PolyhedronToFaceIdOffsets", offset(parts.nToFaces));
        }
        const auto reader = open(file.close());
        for (const std::size_t step : {1, 0, 1}) expectCubes(*reader, step, step == 0 ? 5 : 4);
    }
}

// Each step has numbers of its own, of cells that stand there once.
TEST(VtkHdfPolyhedra, OneGridMayServeAllSteps) {
    Parts parts;
    parts.add(0, 3);
    for (Numbers* each : {&parts.nPoints, &parts.nCells, &parts.nIds, &parts.nFaces,
                          &parts.nCorners, &parts.nToFaces})
        each->push_back(each->front());
    HdfFile file;
    parts.put(file);
    file.put("VTKHDF/Steps/Values", std::vector<double>{1, 2});
    file.put("VTKHDF/Steps/NumberOfParts", Numbers{1, 1});
    file.put("VTKHDF/Steps/PartOffsets", Numbers{0, 1});
    for (const char* name :
         {"PointOffsets", "CellOffsets", "ConnectivityIdOffsets", "FaceOffsetsOffsets",
          "FaceConnectivityOffsets", "PolyhedronToFaceIdOffsets", "PointDataOffsets/p",
          "CellDataOffsets/x"})
        file.put(std::string("VTKHDF/Steps/") + name, Numbers{0, 0});
    const auto reader = open(file.close());
    for (const std::size_t step : {0, 1}) expectCubes(*reader, step, 3);
}

TEST(VtkHdfPolyhedra, WhatIsWrongIsNamed) {
    const auto told = [](const std::function<void(Parts&)>& change) {
        Parts parts;
        parts.add(0, 3);
        change(parts);
        HdfFile file;
        parts.put(file);
        return refusalOf(file.close());
    };
    using P = Parts&;
    EXPECT_EQ(told([](P) {}), "");
    EXPECT_THAT(told([](P p) { p.nFaces.push_back(0); }),
                HasSubstr("NumberOfFaces: expected numbers of 1 parts, found 2"));
    EXPECT_THAT(told([](P p) { p.ends.back() = 0; }),
                HasSubstr("'VTKHDF/FaceOffsets': expected 16 faces of part 0"));
    EXPECT_THAT(told([](P p) { p.cellEnds.back() = 99; }),
                HasSubstr("'VTKHDF/PolyhedronOffsets': expected 16 faces of part 0"));
    for (const std::int64_t wrong : {std::int64_t{16}, std::int64_t{-1}})
        EXPECT_THAT(told([&](P p) { p.faces[3] = wrong; }),
                    HasSubstr("a face of cell 0 has point"));
    EXPECT_THAT(told([](P p) { p.corners[2] = 16; }), HasSubstr("a face of cell 0 has point"));
    EXPECT_THAT(told([](P p) { p.nToFaces[0] = 1 << 20; }), HasSubstr("PolyhedronOffsets"));
}

}  // namespace
}  // namespace timeseries::vtkhdf_polyhedra
