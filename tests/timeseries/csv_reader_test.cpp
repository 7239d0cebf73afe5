// Tables of scattered points.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/damage.h"
#include "tests/support/files.h"
#include "tests/support/read_variables.h"

namespace timeseries::csv {
namespace {

using namespace tests;
using testing::ElementsAre;
using testing::HasSubstr;
using tests::refusalOf;

std::filesystem::path table(const std::string& text) {
    writeBytes(testFolder() / "table.csv", text);
    return testFolder() / "table.csv";
}

TEST(Csv, ColumnsAreCoordinatesAndVariables) {
    const auto reader =
        open(table("# made by hand\nid,X [m],y [ m ],z,T (K),name\n"
                   "1,0,0,0,300.5,a\n2,1,0,0,+1e3,b\n3,0,2,0,,c\n"
                   "4,0,0,-3,-inf,\"d, e\"\n"));
    EXPECT_EQ(reader->format(), "CSV");
    EXPECT_THAT(namesOf(*reader), ElementsAre("id", "T"));
    const Variable& heat = reader->variables()[1];
    EXPECT_EQ(heat.units, "K");
    EXPECT_EQ(heat.type, ValueType::F64);
    EXPECT_EQ(heat.grid->axes()[0].units, "m");
    const auto values = valuesOf<double>(*reader, "T");
    ASSERT_EQ(values.size(), 4u);
    EXPECT_EQ(values[0], 300.5);
    EXPECT_EQ(values[1], 1000);
    EXPECT_TRUE(std::isnan(values[2]));
    EXPECT_EQ(values[3], -HUGE_VAL);
    EXPECT_EQ(heat.grid->position(2), glm::dvec3(0, 2, 0));
    EXPECT_EQ(heat.grid->position(3), glm::dvec3(0, 0, -3));
}

// By its name a variable is chosen, and found in other files.
TEST(Csv, ColumnsOfOneNameAreToldApart) {
    const std::string head = "x,y,z,T,T (2),T\n";
    writeBytes(freshFolder() / "t1.csv", head + "0,0,0,1,2,3\n1,0,0,1,2,4\n");
    writeBytes(testFolder() / "t2.csv", head + "0,0,0,5,6,7\n1,0,0,5,6,8\n");
    const std::vector paths{testFolder() / "t1.csv", testFolder() / "t2.csv"};
    const auto reader = openReader(paths);
    ASSERT_THAT(namesOf(*reader), ElementsAre("T", "T (2)", "T (3)"));
    for (std::size_t step = 0; step < 2; ++step)
        for (std::size_t v = 0; v < 3; ++v)
            EXPECT_EQ(std::get<std::vector<double>>(reader->read(v, step).values)[0],
                      1 + double(v) + 4 * double(step));
}

TEST(Csv, NumbersBeyondDoubleAreInfiniteOrZero) {
    const auto reader = open(table("x,y,z,T\n0,0,0,1e400\n1,0,0,-1e400\n0,1,0,1e-400\n0,0,1,5\n"));
    EXPECT_THAT(valuesOf<double>(*reader, "T"), ElementsAre(HUGE_VAL, -HUGE_VAL, 0, 5));
}

// As several programs write them.
TEST(Csv, SeparatorsAndTitlesAreThoseOfManyPrograms) {
    for (const std::string text : {
             "T,Points:0,Points:1,Points:2\r\n1,5,6,7\r\n2,8,9,1\r\n",
             "x;y;z;T\n5;6;7;1\n8;9;1;2",
             "x\ty\tz\tT\n5\t6\t7\t1\n8\t9\t1\t2\n",
             "  x   y  z T\n 5 6  7  1\n8 9 1 2  \n",
             "\xEF\xBB\xBF\"x-coordinate\",    \"y-coordinate\", z-coordinate, T\n5, 6, 7, 1\n"
             "8, 9, 1, 2\n",
             "# of run 7\n# x y z T\n5 6 7 1\n8 9 1 2\n",
             "#x,y,z,T\r\n5,6,7,1\r\n8,9,1,2\r\n",
             "# 1 2 3\nx,y,z,T\n5,6,7,1\n8,9,1,2\n",
         }) {
        const auto reader = open(table(text));
        EXPECT_THAT(namesOf(*reader), ElementsAre("T")) << text;
        EXPECT_THAT(valuesOf<double>(*reader, "T"), ElementsAre(1, 2)) << text;
        EXPECT_LT(glm::distance(reader->variables()[0].grid->position(0), glm::dvec3(5, 6, 7)),
                  1e-5)
            << text;
    }
    const auto gaps = open(table("x,y,T,U\n0,1,NA,4\n1,2,5,n/a\n2,1,null,6\n"));
    EXPECT_THAT(valuesOf<double>(*gaps, "T"), ElementsAre(testing::IsNan(), 5, testing::IsNan()));
    EXPECT_THAT(valuesOf<double>(*gaps, "U"), ElementsAre(4, testing::IsNan(), 6));
    // Without heights; an index without a title, as pandas writes it.
    const auto flat = open(table(",x,y,T\n0,1,1,4\n1,2,1,5\n2,1,2,6\n"));
    EXPECT_THAT(namesOf(*flat), ElementsAre("column 1", "T"));
    EXPECT_EQ(flat->variables()[0].grid->position(1), glm::dvec3(2, 1, 0));
}

TEST(Csv, AFileIsASeriesOfOneStepAndSeveralAreOneOfMore) {
    std::vector<std::filesystem::path> paths;
    for (int i = 0; i < 3; ++i) {
        paths.push_back(testFolder() / ("points_" + std::to_string(i) + ".csv"));
        std::string text = "x,y,z,T\n";
        for (int n = 0; n < 50; ++n)
            text += std::to_string(n % 5 + i) + "," + std::to_string(n / 5) + ",0," +
                    std::to_string(100 * i + n) + "\n";
        writeBytes(paths.back(), text);
    }
    const auto reader = openReader(paths);
    ASSERT_EQ(reader->variables()[0].time->points.size(), 3u);
    EXPECT_EQ(valuesOf<double>(*reader, "T", 2)[7], 207);
    EXPECT_LT(glm::distance(reader->read(0, 2).grid->position(0), glm::dvec3(2, 0, 0)), 1e-5);
}

TEST(Csv, WhatIsWrongIsToldWithItsRow) {
    const std::string kNoTable = "expected a table whose first line names columns x and y";
    for (const auto& [text, told] : std::vector<std::pair<std::string, std::string>>{
             {"x,y,z,T\n1,2,3,4\n1,2,3\n", "row 3: expected 4 numbers, found 3"},
             {"x,y,z,T\n1,2,3,4\n1,2,3,hot\n", "row 3: expected a number in column T, found 'hot'"},
             {"x,y,z,T\nnan,2,3,4\n", "expected points that take space"},
             {"x,y,z\n1,2,3\n", kNoTable},
             {"x,z,T\n1,2,3\n", kNoTable},
             {"x,y,z,T\n", kNoTable},
             {"x,y,z,T\none,2,3,4\n", "row 2: expected a number in column x, found 'one'"},
             {"x;y;z;T\n1.0;2.0;3.0;0,5\n", "row 2: expected a number in column T, found '0,5'"},
             {"x,y,z,T\n1,2,3\n1,2,3\n", "row 2: expected 4 numbers, found 3"},
             {"some words, and more\nx,y,z,T\n1,2,3,4\n", kNoTable},
         })
        EXPECT_THAT(refusalOf(table(text)), HasSubstr(told)) << text;
}

// Neighbours there are one double.
TEST(Csv, WholeNumbersBeyondDoublesAreThemselves) {
    const auto reader =
        openReader(std::array{table("x,y,z,id,key,half\n0,0,0,9007199254740993,1,1\n"
                                    "1,0,0,-9007199254740992,NA,2\n"
                                    "0,1,0,3,18446744073709551615,0.5\n"
                                    "0,0,1,NA,18446744073709551614,9007199254740993\n")});
    EXPECT_THAT(valuesOf<std::int64_t>(*reader, "id"),
                ElementsAre(9007199254740993, -9007199254740992, 3, 0));
    EXPECT_THAT(reader->read(0, 0).missing, ElementsAre(false, false, false, true));
    EXPECT_THAT(valuesOf<std::uint64_t>(*reader, "key"),
                ElementsAre(1u, 0u, 18446744073709551615u, 18446744073709551614u));
    EXPECT_EQ(valuesOf<double>(*reader, "half")[3], 9007199254740992.0) << "not all are whole";
}

TEST(Csv, LinesWithoutRowsMayStandAnywhere) {
    const auto reader =
        openReader(std::array{table("x,y,z,T\n\n\r\n0,0,0,1\n1,0,0,2\n\n0,1,0,3\n0,0,1,4\n\n")});
    EXPECT_THAT(valuesOf<double>(*reader, "T"), ElementsAre(1, 2, 3, 4));
}

// Also numbers of many digits, quotes, and what is no text.
TEST(Csv, FilesCutOrDamagedAnywhereAreReadOrRefused) {
    const auto path =
        table("\"x\";y;z;T [K]\n0;0;0;1\n1;0;0;2.5e3\n0;1;0;-3\n0;0;1;nan\n1;1;1;1e400\n");
    damageInRounds(path, path);
    // The sanitizer copies a field for every few characters by which it grows.
    constexpr std::size_t kLong = tests::kSanitized ? 1 << 16 : 1 << 20;
    for (const std::string& text :
         {std::string("x,y,z,T\n0,0,0,1\n1,0,0,\"2"), std::string("x,y\n") + std::string(9999, ','),
          "x,y,z,T\n0,0,0," + std::string(kLong, '9') + "\n1,1,1,1\n",
          std::string("x,y,z,T\n0,0,0,1\n\0\0,1,1,1\n", 25), std::string(kLong, '"')})
        isRefusedInOneSentence(table(text));
}

}  // namespace
}  // namespace timeseries::csv
