// VTKHDF files: their cells, parts and steps. netCDF writes HDF5 that has the format's groups.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "tests/support/array_builder.h"
#include "tests/support/hdf_file.h"
#include "tests/support/kept_steps.h"
#include "tests/support/netcdf_builder.h"
#include "tests/support/read_variables.h"
#include "tests/support/shared_data.h"
#include "tests/support/unstructured.h"
#include "timeseries/grid/cell_types.h"

namespace timeseries {
namespace {

using tests::indexOf;
using tests::valuesOf;
using namespace tests;
using testing::ElementsAre;
using testing::HasSubstr;
using Numbers = std::vector<std::int64_t>;

// A row of unit cubes from x on, of 4 (count + 1) points.
struct Cubes {
    std::vector<double> points;
    Numbers connectivity, offsets{0};
    std::vector<std::uint8_t> types;
    explicit Cubes(double x, int count) {
        for (int i = 0; i <= count; ++i)
            for (int n = 0; n < 4; ++n)
                for (const double c : {x + i, double(n & 1), double(n >> 1)}) points.push_back(c);
        for (int i = 0; i < count; ++i) {
            for (const int n : {0, 4, 5, 1, 2, 6, 7, 3}) connectivity.push_back(4 * i + n);
            offsets.push_back(8 * (i + 1));
            types.push_back(12);
        }
    }
};

template <typename T>
void append(std::vector<T>& to, const std::vector<T>& more) {
    to.insert(to.end(), more.begin(), more.end());
}

// Parts one behind the other, as the file has them.
struct Parts {
    std::vector<double> points;
    Numbers connectivity, offsets, counts, cells, ids;
    std::vector<std::uint8_t> types;
    void add(const Cubes& part) {
        counts.push_back(std::int64_t(part.points.size() / 3));
        cells.push_back(std::int64_t(part.types.size()));
        ids.push_back(std::int64_t(part.connectivity.size()));
        append(points, part.points);
        append(connectivity, part.connectivity);
        append(offsets, part.offsets);
        append(types, part.types);
    }
    void put(HdfFile& file) const {
        file.put("VTKHDF/Points", points, 3);
        file.put("VTKHDF/Connectivity", connectivity);
        file.put("VTKHDF/Offsets", offsets);
        file.put("VTKHDF/Types", types);
        file.put("VTKHDF/NumberOfPoints", counts);
        file.put("VTKHDF/NumberOfCells", cells);
        file.put("VTKHDF/NumberOfConnectivityIds", ids);
    }
};

TEST(VtkHdf, PartsOfOneStepStandBehindEachOther) {
    Parts parts;
    parts.add(Cubes(0, 2));
    parts.add(Cubes(2, 3));
    HdfFile file;
    parts.put(file);
    file.put("VTKHDF/PointData/p", ramp<float>(28));
    file.put("VTKHDF/PointData/v", ramp<double>(84), 3);
    file.put("VTKHDF/CellData/c", ramp<std::int32_t>(5));
    file.put("VTKHDF/CellData/vtkGhostType", std::vector<std::uint8_t>{0, 0, 1, 2, 8});
    file.put("VTKHDF/FieldData/TimeValue", std::vector<double>{2.5});
    const auto reader = open(file.close());
    EXPECT_EQ(reader->format(), "VTKHDF unstructured grid");
    EXPECT_EQ(reader->variables()[0].time->points[0].value, 2.5);
    EXPECT_EQ(valuesOf<float>(*reader, "p"), ramp<float>(28));
    EXPECT_EQ(valuesOf<double>(*reader, "v[1]")[4], 13);
    EXPECT_DOUBLE_EQ(valuesOf<double>(*reader, "v magnitude")[1], std::hypot(3, 4, 5));
    EXPECT_EQ(valuesOf<std::int32_t>(*reader, "c"), ramp<std::int32_t>(5));
    EXPECT_EQ(reader->read(indexOf(*reader, "c"), 0).missing,
              (std::vector<bool>{false, false, true, false, true}));
    const Grid& atCells = *reader->variables()[indexOf(*reader, "c")].grid;
    for (std::uint64_t i = 0; i < 5; ++i) {
        EXPECT_NEAR(atCells.position(i).x, double(i) + 0.5, 1e-6);
        EXPECT_NEAR(tests::volume(*atCells.mesh(), i), 1, 1e-6);
    }
    const Grid& atPoints = *reader->variables()[indexOf(*reader, "p")].grid;
    // Those of the last ghost alone are nowhere in particular: at the own cells' end.
    for (std::uint64_t i = 0; i < 28; ++i)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(atPoints.position(i)[c],
                        std::min<double>(parts.points[3 * i + std::size_t(c)], 4), 1e-6);
    EXPECT_NEAR(tests::volume(*atPoints.mesh()), 3, 1e-6) << "of five, two are ghosts";
    EXPECT_EQ(atPoints.mesh()->solids()->count(), 3u);
}

// Two steps, of one part and of two, all else than the first's; the second's values may stand
// first.
TEST(VtkHdf, EachStepHasItsOwnCells) {
    for (const bool turned : {false, true}) {
        Parts parts;
        parts.add(Cubes(0, 2));
        parts.add(Cubes(10, 1));
        parts.add(Cubes(11, 3));
        HdfFile file;
        parts.put(file);
        file.put("VTKHDF/PointData/p", ramp<std::int32_t>(12 + 8 + 16));
        file.put("VTKHDF/CellData/c", ramp<std::int32_t>(6));
        file.put("VTKHDF/Steps/Values", std::vector<float>{0, 0.5f});
        file.put("VTKHDF/Steps/NumberOfParts", Numbers{1, 2});
        file.put("VTKHDF/Steps/PartOffsets", Numbers{0, 1});
        file.put("VTKHDF/Steps/PointOffsets", Numbers{0, 12});
        file.put("VTKHDF/Steps/CellOffsets", Numbers{0, 2});
        file.put("VTKHDF/Steps/ConnectivityIdOffsets", Numbers{0, 16});
        if (turned) {
            file.put("VTKHDF/Steps/PointDataOffsets/p", Numbers{24, 0});
            file.put("VTKHDF/Steps/CellDataOffsets/c", Numbers{4, 0});
        }
        const auto reader = open(file.close());
        ASSERT_EQ(reader->variables()[0].time->points.size(), 2u);
        EXPECT_EQ(reader->variables()[0].time->points[1].value, 0.5);
        const auto first = valuesOf<std::int32_t>(*reader, "p", 0);
        ASSERT_EQ(first.size(), 12u);
        EXPECT_EQ(first[0], turned ? 24 : 0);
        const auto second = valuesOf<std::int32_t>(*reader, "p", 1);
        ASSERT_EQ(second.size(), 24u);
        EXPECT_EQ(second[0], turned ? 0 : 12);
        const int at = turned ? 0 : 2;
        EXPECT_THAT(valuesOf<std::int32_t>(*reader, "c", 1),
                    ElementsAre(at, at + 1, at + 2, at + 3));
        const Field field = reader->read(indexOf(*reader, "c"), 1);
        for (std::uint64_t i = 0; i < 4; ++i) {
            EXPECT_NEAR(field.grid->position(i).x, 10.5 + double(i), 1e-5);
            EXPECT_NEAR(tests::volume(*field.grid->mesh(), i), 1, 1e-5);
        }
    }
}

// A triangle and a square beside each other, or a square and a triangle.
struct Polygons {
    std::vector<float> points;
    Numbers connectivity, offsets;
    void add(bool triangleFirst) {
        append(offsets, triangleFirst ? Numbers{0, 3, 7} : Numbers{0, 4, 7});
        append(connectivity,
               triangleFirst ? Numbers{0, 1, 2, 1, 3, 4, 2} : Numbers{0, 1, 3, 2, 1, 4, 3});
        append(points, triangleFirst
                           ? std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0, 2, 1, 0}
                           : std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 2, 0, 0});
    }
};

