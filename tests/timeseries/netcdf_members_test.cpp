// Variables with dimensions that are no axes: each place along these is a field of its own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/support/netcdf_builder.h"
#include "tests/support/read_variables.h"

namespace timeseries {
namespace {

using testing::ElementsAre;
using tests::namesOf;
using tests::NetcdfBuilder;
using tests::open;

// v(time, number, z, y, x) and w(z, y, wavelength, x, time, member), whose values say where they
// stand.
std::filesystem::path written(const std::string& name, std::vector<double> wavelengths,
                              int runs = 2) {
    NetcdfBuilder file(name);
    const int t = file.dimension("time", 2), number = file.dimension("number", std::size_t(runs)),
              z = file.dimension("z", 4), y = file.dimension("y", 3), x = file.dimension("x", 5),
              band = file.dimension("wavelength", 3), kind = file.dimension("member", 2);
    const int times = file.variable("time", NC_DOUBLE, {t});
    file.text(times, "units", "days since 2000-01-01");
    const int bands = file.variable("wavelength", NC_FLOAT, {band});
    file.text(bands, "units", "nm");
    const int v = file.variable("v", NC_INT, {t, number, z, y, x});
    const int w = file.variable("w", NC_INT, {z, y, band, x, t, kind});
    file.text(w, "long_name", "radiance");
    file.write(times, std::vector<double>{0, 1});
    file.write(bands, std::vector<float>(wavelengths.begin(), wavelengths.end()));
    std::vector<std::int32_t> values;
    for (int time = 0; time < 2; ++time)
        for (int run = 0; run < runs; ++run)
            for (int i = 0; i < 4 * 3 * 5; ++i) values.push_back(1000 * time + 100 * run + i);
    file.write(v, values);
    values.clear();
    for (int row = 0; row < 4 * 3; ++row)
        for (int b = 0; b < 3; ++b)
            for (int i = 0; i < 5; ++i)
                for (int time = 0; time < 2; ++time)
                    for (int k = 0; k < 2; ++k)
                        values.push_back(10000 * b + 1000 * k + 100 * time + 5 * row + i);
    file.write(w, values);
    return file.close();
}

TEST(NetcdfMembers, AreVariablesOfTheirOwn) {
    const auto reader = open(written("a.nc", {355, 532.5, 1064}));
    EXPECT_THAT(namesOf(*reader),
                ElementsAre("v:number=0", "v:number=1", "w:wavelength=355,member=0",
                            "w:wavelength=355,member=1", "w:wavelength=532.5,member=0",
                            "w:wavelength=532.5,member=1", "w:wavelength=1064,member=0",
                            "w:wavelength=1064,member=1"));
    EXPECT_EQ(reader->variables()[0].longName, "");
    EXPECT_EQ(reader->variables()[5].longName, "radiance, wavelength 532.5 nm, member 1");
    EXPECT_TRUE(reader->damaged().empty());
    for (int time = 0; time < 2; ++time) {
        const auto step = static_cast<std::size_t>(time);
        for (int run = 0; run < 2; ++run) {
            const Field field = reader->read(static_cast<std::size_t>(run), step);
            const auto& values = std::get<std::vector<std::int32_t>>(field.values);
            ASSERT_EQ(values.size(), 60u);
            for (int i = 0; i < 60; ++i)
                EXPECT_EQ(values[std::size_t(i)], 1000 * time + 100 * run + i);
        }
        for (int member = 0; member < 6; ++member) {
            const Field field = reader->read(static_cast<std::size_t>(2 + member), step);
            const auto& values = std::get<std::vector<std::int32_t>>(field.values);
            ASSERT_EQ(values.size(), 60u);
            for (int i = 0; i < 60; ++i)
                EXPECT_EQ(values[std::size_t(i)],
                          10000 * (member / 2) + 1000 * (member % 2) + 100 * time + i);
        }
    }
}

// A slab of one is of this one.
TEST(NetcdfMembers, AreReadInSlabs) {
    const auto reader = open(written("a.nc", {355, 532.5, 1064}));
    Field field;
    reader->readSlab(1, 1, {.axis = 2, .first = 1, .count = 2}, field);
    const auto& values = std::get<std::vector<std::int32_t>>(field.values);
    ASSERT_EQ(values.size(), 30u);
    for (int i = 0; i < 30; ++i) EXPECT_EQ(values[std::size_t(i)], 1100 + 15 + i);
}

// By their coordinate only where that tells them apart.
TEST(NetcdfMembers, AreCountedWhereTheirCoordinateDoesNotTellThem) {
    for (const std::vector<double>& bands :
         {std::vector<double>{355, 355, 1064}, {355, std::nan(""), 1064}})
        EXPECT_EQ(namesOf(*open(written("a.nc", bands)))[4], "w:wavelength=1,member=0");
}

TEST(NetcdfMembers, OfASeriesAreTheSameInEachFile) {
    const std::vector paths{written("a1.nc", {355, 532.5, 1064}),
                            written("a2.nc", {355, 532.5, 1064}, 3)};
    EXPECT_THAT(tests::refusalOf(paths),
                testing::HasSubstr("expected the same variables, found 'w:wavelength=355,member=0' "
                                   "and 'v:number=2'"));
}

}  // namespace
}  // namespace timeseries
