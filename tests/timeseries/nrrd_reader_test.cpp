// NRRD files written here by hand: values, axes, times, and where the values lie.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <random>

#include "tests/support/nrrd_builder.h"

namespace timeseries {
namespace {

using namespace tests;
using testing::ElementsAre;
using testing::HasSubstr;
using tests::freshFolder;
using tests::writeBytes;

// Values that a wrong type or byte order would change: the ends of the type's range among them.
template <typename T>
std::vector<T> telling() {
    using Limits = std::numeric_limits<T>;
    return {Limits::lowest(), Limits::max(), Limits::min(), T(1), T(2), T(100), T(7), T(0)};
}

template <typename T>
void expectExact(const std::string& type, ValueType expected) {
    const std::vector<T> values = telling<T>();
    for (const std::endian order : {std::endian::little, std::endian::big})
        for (const char* encoding : {"raw", "gzip", "bzip2"}) {
            const auto reader = openBytes(
                nrrd(fmt::format("type: {}\ndimension: 3\nsizes: 2 2 2\nendian: {}\nencoding: {}\n",
                                 type, order == std::endian::little ? "little" : "big", encoding),
                     encoded(encoding, bytesOf(values, order))));
            EXPECT_EQ(reader->variables()[0].type, expected) << type;
            EXPECT_EQ(valuesOf<T>(*reader), values) << type;
        }
    std::string text;
    for (const T value : values) text += fmt::format("{} ", value);
    const auto reader = openBytes(
        nrrd(fmt::format("type: {}\ndimension: 3\nsizes: 2 2 2\nencoding: ascii\n", type), text));
    EXPECT_EQ(valuesOf<T>(*reader), values) << type << " as text";
}

TEST(Nrrd, EveryTypeInEitherByteOrderAndEveryEncodingIsExact) {
    expectExact<std::int8_t>("int8", ValueType::I8);
    expectExact<std::int8_t>("signed char", ValueType::I8);
    expectExact<std::uint8_t>("uchar", ValueType::U8);
    expectExact<std::int16_t>("short", ValueType::I16);
    expectExact<std::uint16_t>("uint16_t", ValueType::U16);
    expectExact<std::int32_t>("int", ValueType::I32);
    expectExact<std::uint32_t>("unsigned int", ValueType::U32);
    expectExact<std::int64_t>("long long int", ValueType::I64);
    expectExact<std::uint64_t>("uint64", ValueType::U64);
    expectExact<float>("float", ValueType::F32);
    expectExact<double>("double", ValueType::F64);
}

TEST(Nrrd, FilesWhoseArraysHaveNoNameMakeASeries) {
    const std::filesystem::path folder = freshFolder();
    const std::array paths{folder / "run_1.nrrd", folder / "run_2.nrrd"};
    const auto writeWith = [&](const std::string& content, std::size_t file) {
        const auto values = std::vector<std::uint8_t>(8, static_cast<std::uint8_t>(file));
        writeBytes(paths[file],
                   nrrd("type: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n" + content,
                        bytesOf(values)));
    };
    for (const std::size_t file : {0u, 1u}) writeWith("", file);
    const auto reader = openReader(paths);
    EXPECT_EQ(reader->variables()[0].name, "run");
    ASSERT_EQ(reader->variables()[0].time->points.size(), 2u);
    EXPECT_EQ(valuesOf<std::uint8_t>(*reader, 1), std::vector<std::uint8_t>(8, 1));
    writeWith("content: heat\n", 0);
    writeWith("content: pressure\n", 1);
    EXPECT_THROW(openReader(paths), FileError);
}

TEST(Nrrd, TextTakesCommasSignsNansAndInfinities) {
    const auto reader = openBytes(nrrd("type: float\ndimension: 3\nsizes: 5 1 1\nencoding: text\n",
                                       "+1.5, nan\n-inf,,1e3\r\n 1e-50"));
    const auto values = valuesOf<float>(*reader);
    EXPECT_EQ(values[0], 1.5f);
    EXPECT_TRUE(std::isnan(values[1]));
    EXPECT_EQ(values[2], -std::numeric_limits<float>::infinity());
    EXPECT_EQ(values[3], 1000.0f);
    EXPECT_EQ(values[4], 0.0f);
}

// Which place in the file a point (x, y, z, t) has when the axes stand in `order`, by the format:
// the first axis is the fastest.
struct Order {
    std::array<std::size_t, 4> axes;  // of x, y, z, t, fastest first

