// Where the samples of an NRRD file lie, and when.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/support/array_builder.h"

namespace timeseries {
namespace {

using namespace tests;
using testing::ElementsAre;
using testing::HasSubstr;

std::string slab(const std::string& lines) {
    return nrrd("type: uchar\ndimension: 3\nsizes: 2 3 4\nencoding: raw\n" + lines,
                bytesOf(ramp<std::uint8_t>(24)));
}

const std::vector<double>& coordinates(const Reader& reader, std::size_t axis) {
    return reader.variables()[0].grid->axes()[axis].coordinates;
}

TEST(Nrrd, SpacingsMinimumsCentersLabelsAndUnitsPlaceAxes) {
    const auto reader =
        openWritten(slab("spacings: 2 -0.5 nan\naxis mins: 10 nan 0\naxis maxs: nan nan 3\n"
                         "centers: node cell node\nlabels: \"lon\" \"lat\" \"depth\"\n"
                         "units: \"km\" \"mm\" \"m\"\nthicknesses: 9 9 9\ncontent: ramp\n"
                         "sample units: K\n"));
    EXPECT_EQ(coordinates(*reader, 0), (std::vector<double>{10, 12}));
    EXPECT_EQ(coordinates(*reader, 1), (std::vector<double>{0, -0.5, -1}));
    EXPECT_EQ(coordinates(*reader, 2), (std::vector<double>{0, 1, 2, 3}));
    const Variable& variable = reader->variables()[0];
    EXPECT_EQ(variable.name, "ramp");
    EXPECT_EQ(variable.units, "K");
    EXPECT_EQ(variable.grid->axes()[0].name, "lon");
    EXPECT_EQ(variable.grid->axes()[0].units, "km");
    EXPECT_EQ(variable.grid->axes()[2].units, "m");
    EXPECT_THAT(variable.notes, ElementsAre());
}

TEST(Nrrd, CellsBeginAtTheirBorder) {
    // Three cells of 4 from 0 to 12 have their middles at 2, 6 and 10; by teem's default so have
    // those of an axis without a center.
    const auto reader =
        openWritten(slab("spacings: 1 nan 4\naxis mins: 0 0 0\naxis maxs: 2 12 16\n"
                         "centers: ??? cell cell\n"));
    EXPECT_EQ(coordinates(*reader, 0), (std::vector<double>{0.5, 1.5}));
    EXPECT_EQ(coordinates(*reader, 1), (std::vector<double>{2, 6, 10}));
    EXPECT_EQ(coordinates(*reader, 2), (std::vector<double>{2, 6, 10, 14}));
}

TEST(Nrrd, AxesWithoutSpacingAreCountedAndSaySo) {
    const auto reader = openWritten(slab("spacings: 1 nan 1\naxis mins: nan nan 1e300\n"));
    const Variable& variable = reader->variables()[0];
    EXPECT_EQ(variable.grid->axes()[1].units, "index");
    EXPECT_EQ(variable.grid->axes()[2].units, "index");
    EXPECT_THAT(
        variable.notes,
        ElementsAre("y is placed by index: the file has no spacing for it",
                    "z is placed by index: a spacing of 1 does not tell its samples apart"));
}

TEST(Nrrd, SeveralAxesWithoutSpacingAreToldTogether) {
    const auto notes = [](const char* spacings) {
        return openWritten(slab(spacings))->variables()[0].notes;
    };
    EXPECT_THAT(notes("spacings: nan 2 nan\n"),
                ElementsAre("x and z are placed by index: the file has no spacing for them"));
    EXPECT_THAT(notes("spacings: nan nan nan\n"),
                ElementsAre("x, y and z are placed by index: the file has no spacing for them"));
}

// The place of every sample as the format defines it: origin + i d0 + j d1 + k d2.
void expectPlaces(const Grid& grid, const glm::dvec3& origin, const glm::dmat3& steps) {
    const auto n = grid.size();
    for (std::uint64_t index = 0; index < grid.count(); ++index) {
        const glm::dvec3 ijk(index % n[0], index / n[0] % n[1], index / n[0] / n[1]);
        EXPECT_LT(glm::distance(grid.position(index), origin + steps * ijk), 1e-9) << index;
        EXPECT_LT(glm::distance(grid.cell(index)[0], steps[0]), 1e-9) << index;
    }
}

TEST(Nrrd, RotatedAndShearedGridsLieWhereTheirDirectionsSay) {
    struct Case {
        const char* directions;
        glm::dmat3 steps;
    };
    for (const Case& c :
         {Case{"(1.6,1.2,0) (-0.6,0.8,0) (0,0,3)", {{1.6, 1.2, 0}, {-0.6, 0.8, 0}, {0, 0, 3}}},
          Case{"(1,0,0) (1,1,0) (0,0,-2)", {{1, 0, 0}, {1, 1, 0}, {0, 0, -2}}},
          Case{"(0,0.5,0.5) (1,0,0) (0,2,-1)", {{0, 0.5, 0.5}, {1, 0, 0}, {0, 2, -1}}}}) {
        const auto reader = openWritten(
            slab(fmt::format("space: RAS\nspace origin: (-10,20,1e6)\nspace units: \"mm\" \"mm\" "
                             "\"mm\"\nspace directions: {}\n",
                             c.directions)));
        EXPECT_EQ(valuesOf<std::uint8_t>(*reader), ramp<std::uint8_t>(24));
        const Grid& grid = *reader->variables()[0].grid;
        expectPlaces(grid, {-10, 20, 1e6}, c.steps);
        EXPECT_EQ(grid.axes()[0].name, "i");
        EXPECT_EQ(grid.axes()[2].units, "mm");
        EXPECT_EQ(grid.axes()[0].coordinates[0], 0) << "lengths from the first sample";
        EXPECT_THAT(grid.frame().names, ElementsAre("right", "anterior", "superior"));
        EXPECT_TRUE(reader->variables()[0].notes.empty());
    }
}

TEST(Nrrd, DirectionsThatPlaceNothingAreDrawnInIndexSpace) {
    for (const char* space :
         {"space directions: (1,0,0) (2,0,0) (0,0,1)", "space directions: (0,0,0) (0,1,0) (0,0,1)",
          "space directions: (1,0,0) (0,1,0) (1,1,1e-9)",
          "space directions: (1e300,1e300,0) (0,1,0) (0,1e308,1e308)",
          "space directions: (0.8,0.6,0) (-0.6,0.8,0) (0,0,1)\nspace units: \"m\" \"mm\" \"m\""}) {
        const auto reader = openWritten(slab(fmt::format("space: RAS\n{}\n", space)));
        EXPECT_EQ(valuesOf<std::uint8_t>(*reader), ramp<std::uint8_t>(24));
        EXPECT_EQ(coordinates(*reader, 1), (std::vector<double>{0, 1, 2}));
        EXPECT_THAT(reader->variables()[0].notes, ElementsAre(HasSubstr("index space"))) << space;
    }
}

TEST(Nrrd, ObliquePlanesAndRowsStandInSpace) {
    const auto plane =
        openWritten(nrrd("type: uchar\ndimension: 2\nsizes: 2 3\nencoding: raw\nspace: RAS\n"
                         "space directions: (0.6,0,0.8) (0,2,0)\nspace origin: (1,2,3)\n",
                         "abcdef"));
    const Grid& grid = *plane->variables()[0].grid;
    EXPECT_LT(glm::distance(grid.position(5), {1.6, 6, 3.8}), 1e-12);
    EXPECT_NEAR(glm::length(grid.cell(0)[2]), 1, 1e-12) << "as thick as its smallest step";
    EXPECT_NEAR(glm::dot(grid.cell(0)[2], grid.cell(0)[0]), 0, 1e-12) << "and upright";
    const auto row =
        openWritten(nrrd("type: uchar\ndimension: 1\nsizes: 6\nencoding: raw\n"
                         "space: RAS\nspace directions: (1,1,1)\n",
                         "abcdef"));
    EXPECT_LT(glm::distance(row->variables()[0].grid->position(5), {5, 5, 5}), 1e-12);
}

TEST(Nrrd, ObliqueStepsOfASeriesShareTheirPlaces) {
    // Time in space, as the fourth coordinate, and as the first axis.
    const auto reader =
        openWritten(nrrd("type: uchar\ndimension: 4\nsizes: 2 2 3 1\nencoding: raw\nspace: RAST\n"
                         "space directions: (0,0,0,5) (0.6,0.8,0,0) (-0.8,0.6,0,0) (0,0,1,0)\n",
                         bytesOf(ramp<std::uint8_t>(12))));
    EXPECT_EQ(reader->variables()[0].time->points.size(), 2u);
    expectPlaces(*reader->variables()[0].grid, {}, {{0.6, 0.8, 0}, {-0.8, 0.6, 0}, {0, 0, 1}});
    EXPECT_EQ(valuesOf<std::uint8_t>(*reader, 1), (std::vector<std::uint8_t>{1, 3, 5, 7, 9, 11}));
    // A direction that leans into time has no place in space.
    const auto leaning =
        openWritten(nrrd("type: uchar\ndimension: 4\nsizes: 2 2 3 1\nencoding: raw\nspace: RAST\n"
                         "space directions: (0,0,0,5) (0.6,0.8,0,1) (-0.8,0.6,0,0) (0,0,1,0)\n",
                         bytesOf(ramp<std::uint8_t>(12))));
    EXPECT_THAT(leaning->variables()[0].notes, ElementsAre(HasSubstr("index space")));
}

TEST(Nrrd, LeftHandedSpacesSayThatThePictureIsMirrored) {
    const auto reader =
        openWritten(slab("space: LAS\nspace directions: (1,0,0) (0,1,1e-12) (0,0,1)\n"
                         "space units: \"mm\" \"mm\" \"mm\"\n"));
    EXPECT_EQ(reader->variables()[0].grid->axes()[1].name, "anterior");
    EXPECT_EQ(reader->variables()[0].grid->axes()[1].units, "mm");
    EXPECT_THAT(reader->variables()[0].notes, ElementsAre(HasSubstr("mirrored")));
    const auto oblique =
        openWritten(slab("space: LAS\nspace directions: (0.8,0.6,0) (-0.6,0.8,0) (0,0,1)\n"));
    EXPECT_THAT(oblique->variables()[0].notes, ElementsAre(HasSubstr("mirrored")));
    expectPlaces(*oblique->variables()[0].grid, {}, {{0.8, 0.6, 0}, {-0.6, 0.8, 0}, {0, 0, 1}});
}

TEST(Nrrd, PlanesAndRowsAreOneLayer) {
    const auto plane = openWritten(
        nrrd("type: uchar\ndimension: 2\nsizes: 2 3\nencoding: raw\nspacings: 1 1\n", "abcdef"));
    EXPECT_THAT(plane->variables()[0].grid->size(), ElementsAre(2, 3, 1));
    const auto row =
        openWritten(nrrd("type: uchar\ndimension: 1\nsizes: 6\nencoding: raw\n", "abcdef"));
    EXPECT_THAT(row->variables()[0].grid->size(), ElementsAre(6, 1, 1));
    const auto movie = openWritten(
        nrrd("type: uchar\ndimension: 3\nsizes: 2 1 3\nencoding: raw\nkinds: space space time\n",
             "abcdef"));
    EXPECT_EQ(movie->variables()[0].time->points.size(), 3u);
    EXPECT_EQ(valuesOf<std::uint8_t>(*movie, 1), (std::vector<std::uint8_t>{'c', 'd'}));
}

TEST(Nrrd, StubsAreNoAxes) {
    const auto reader =
        openWritten(nrrd("type: uchar\ndimension: 5\nsizes: 1 2 3 1 4\nencoding: raw\n"
                         "kinds: scalar space space space time\n",
                         bytesOf(ramp<std::uint8_t>(24))));
    EXPECT_THAT(reader->variables()[0].grid->size(), ElementsAre(2, 3, 1));
    EXPECT_EQ(valuesOf<std::uint8_t>(*reader, 1), (std::vector<std::uint8_t>{6, 7, 8, 9, 10, 11}));
}

std::vector<double> times(const Reader& reader) {
    std::vector<double> values;
    for (const TimePoint& point : reader.variables()[0].time->points) values.push_back(point.value);
    return values;
}

std::string movie(const std::string& lines) {
    return nrrd("type: uchar\ndimension: 4\nsizes: 2 2 2 3\nencoding: raw\n" + lines,
                bytesOf(ramp<std::uint8_t>(24)));
}

TEST(Nrrd, TimesComeFromKeysThatNameTheAxis) {
    const std::string kinds = "kinds: space space space time\nlabels: \"\" \"\" \"\" \"day\"\n";
    for (const char* key : {"days:=2 3.5 30", "Day:=2, 3.5, 30", "times:=2 3.5 30",
                            "axis 3 index values:=2 3.5 30", "MultiVolume.FrameLabels:=2,3.5,30"}) {
        const auto reader = openWritten(movie(kinds + key + "\n"));
        EXPECT_EQ(times(*reader), (std::vector<double>{2, 3.5, 30})) << key;
        EXPECT_EQ(reader->variables()[0].time->name, "day") << key;
    }
    EXPECT_EQ(openWritten(movie(kinds + "days:=2 3 30\n"))->variables()[0].time->units, "days");
}

TEST(Nrrd, KeysThatDoNotNameTimesAreNotTaken) {
    for (const char* key : {"days:=2 3", "days:=2 3 4 5", "days:=2 3 x", "days:=2 3 nan",
                            "weights:=2 3 4", "days:=1 2 3\ntimes:=4 5 6"}) {
        const auto reader = openWritten(movie(fmt::format(
            "kinds: space space space time\nlabels: \"\" \"\" \"\" \"day\"\n{}\n", key)));
        EXPECT_EQ(times(*reader), (std::vector<double>{0, 1, 2})) << key;
        EXPECT_EQ(reader->variables()[0].time->name, "step") << key;
    }
}

TEST(Nrrd, EvenTimesComeFromTheAxis) {
    const auto reader = openWritten(
        movie("kinds: space space space time\nspacings: 1 1 1 0.5\naxis mins: nan nan nan 10\n"
              "units: \"\" \"\" \"\" \"ms\"\n"));
    EXPECT_EQ(times(*reader), (std::vector<double>{10, 10.5, 11}));
    EXPECT_EQ(reader->variables()[0].time->units, "ms");

    const auto dated =
        openWritten(movie("kinds: space space space time\nspacings: 1 1 1 6\n"
                          "units: \"\" \"\" \"\" \"hours since 2000-01-01\"\n"));
    EXPECT_EQ(dated->variables()[0].time->points[2].date, "2000-01-01 12:00:00");

    const auto space =
        openWritten(movie("space: 3D-right-handed-time\n"
                          "space directions: (1,0,0,0) (0,1,0,0) (0,0,1,0) (0,0,0,4)\n"
                          "space origin: (0,0,0,20)\nspace units: \"mm\" \"mm\" \"mm\" \"s\"\n"));
    EXPECT_EQ(times(*space), (std::vector<double>{20, 24, 28}));
    EXPECT_EQ(space->variables()[0].time->units, "s");
}

TEST(Nrrd, TheSlowestOfFourUntoldAxesIsTimeAndANoteSaysSo) {
    const auto reader = openWritten(movie(""));
    EXPECT_EQ(reader->variables()[0].time->points.size(), 3u);
    EXPECT_THAT(reader->variables()[0].notes, testing::Contains(HasSubstr("taken for time")));
    const auto labelled = openWritten(nrrd(
        "type: uchar\ndimension: 4\nsizes: 3 2 2 2\nencoding: raw\nlabels: \"t\" \"\" \"\" \"\"\n",
        bytesOf(ramp<std::uint8_t>(24))));
    EXPECT_EQ(valuesOf<std::uint8_t>(*labelled, 1),
              (std::vector<std::uint8_t>{1, 4, 7, 10, 13, 16, 19, 22}));
}

}  // namespace
}  // namespace timeseries