// Four steps of polygons with these offsets; `blocks` of cells are in the file.
std::unique_ptr<Reader> fourSteps(const std::vector<bool>& points, const std::vector<bool>& blocks,
                                  const Numbers& cellOffsets, const Numbers& idOffsets,
                                  bool tellsParts = true) {
    HdfFile file;
    Polygons places, cells;
    for (const bool each : points) places.add(each);
    for (const bool each : blocks) cells.add(each);
    file.put("VTKHDF/Points", places.points, 3);
    file.put("VTKHDF/NumberOfPoints", Numbers(4, 5));
    for (const std::string name : {"Vertices", "Lines", "Polygons", "Strips"}) {
        const std::string group = "VTKHDF/" + name + "/";
        const bool is = name == "Polygons";
        file.put(group + "Connectivity", is ? cells.connectivity : Numbers{});
        file.put(group + "Offsets", is ? cells.offsets : Numbers{0, 0, 0, 0});
        file.put(group + "NumberOfCells", Numbers(4, is ? 2 : 0));
        file.put(group + "NumberOfConnectivityIds", Numbers(4, is ? 7 : 0));
    }
    const auto fours = [](const Numbers& each) {
        Numbers all;
        for (const std::int64_t n : each) append(all, Numbers{0, 0, n, 0});
        return all;
    };
    file.put("VTKHDF/CellData/c", ramp<std::int32_t>(8));
    file.put("VTKHDF/Steps/Values", std::vector<double>{0, 1, 2, 3});
    if (tellsParts) file.put("VTKHDF/Steps/NumberOfParts", Numbers(4, 1));
    file.put("VTKHDF/Steps/PartOffsets", Numbers{0, 1, 2, 3});
    file.put("VTKHDF/Steps/PointOffsets", Numbers{0, 5, 10, 15});
    file.put("VTKHDF/Steps/CellOffsets", fours(cellOffsets), 4);
    file.put("VTKHDF/Steps/ConnectivityIdOffsets", fours(idOffsets), 4);
    file.put("VTKHDF/Steps/CellDataOffsets/c", Numbers{0, 2, 4, 6});
    return open(file.close());
}

