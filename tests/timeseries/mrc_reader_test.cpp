// MRC and CCP4 maps: where their voxels lie, and what they hold. Words are counted from 1.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <random>

#include "tests/support/array_builder.h"
#include "tests/support/damage.h"
#include "tests/support/shared_data.h"

namespace timeseries {
namespace {

using namespace tests;
using namespace std::string_literals;
using testing::ElementsAre;
using testing::HasSubstr;

std::size_t word(std::size_t number) { return 4 * (number - 1); }

// 2 columns, 3 rows, 4 sections along x, y and z, in a cell of 4, 9 and 16 with as many intervals.
BinaryHeader map(std::int32_t mode, std::endian order = std::endian::little) {
    BinaryHeader header(1024, order);
    header.put(word(1), std::vector<std::int32_t>{2, 3, 4, mode, 0, 0, 0, 2, 3, 4})
        .put(word(11), std::vector<float>{4, 9, 16, 90, 90, 90})
        .put(word(17), std::vector<std::int32_t>{1, 2, 3})
        .put(word(53), "MAP "s)
        .put(word(54), order == std::endian::little ? "\x44\x44\0\0"s : "\x11\x11\0\0"s);
    return header;
}

std::string slab(const BinaryHeader& header) {
    return header.bytes() + bytesOf(ramp<std::int16_t>(24), header.order());
}

template <typename At>
void expectPlaces(const BinaryHeader& header, const At& at) {
    const auto reader = openWritten(slab(header));
    const Grid& grid = *reader->variables()[0].grid;
    const auto values = valuesOf<std::int16_t>(*reader);
    ASSERT_EQ(values.size(), 24u);
    for (std::size_t index = 0; index < 24; ++index) {
        const double v = values[index];
        const glm::dvec3 expected =
            at(std::fmod(v, 2), std::fmod(std::floor(v / 2), 3), std::floor(v / 6));
        const glm::dvec3 found = grid.position(index);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1e-5) << v << ' ' << c;
    }
}

TEST(Mrc, TheCellPlacesVoxels) {
    expectPlaces(map(1),
                 [](double i, double j, double k) { return glm::dvec3(2 * i, 3 * j, 4 * k); });
    const auto reader = openWritten(slab(map(1)));
    const Variable& variable = reader->variables()[0];
    EXPECT_EQ(variable.name, "density");
    EXPECT_EQ(variable.grid->axes()[0].units, "Å");
    EXPECT_THAT(variable.notes, ElementsAre());
    EXPECT_EQ(reader->format(), "MRC");
}

TEST(Mrc, BeginsAtItsOriginElseAtItsFirstColumnRowAndSection) {
    const auto starts = std::vector<std::int32_t>{5, -6, 7};
    expectPlaces(map(1).put(word(5), starts), [](double i, double j, double k) {
        return glm::dvec3(2 * (i + 5), 3 * (j - 6), 4 * (k + 7));
    });
    expectPlaces(
        map(1).put(word(5), starts).put(word(50), std::vector<float>{0.5, 0, -100}),
        [](double i, double j, double k) { return glm::dvec3(2 * i + 0.5, 3 * j, 4 * k - 100); });
}

TEST(Mrc, ColumnsMayRunAlongAnyAxis) {
    // Columns along z, rows along x, sections along y: the cell and its intervals are x, y and z's.
    expectPlaces(map(1)
                     .put(word(17), std::vector<std::int32_t>{3, 1, 2})
                     .put(word(5), std::vector<std::int32_t>{1, 2, 3}),
                 [](double i, double j, double k) {
                     return glm::dvec3(2 * (j + 2), 3 * (k + 3), 4 * (i + 1));
                 });
}

TEST(Mrc, CellsMayLean) {
    // A hexagonal cell: the second edge leans by 120 degrees.
    const double c = std::cos(2 * M_PI / 3), s = std::sin(2 * M_PI / 3);
    expectPlaces(map(1).put(word(14), std::vector<float>{90, 90, 120}),
                 [&](double i, double j, double k) {
                     return glm::dvec3(2 * i + 3 * j * c, 3 * j * s, 4 * k);
                 });
    // Of three other angles, edges have their lengths and these angles between them.
    const auto reader = openWritten(slab(map(1).put(word(14), std::vector<float>{80, 95, 110})));
    const Grid& grid = *reader->variables()[0].grid;
    const auto step = [&](std::uint64_t to) { return grid.position(to) - grid.position(0); };
    const glm::dvec3 x = step(1), y = step(2), z = step(6);
    EXPECT_NEAR(glm::length(x), 2, 1e-6);
    EXPECT_NEAR(glm::length(y), 3, 1e-6);
    EXPECT_NEAR(glm::length(z), 4, 1e-6);
    EXPECT_NEAR(glm::dot(y, z), 12 * std::cos(glm::radians(80.0)), 1e-5);
    EXPECT_NEAR(glm::dot(x, z), 8 * std::cos(glm::radians(95.0)), 1e-5);
    EXPECT_NEAR(glm::dot(x, y), 6 * std::cos(glm::radians(110.0)), 1e-5);
}

TEST(Mrc, WithoutACellVoxelsAreCubesAndItIsTold) {
    const auto reader = openWritten(slab(map(1).put(word(11), std::vector<float>(6))));
    EXPECT_THAT(reader->variables()[0].notes, ElementsAre(HasSubstr("drawn as cubes")));
    EXPECT_EQ(reader->variables()[0].grid->axes()[2].coordinates,
              (std::vector<double>{0, 1, 2, 3}));
}

TEST(Mrc, AStackOfVolumesIsASeries) {
    const auto reader =
        openWritten(slab(map(1).put(word(23), std::int32_t{401}).put(word(10), std::int32_t{2})));
    EXPECT_EQ(reader->variables()[0].time->points.size(), 2u);
    EXPECT_EQ(valuesOf<std::int16_t>(*reader, 1)[0], 12);
    const auto path = freshFolder() / "stack.mrc";
    writeBytes(path, slab(map(1).put(word(23), std::int32_t{401}).put(word(10), std::int32_t{3})));
    EXPECT_THAT(refusal(path), HasSubstr("whole volumes of 3"));
}

template <typename T>
void expectValues(std::int32_t mode) {
    std::vector<T> values = ramp<T>(24);
    values[1] = std::numeric_limits<T>::lowest();
    values[2] = std::numeric_limits<T>::max();
    for (const std::endian order : {std::endian::little, std::endian::big}) {
        const std::string bytes = bytesOf(values, order);
        EXPECT_EQ(valuesOf<T>(*openWritten(map(mode, order).bytes() + bytes)), values);
        // Behind symmetry operators, and without a stamp.
        BinaryHeader header = map(mode, order);
        header.put(word(24), std::int32_t{160}).put(word(54), std::int32_t{0});
        EXPECT_EQ(valuesOf<T>(*openWritten(header.bytes() + std::string(160, 'x') + bytes)),
                  values);
    }
}

TEST(Mrc, EveryModeOfRealNumbersInEitherOrder) {
    expectValues<std::int8_t>(0);
    expectValues<std::int16_t>(1);
    expectValues<float>(2);
    expectValues<std::uint16_t>(6);
    // IMOD's bytes, unless it says that they have a sign.
    const std::string bytes = bytesOf(ramp<std::uint8_t>(24));
    for (const std::int32_t flags : {0, 1}) {
        const auto reader =
            openWritten(map(0).put(word(39), "IMOD"s).put(word(40), flags).bytes() + bytes);
        EXPECT_EQ(reader->variables()[0].type, flags == 1 ? ValueType::I8 : ValueType::U8);
    }
}

TEST(Mrc, WhatCannotBeReadIsNamed) {
    const auto path = freshFolder() / "file.mrc";
    const auto refused = [&](const std::string& bytes) {
        writeBytes(path, bytes);
        return refusal(path);
    };
    EXPECT_THAT(refused(slab(map(4))), HasSubstr("mode: expected 0 (int8)"));
    EXPECT_THAT(refused(slab(map(1)).substr(0, 1000)),
                HasSubstr("expected 1024 bytes, found 1000"));
    EXPECT_THAT(refused(slab(map(1)).substr(0, 1050)), HasSubstr("expected at least 48 bytes"));
    EXPECT_THAT(refused(slab(map(1).put(word(2), std::int32_t{0}))), HasSubstr("one or more"));
    EXPECT_THAT(refused(slab(map(1).put(word(24), std::int32_t{-1}))), HasSubstr("NSYMBT"));
    EXPECT_THAT(refused(slab(map(1).put(word(14), std::vector<float>{10, 10, 170}))),
                HasSubstr("angles"));
    std::mt19937 random(13);
    const std::string whole = slab(map(1));
    for (int trial = 0; trial < 3000; ++trial) {
        std::string damaged = whole;
        for (int i = 0; i < 3; ++i) damaged[random() % 208] = static_cast<char>(random());
        refused(damaged);  // a sentence, if it is one
    }
}

// The file's own statistics are of its values, and its place is what its entry in EMDB tells.
// Each word of the header by itself, then anything anywhere.
TEST(Mrc, HostileHeadersAreReadOrRefusedInASentence) {
    const auto path = freshFolder() / "file.mrc";
    for (const auto order : {std::endian::little, std::endian::big}) {
        for (std::size_t at = 1; at <= 56; ++at)
            for (const std::uint32_t hostile :
                 {0u, 1u, 0x7fffffffu, 0x80000000u, 0xffffffffu, 0x7f800000u, 0x7f7fffffu}) {
                const auto damaged =
                    map(1, order).put(word(at), static_cast<std::int32_t>(hostile));
                writeBytes(path, slab(damaged));
                SCOPED_TRACE(testing::Message() << "word " << at << ", " << hostile);
                isRefusedInOneSentence(path);
            }
        writeBytes(path, slab(map(1, order)));
        damageInRounds(path, path);
    }
}

TEST(RealMrc, AMapWithPermutedAxesHoldsWhatItsHeaderSays) {
    const auto path = tests::sharedData("grids/emd_3001.map");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no real data at " << path;
    const auto reader = open(path);
    const auto values = valuesOf<float>(*reader);
    double sum = 0;
    for (const float v : values) sum += static_cast<double>(v);
    std::ifstream file(path, std::ios::binary);
    const auto headerReals = [&](std::size_t first) {
        std::array<float, 3> reals{};
        file.seekg(static_cast<std::streamoff>(word(first)));
        file.read(reinterpret_cast<char*>(reals.data()), sizeof reals);
        return reals;
    };
    const auto statistics = headerReals(20), edges = headerReals(11), angles = headerReals(14);
    EXPECT_EQ(*std::ranges::min_element(values), statistics[0]);
    EXPECT_EQ(*std::ranges::max_element(values), statistics[1]);
    EXPECT_NEAR(sum / static_cast<double>(values.size()), static_cast<double>(statistics[2]), 1e-6);
    // 73 columns along z, 43 rows along x, 25 sections along y, in a cell of which x and z lean,
    // cut into 40, 12 and 72; the first are 0, -21 and -12.
    const Grid& grid = *reader->variables()[0].grid;
    EXPECT_THAT(grid.size(), ElementsAre(73, 43, 25));
    EXPECT_EQ(angles[0], 90);
    EXPECT_EQ(angles[2], 90);
    const double lean = glm::radians(static_cast<double>(angles[1]));
    const glm::dvec3 x(edges[0] / 40, 0, 0), y(0, edges[1] / 12, 0),
        z = edges[2] / 72.0 * glm::dvec3(std::cos(lean), 0, std::sin(lean));
    for (const glm::ivec3 at : {glm::ivec3(0, 0, 0), {72, 0, 0}, {3, 42, 7}, {10, 20, 24}}) {
        const glm::dvec3 expected =
            double(at.x) * z + double(at.y - 21) * x + double(at.z - 12) * y;
        const auto index = static_cast<std::uint64_t>(at.x + 73 * (at.y + 43 * at.z));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(grid.position(index)[c], expected[c], 1e-5);
    }
}

}  // namespace
}  // namespace timeseries