    std::size_t place(const std::array<std::size_t, 4>& point,
                      const std::array<std::size_t, 4>& sizes) const {
        std::size_t at = 0, stride = 1;
        for (const std::size_t axis : axes) {
            at += point[axis] * stride;
            stride *= sizes[axis];
        }
        return at;
    }
};

TEST(Nrrd, TimeStandsOnAnyAxisAndDirectionsPutSpaceInOrder) {
    constexpr std::array<std::size_t, 4> kSizes{5, 3, 4, 6};  // of x, y, z, t
    constexpr std::array<const char*, 4> kDirections{"(2,0,0)", "(0,-3,0)", "(0,0,0.5)", "none"};
    Order order{{0, 1, 2, 3}};
    do {
        std::string sizes, kinds, directions;
        for (const std::size_t axis : order.axes) {
            sizes += fmt::format(" {}", kSizes[axis]);
            kinds += axis == 3 ? " list" : " domain";
            directions += fmt::format(" {}", kDirections[axis]);
        }
        // Each value is the place it has in the file.
        const auto stored = ramp<std::uint16_t>(5 * 3 * 4 * 6);
        for (const char* encoding : {"raw", "gzip", "bzip2"}) {
            const auto reader = openBytes(
                nrrd(fmt::format("type: ushort\ndimension: 4\nspace dimension: 3\nsizes:{}\n"
                                 "space directions:{}\nkinds:{}\nspace origin: (1,10,100)\n"
                                 "endian: little\nencoding: {}\n",
                                 sizes, directions, kinds, encoding),
                     encoded(encoding, bytesOf(stored))));
            const Variable& variable = reader->variables()[0];
            ASSERT_EQ(variable.time->points.size(), 6u);
            ASSERT_THAT(variable.grid->size(), ElementsAre(5, 3, 4)) << sizes;
            EXPECT_EQ(variable.grid->axes()[0].coordinates, (std::vector<double>{1, 3, 5, 7, 9}));
            EXPECT_EQ(variable.grid->axes()[1].coordinates, (std::vector<double>{10, 7, 4}));
            EXPECT_EQ(variable.grid->axes()[2].coordinates,
                      (std::vector<double>{100, 100.5, 101, 101.5}));
            // Backwards too: what is compressed has to be decoded again.
            for (const std::size_t step : {0u, 3u, 5u, 1u}) {
                const auto values = valuesOf<std::uint16_t>(*reader, step);
                for (std::size_t i = 0; i < values.size(); ++i)
                    ASSERT_EQ(values[i], order.place({i % 5, i / 5 % 3, i / 15, step}, kSizes))
                        << sizes << " step " << step << " point " << i;
            }
        }
    } while (std::ranges::next_permutation(order.axes).found);
}

TEST(Nrrd, StepsLargerThanTheBufferAreReadWhole) {
    // 70,001 values a row: neither a multiple of the buffer's bytes nor of what is turned at once.
    const auto stored = ramp<std::uint32_t>(70001 * 2 * 3);
    const std::string bytes = bytesOf(stored, std::endian::big);
    for (const char* encoding : {"raw", "gzip", "bzip2"})
        for (const char* directions :
             {"(1,0,0) (0,1,0) none", "(0,1,0) (1,0,0) none", "none (1,0,0) (0,0,1)"}) {
            const auto reader = openBytes(
                nrrd(fmt::format("type: uint\ndimension: 3\nspace dimension: 3\nsizes: 70001 2 3\n"
                                 "space directions: {}\nkinds: {}\nendian: big\nencoding: {}\n",
                                 directions,
                                 directions[0] == 'n' ? "time space space" : "space space time",
                                 encoding),
                     encoded(encoding, bytes)));
            const std::size_t step = 2;
            const auto values = valuesOf<std::uint32_t>(*reader, step);
            for (std::size_t i = 0; i < values.size(); ++i) {
                std::size_t at = i + 2 * 70001 * step;  // x, y, then time
                if (directions[1] == '0') at = i / 2 + i % 2 * 70001 + 2 * 70001 * step;  // turned
                if (directions[0] == 'n') at = i * 70001 + step;  // time fastest
                ASSERT_EQ(values[i], at) << directions << ' ' << i;
            }
        }
}

TEST(Nrrd, CompressedStreamsBehindEachOtherAreOne) {
    // Larger than the buffers of packed and of unpacked bytes; the parts end where no row does.
    std::mt19937 random(3);
    std::vector<std::uint8_t> stored(300 * 200 * 5);
    for (std::uint8_t& value : stored) value = static_cast<std::uint8_t>(random());
    const std::string bytes = bytesOf(stored);
    for (const std::string encoding : {"gzip", "bzip2"})
        for (const std::size_t part : {1001u, 65536u, 299999u}) {
            std::string packed = encoded(encoding, "skip");
            for (std::size_t at = 0; at < bytes.size(); at += part)
                packed += encoded(encoding, bytes.substr(at, part));
            for (const char* behind : {"", "BZ", "\n# not packed\n"}) {
                const auto reader =
                    openBytes(nrrd("type: uchar\ndimension: 4\nsizes: 300 20 10 5\nbyte skip: 4\n"
                                   "encoding: " +
                                       encoding + "\n",
                                   packed + behind));
                for (const std::size_t step : {4u, 0u, 3u}) {
                    const auto values = valuesOf<std::uint8_t>(*reader, step);
                    ASSERT_EQ(values.size(), 60000u);
                    EXPECT_TRUE(
                        std::ranges::equal(values, std::span(stored).subspan(step * 60000, 60000)))
                        << encoding << " in parts of " << part << " step " << step;
                }
            }
        }
}

std::string slab(const std::string& lines) {
    return nrrd("type: uchar\ndimension: 3\nsizes: 2 3 4\nencoding: raw\n" + lines,
                bytesOf(ramp<std::uint8_t>(24)));
}

const std::vector<double>& coordinates(const Reader& reader, std::size_t axis) {
    return reader.variables()[0].grid->axes()[axis].coordinates;
}

TEST(Nrrd, SpacingsMinimumsCentersLabelsAndUnitsPlaceAxes) {
    const auto reader =
        openBytes(slab("spacings: 2 -0.5 nan\naxis mins: 10 nan 0\naxis maxs: nan nan 3\n"
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
        openBytes(slab("spacings: 1 nan 4\naxis mins: 0 0 0\naxis maxs: 2 12 16\n"
                       "centers: ??? cell cell\n"));
    EXPECT_EQ(coordinates(*reader, 0), (std::vector<double>{0.5, 1.5}));
    EXPECT_EQ(coordinates(*reader, 1), (std::vector<double>{2, 6, 10}));
    EXPECT_EQ(coordinates(*reader, 2), (std::vector<double>{2, 6, 10, 14}));
}

TEST(Nrrd, AxesWithoutSpacingAreCountedAndSaySo) {
    const auto reader = openBytes(slab("spacings: 1 nan 1\naxis mins: nan nan 1e300\n"));
    const Variable& variable = reader->variables()[0];
    EXPECT_EQ(variable.grid->axes()[1].units, "index");
    EXPECT_EQ(variable.grid->axes()[2].units, "index");
    EXPECT_THAT(
        variable.notes,
        ElementsAre("y is placed by index: the file has no spacing for it",
                    "z is placed by index: a spacing of 1 does not tell its samples apart"));
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
        const auto reader = openBytes(
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
        const auto reader = openBytes(slab(fmt::format("space: RAS\n{}\n", space)));
        EXPECT_EQ(valuesOf<std::uint8_t>(*reader), ramp<std::uint8_t>(24));
        EXPECT_EQ(coordinates(*reader, 1), (std::vector<double>{0, 1, 2}));
        EXPECT_THAT(reader->variables()[0].notes, ElementsAre(HasSubstr("index space"))) << space;
    }
}

TEST(Nrrd, ObliquePlanesAndRowsStandInSpace) {
    const auto plane =
        openBytes(nrrd("type: uchar\ndimension: 2\nsizes: 2 3\nencoding: raw\nspace: RAS\n"
                       "space directions: (0.6,0,0.8) (0,2,0)\nspace origin: (1,2,3)\n",
                       "abcdef"));
    const Grid& grid = *plane->variables()[0].grid;
    EXPECT_LT(glm::distance(grid.position(5), {1.6, 6, 3.8}), 1e-12);
    EXPECT_NEAR(glm::length(grid.cell(0)[2]), 1, 1e-12) << "as thick as its smallest step";
    EXPECT_NEAR(glm::dot(grid.cell(0)[2], grid.cell(0)[0]), 0, 1e-12) << "and upright";
    const auto row =
        openBytes(nrrd("type: uchar\ndimension: 1\nsizes: 6\nencoding: raw\n"
                       "space: RAS\nspace directions: (1,1,1)\n",
                       "abcdef"));
    EXPECT_LT(glm::distance(row->variables()[0].grid->position(5), {5, 5, 5}), 1e-12);
}

TEST(Nrrd, ObliqueStepsOfASeriesShareTheirPlaces) {
    // Time in space, as the fourth coordinate, and as the first axis.
    const auto reader =
        openBytes(nrrd("type: uchar\ndimension: 4\nsizes: 2 2 3 1\nencoding: raw\nspace: RAST\n"
                       "space directions: (0,0,0,5) (0.6,0.8,0,0) (-0.8,0.6,0,0) (0,0,1,0)\n",
                       bytesOf(ramp<std::uint8_t>(12))));
    EXPECT_EQ(reader->variables()[0].time->points.size(), 2u);
    expectPlaces(*reader->variables()[0].grid, {}, {{0.6, 0.8, 0}, {-0.8, 0.6, 0}, {0, 0, 1}});
    EXPECT_EQ(valuesOf<std::uint8_t>(*reader, 1), (std::vector<std::uint8_t>{1, 3, 5, 7, 9, 11}));
    // A direction that leans into time has no place in space.
    const auto leaning =
        openBytes(nrrd("type: uchar\ndimension: 4\nsizes: 2 2 3 1\nencoding: raw\nspace: RAST\n"
                       "space directions: (0,0,0,5) (0.6,0.8,0,1) (-0.8,0.6,0,0) (0,0,1,0)\n",
                       bytesOf(ramp<std::uint8_t>(12))));
    EXPECT_THAT(leaning->variables()[0].notes, ElementsAre(HasSubstr("index space")));
}

TEST(Nrrd, LeftHandedSpacesSayThatThePictureIsMirrored) {
    const auto reader =
        openBytes(slab("space: LAS\nspace directions: (1,0,0) (0,1,1e-12) (0,0,1)\n"
                       "space units: \"mm\" \"mm\" \"mm\"\n"));
    EXPECT_EQ(reader->variables()[0].grid->axes()[1].name, "anterior");
    EXPECT_EQ(reader->variables()[0].grid->axes()[1].units, "mm");
    EXPECT_THAT(reader->variables()[0].notes, ElementsAre(HasSubstr("mirrored")));
    const auto oblique =
        openBytes(slab("space: LAS\nspace directions: (0.8,0.6,0) (-0.6,0.8,0) (0,0,1)\n"));
    EXPECT_THAT(oblique->variables()[0].notes, ElementsAre(HasSubstr("mirrored")));
    expectPlaces(*oblique->variables()[0].grid, {}, {{0.8, 0.6, 0}, {-0.6, 0.8, 0}, {0, 0, 1}});
}

TEST(Nrrd, PlanesAndRowsAreOneLayer) {
    const auto plane = openBytes(
        nrrd("type: uchar\ndimension: 2\nsizes: 2 3\nencoding: raw\nspacings: 1 1\n", "abcdef"));
    EXPECT_THAT(plane->variables()[0].grid->size(), ElementsAre(2, 3, 1));
    const auto row =
        openBytes(nrrd("type: uchar\ndimension: 1\nsizes: 6\nencoding: raw\n", "abcdef"));
    EXPECT_THAT(row->variables()[0].grid->size(), ElementsAre(6, 1, 1));
    const auto movie = openBytes(
        nrrd("type: uchar\ndimension: 3\nsizes: 2 1 3\nencoding: raw\nkinds: space space time\n",
             "abcdef"));
    EXPECT_EQ(movie->variables()[0].time->points.size(), 3u);
    EXPECT_EQ(valuesOf<std::uint8_t>(*movie, 1), (std::vector<std::uint8_t>{'c', 'd'}));
}

TEST(Nrrd, StubsAreNoAxes) {
    const auto reader =
        openBytes(nrrd("type: uchar\ndimension: 5\nsizes: 1 2 3 1 4\nencoding: raw\n"
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
        const auto reader = openBytes(movie(kinds + key + "\n"));
        EXPECT_EQ(times(*reader), (std::vector<double>{2, 3.5, 30})) << key;
        EXPECT_EQ(reader->variables()[0].time->name, "day") << key;
    }
    EXPECT_EQ(openBytes(movie(kinds + "days:=2 3 30\n"))->variables()[0].time->units, "days");
}

TEST(Nrrd, KeysThatDoNotNameTimesAreNotTaken) {
    for (const char* key : {"days:=2 3", "days:=2 3 4 5", "days:=2 3 x", "days:=2 3 nan",
                            "weights:=2 3 4", "days:=1 2 3\ntimes:=4 5 6"}) {
        const auto reader = openBytes(movie(fmt::format(
            "kinds: space space space time\nlabels: \"\" \"\" \"\" \"day\"\n{}\n", key)));
        EXPECT_EQ(times(*reader), (std::vector<double>{0, 1, 2})) << key;
        EXPECT_EQ(reader->variables()[0].time->name, "step") << key;
    }
}

TEST(Nrrd, EvenTimesComeFromTheAxis) {
    const auto reader = openBytes(
        movie("kinds: space space space time\nspacings: 1 1 1 0.5\naxis mins: nan nan nan 10\n"
              "units: \"\" \"\" \"\" \"ms\"\n"));
    EXPECT_EQ(times(*reader), (std::vector<double>{10, 10.5, 11}));
    EXPECT_EQ(reader->variables()[0].time->units, "ms");

    const auto dated =
        openBytes(movie("kinds: space space space time\nspacings: 1 1 1 6\n"
                        "units: \"\" \"\" \"\" \"hours since 2000-01-01\"\n"));
    EXPECT_EQ(dated->variables()[0].time->points[2].date, "2000-01-01 12:00:00");

    const auto space =
        openBytes(movie("space: 3D-right-handed-time\n"
                        "space directions: (1,0,0,0) (0,1,0,0) (0,0,1,0) (0,0,0,4)\n"
                        "space origin: (0,0,0,20)\nspace units: \"mm\" \"mm\" \"mm\" \"s\"\n"));
    EXPECT_EQ(times(*space), (std::vector<double>{20, 24, 28}));
    EXPECT_EQ(space->variables()[0].time->units, "s");
}

TEST(Nrrd, TheSlowestOfFourUntoldAxesIsTimeAndANoteSaysSo) {
    const auto reader = openBytes(movie(""));
    EXPECT_EQ(reader->variables()[0].time->points.size(), 3u);
    EXPECT_THAT(reader->variables()[0].notes, testing::Contains(HasSubstr("taken for time")));
    const auto labelled = openBytes(nrrd(
        "type: uchar\ndimension: 4\nsizes: 3 2 2 2\nencoding: raw\nlabels: \"t\" \"\" \"\" \"\"\n",
        bytesOf(ramp<std::uint8_t>(24))));
    EXPECT_EQ(valuesOf<std::uint8_t>(*labelled, 1),
              (std::vector<std::uint8_t>{1, 4, 7, 10, 13, 16, 19, 22}));
}

// Headers beside their values.
class DetachedNrrd : public testing::Test {
 protected:
    std::string open(const std::string& lines) {
        writeBytes(folder / "file.nhdr",
                   "NRRD0004\r\ntype: uchar\r\ndimension: 3\r\n"
                   "sizes: 2 3 4\r\n" +
                       lines);
        return refusal(folder / "file.nhdr");
    }
    void expectRamp() {
        const auto reader = openOne(folder / "file.nhdr");
        EXPECT_EQ(valuesOf<std::uint8_t>(*reader), ramp<std::uint8_t>(24));
    }
    std::string part(std::size_t first, std::size_t count) const {
        return bytesOf(ramp<std::uint8_t>(24)).substr(first, count);
    }
    std::filesystem::path folder = freshFolder();
};

TEST_F(DetachedNrrd, OneFileAfterLinesAndBytesThatAreSkipped) {
    std::filesystem::create_directory(folder / "sub");
    writeBytes(folder / "sub/with blank.raw", "one\ntwo\nxyz" + part(0, 24));
    EXPECT_EQ(open("encoding: raw\nline skip: 2\nbyte skip: 3\ndata file: sub/with blank.raw\n"),
              "");
    expectRamp();
    EXPECT_EQ(open("encoding: raw\nbyte skip: -1\ndatafile: ./sub/with blank.raw"), "");
    expectRamp();
    writeBytes(folder / "v.gz", "one\n" + gzipped("xyz" + part(0, 24)));
    EXPECT_EQ(open("encoding: gz\nline skip: 1\nbyte skip: 3\ndata file: v.gz\n\n"), "");
    expectRamp();
    writeBytes(folder / "v.txt",
               "24 values\n0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 "
               "20 21 22 23");
    EXPECT_EQ(open("encoding: txt\nline skip: 1\ndata file: v.txt\n"), "");
    expectRamp();
}

TEST_F(DetachedNrrd, OneFileASliceRowOrSlab) {
    for (std::size_t i = 0; i < 4; ++i)
        writeBytes(folder / fmt::format("s{:03}.raw", 8 - 2 * i), part(6 * i, 6));
    EXPECT_EQ(open("encoding: raw\ndata file: s%03d.raw 8 2 -2\n"), "");
    expectRamp();
    EXPECT_EQ(open("encoding: raw\ndata file: LIST\ns008.raw\ns006.raw\ns004.raw\ns002.raw\n"), "");
    expectRamp();
    for (std::size_t i = 0; i < 12; ++i)
        writeBytes(folder / fmt::format("r%{:2}", i), gzipped(part(2 * i, 2)));
    EXPECT_EQ(open("encoding: gzip\ndata file: r%%%2d 0 11 1 1\n"), "");
    expectRamp();
    for (std::size_t i = 0; i < 12; ++i)
        writeBytes(folder / fmt::format("r%{}", i), gzipped(part(2 * i, 2)));
    EXPECT_EQ(open("encoding: gzip\ndata file: r%%%d 0 11 1 1\n"), "");
    expectRamp();
    writeBytes(folder / "a", part(0, 12));
    writeBytes(folder / "b", part(12, 12));
    EXPECT_EQ(open("encoding: raw\ndata file: LIST 3\na\nb\n"), "");
    expectRamp();
}

TEST_F(DetachedNrrd, FilesOutsideTheHeadersFolderAreFoundFromItOrByAnAbsolutePath) {
    for (const char* each : {"header", "values/raw"})
        std::filesystem::create_directories(folder / each);
    for (std::size_t i = 0; i < 4; ++i)
        writeBytes(folder / fmt::format("values/raw/s{}", i), part(6 * i, 6));
    writeBytes(folder / "values/all", part(0, 24));
    std::filesystem::create_symlink("../values/all", folder / "header/link");
    const std::filesystem::path values = folder / "values";
    folder /= "header";
    for (const std::string& dataFile :
         {std::string("../values/all"), (values / "all").string(), std::string("link"),
          std::string("../values/raw/s%d 0 3 1"), (values / "raw/s%d 0 3 1").string(),
          "LIST\n../values/raw/s0\n../values/raw/../raw/s1\n" + (values / "raw/s2").string() +
              "\n../values/raw/s3"}) {
        EXPECT_EQ(open("encoding: raw\ndata file: " + dataFile + "\n"), "") << dataFile;
        expectRamp();
    }
}

TEST_F(DetachedNrrd, APercentSignWithoutNumbersIsAName) {
    writeBytes(folder / "50%s.raw", part(0, 24));
    EXPECT_EQ(open("encoding: raw\ndata file: 50%s.raw\n"), "");
    expectRamp();
}

}  // namespace
}  // namespace timeseries