// As VTK reads them: cells of each step, or once for several, which then change.
TEST(VtkHdf, PolygonsOfAStepAreItsOwn) {
    const auto expectAreas = [](Reader& reader, const std::vector<bool>& triangleFirst) {
        for (std::size_t step = 0; step < 4; ++step) {
            const Field field = reader.read(0, step);
            const double ratio =
                tests::volume(*field.grid->mesh(), 0) / tests::volume(*field.grid->mesh(), 1);
            EXPECT_NEAR(ratio, triangleFirst[step] ? 0.5 : 2, 1e-5) << step;
        }
    };
    const std::vector<bool> changes{true, true, true, false};
    for (const bool tellsParts : {true, false})
        expectAreas(*fourSteps(changes, changes, {0, 2, 4, 6}, {0, 7, 14, 21}, tellsParts),
                    changes);
    expectAreas(*fourSteps(changes, {true, false}, {0, 0, 0, 2}, {0, 0, 0, 7}), changes);
}

// Of the places in Offsets where a step begins only the cells before count in one file, in the
// other the cells are written once for all steps.
TEST(VtkHdf, CellsThatDoNotChangeStandOnce) {
    const Cubes cubes(0, 2);
    HdfFile file;
    std::vector<double> points = cubes.points;
    for (const double at : cubes.points) points.push_back(2 * at);
    file.put("VTKHDF/Points", points, 3);
    file.put("VTKHDF/Connectivity", cubes.connectivity);
    file.put("VTKHDF/Offsets", cubes.offsets);
    file.put("VTKHDF/Types", cubes.types);
    file.put("VTKHDF/NumberOfPoints", Numbers{12, 12});
    file.put("VTKHDF/NumberOfCells", Numbers{2, 2});
    file.put("VTKHDF/NumberOfConnectivityIds", Numbers{16, 16});
    file.put("VTKHDF/PointData/p", ramp<double>(24));
    file.put("VTKHDF/Steps/Values", std::vector<double>{0, 1});
    file.put("VTKHDF/Steps/NumberOfParts", Numbers{1, 1});
    file.put("VTKHDF/Steps/PartOffsets", Numbers{0, 1});
    file.put("VTKHDF/Steps/PointOffsets", Numbers{0, 12});
    file.put("VTKHDF/Steps/CellOffsets", Numbers{0, 0});
    file.put("VTKHDF/Steps/ConnectivityIdOffsets", Numbers{0, 0});
    const auto reader = open(file.close());
    const Field second = reader->read(0, 1);
    EXPECT_EQ(std::get<std::vector<double>>(second.values)[0], 12);
    double volume = 0;
    for (std::uint64_t i = 0; i < 12; ++i) volume += tests::volume(*second.grid->mesh(), i);
    EXPECT_NEAR(volume, 16, 1e-4);
}

TEST(VtkHdf, StepsAreKeptWhereNothingMoves) {
    const Cubes cubes(0, 2);
    const auto written = [&](const Numbers& pointsAt) {
        HdfFile file;
        Parts parts;
        parts.add(cubes);
        parts.add(cubes);
        parts.put(file);
        file.put("VTKHDF/PointData/p", ramp<double>(24));
        file.put("VTKHDF/Steps/Values", std::vector<double>{0, 1});
        file.put("VTKHDF/Steps/NumberOfParts", Numbers{1, 1});
        file.put("VTKHDF/Steps/PartOffsets", Numbers{0, 0});
        file.put("VTKHDF/Steps/PointOffsets", pointsAt);
        file.put("VTKHDF/Steps/CellOffsets", Numbers{0, 0});
        file.put("VTKHDF/Steps/ConnectivityIdOffsets", Numbers{0, 0});
        file.put("VTKHDF/Steps/PointDataOffsets/p", Numbers{0, 12});
        return file.close();
    };
    expectKept({written({0, 0})}, 0);
    const auto moving = open(written({0, 12}));
    EXPECT_FALSE(moving->sources(0, 0).files.empty());
    EXPECT_TRUE(moving->sources(0, 1).files.empty());
}

