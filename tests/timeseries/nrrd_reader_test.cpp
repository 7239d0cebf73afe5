// NRRD files written here by hand: values, and where in the file they lie.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "tests/support/array_builder.h"

namespace timeseries {
namespace {

using namespace tests;
using testing::ElementsAre;
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
            const auto reader = openWritten(
                nrrd(fmt::format("type: {}\ndimension: 3\nsizes: 2 2 2\nendian: {}\nencoding: {}\n",
                                 type, order == std::endian::little ? "little" : "big", encoding),
                     encoded(encoding, bytesOf(values, order))));
            EXPECT_EQ(reader->variables()[0].type, expected) << type;
            EXPECT_EQ(valuesOf<T>(*reader), values) << type;
        }
    std::string text;
    for (const T value : values) text += fmt::format("{} ", value);
    const auto reader = openWritten(
        nrrd(fmt::format("type: {}\ndimension: 3\nsizes: 2 2 2\nencoding: ascii\n", type), text));
    EXPECT_EQ(valuesOf<T>(*reader), values) << type << " as text";
}

// So many that threads share them.
TEST(Nrrd, ManyValuesAreExact) {
    std::vector<std::uint16_t> values(1000 * 110 * 100);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = static_cast<std::uint16_t>(i * 40'503 >> 8);
    const auto reader = openWritten(
        nrrd("type: uint16\ndimension: 3\nsizes: 1000 110 100\nendian: little\nencoding: raw\n",
             bytesOf(values, std::endian::little)));
    EXPECT_TRUE(valuesOf<std::uint16_t>(*reader) == values);
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
    const auto reader =
        openWritten(nrrd("type: float\ndimension: 3\nsizes: 5 1 1\nencoding: text\n",
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
            const auto reader = openWritten(
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
            const auto reader = openWritten(
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
                    openWritten(nrrd("type: uchar\ndimension: 4\nsizes: 300 20 10 5\nbyte skip: 4\n"
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

}  // namespace
}  // namespace timeseries
