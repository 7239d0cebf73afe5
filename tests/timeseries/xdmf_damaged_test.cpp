// XDMF files that say what is not there, what is not read, or what would take forever.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/array_builder.h"
#include "tests/support/hdf_file.h"
#include "tests/support/read_variables.h"
#include "tests/support/xdmf_text.h"

namespace timeseries::xdmf_damaged {
namespace {

using namespace tests;
using namespace tests::xdmf;
using testing::HasSubstr;
using tests::refusalOf;

// One that is not read costs only itself.
TEST(DamagedXdmf, AnAttributeThatIsNotReadIsTold) {
    const auto reader = open(written(grid(
        kImage + attribute("p", "Node", item("24", numbersTo(24))) +
        attribute("edges", "Edge", item("24", numbersTo(24))) +
        attribute("few", "Node", item("7", numbersTo(7))) +
        attribute("sum", "Node",
                  "<DataItem ItemType=\"Function\" Function=\"$0 + 1\" Dimensions=\"24\"/>"))));
    EXPECT_EQ(reader->variables().size(), 1u);
    ASSERT_EQ(reader->damaged().size(), 3u);
    EXPECT_THAT(reader->damaged()[0].why, HasSubstr("at edge, which is not read"));
    EXPECT_THAT(reader->damaged()[1].why, HasSubstr("for each of 24 points, found 7"));
    EXPECT_THAT(reader->damaged()[2].why, HasSubstr("ItemType Function, which is not read"));
}

TEST(DamagedXdmf, GridsThatHaveThemselvesAreRefused) {
    EXPECT_THAT(refusalOf(written("<Grid GridType=\"Collection\" CollectionType=\"Spatial\">"
                                  "<xi:include xpointer=\"xpointer(//Grid)\"/></Grid>")),
                HasSubstr("expected at most 32 nested grids"));
}

TEST(DamagedXdmf, WhatIsWrongIsToldWithItsLine) {
    HdfFile data("data.h5");
    data.put("a", ramp<float>(10));
    data.close();
    const std::string values = attribute("p", "Node", item("24", numbersTo(24)));
    const auto with = [&](const std::string& of) {
        return grid(kImage + attribute("p", "Node", of));
    };
    const auto cells = [&](const std::string& topology, const std::string& places) {
        return grid(topology + "<Geometry>" + places + "</Geometry>" +
                    attribute("p", "Node", item("3", "1 2 3")));
    };
    const std::string triangle = item("3 3", "0 0 0 1 0 0 0 1 0");
    for (const auto& [domain, told] : std::vector<std::pair<std::string, std::string>>{
             {"", "expected a Grid with an Attribute"},
             {"<Grid>", "expected well-formed XML"},
             {grid(kImage), "expected a Grid with an Attribute"},
             {grid(values), "line 4: expected a Topology in a Grid"},
             {with(item("24", "1 2 x " + numbersTo(21))),
              "expected a number of float32, found 'x'"},
             {with(item("24", "1 2")), "expected 24 numbers, found 2"},
             {with(item("-4", "1 2")), "expected lengths, found '-4'"},
             {with(item("9999999 9999999 9999999", "1")), "expected fewer than 2^40 values"},
             {with(item("24", "1", "NumberType=\"Complex\"")), "numbers of a type that there is"},
             {with(item("24", "1", "Format=\"GDAL\"")), "expected the Format HDF, Binary or XML"},
             {with(inHdf("24", "b")), "expected the array 'b' of numbers in "},
             {with(inHdf("24", "a")), "expected the Dimensions that a has in "},
             {with(item("24", "none.h5:/a", "Format=\"HDF\"")), "none.h5: "},
             {with(item("24", "nothing", "Format=\"HDF\"")), "expected an array as file.h5:/path"},
             {with(item("24", "file.xdmf:/a", "Format=\"HDF\"")), "file.xdmf: "},
             {with(item("24", "data.h5", "Format=\"Binary\" Seek=\"99999999\"")),
              "expected 24 values of 4 bytes from byte 99999999 on"},
             {with(item("24", "data.h5", "Format=\"Binary\" Compression=\"Zlib\"")),
              "found Compression Zlib"},
             {with(slab("0 0 0 0 1 1 1 1 1 2 3 5", item("1 2 3 4", numbersTo(24)), "24")),
              "expected a part of 4 values along dimension 3"},
             {with(slab("0 0 0 0 1 1 0 1 1 2 3 4", item("1 2 3 4", numbersTo(24)), "24")),
              "stride 0"},
             {grid("<Topology TopologyType=\"3DCoRectMesh\" Dimensions=\"2 3\"/><Geometry/>" +
                   values),
              "expected 3 Dimensions of a grid"},
             {grid("<Topology TopologyType=\"3DCoRectMesh\" Dimensions=\"2048 2048 2048\"/>"
                   "<Geometry/>" +
                   values),
              "expected 3 Dimensions of a grid"},
             {grid("<Topology TopologyType=\"3DCoRectMesh\" Dimensions=\"2 3 4\"/>"
                   "<Geometry GeometryType=\"ORIGIN_DXDYDZ\">" +
                   item("3", "0 0 0") + item("3", "1 0 1") + "</Geometry>" + values),
              "expected cells that take space"},
             {grid("<Topology TopologyType=\"4DMesh\" Dimensions=\"2\"/><Geometry/>" + values),
              "expected a TopologyType that is read"},
             {cells("<Topology TopologyType=\"Blob\"/>", triangle),
              "expected a TopologyType that is read, found 'blob'"},
             {cells("<Topology TopologyType=\"Triangle\">" + item("4", "0 1 2 0") + "</Topology>",
                    triangle),
              "expected 3 corners of each cell, found 4 in all"},
             {cells("<Topology TopologyType=\"Triangle\">" + item("3", "0 1 3") + "</Topology>",
                    triangle),
              "expected cells of points that there are"},
             {cells("<Topology TopologyType=\"Triangle\">" + item("3", "0 1 -2") + "</Topology>",
                    triangle),
              "expected cells of points that there are"},
             {cells("<Topology TopologyType=\"Mixed\">" + item("3", "77 1 2") + "</Topology>",
                    triangle),
              "expected the number of a shape that is read, found 77"},
             {cells("<Topology TopologyType=\"Mixed\">" + item("3", "3 9 2") + "</Topology>",
                    triangle),
              "expected 9 corners from number 2 on, found 1"},
             {cells("<Topology TopologyType=\"Triangle\">" + item("3", "0 1 2") + "</Topology>",
                    item("2", "0 0")),
              "expected 3 numbers for each of as many points"},
             {grid("<Topology Reference=\"/Xdmf/Domain/None\"/>" + values), "found none"},
             {grid("<Topology Reference=\"count(//*)\"/>" + values),
              "expected the path of an element"},
             {grid("<Topology Reference=\"/Xdmf/Domain/Grid/Topology\"/>" + values),
              "expected references that end"},
             {grid("<xi:include href=\"other.xdmf\"/>" + values), "includes 'other.xdmf'"},
             {inTime(grid("<Time Value=\"soon\"/>" + kImage + values)), "expected a time"},
             {inTime(inTime(grid(kImage + values))), "collections in space, found Collection"},
             {inTime(""), "expected a Grid with an Attribute"},
             {grid(kImage + values) + grid(kImage + values), "expected one structured grid a step"},
         }) {
        std::string refusal;
        try {
            open(written(domain))->read(0, 0);
        } catch (const FileError& error) {
            refusal = error.what();
        }
        EXPECT_THAT(refusal, HasSubstr("file.xdmf: ")) << domain;
        EXPECT_THAT(refusal, HasSubstr(told)) << domain;
    }
}

// Also where the library cites the file, in lines of its own.
TEST(DamagedXdmf, ASentenceIsOneLine) {
    for (const std::string& domain :
         {std::string("<Grid\xFF>"), "<Grid Name=\"a\nb\"><Topology Reference=\"&#10;\"/>" +
                                         attribute("p", "Node", item("1", "1")) + "</Grid>"}) {
        const std::string refusal = refusalOf(written(domain));
        EXPECT_THAT(refusal, HasSubstr("expected"));
        EXPECT_EQ(refusal.find('\n'), refusal.npos) << refusal;
    }
}

// Steps are only read when they are asked for.
TEST(DamagedXdmf, AStepThatIsNotLikeTheFirstIsTold) {
    const auto image = [](const std::string& of) {
        return grid(kImage + attribute("p", "Node", of));
    };
    const std::string good = image(item("24", numbersTo(24)));
    for (const auto& [second, told] : std::vector<std::pair<std::string, std::string>>{
             {image(item("24", numbersTo(24), "Precision=\"8\"")),
              "expected 24 numbers of float32, found 24 of float64"},
             {grid(kImage), "expected the Attribute 'p' in each grid"},
             {image(item("23", numbersTo(23))), "expected 24 numbers of float32, found 23"}}) {
        const auto reader = open(written(inTime(good + second)));
        EXPECT_EQ(valuesOf<float>(*reader, "p").size(), 24u);
        try {
            reader->read(0, 1);
            ADD_FAILURE() << told;
        } catch (const FileError& error) {
            EXPECT_THAT(error.what(), HasSubstr(told));
        }
    }
}

// Other files are opened only as arrays.
TEST(DamagedXdmf, EntitiesOfOtherFilesAreNotRead) {
    writeBytes(testFolder() / "numbers.txt", numbersTo(24));
    const auto path = written(grid(kImage + attribute("p", "Node", item("24", "&numbers;"))),
                              "<!DOCTYPE Xdmf [ <!ENTITY numbers SYSTEM \"" +
                                  (testFolder() / "numbers.txt").string() + "\"> ]>\n");
    try {
        open(path)->read(0, 0);
        ADD_FAILURE();
    } catch (const FileError& error) {
        EXPECT_THAT(error.what(), HasSubstr("expected 24 numbers, found 0"));
    }
}

// Entities that grow tenfold each, paths that look at everything for everything.
TEST(DamagedXdmf, WhatWouldTakeForeverIsRefused) {
    std::string entities = "<!DOCTYPE Xdmf [ <!ENTITY e0 \"0123456789\">";
    for (int i = 1; i < 12; ++i) {
        const std::string inner = "&e" + std::to_string(i - 1) + ";";
        entities += "<!ENTITY e" + std::to_string(i) + " \"";
        for (int n = 0; n < 10; ++n) entities += inner;
        entities += "\">";
    }
    EXPECT_THAT(refusalOf(written(grid(kImage + attribute("p", "Node", item("24", "&e11;"))),
                                  entities + "]>\n")),
                HasSubstr("expected well-formed XML"));
    std::string many;
    for (int i = 0; i < 3000; ++i) many += "<Information/>";
    EXPECT_THAT(
        refusalOf(written(many + grid("<Topology Reference=\"//*[//*[//*[//*[//None]]]]\"/>"))),
        HasSubstr("expected a Grid with an Attribute"));
    EXPECT_THAT(
        refusalOf(written(many + grid("<Topology Reference=\"//*[count(//*[count(//*[count(//*) = "
                                      "7]) = 7]) = 7]\"/>" +
                                      attribute("p", "Node", item("24", numbersTo(24)))))),
        HasSubstr("expected the path of an element"));
}

}  // namespace
}  // namespace timeseries::xdmf_damaged