// Squares beside each other and a line, whose values stand in the order of the groups in each part.
TEST(VtkHdf, PolygonsAreSurfaces) {
    HdfFile file;
    file.put("VTKHDF/Points",
             std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0, 2, 1, 0}, 3);
    file.put("VTKHDF/NumberOfPoints", Numbers{6});
    const auto topology = [&](const std::string& name, const Numbers& connectivity,
                              const Numbers& offsets) {
        const std::string group = "VTKHDF/" + name + "/";
        file.put(group + "Connectivity", connectivity);
        file.put(group + "Offsets", offsets);
        file.put(group + "NumberOfCells", Numbers{std::int64_t(offsets.size()) - 1});
        file.put(group + "NumberOfConnectivityIds", Numbers{std::int64_t(connectivity.size())});
    };
    topology("Vertices", {}, {0});
    topology("Lines", {0, 5}, {0, 2});
    topology("Polygons", {0, 1, 2, 3, 1, 4, 5, 2}, {0, 4, 8});
    topology("Strips", {0, 1, 3, 4}, {0, 4});
    file.put("VTKHDF/CellData/c", ramp<std::int32_t>(4));
    const auto reader = open(file.close());
    EXPECT_EQ(reader->format(), "VTKHDF polygons");
    const Grid& grid = *reader->variables()[0].grid;
    EXPECT_EQ(grid.mesh()->flat(), 2u);  // the line, and the strip, which is told
    EXPECT_EQ(cellName(*grid.mesh()->about().typeOf(3), 1), "triangle strip");
    EXPECT_NEAR(grid.position(1).x, 0.5, 1e-6);
    EXPECT_NEAR(grid.position(2).x, 1.5, 1e-6);
    EXPECT_NEAR(tests::volume(*grid.mesh(), 1), 1, 1e-5);
    EXPECT_THAT(valuesOf<std::int32_t>(*reader, "c"), ElementsAre(0, 1, 2, 3));
}

TEST(VtkHdf, NumbersThatDoNotFitAreRefused) {
    const auto told = [](const auto& change) -> std::string {
        Parts parts;
        parts.add(Cubes(0, 2));
        change(parts);
        HdfFile file;
        parts.put(file);
        file.put("VTKHDF/CellData/c", ramp<std::int32_t>(2));
        try {
            const auto reader = open(file.close());
            reader->read(0, 0);
        } catch (const FileError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(told([](Parts&) {}), "");
    EXPECT_THAT(told([](Parts& p) { p.counts = {13}; }),
                HasSubstr("expected 13 rows from row 0 on"));
    EXPECT_THAT(told([](Parts& p) { p.counts = {-1}; }), HasSubstr("expected 0 or more"));
    EXPECT_THAT(told([](Parts& p) { p.cells = {3}; }), HasSubstr("expected 3 cells of part 0"));
    EXPECT_THAT(told([](Parts& p) { p.cells = {std::int64_t{1} << 40}; }), HasSubstr("2^32"));
    EXPECT_THAT(told([](Parts& p) { p.ids = {17}; }), HasSubstr("from 0 to 17 corners"));
    EXPECT_THAT(told([](Parts& p) { p.offsets[1] = 15; }), HasSubstr("expected"));
    EXPECT_THAT(told([](Parts& p) { p.offsets[1] = 99; }), HasSubstr("expected cells of points"));
    EXPECT_THAT(told([](Parts& p) { p.connectivity[3] = 12; }),
                HasSubstr("expected cells of points that there are"));
    EXPECT_THAT(told([](Parts& p) { p.connectivity[3] = -2; }),
                HasSubstr("expected cells of points"));
    EXPECT_THAT(told([](Parts& p) {
                    p.counts = {6, 6};
                }),
                HasSubstr("expected numbers of 2 parts"));
    EXPECT_THAT(told([](Parts& p) { p.types = {12}; }), HasSubstr("expected 2 rows"));
}

TEST(RealVtkHdf, SpheresThatWarpAreSurfacesOfTheirSteps) {
    const auto path = tests::sharedData("grids/warping_spheres.vtkhdf");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no real data at " << path;
    const auto reader = open(path);
    EXPECT_EQ(reader->variables()[0].time->points.size(), 100u);
    for (const std::size_t step : {0u, 50u, 99u}) {
        const Field field = reader->read(0, step);
        EXPECT_EQ(field.grid->count(), 1684u);
        EXPECT_EQ(field.grid->mesh()->flat(), 0u);
    }
}

}  // namespace
}  // namespace timeseries
