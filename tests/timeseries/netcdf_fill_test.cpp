// Which stored numbers are missing: fill values, missing_value, valid ranges.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/netcdf_plane.h"
#include "tests/support/read_variables.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

using testing::ElementsAre;
using tests::asValues;
using tests::ncType;
using tests::NetcdfBuilder;
using tests::open;
using tests::plane;
using Path = std::filesystem::path;

TEST(NetcdfFill, UnsignedAttributeTurnsBytesAndTheirFill) {
    const auto path = plane<std::int8_t>(
        "a.nc", {-1, -2, 0, 127},
        [](auto& file, int v) {
            file.text(v, "_Unsigned", "true");
            file.template number<std::int8_t>(v, "_FillValue", -1);
            file.template number<std::int8_t>(v, "valid_range", {1, -2});  // 1 to 254
        },
        NC_CLASSIC_MODEL);
    const auto reader = open(path);
    EXPECT_EQ(reader->variables()[0].missing, "_FillValue 255, outside 1..254");
    const Field field = reader->read(0, 0);
    EXPECT_THAT(asValues<std::uint8_t>(field), ElementsAre(255, 254, 0, 127));
    EXPECT_THAT(field.missing, ElementsAre(true, false, true, false));
}

// What the library itself leaves where nothing was written is missing, and nothing else: not the
// fill of the type that the values are meant as.
template <typename T, typename Meant>
void expectFillOfTheStoredType(const char* sign, Meant fillOfMeant) {
    NetcdfBuilder file("a.nc");
    const int y = file.dimension("y", 2), x = file.dimension("x", 2);
    const int v = file.variable("v", ncType<T>(), {y, x});
    file.text(v, "_Unsigned", sign);
    file.write(v, {0, 0}, {1, 2}, std::vector<T>{static_cast<T>(fillOfMeant), 5});
    const auto reader = open(file.close());
    const Field field = reader->read(0, 0);
    const std::vector<Meant>& values = asValues<Meant>(field);
    EXPECT_EQ(values[0], fillOfMeant);
    EXPECT_THAT(field.missing, ElementsAre(false, false, true, true)) << sign << sizeof(T);
    EXPECT_EQ(reader->variables()[0].missing, fmt::format("netCDF's default fill {}", values[2]));
}

TEST(NetcdfFill, TheDefaultFillIsOfTheStoredTypeWhateverTheUnsignedAttributeSays) {
    expectFillOfTheStoredType<std::int16_t>("true", std::uint16_t{NC_FILL_USHORT});
    expectFillOfTheStoredType<std::int32_t>("true", std::uint32_t{NC_FILL_UINT});
    expectFillOfTheStoredType<std::int64_t>("true", std::uint64_t{NC_FILL_UINT64});
    expectFillOfTheStoredType<std::uint16_t>("false", std::int16_t{NC_FILL_SHORT});
    expectFillOfTheStoredType<std::uint32_t>("false", std::int32_t{NC_FILL_INT});
    expectFillOfTheStoredType<std::uint64_t>("false", std::int64_t{NC_FILL_INT64});
}

TEST(NetcdfFill, ClassicFilesHaveDefaultFillsToo) {
    const auto path = plane<float>(
        "a.nc", {NC_FILL_FLOAT, 5, 6, 7}, [](auto&, int) {}, 0);
    const auto reader = open(path);
    EXPECT_EQ(reader->variables()[0].missing, "netCDF's default fill 9.96921e+36");
    EXPECT_THAT(reader->read(0, 0).missing, ElementsAre(true, false, false, false));
}

