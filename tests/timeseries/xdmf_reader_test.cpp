// XDMF files: their grids of every kind, arrays of every kind, and steps. netCDF writes the HDF5.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "tests/support/array_builder.h"
#include "tests/support/hdf_file.h"
#include "tests/support/read_variables.h"
#include "tests/support/unstructured.h"
#include "tests/support/xdmf_text.h"

namespace timeseries::xdmf {
namespace {

using namespace tests;
using namespace tests::xdmf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using tests::refusalOf;

TEST(Xdmf, AnImageLiesWhereItsOriginAndStepsSay) {
    const auto reader =
        open(written(grid(kImage + attribute("p", "Node", item("2 3 4", numbersTo(24))) +
                          attribute("c", "Cell", item("1 2 3", numbersTo(6))))));
    EXPECT_EQ(reader->format(), "XDMF");
    EXPECT_EQ(valuesOf<float>(*reader, "p"), ramp<float>(24));
    EXPECT_EQ(valuesOf<float>(*reader, "c"), ramp<float>(6));
    const Grid& points = *reader->variables()[indexOf(*reader, "p")].grid;
    const Grid& cells = *reader->variables()[indexOf(*reader, "c")].grid;
    EXPECT_THAT(points.size(), ElementsAre(4, 3, 2));
    EXPECT_THAT(cells.size(), ElementsAre(3, 2, 1));
    EXPECT_EQ(points.position(3 + 4 * (2 + 3 * 1)), glm::dvec3(31, 42, 33));
    EXPECT_EQ(cells.position(2 + 3 * 1), glm::dvec3(26, 32, 18));
    EXPECT_TRUE(reader->variables()[0].time->counted);
}

// 24, 25, ...: not what the first one has.
std::string otherNumbers() { return numbersTo(48).substr(numbersTo(24).size()); }
std::string attributeOf(const std::string& values) {
    return attribute("p", "Node", item("2 3 4", values));
}

// Steps have theirs by their names: a second one of one name would have the first one's values.
TEST(Xdmf, ASecondAttributeOfOneNameIsLeftOut) {
    const auto reader =
        open(written(grid(kImage + attributeOf(numbersTo(24)) + attributeOf(otherNumbers()))));
    EXPECT_EQ(reader->variables().size(), 1u);
    EXPECT_EQ(valuesOf<float>(*reader, "p"), ramp<float>(24));
    ASSERT_EQ(reader->damaged().size(), 1u);
    EXPECT_THAT(reader->damaged()[0].why,
                HasSubstr("expected names that differ, found the Attribute 'p' again"));
}

TEST(Xdmf, SeriesOfOneNameAreToldApart) {
    const auto reader = open(written(inTime(grid(kImage + attributeOf(numbersTo(24)))) +
                                     inTime(grid(kImage + attributeOf(otherNumbers())))));
    EXPECT_EQ(valuesOf<float>(*reader, "p"), ramp<float>(24));
    EXPECT_EQ(valuesOf<float>(*reader, "p (2)")[0], 24);
}

// What programs print of numbers that a type does not hold.
TEST(Xdmf, TextBeyondATypesRangeIsInfiniteOrZero) {
    const auto reader =
        open(written(grid("<Topology TopologyType=\"3DCoRectMesh\" Dimensions=\"1 2 2\"/>"
                          "<Geometry GeometryType=\"ORIGIN_DXDYDZ\">" +
                          item("3", "0 0 0") + item("3", "1 1 1") + "</Geometry>" +
                          attribute("p", "Node", item("1 2 2", "1e-60 1e60 -1e60 +2")))));
    EXPECT_THAT(valuesOf<float>(*reader, "p"), ElementsAre(0, HUGE_VALF, -HUGE_VALF, 2));
}

TEST(Xdmf, ARectilinearGridHasTheCoordinatesOfItsAxes) {
    const auto reader = open(
        written(grid("<Topology TopologyType=\"3DRectMesh\" Dimensions=\"1 2 3\"/>"
                     "<Geometry GeometryType=\"VXVYVZ\">" +
                     item("3", "1 2 4") + item("2", "-1 +5.5e0") + item("1", "7") + "</Geometry>" +
                     attribute("p", "Node", item("1 2 3", numbersTo(6), "NumberType=\"Int\"")))));
    EXPECT_EQ(valuesOf<std::int32_t>(*reader, "p"), ramp<std::int32_t>(6));
    EXPECT_EQ(reader->variables()[0].grid->position(5), glm::dvec3(4, 5.5, 7));
}

// Sheared; as one array of places, and as one of each coordinate.
TEST(Xdmf, AStructuredGridLiesWhereItsPlacesSay) {
    std::string together;
    std::array<std::string, 3> apart;
    for (int k = 0; k < 2; ++k)
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 4; ++i) {
                const std::array<double, 3> at{i + 0.5 * j, 2.0 * j, 3.0 * k};
                for (std::size_t c = 0; c < 3; ++c) {
                    together += std::to_string(at[c]) + " ";
                    apart[c] += std::to_string(at[c]) + " ";
                }
            }
    for (const bool isApart : {false, true}) {
        const std::string geometry =
            isApart ? "<Geometry GeometryType=\"X_Y_Z\">" + item("24", apart[0]) +
                          item("24", apart[1]) + item("24", apart[2])
                    : "<Geometry GeometryType=\"XYZ\">" + item("2 3 4 3", together);
        const auto reader = open(
            written(grid("<Topology TopologyType=\"3DSMesh\" Dimensions=\"2 3 4\"/>" + geometry +
                         "</Geometry>" + attribute("p", "Node", item("2 3 4", numbersTo(24))) +
                         attribute("c", "Cell", item("6", numbersTo(6))))));
        const Grid& points = *reader->variables()[indexOf(*reader, "p")].grid;
        EXPECT_EQ(points.position(1 + 4 * 2), glm::dvec3(2, 4, 0));
        const Grid& cells = *reader->variables()[indexOf(*reader, "c")].grid;
        ASSERT_EQ(cells.count(), 6u);
        EXPECT_EQ(cells.position(1), glm::dvec3(1.75, 1, 1.5));
        // One layer, as thick as it is.
        for (std::uint64_t cell = 0; cell < 6; ++cell)
            EXPECT_NEAR(tests::volume(*cells.mesh(), cell), 1 * 2 * 3, 1e-5);
    }
}

// Numbered from 0 or from 1; joined with another grid's.
constexpr const char* kTwoHexahedra =
    "0 0 0  1 0 0  2 0 0  0 1 0  1 1 0  2 1 0  0 0 1  1 0 1  2 0 1  0 1 1  1 1 1  2 1 1";

TEST(Xdmf, CellsOfOneShapeHaveTheirVolumes) {
    for (const int base : {0, 1}) {
        std::string corners;
        for (const int n : {0, 1, 4, 3, 6, 7, 10, 9, 1, 2, 5, 4, 7, 8, 11, 10})
            corners += std::to_string(n + base) + " ";
        const auto reader = open(written(
            grid("<Topology TopologyType=\"Hexahedron\" NumberOfElements=\"2\" BaseOffset=\"" +
                 std::to_string(base) + "\">" + item("2 8", corners, "NumberType=\"Int\"") +
                 "</Topology><Geometry>" + item("12 3", kTwoHexahedra) + "</Geometry>" +
                 attribute("c", "Cell", item("2", "5 7")) +
                 attribute("v", "Node", item("12 3", numbersTo(36))))));
        EXPECT_THAT(valuesOf<float>(*reader, "c"), ElementsAre(5, 7));
        EXPECT_EQ(valuesOf<float>(*reader, "v[2]")[3], 11);
        EXPECT_DOUBLE_EQ(valuesOf<double>(*reader, "v magnitude")[1], std::hypot(3, 4, 5));
        const Mesh& mesh = *reader->variables()[0].grid->mesh();
        EXPECT_NEAR(mesh.position(1).x, 1.5, 1e-6);
        EXPECT_NEAR(volume(mesh, 0), 1, 1e-6);
    }
}

TEST(Xdmf, CellsOfMixedShapesFollowTheNumbersOfTheirShapes) {
    // A hexahedron, the other one as two wedges, and a polyline of three points.
    const auto reader = open(
        written(grid("<Topology TopologyType=\"Mixed\" NumberOfElements=\"4\">" +
                     item("28", "9 0 1 4 3 6 7 10 9  8 1 2 4 7 8 10  8 2 5 4 8 11 10  2 3 0 1 2",
                          "NumberType=\"UInt\" Precision=\"8\"") +
                     "</Topology><Geometry>" + item("12 3", kTwoHexahedra) + "</Geometry>" +
                     attribute("c", "Cell", item("4", "1 2 3 4")))));
    const Mesh& mesh = *reader->variables()[0].grid->mesh();
    ASSERT_EQ(mesh.count(), 4u);
    EXPECT_NEAR(volume(mesh, 0), 1, 1e-6);
    EXPECT_NEAR(volume(mesh, 1), 0.5, 1e-6);
    EXPECT_NEAR(volume(mesh, 2), 0.5, 1e-6);
    EXPECT_EQ(mesh.flat(), 1u);
}

// Tetrahedra of FEniCS: one mesh, which each step includes from where it stands.
TEST(Xdmf, StepsIncludeTheMeshOfAnotherGrid) {
    HdfFile data("data.h5");
    data.put("Mesh/topology", std::vector<std::int64_t>{0, 1, 2, 3}, 4);
    data.put("Mesh/geometry", std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, 3);
    std::string steps;
    for (int i = 0; i < 3; ++i) {
        const std::string name = "f/" + std::to_string(i);
        data.put(name, std::vector<double>{i + 0.0, i + 0.1, i + 0.2, i + 0.3},
                 std::vector<std::size_t>{4, 1});
        steps += grid(
            "<xi:include xpointer=\"xpointer(//Grid[@Name='mesh']/*[self::Topology or "
            "self::Geometry])\"/><Time Value=\"" +
            std::to_string(i * 0.25) + "\"/>" + attribute("f", "Node", inHdf("4 1", name)));
    }
    data.close();
    const auto reader = open(
        written(grid("<Topology TopologyType=\"Tetrahedron\">" + inHdf("1 4", "Mesh/topology") +
                         "</Topology><Geometry GeometryType=\"XYZ\">" +
                         inHdf("4 3", "Mesh/geometry") + "</Geometry>",
                     "Name=\"mesh\"") +
                inTime(steps)));
    ASSERT_EQ(reader->variables().size(), 1u);
    EXPECT_THAT(timesOf(*reader), ElementsAre(0, 0.25, 0.5));
    EXPECT_THAT(valuesOf<double>(*reader, "f", 2), ElementsAre(2.0, 2.1, 2.2, 2.3));
    EXPECT_EQ(reader->read(0, 2).grid, reader->variables()[0].grid);
    EXPECT_NEAR(volume(*reader->variables()[0].grid->mesh()), 1.0 / 6, 1e-6);
}

TEST(Xdmf, StepsMayMoveAndHaveOtherCells) {
    const auto step = [](double x, int cells) {
        std::string points, corners;
        for (int i = 0; i <= cells; ++i)
            for (int n = 0; n < 4; ++n)
                points += std::to_string(x + i) + " " + std::to_string(n & 1) + " " +
                          std::to_string(n >> 1) + " ";
        for (int i = 0; i < cells; ++i)
            for (const int n : {0, 4, 5, 1, 2, 6, 7, 3}) corners += std::to_string(4 * i + n) + " ";
        const std::string count = std::to_string(cells);
        return grid("<Topology TopologyType=\"Hexahedron\">" +
                    item(count + " 8", corners, "NumberType=\"Int\"") + "</Topology><Geometry>" +
                    item(std::to_string(4 * (cells + 1)) + " 3", points) + "</Geometry>" +
                    attribute("c", "Cell", item(count, numbersTo(cells))));
    };
    const auto reader = open(written(inTime(step(0, 2) + step(5, 3))));
    const Field field = reader->read(0, 1);
    ASSERT_EQ(field.grid->count(), 3u);
    for (std::uint64_t i = 0; i < 3; ++i)
        EXPECT_NEAR(field.grid->position(i).x, 5.5 + double(i), 1e-5);
    const auto still = open(written(inTime(step(5, 3) + step(5, 3))));
    EXPECT_EQ(still->read(0, 1).grid, still->variables()[0].grid) << "one that moves nowhere";
}

TEST(Xdmf, PartsOfACollectionInSpaceStandBehindEachOther) {
    const auto part = [](const std::string& z, const std::string& values) {
        return grid("<Topology TopologyType=\"Triangle\">" +
                    item("1 3", "0 1 2", "NumberType=\"Int\"") + "</Topology><Geometry>" +
                    item("3 3", "0 0 " + z + " 1 0 " + z + " 0 1 " + z) + "</Geometry>" +
                    attribute("p", "Node", item("3", values)));
    };
    const auto reader =
        open(written(inTime(grid("<Time Value=\"4\"/>" + part("0", "1 2 3") + part("1", "4 5 6"),
                                 "GridType=\"Collection\" CollectionType=\"Spatial\""))));
    EXPECT_THAT(valuesOf<float>(*reader, "p"), ElementsAre(1, 2, 3, 4, 5, 6));
    EXPECT_THAT(timesOf(*reader), ElementsAre(4));
    EXPECT_EQ(reader->variables()[0].grid->position(3).z, 1);
}

// All steps in one array of four dimensions; and every second value of it.
TEST(Xdmf, AHyperSlabIsAPartOfAnArray) {
    HdfFile data("data.h5");
    data.put("all", ramp<std::int32_t>(3 * 2 * 3 * 4), {3, 2, 3, 4});
    data.close();
    const std::string inFile = inHdf("3 2 3 4", "all"),
                      asText = item("3 2 3 4", numbersTo(72), "NumberType=\"Int\"");
    for (const std::string& whole : {inFile, asText}) {
        std::string steps;
        for (int i = 0; i < 3; ++i)
            steps += grid(kImage + attribute("p", "Node",
                                             slab(std::to_string(i) + " 0 0 0  1 1 1 1  1 2 3 4",
                                                  whole, "2 3 4")));
        const auto reader = open(written(
            inTime("<Time TimeType=\"HyperSlab\">" + item("3", "10 0.5 3") + "</Time>" + steps)));
        EXPECT_THAT(timesOf(*reader), ElementsAre(10, 10.5, 11));
        const auto last = ramp<std::int32_t>(72);
        EXPECT_THAT(valuesOf<std::int32_t>(*reader, "p", 2),
                    testing::ElementsAreArray(last.begin() + 48, last.end()));
        const auto thin = open(
            written(grid("<Topology TopologyType=\"2DCoRectMesh\" Dimensions=\"2 2\"/>"
                         "<Geometry GeometryType=\"ORIGIN_DXDY\">" +
                         item("2", "0 0") + item("2", "1 1") + "</Geometry>" +
                         attribute("p", "Node", slab("1 1 0 1  1 1 2 2  1 1 2 2", whole, "2 2")))));
        EXPECT_THAT(valuesOf<std::int32_t>(*thin, "p"), ElementsAre(37, 39, 45, 47));
    }
}

TEST(Xdmf, BinaryFilesAreOfEitherByteOrder) {
    std::string bytes = "head";
    for (int i = 0; i < 24; ++i) bytes += {'\0', static_cast<char>(i)};
    writeBytes(testFolder() / "data.bin", bytes);
    const auto reader = open(written(grid(
        kImage + attribute("p", "Node",
                           item("2 3 4", "data.bin",
                                "Format=\"Binary\" Endian=\"Big\" Seek=\"4\" NumberType=\"Int\" "
                                "Precision=\"2\"")))));
    EXPECT_EQ(valuesOf<std::int16_t>(*reader, "p"), ramp<std::int16_t>(24));
}

// Entities of the file, references to an element, times as a list.
TEST(Xdmf, WhatStandsElsewhereInTheFileIsFound) {
    const auto reader = open(written(
        grid(kImage + attribute("p", "Node", item("&size;", numbersTo(24))), "Name=\"a\"") +
            inTime("<Time TimeType=\"List\">" + item("2", "3 8") + "</Time>" +
                   grid("<Topology Reference=\"//Grid[@Name='a']/Topology\"/>"
                        "<Geometry Reference=\"XML\">/Xdmf/Domain/Grid[1]/Geometry</Geometry>" +
                        attribute("q", "Node", item("24", numbersTo(24)))) +
                   grid(kImage + attribute("q", "Node", item("24", numbersTo(24))))),
        "<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" [ <!ENTITY size \"2 3 4\"> ]>\n"));
    EXPECT_EQ(valuesOf<float>(*reader, "p"), ramp<float>(24));
    EXPECT_EQ(valuesOf<float>(*reader, "q", 1), ramp<float>(24));
    EXPECT_THAT(reader->variables()[indexOf(*reader, "q")].time->points[1].value, 8);
    EXPECT_EQ(reader->variables()[indexOf(*reader, "p")].time->points.size(), 1u);
}

TEST(Xdmf, WhatStepsDoNotShowIsNoted) {
    const auto with = [](const std::string& name, const std::string& before = "") {
        return grid(before + kImage + attribute("p", "Node", item("24", numbersTo(24))) +
                    (name.empty() ? "" : attribute(name, "Node", item("24", numbersTo(24)))));
    };
    const auto notesOf = [](const std::string& inside) {
        return open(written(inTime(inside)))->variables()[0].notes;
    };
    const std::string range = "<Time TimeType=\"Range\">" + item("2", "5 9") + "</Time>",
                      list = "<Time TimeType=\"List\">" + item("2", "5 9") + "</Time>",
                      alone = "<Time Value=\"4\"/>";
    EXPECT_THAT(notesOf(with("") + with("q") + with("q")),
                Contains("1 of 3 grids have no Attribute 'q'"));
    EXPECT_THAT(notesOf(with("q") + with("")), Contains("1 of 2 grids have no Attribute 'q'"));
    EXPECT_THAT(notesOf(range + with("") + with("")),
                Contains("steps are counted: a Time of TimeType range is not read"));
    EXPECT_THAT(notesOf(list + with("") + with("") + with("")),
                Contains("steps are counted: its Time has 2 for 3 grids"));
    EXPECT_THAT(notesOf(with("", alone) + with("")),
                Contains("steps are counted: 1 of 2 grids have no Time"));
    EXPECT_THAT(notesOf(list + with("") + with("")), IsEmpty());
    EXPECT_THAT(notesOf(with("") + with("")), IsEmpty());
}

// The same arrays may mean other cells.
TEST(Xdmf, StepsOfTheSameArraysMayHaveCellsOfOtherShapes) {
    HdfFile data("data.h5");
    data.put("ids", std::vector<std::int32_t>{0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1});
    data.put("places", std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0}, 3);
    data.close();
    const auto step = [](const std::string& corners, int cells) {
        return grid("<Topology TopologyType=\"Polygon\" NodesPerElement=\"" + corners + "\">" +
                    inHdf("12", "ids") + "</Topology><Geometry>" + inHdf("5 3", "places") +
                    "</Geometry>" +
                    attribute("c", "Cell", item(std::to_string(cells), numbersTo(cells))));
    };
    const auto reader = open(written(inTime(step("3", 4) + step("4", 3))));
    EXPECT_EQ(reader->read(0, 0).grid->count(), 4u);
    EXPECT_EQ(reader->read(0, 1).grid->count(), 3u);
}

}  // namespace
}  // namespace timeseries::xdmf
