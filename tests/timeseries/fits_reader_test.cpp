// FITS images: where their pixels lie, and what they hold. Expected texts and formulas are of the
// standard (version 4.0), which stores numbers in big-endian order.
#include <fitsio.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/fits_builder.h"
#include "tests/support/shared_data.h"

namespace timeseries {
namespace {

using namespace tests;
using namespace tests::fits;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Fits, KeywordsPlaceACubeOfTheSky) {
    const auto reader = openWritten(
        slab({"CTYPE1  = 'RA---TAN'", "CRVAL1  = 52.5", "CDELT1  = -0.25", "CRPIX1  = 1.0",
              "CTYPE2  = 'DEC--TAN'", "CRVAL2  = 31.0", "CDELT2  = 0.25", "CRPIX2  = 2.0",
              "CUNIT2  = 'deg'", "CTYPE3  = 'VRAD'", "CRVAL3  = 7000.0", "CDELT3  = -100.0",
              "CRPIX3  = 3.0", "BUNIT   = 'Jy/beam'"}));
    const Variable& variable = reader->variables()[0];
    const auto& axes = variable.grid->axes();
    EXPECT_EQ(axes[0].name, "RA");
    EXPECT_EQ(axes[0].units, "degree");
    EXPECT_EQ(axes[0].coordinates, (std::vector<double>{0, -0.25}));
    EXPECT_EQ(axes[1].coordinates, (std::vector<double>{-0.25, 0, 0.25}));
    EXPECT_EQ(axes[2].name, "VRAD");
    EXPECT_EQ(axes[2].units, "m/s");
    EXPECT_EQ(axes[2].coordinates, (std::vector<double>{7200, 7100, 7000, 6900}));
    EXPECT_EQ(variable.units, "Jy/beam");
    EXPECT_THAT(variable.notes,
                ElementsAre("RA is the angle from 52.5 degree on the plane of the sky",
                            "DEC is the angle from 31 degree on the plane of the sky"));
    EXPECT_EQ(valuesOf<std::int16_t>(*reader), ramp<std::int16_t>(24));
}

TEST(Fits, PixelsWithoutStepsAreCountedAndTurnedAxesAreTold) {
    const auto counted = openWritten(slab({"CDELT2  = 0.0"}));
    EXPECT_EQ(counted->variables()[0].grid->axes()[1].units, "index");
    EXPECT_THAT(counted->variables()[0].notes,
                testing::Contains(HasSubstr("y is placed by index")));
    const auto turned =
        openWritten(slab({"CD1_1   = 2.0", "CD2_2   = 2.0", "CDELT3  = 1.0", "CD1_2   = 0.5"}));
    EXPECT_EQ(turned->variables()[0].grid->axes()[0].coordinates, (std::vector<double>{2, 4}));
    EXPECT_NEAR(turned->variables()[0].grid->axes()[1].coordinates[0], std::hypot(0.5, 2), 1e-12);
    EXPECT_THAT(turned->variables()[0].notes, ElementsAre(HasSubstr("turned")));
    const auto mirrored = openWritten(slab(
        {"PC1_1   = -1.0", "CDELT1  = 0.5", "CDELT2  = 1.0", "PC3_3   = 1000.0", "CDELT3  = 2.0"}));
    const auto& axes = mirrored->variables()[0].grid->axes();
    EXPECT_EQ(axes[0].coordinates, (std::vector<double>{-0.5, -1}));
    EXPECT_EQ(axes[2].coordinates[1] - axes[2].coordinates[0], 2000);
}

// CTYPE's last three letters (FITS 4.0, table 26).
TEST(Fits, AxesThatAreNotEvenAreUnevenOrCounted) {
    const auto placed = [](const char* type) {
        return openWritten(slab({fmt::format("CTYPE3  = '{}'", type), "CRVAL3  = 100.0",
                                 "CDELT3  = 10.0", "CRPIX3  = 1.0"}));
    };
    const auto log = placed("WAVE-LOG");
    const auto& axis = log->variables()[0].grid->axes()[2];
    EXPECT_EQ(axis.name, "WAVE");
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(axis.coordinates[i], 100 * std::exp(0.1 * static_cast<double>(i)), 1e-12);
    for (const char* type : {"WAVE-TAB", "VOPT-F2W", "WAVE-GRI"}) {
        const auto counted = placed(type);
        EXPECT_EQ(counted->variables()[0].grid->axes()[2].units, "index") << type;
        EXPECT_THAT(counted->variables()[0].notes, testing::Contains(HasSubstr(type)));
    }
    EXPECT_THAT(placed("FREQ-LSR")->variables()[0].grid->axes()[2].coordinates,
                ElementsAre(100, 110, 120, 130))
        << "of an older convention, even";
}

TEST(Fits, AxesMayBeOfEachOthersCoordinates) {
    const auto reader = openWritten(
        slab({"CTYPE1  = 'XX'", "CTYPE2  = 'YY'", "PC1_1   = 0.0", "PC2_2   = 0.0", "PC1_2   = 1.0",
              "PC2_1   = -1.0", "CDELT1  = 2.0", "CDELT2  = 3.0", "CUNIT1  = 'm'", "CUNIT2  = 's'",
              "CRVAL1  = 10.0", "CRVAL2  = 20.0", "CRPIX1  = 1.0", "CRPIX2  = 1.0"}));
    const auto& axes = reader->variables()[0].grid->axes();
    EXPECT_EQ(axes[0].name, "YY");
    EXPECT_EQ(axes[0].units, "s");
    EXPECT_THAT(axes[0].coordinates, ElementsAre(20, 17));
    EXPECT_EQ(axes[1].name, "XX");
    EXPECT_EQ(axes[1].units, "m");
    EXPECT_THAT(axes[1].coordinates, ElementsAre(10, 12, 14));
    EXPECT_THAT(reader->variables()[0].notes, testing::Each(testing::Not(HasSubstr("turned"))));
}

template <typename T, typename Stored>
void expectValues(int bitpix, const std::vector<std::string>& more, double zero) {
    std::vector<Stored> stored = ramp<Stored>(24);
    stored[1] = std::numeric_limits<Stored>::lowest();
    stored[2] = std::numeric_limits<Stored>::max();
    const auto reader =
        openWritten(image(bitpix, {2, 3, 4}, more, bytesOf(stored, std::endian::big)));
    const auto values = valuesOf<T>(*reader);
    ASSERT_EQ(values.size(), stored.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        EXPECT_EQ(values[i], static_cast<T>(static_cast<T>(stored[i]) + static_cast<T>(zero))) << i;
}

TEST(Fits, EveryTypeOfNumber) {
    expectValues<std::uint8_t, std::uint8_t>(8, {}, 0);
    expectValues<std::int16_t, std::int16_t>(16, {}, 0);
    expectValues<std::int32_t, std::int32_t>(32, {}, 0);
    expectValues<std::int64_t, std::int64_t>(64, {}, 0);
    expectValues<float, float>(-32, {}, 0);
    expectValues<double, double>(-64, {}, 0);
    // By an offset of half their range, with the other sign.
    expectValues<std::int8_t, std::uint8_t>(8, {"BZERO   = -128"}, -128);
    expectValues<std::uint16_t, std::int16_t>(16, {"BZERO   = 32768"}, 32768);
    expectValues<std::uint32_t, std::int32_t>(32, {"BZERO   = 2147483648"}, 2147483648.0);
    expectValues<std::uint64_t, std::int64_t>(64, {"BZERO   = 9223372036854775808"},
                                              9223372036854775808.0);
}

TEST(Fits, UnsignedIntegersOf64BitsAreExact) {
    constexpr auto kLeast = std::numeric_limits<std::int64_t>::lowest();
    for (const std::uint64_t first : {std::uint64_t{0}, std::uint64_t{1} << 60,
                                      (std::uint64_t{1} << 63) - 12, ~std::uint64_t{23}}) {
        std::vector<std::int64_t> stored;
        std::vector<std::uint64_t> expected;
        for (std::uint64_t i = 0; i < 24; ++i) {
            expected.push_back(first + i);
            stored.push_back(static_cast<std::int64_t>(first + i) ^ kLeast);
        }
        const auto reader = openWritten(image(
            64, {2, 3, 4}, {"BZERO   =  9223372036854775808", "BSCALE  =                    1"},
            bytesOf(stored, std::endian::big)));
        EXPECT_EQ(valuesOf<std::uint64_t>(*reader), expected) << first;
    }
}

// Doubles would hold none of these.
TEST(Fits, IntegersWithAnOffsetAreExact) {
    const auto most = std::numeric_limits<std::int64_t>::max();
    for (const auto& [offset, first] :
         std::vector<std::pair<std::int64_t, std::int64_t>>{{1, (1ll << 60) + 1},
                                                            {-3, most - 30},
                                                            {most, -most - 1},
                                                            {1ll << 62, -20},
                                                            {7, -12}}) {
        std::vector<std::int64_t> stored, expected;
        for (std::int64_t i = 0; i < 24; ++i) {
            stored.push_back(first + i);
            expected.push_back(first + i + offset);
        }
        const auto reader = openWritten(image(64, {2, 3, 4}, {fmt::format("BZERO   = {}", offset)},
                                              bytesOf(stored, std::endian::big)));
        EXPECT_EQ(valuesOf<std::int64_t>(*reader), expected) << offset;
        EXPECT_EQ(reader->variables()[0].type, ValueType::I64);
        EXPECT_EQ(reader->variables()[0].storedAs, fmt::format("BITPIX 64, offset {}", offset));
    }
    // Of 16 bits, too, where the offset alone is as large.
    const auto far = openWritten(slab({"BZERO   = 1152921504606846977"}));
    EXPECT_EQ(valuesOf<std::int64_t>(*far)[5], (1ll << 60) + 1 + 5);
    EXPECT_EQ(openWritten(slab({"BZERO   = 5"}))->variables()[0].type, ValueType::F64);
}

TEST(Fits, IntegersBeyond64BitsAreRefusedUnlessBlank) {
    const auto most = std::numeric_limits<std::int64_t>::max();
    std::vector<std::int64_t> stored(24, most - 1);
    stored[3] = most;
    const std::string bytes = bytesOf(stored, std::endian::big);
    const auto reader = openWritten(image(64, {2, 3, 4}, {"BZERO   = 1"}, bytes));
    EXPECT_THROW(
        {
            try {
                reader->read(0, 0);
            } catch (const FileError& error) {
                EXPECT_THAT(error.what(),
                            HasSubstr("expected values of 64 bits, found 9223372036854775807 with "
                                      "BZERO 1"));
                throw;
            }
        },
        FileError);
    const auto blank =
        openWritten(image(64, {2, 3, 4}, {"BZERO   = 1", "BLANK   = 9223372036854775807"}, bytes));
    const Field field = blank->read(0, 0);
    for (std::size_t i = 0; i < 24; ++i) EXPECT_EQ(field.missing[i], i == 3);
    EXPECT_EQ(std::get<std::vector<std::int64_t>>(field.values)[4], most);
    for (const char* zero : {"1.0E19", "-1.0E19", "9223372036854777856"})
        EXPECT_THROW(openWritten(image(64, {2, 3, 4}, {std::string("BZERO   = ") + zero}, bytes)),
                     FileError)
            << zero;
}

TEST(Fits, BlankPixelsAreMissing) {
    std::vector<std::int16_t> stored = ramp<std::int16_t>(24);
    stored[5] = -99;
    const std::string bytes = bytesOf(stored, std::endian::big);
    for (const std::string zero : {"0", "32768"}) {
        const Field field =
            openWritten(image(16, {2, 3, 4}, {"BLANK   = -99", "BZERO   = " + zero}, bytes))
                ->read(0, 0);
        ASSERT_EQ(field.missing.size(), 24u);
        for (std::size_t i = 0; i < 24; ++i) EXPECT_EQ(field.missing[i], i == 5) << zero;
    }
    // Scaled ones are doubles, of which a blank one is no number.
    const auto scaled = openWritten(
        image(16, {2, 3, 4}, {"BLANK   = -99", "BSCALE  = 0.5", "BZERO   = 10"}, bytes));
    const auto values = valuesOf<double>(*scaled);
    for (std::size_t i = 0; i < 24; ++i) {
        if (i == 5)
            EXPECT_TRUE(std::isnan(values[i]));
        else
            EXPECT_EQ(values[i], 10 + 0.5 * static_cast<double>(i));
    }
    EXPECT_THAT(openWritten(slab({"BLANK   = -99"}))->read(0, 0).missing, IsEmpty());
}

// Whatever their bits, scales and offsets.
template <typename Stored>
void expectScaled(int bitpix, const std::string& scale, const std::string& zero) {
    std::vector<Stored> stored = ramp<Stored>(24);
    stored[3] = std::numeric_limits<Stored>::max();
    const auto reader = openWritten(
        image(bitpix, {2, 3, 4}, {"BSCALE  = " + scale, "BZERO   = " + zero, "BLANK   = 7"},
              bytesOf(stored, std::endian::big)));
    const auto values = valuesOf<double>(*reader);
    for (std::size_t i = 0; i < 24; ++i) {
        if (i == 7) {
            EXPECT_TRUE(std::isnan(values[i])) << bitpix;
            continue;
        }
        const double expected = static_cast<double>(stored[i]) * std::stod(scale) + std::stod(zero);
        EXPECT_NEAR(values[i], expected, 1e-15 * std::abs(expected)) << bitpix << ' ' << i;
    }
}

TEST(Fits, ScaledIntegersAreDoubles) {
    for (const auto& [scale, zero] :
         {std::pair("3", "0"), {"0.1", "0"}, {"0.001", "2451545"}, {"1", "5"}, {"-2", "32768"}}) {
        expectScaled<std::uint8_t>(8, scale, zero);
        expectScaled<std::int16_t>(16, scale, zero);
        expectScaled<std::int32_t>(32, scale, zero);
        if (scale != std::string("1")) expectScaled<std::int64_t>(64, scale, zero);
    }
}

TEST(Fits, FloatsAreAsStored) {
    std::vector<float> stored = ramp<float>(24);
    stored[1] = std::numeric_limits<float>::infinity();
    stored[2] = -stored[1];
    stored[3] = 1e-40f;
    stored[4] = std::nanf("");
    const auto values =
        valuesOf<float>(*openWritten(image(-32, {2, 3, 4}, {}, bytesOf(stored, std::endian::big))));
    for (std::size_t i = 0; i < 24; ++i) {
        if (i == 4)
            EXPECT_TRUE(std::isnan(values[i]));
        else
            EXPECT_EQ(values[i], stored[i]) << i;
    }
}

TEST(Fits, ScaledFloatsKeepInfinities) {
    std::vector<float> stored = ramp<float>(24);
    stored[1] = std::numeric_limits<float>::infinity();
    stored[3] = 1e-40f;
    const auto values = valuesOf<double>(
        *openWritten(image(-32, {2, 3, 4}, {"BSCALE  = 2.0"}, bytesOf(stored, std::endian::big))));
    for (std::size_t i = 0; i < 24; ++i) EXPECT_EQ(values[i], 2 * static_cast<double>(stored[i]));
}

TEST(Fits, AFourthAxisIsTimeAndOneOfOnePixelIsNone) {
    const std::string bytes = bytesOf(ramp<std::int16_t>(24), std::endian::big);
    const auto one = openWritten(image(16, {2, 3, 4, 1}, {}, bytes));
    EXPECT_EQ(one->variables()[0].time->points.size(), 1u);
    // Time may be any of them.
    const auto first = openWritten(
        image(16, {2, 3, 4},
              {"CTYPE1  = 'TIME'", "CRPIX1  = 1.0", "CRVAL1  = 5.0", "CDELT1  = 0.5"}, bytes));
    const TimeAxis& time = *first->variables()[0].time;
    ASSERT_EQ(time.points.size(), 2u);
    EXPECT_EQ(time.points[1].value, 5.5);
    EXPECT_EQ(time.units, "s");
    const auto odd = valuesOf<std::int16_t>(*first, 1);
    ASSERT_EQ(odd.size(), 12u);
    for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(odd[i], static_cast<std::int16_t>(2 * i + 1));
    const auto last = openWritten(image(16, {2, 3, 2, 2}, {"CTYPE4  = 'BEAM'"}, bytes));
    EXPECT_EQ(valuesOf<std::int16_t>(*last, 1)[0], 12);
    const auto endless =
        openWritten(image(16, {2, 3, 4}, {"CTYPE3  = 'TIME'", "CDELT3  = 1E308"}, bytes));
    EXPECT_TRUE(endless->variables()[0].time->counted);
    EXPECT_THAT(last->variables()[0].notes,
                testing::Contains("BEAM is taken for time: no axis says that it is"));
}

std::vector<std::string> namesOf(const Reader& reader) {
    std::vector<std::string> all;
    for (const Variable& variable : reader.variables()) all.push_back(variable.name);
    return all;
}

// As AIPS orders them: frequencies come last, and are no time.
TEST(Fits, PolarisationIsNoPlace) {
    const std::vector<std::string> keys{"CTYPE3  = 'STOKES'", "CRVAL3  = 1.0",    "CRPIX3  = 1.0",
                                        "CDELT3  = 1.0",      "CTYPE4  = 'FREQ'", "CRVAL4  = 1.0E9",
                                        "CRPIX4  = 1.0",      "CDELT4  = 1.0E6"};
    const auto reader = openWritten(
        image(16, {2, 3, 4, 5}, keys, bytesOf(ramp<std::int16_t>(120), std::endian::big)));
    ASSERT_THAT(namesOf(*reader), ElementsAre("STOKES=I", "STOKES=Q", "STOKES=U", "STOKES=V"));
    for (std::size_t v = 0; v < 4; ++v) {
        const Variable& plane = reader->variables()[v];
        EXPECT_EQ(plane.grid->size(), (std::array<std::size_t, 3>{2, 3, 5}));
        EXPECT_EQ(plane.grid->axes()[2].name, "FREQ");
        EXPECT_EQ(plane.time->points.size(), 1u);
        const auto values = std::get<std::vector<std::int16_t>>(reader->read(v, 0).values);
        for (std::size_t i = 0; i < 30; ++i)
            EXPECT_EQ(values[i], i % 6 + 6 * (v + 4 * (i / 6))) << v << ' ' << i;
    }
    // Circular ones count down from -1.
    const auto flat = openWritten(image(16, {2, 3, 2},
                                        {"CTYPE3  = 'STOKES'", "CRVAL3  = -1.0", "CRPIX3  = 1.0",
                                         "CDELT3  = -1.0", "EXTNAME = 'beam'"},
                                        bytesOf(ramp<std::int16_t>(12), std::endian::big)));
    ASSERT_THAT(namesOf(*flat), ElementsAre("beam:STOKES=RR", "beam:STOKES=LL"));
    EXPECT_EQ(flat->variables()[1].grid->size(), (std::array<std::size_t, 3>{2, 3, 1}));
}

TEST(Fits, EveryImageIsAVariable) {
    const std::string bytes = bytesOf(ramp<std::int16_t>(24), std::endian::big);
    const std::string extension = "XTENSION= 'IMAGE   '";
    const std::vector<std::string> own{"PCOUNT  = 0", "GCOUNT  = 1"};
    auto named = own;
    named.push_back("EXTNAME = 'ERROR'");
    const auto reader =
        openWritten(image(16, {}, {}, "") + image(16, {2, 3, 4}, own, bytes, extension) +
                    image(16, {2, 3, 4}, named, bytes, extension) +
                    image(16, {2, 3, 4}, named, bytes, extension));
    ASSERT_EQ(reader->variables().size(), 3u);
    EXPECT_TRUE(reader->variables()[0].nameless);
    EXPECT_EQ(reader->variables()[1].name, "ERROR");
    EXPECT_EQ(reader->variables()[2].name, "ERROR (HDU 4)");
    EXPECT_EQ(std::get<std::vector<std::int16_t>>(reader->read(1, 0).values),
              ramp<std::int16_t>(24));
}

TEST(Fits, ImagesCompressedByTiles) {
    const auto path = freshFolder() / "packed.fits";
    std::vector<std::int32_t> values(40 * 30 * 20);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = static_cast<std::int32_t>(i / 100 % 50);
    for (const int method : {RICE_1, GZIP_2}) {
        std::filesystem::remove(path);
        fitsfile* file = nullptr;
        int status = 0;
        std::array<long, 3> axes{40, 30, 20};
        fits_create_diskfile(&file, path.c_str(), &status);
        fits_set_compression_type(file, method, &status);
        fits_create_img(file, LONG_IMG, 3, axes.data(), &status);
        fits_write_img(file, TINT, 1, static_cast<LONGLONG>(values.size()), values.data(), &status);
        fits_close_file(file, &status);
        ASSERT_EQ(status, 0);
        EXPECT_LT(std::filesystem::file_size(path), values.size() * 4 / 2);
        EXPECT_EQ(valuesOf<std::int32_t>(*open(path)), values);
    }
}

TEST(RealFits, ACubeIsReadAsItsHeaderSays) {
    const auto path = tests::sharedData("grids/example_cube.fits");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no real data at " << path;
    const auto reader = open(path);
    const Variable& variable = reader->variables()[0];
    EXPECT_THAT(variable.grid->size(), ElementsAre(3, 4, 7));
    EXPECT_EQ(variable.units, "Jy/beam");
    const auto values = valuesOf<float>(*reader);
    EXPECT_FLOAT_EQ(*std::ranges::min_element(values), -0.1408792659640e-1f);  // DATAMIN
    EXPECT_FLOAT_EQ(*std::ranges::max_element(values), 0.1936739496887e-1f);
}

}  // namespace
}  // namespace timeseries