TEST(NetcdfFill, TurnedStepsAreUnpackedAndMaskedInTheirNewPlace) {
    NetcdfBuilder file("a.nc");
    const int x = file.dimension("x", 2), t = file.dimension("time", 2), y = file.dimension("y", 3);
    const int v = file.variable("v", NC_SHORT, {x, t, y});
    file.number(v, "add_offset", 100.0);
    file.number<std::int16_t>(v, "_FillValue", 7);
    // x 0: t 0: y 0..2, t 1: y 0..2; x 1: the same.
    file.write(v, std::vector<std::int16_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
    const auto reader = open(file.close());
    const Field field = reader->read(0, 0);
    EXPECT_THAT(asValues<double>(field), ElementsAre(100, 106, 101, 107, 102, 108));
    EXPECT_THAT(field.missing, ElementsAre(false, false, false, true, false, false));
}

TEST(NetcdfFill, MissingValuesMayBeSeveral) {
    const auto path = plane<float>("a.nc", {1, -9, -99, -9.5f}, [](auto& file, int v) {
        file.number(v, "missing_value", std::vector<double>{-9, -99});
    });
    const auto reader = open(path);
    EXPECT_THAT(reader->variables()[0].missing, HasSubstr("missing_value -9, missing_value -99"));
    EXPECT_THAT(reader->read(0, 0).missing, ElementsAre(false, true, true, false));
}

TEST(NetcdfFill, MissingValuesMayBeSpelt) {
    const auto path = plane<float>("a.nc", {1, -9, 1e20f, -9.5f}, [](auto& file, int v) {
        file.text(v, "missing_value", "-9. 1e20");
    });
    const auto reader = open(path);
    EXPECT_THAT(reader->variables()[0].missing, HasSubstr("missing_value -9, missing_value 1e+20"));
    EXPECT_THAT(reader->read(0, 0).missing, ElementsAre(false, true, true, false));
}

TEST(NetcdfFill, FillOfAnotherTypeIsTheNearestOfTheVariables) {
    // 1e20 as a double is not the float 1e20, but means it.
    const auto path = plane<float>("a.nc", {1, 1e20f, 1.0001e20f, 2}, [](auto& file, int v) {
        file.number(v, "missing_value", 1e20);
    });
    EXPECT_THAT(open(path)->read(0, 0).missing, ElementsAre(false, true, false, false));
}

TEST(NetcdfFill, ValidRangeIsInStoredValuesUnlessItHasTheScalesType) {
    const auto stored = plane<std::int16_t>("a.nc", {9, 10, 20, 21}, [](auto& file, int v) {
        file.number(v, "scale_factor", 0.5);
        file.template number<std::int16_t>(v, "valid_min", 10);
        file.template number<std::int16_t>(v, "valid_max", 20);
    });
    EXPECT_THAT(open(stored)->read(0, 0).missing, ElementsAre(true, false, false, true));
    const auto unpacked = plane<std::int16_t>("b.nc", {9, 10, 20, 21}, [](auto& file, int v) {
        file.number(v, "scale_factor", 0.5);
        file.number(v, "valid_range", std::vector<double>{4.75, 10});
    });
    EXPECT_THAT(open(unpacked)->read(0, 0).missing, ElementsAre(true, false, false, true));
}

// Of floats that doubles unpack, a range of doubles is wider than what is stored; of floats that
// floats unpack, one of any type is not of the scale's.
TEST(NetcdfFill, ValidRangeOfScaledFloatsIsInTheWiderType) {
    const auto missingOf = [](auto scale) {
        return open(plane<float>("a.nc", {1, 2, 4, 8},
                                 [&](auto& file, int v) {
                                     file.number(v, "scale_factor", scale);
                                     file.number(v, "valid_range", std::vector<double>{4, 10});
                                 }))
            ->read(0, 0)
            .missing;
    };
    EXPECT_THAT(missingOf(2.0), ElementsAre(true, false, false, true)) << "2, 4, 8, 16";
    EXPECT_THAT(missingOf(2.0f), ElementsAre(true, true, false, false)) << "1, 2, 4, 8";
}

TEST(NetcdfFill, DefaultFillIsMissingExceptInBytes) {
    const auto shorts =
        plane<std::int16_t>("a.nc", {NC_FILL_SHORT, -32766, -32768, 1}, [](auto&, int) {});
    EXPECT_THAT(open(shorts)->read(0, 0).missing, ElementsAre(true, false, false, false));
    const auto bytes = plane<std::int8_t>("b.nc", {NC_FILL_BYTE, -128, 127, 1}, [](auto&, int) {});
    EXPECT_TRUE(open(bytes)->read(0, 0).missing.empty());
    const auto floats = plane<float>(
        "c.nc", {NC_FILL_FLOAT, std::nextafter(NC_FILL_FLOAT, 0.0f), 1, 2}, [](auto&, int) {});
    EXPECT_THAT(open(floats)->read(0, 0).missing, ElementsAre(true, false, false, false));
    // A _FillValue of its own takes the default's place; a variable that is not filled has none.
    const auto own = plane<std::int16_t>("d.nc", {NC_FILL_SHORT, 5, 6, 7}, [](auto& file, int v) {
        file.template number<std::int16_t>(v, "_FillValue", 5);
    });
    EXPECT_THAT(open(own)->read(0, 0).missing, ElementsAre(false, true, false, false));
    const auto noFill =
        plane<std::int16_t>("e.nc", {NC_FILL_SHORT, 5, 6, 7}, [](auto& file, int v) {
            NetcdfBuilder::check(nc_def_var_fill(file.id(), v, NC_NOFILL, nullptr));
        });
    EXPECT_TRUE(open(noFill)->read(0, 0).missing.empty());
}

TEST(NetcdfFill, NanIsLeftUnmarkedAlsoAsFillAndInValidRanges) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto path = plane<float>("a.nc", {1, nan, 7, 3}, [&](auto& file, int v) {
        file.number(v, "_FillValue", nan);
        file.number(v, "valid_max", 5.0f);
    });
    const Field field = open(path)->read(0, 0);
    EXPECT_TRUE(std::isnan(asValues<float>(field)[1]));
    EXPECT_THAT(field.missing, ElementsAre(false, false, true, false));
}

}  // namespace
}  // namespace timeseries
