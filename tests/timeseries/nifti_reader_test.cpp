// NIfTI files: where their voxels lie, when, and what they hold.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/nifti_builder.h"
#include "tests/support/shared_data.h"

namespace timeseries {
namespace {

using namespace tests;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::int16_t kU8 = 2, kI16 = 4, kI32 = 8, kF32 = 16, kF64 = 64, kI8 = 256, kU16 = 512,
                       kU32 = 768, kI64 = 1024, kU64 = 1280;
constexpr std::size_t kPixdim = 76, kSlope = 112, kUnits = 123, kToffset = 136, kQform = 252,
                      kQuaternion = 256, kSform = 254, kSrow = 280, kIntent = 68;

// 2 x 3 x 4 voxels, 0 to 23.
std::string slab(const BinaryHeader& header) {
    return header.bytes() + bytesOf(ramp<std::uint8_t>(24), header.order());
}
BinaryHeader slabHeader() {
    return nifti1(kU8, {3, 2, 3, 4}).put(kPixdim, std::vector<float>{1, 1, 1, 1});
}

// The place in the file's space of the voxel that holds each value: `at(i, j, k)`.
template <typename At>
void expectPlaces(const std::string& file, const At& at) {
    const auto reader = openWritten(file);
    const Grid& grid = *reader->variables()[0].grid;
    const auto values = valuesOf<std::uint8_t>(*reader);
    ASSERT_EQ(values.size(), 24u);
    for (std::size_t index = 0; index < 24; ++index) {
        const double v = values[index];
        const glm::dvec3 expected =
            at(std::fmod(v, 2), std::fmod(std::floor(v / 2), 3), std::floor(v / 6));
        const glm::dvec3 found = grid.position(index);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1e-5) << v << ' ' << c;
    }
}

TEST(Nifti, TheSformPlacesVoxels) {
    // Flipped and turned by right angles, and oblique.
    const glm::dmat3 upright{{0, 0, 2}, {-3, 0, 0}, {0, 1.5, 0}};
    const double c = std::cos(0.3), s = std::sin(0.3);
    const glm::dmat3 oblique{{-2 * c, 2 * s, 0}, {3 * s, 3 * c, 0}, {0, 0, 1.5}};
    for (const glm::dmat3& m : {upright, oblique}) {
        std::vector<float> rows;
        const glm::dvec3 first(-90.5, 126, -72);
        for (int r = 0; r < 3; ++r) {
            for (int i = 0; i < 3; ++i) rows.push_back(static_cast<float>(m[i][r]));
            rows.push_back(static_cast<float>(first[r]));
        }
        const std::string file = slab(slabHeader()
                                          .put(kSform, std::int16_t{1})
                                          .put(kSrow, rows)
                                          .put(kUnits, std::uint8_t{2})
                                          .put(kQform, std::int16_t{1}));
        expectPlaces(file,
                     [&](double i, double j, double k) { return first + m * glm::dvec3(i, j, k); });
    }
}

TEST(Nifti, AxesAreCalledAsTheyGrowThroughTheBody) {
    const auto reader = openWritten(
        slab(slabHeader()
                 .put(kSform, std::int16_t{4})
                 .put(kSrow, std::vector<float>{-2, 0, 0, 90, 0, 2, 0, -126, 0, 0, 2, -72})
                 .put(kUnits, std::uint8_t{2})));
    const auto& axes = reader->variables()[0].grid->axes();
    EXPECT_EQ(axes[0].name, "right");
    EXPECT_EQ(axes[1].name, "anterior");
    EXPECT_EQ(axes[2].name, "superior");
    EXPECT_EQ(axes[2].units, "mm");
    EXPECT_EQ(axes[0].coordinates, (std::vector<double>{90, 88}));
    EXPECT_EQ(reader->format(), "NIfTI-1");
}

TEST(Nifti, WithoutAnSformTheQformDoes) {
    // A quarter turn about z, cells of 1, 2 and 3, k counted against z (nifti1.h, method 2).
    const auto half = static_cast<float>(std::sqrt(0.5));
    const std::string file =
        slab(slabHeader()
                 .put(kQform, std::int16_t{1})
                 .put(kPixdim, std::vector<float>{-1, 1, 2, 3})
                 .put(kQuaternion, std::vector<float>{0, 0, half, 10, 20, 30}));
    expectPlaces(file, [](double i, double j, double k) {
        return glm::dvec3(10 - 2 * j, 20 + i, 30 - 3 * k);
    });
}

TEST(Nifti, WithoutEitherTheSpacingsDo) {
    expectPlaces(slab(slabHeader().put(kPixdim, std::vector<float>{0, 0.5, 2, 3})),
                 [](double i, double j, double k) { return glm::dvec3(0.5 * i, 2 * j, 3 * k); });
    // So they do, and it is told, where the sform is flat.
    const auto reader = openWritten(slab(
        slabHeader().put(kSform, std::int16_t{1}).put(kPixdim, std::vector<float>{0, 0.5, 2, 3})));
    EXPECT_THAT(reader->variables()[0].notes, ElementsAre(HasSubstr("placed by pixdim")));
    EXPECT_EQ(reader->variables()[0].grid->axes()[0].coordinates, (std::vector<double>{0, 0.5}));
}

TEST(Nifti, NothingIsInventedWhereSpacingsAreNone) {
    for (const float none : {0.0f, std::nanf("")}) {
        const auto reader = openWritten(nifti1(kU8, {4, 2, 3, 2, 2})
                                            .put(kPixdim, std::vector<float>{0, none, 1, 1, none})
                                            .bytes() +
                                        bytesOf(ramp<std::uint8_t>(24)));
        const Variable& variable = reader->variables()[0];
        EXPECT_EQ(variable.grid->axes()[0].units, "index");
        EXPECT_THAT(variable.notes, testing::Contains(HasSubstr("placed by index")));
        EXPECT_TRUE(variable.time->counted);
        const auto turned = openWritten(slab(slabHeader()
                                                 .put(kPixdim, std::vector<float>{1, none, 1, 1})
                                                 .put(kQform, std::int16_t{1})));
        EXPECT_EQ(turned->variables()[0].grid->axes()[0].units, "index");
    }
}

TEST(Nifti, TheFourthDimensionIsTime) {
    const auto reader = openWritten(nifti1(kI16, {4, 2, 3, 4, 5})
                                        .put(kPixdim, std::vector<float>{0, 1, 1, 1, 2.5f})
                                        .put(kToffset, 10.0f)
                                        .put(kUnits, std::uint8_t{2 + 8})
                                        .bytes() +
                                    bytesOf(ramp<std::int16_t>(120)));
    const TimeAxis& time = *reader->variables()[0].time;
    EXPECT_EQ(time.units, "s");
    ASSERT_EQ(time.points.size(), 5u);
    for (std::size_t t = 0; t < 5; ++t) {
        EXPECT_EQ(time.points[t].value, 10 + 2.5 * double(t));
        std::vector<std::int16_t> expected(24);
        for (std::size_t i = 0; i < 24; ++i) expected[i] = static_cast<std::int16_t>(24 * t + i);
        EXPECT_EQ(valuesOf<std::int16_t>(*reader, t), expected);
    }
}

template <typename T>
void expectValues(std::int16_t type) {
    std::vector<T> values = ramp<T>(24);
    values[1] = std::numeric_limits<T>::lowest();
    values[2] = std::numeric_limits<T>::max();
    for (const std::endian order : {std::endian::little, std::endian::big}) {
        const std::string bytes = bytesOf(values, order);
        for (const std::string& head :
             {nifti1(type, {3, 2, 3, 4}, order).bytes(), nifti2(type, {3, 2, 3, 4}, order).bytes()})
            for (const std::string& file : {head + bytes, byGzip(head + bytes)})
                EXPECT_EQ(valuesOf<T>(*openWritten(file)), values) << type;
    }
}

TEST(Nifti, EveryTypeOfNumberInEitherOrderPlainOrPacked) {
    expectValues<std::int8_t>(kI8);
    expectValues<std::uint8_t>(kU8);
    expectValues<std::int16_t>(kI16);
    expectValues<std::uint16_t>(kU16);
    expectValues<std::int32_t>(kI32);
    expectValues<std::uint32_t>(kU32);
    expectValues<std::int64_t>(kI64);
    expectValues<std::uint64_t>(kU64);
    expectValues<float>(kF32);
    expectValues<double>(kF64);
}

TEST(Nifti, ScaledValuesAreInDouble) {
    const auto open = [](float slope, float offset) {
        return openWritten(slab(slabHeader().put(kSlope, std::vector<float>{slope, offset})));
    };
    const auto reader = open(0.1f, -3);
    EXPECT_EQ(reader->variables()[0].type, ValueType::F64);
    EXPECT_THAT(reader->variables()[0].storedAs, HasSubstr("uint8, scale 0.1"));
    const auto values = valuesOf<double>(*reader);
    for (std::size_t i = 0; i < 24; ++i)
        EXPECT_EQ(values[i], static_cast<double>(0.1f) * static_cast<double>(i) - 3);
    // None, and one that changes nothing.
    for (const float slope : {0.0f, 1.0f, std::nanf("")})
        EXPECT_EQ(valuesOf<std::uint8_t>(*open(slope, 0)), ramp<std::uint8_t>(24));
}

TEST(Nifti, LabelsAreCategories) {
    const auto reader = openWritten(slab(slabHeader().put(kIntent, std::int16_t{1002})));
    EXPECT_TRUE(reader->variables()[0].categories);
    EXPECT_TRUE(reader->read(0, 0).categories);
    EXPECT_FALSE(openWritten(slab(slabHeader()))->variables()[0].categories);
}

TEST(Nifti, AHeaderBesideItsValues) {
    const std::string head = slabHeader().put(344, "ni1\0"s).put(108, 0.0f).bytes().substr(0, 348);
    const std::string values = bytesOf(ramp<std::uint8_t>(24));
    const auto folder = freshFolder();
    for (const auto& [header, image] : {std::pair("a.hdr", "a.img"),
                                        {"b.hdr", "b.img.gz"},
                                        {"c.hdr.gz", "c.img.gz"},
                                        {"d.hdr.gz", "d.img"}}) {
        const auto packed = [](std::string_view name, const std::string& bytes) {
            return name.ends_with(".gz") ? byGzip(bytes) : bytes;
        };
        writeBytes(folder / header, packed(header, head));
        EXPECT_THAT(refusal(folder / header), HasSubstr("img")) << header;
        writeBytes(folder / image, packed(image, values));
        const auto reader = open(folder / header);
        EXPECT_EQ(valuesOf<std::uint8_t>(*reader), ramp<std::uint8_t>(24)) << header;
        EXPECT_EQ(reader->variables()[0].name, std::string(header).substr(0, 1));
        EXPECT_EQ(reader->format(), "NIfTI-1, detached values");
    }
}

TEST(Nifti, WhatIsNoScalarOnAGridIsNamed) {
    const auto path = freshFolder() / "file.nii";
    const auto refused = [&](const BinaryHeader& header) {
        writeBytes(path, slab(header));
        return refusal(path);
    };
    EXPECT_THAT(refused(nifti1(32, {3, 2, 3, 4})), HasSubstr("found COMPLEX64"));
    EXPECT_THAT(refused(nifti1(128, {3, 2, 3, 4})), HasSubstr("found RGB24"));
    EXPECT_THAT(refused(nifti1(kU8, {5, 2, 2, 2, 1, 3}).put(kIntent, std::int16_t{1007})),
                HasSubstr("dim[5]: expected one number a point, found 3 (Vector)"));
    EXPECT_THAT(refused(nifti1(kU8, {3, 2, 3, 5})), HasSubstr("found 24"));
    EXPECT_THAT(refused(nifti1(kU8, {3, 32767, 32767, 32767})), HasSubstr("expected"));
    EXPECT_THAT(refused(nifti1(kU8, {3, 2, 3, -4})),
                HasSubstr("dim[3]: expected one or more, found -4"));
    EXPECT_THAT(refused(nifti1(kU8, {9, 2, 3, 4})), HasSubstr("dim[0]: expected 1 to 7"));
    EXPECT_THAT(refused(nifti1(77, {3, 2, 3, 4})),
                HasSubstr("datatype: expected one of NIfTI's, found 77"));
    for (const float at : {1e9f, 1e30f, -5e9f, std::nanf(""), 348.0f, 352.5f})
        EXPECT_THAT(refused(slabHeader().put(108, at)), HasSubstr("expected")) << at;
    EXPECT_THAT(refused(slabHeader().put(0, std::int32_t{347})),
                HasSubstr("sizeof_hdr: expected 348, found 347"));
    // The byte order of its size is not that of its dimensions.
    EXPECT_THAT(refused(nifti2(kU8, {3, 2, 3, 4}).put(0, "\0\0\2\x1c"s)), HasSubstr("sizeof_hdr"));
    EXPECT_EQ(valuesOf<std::uint8_t>(*openWritten(slab(slabHeader().put(108, 0.0f)))),
              ramp<std::uint8_t>(24));
}

TEST(Nifti, FilesCutOrDamagedAnywhereAreReadOrRefused) {
    const auto path = freshFolder() / "file.nii";
    for (const std::string& whole :
         {slab(slabHeader()
                   .put(kSform, std::int16_t{1})
                   .put(kPixdim, std::vector<float>{1, 1, 1, 1})),
          nifti2(kU8, {3, 2, 3, 4}).bytes() + bytesOf(ramp<std::uint8_t>(24))}) {
        for (std::size_t bytes = 348; bytes < whole.size(); bytes += bytes < 540 ? 7 : 1) {
            writeBytes(path, whole.substr(0, bytes));
            EXPECT_NE(refusal(path), "") << bytes;
        }
        std::mt19937 random(11);
        for (int trial = 0; trial < 2000; ++trial) {
            std::string damaged = whole;
            for (int i = 0; i < 3; ++i) damaged[12 + random() % 330] = static_cast<char>(random());
            writeBytes(path, damaged);
            refusal(path);  // a sentence, if it is one
        }
    }
}

TEST(RealNifti, AnFmriSeriesIsReadAsItsHeaderSays) {
    const auto path = tests::sharedData("fmri_filtered_func_64t.nii.gz");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no real data at " << path;
    const auto reader = open(path);
    const Variable& variable = reader->variables()[0];
    EXPECT_EQ(variable.grid->count(), 64u * 64 * 21);
    EXPECT_EQ(variable.type, ValueType::I16);
    EXPECT_EQ(variable.time->points.size(), 64u);
    EXPECT_EQ(variable.name, "fmri_filtered_func_64t");
}

}  // namespace
}  // namespace timeseries
