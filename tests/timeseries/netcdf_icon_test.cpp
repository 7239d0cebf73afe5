// Output of ICON as its library, CDI, writes it: cells by their vertices in radians, days in
// decimals of a date, heights that are a mesh's levels.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "tests/support/netcdf_builder.h"
#include "tests/support/read_variables.h"
#include "tests/support/unstructured.h"
#include "timeseries/readers/reader.h"

namespace timeseries::netcdf_icon {
namespace {

using tests::NetcdfBuilder;

// An octahedron, each of whose sides is cut into four: longitudes and latitudes of the corners.
constexpr std::size_t kCells = 32, kLevels = 3, kSteps = 2;
using Triangle = std::array<glm::dvec3, 3>;
std::vector<Triangle> cells() {
    std::vector<Triangle> all;
    for (const double x : {-1.0, 1.0})
        for (const double y : {-1.0, 1.0})
            for (const double z : {-1.0, 1.0}) {
                const glm::dvec3 a(x, 0, 0), b(0, y, 0), c(0, 0, z);
                const auto ab = glm::normalize(a + b), bc = glm::normalize(b + c),
                           ca = glm::normalize(c + a);
                for (const Triangle& cell : {Triangle{a, ab, ca}, Triangle{b, bc, ab},
                                             Triangle{c, ca, bc}, Triangle{ab, bc, ca}})
                    all.push_back(cell);
            }
    return all;
}

glm::dvec3 middleOf(const Triangle& cell) { return glm::normalize(cell[0] + cell[1] + cell[2]); }
double longitude(const glm::dvec3& at) { return std::atan2(at.y, at.x); }
double latitude(const glm::dvec3& at) { return std::asin(at.z); }
float valueOf(std::size_t step, std::size_t level, std::size_t cell) {
    return static_cast<float>(1000 * step + 100 * level + cell);
}

std::filesystem::path written() {
    NetcdfBuilder file("icon.nc");
    const int steps = file.dimension("time", NC_UNLIMITED),
              ncells = file.dimension("ncells", kCells), vertices = file.dimension("vertices", 3);
    const auto height = file.coordinate("height", kLevels, "");
    file.text(height.variable, "standard_name", "height");
    file.text(height.variable, "axis", "Z");
    const int time = file.variable("time", NC_DOUBLE, {steps});
    file.text(time, "standard_name", "time");
    file.text(time, "units", "day as %Y%m%d.%f");
    file.text(time, "calendar", "proleptic_gregorian");
    std::array<int, 2> centres{}, corners{};
    for (const std::size_t a : {0u, 1u}) {
        const std::string name = a == 0 ? "clon" : "clat";
        centres[a] = file.variable(name, NC_DOUBLE, {ncells});
        file.text(centres[a], "standard_name", a == 0 ? "longitude" : "latitude");
        file.text(centres[a], "units", "radian");
        file.text(centres[a], "bounds", name + "_vertices");
        corners[a] = file.variable(name + "_vertices", NC_DOUBLE, {ncells, vertices});
        file.text(corners[a], "units", "radian");
    }
    const int temp = file.variable("temp", NC_FLOAT, {steps, height.dimension, ncells});
    file.text(temp, "units", "K");
    file.text(temp, "CDI_grid_type", "unstructured");
    file.number(temp, "number_of_grid_in_reference", std::int32_t{1});
    file.text(temp, "coordinates", "clat clon");

    for (const std::size_t a : {0u, 1u}) {
        const auto angle = a == 0 ? longitude : latitude;
        std::vector<double> own, around;
        for (const Triangle& cell : cells()) {
            own.push_back(angle(middleOf(cell)));
            for (const glm::dvec3& corner : cell) around.push_back(angle(corner));
        }
        file.write(centres[a], own);
        file.write(corners[a], around);
    }
    file.write(height.variable, std::vector<double>{1, 2, 3});
    file.write(time, {0}, {kSteps}, std::vector<double>{20200131.75, 20200201.25});
    std::vector<float> values;
    for (std::size_t s = 0; s < kSteps; ++s)
        for (std::size_t k = 0; k < kLevels; ++k)
            for (std::size_t c = 0; c < kCells; ++c) values.push_back(valueOf(s, k, c));
    file.write(temp, {0, 0, 0}, {kSteps, kLevels, kCells}, values);
    return file.close();
}

TEST(NetcdfIcon, CellsAreAtTheirCentresOnTheirLevels) {
    const auto reader = tests::open(written());
    ASSERT_EQ(tests::namesOf(*reader), std::vector<std::string>{"temp"});
    const Variable& temp = reader->variables()[0];
    EXPECT_EQ(temp.time->points[0].date, "2020-01-31 18:00:00");
    EXPECT_EQ(temp.time->points[1].date, "2020-02-01 06:00:00");
    ASSERT_EQ(temp.grid->count(), kLevels * kCells);
    const auto all = cells();
    for (std::size_t s = 0; s < kSteps; ++s) {
        const Field field = reader->read(0, s);
        for (std::size_t k = 0; k < kLevels; ++k)
            for (std::size_t c = 0; c < kCells; ++c) {
                const std::size_t index = k * kCells + c;
                EXPECT_EQ(std::get<std::vector<float>>(field.values)[index], valueOf(s, k, c));
                const glm::dvec3 at = field.grid->position(index), middle = middleOf(all[c]);
                const double degrees = 180 / std::numbers::pi;
                EXPECT_NEAR(std::remainder(at.x - degrees * longitude(middle), 360), 0, 1e-4) << c;
                EXPECT_NEAR(at.y, degrees * latitude(middle), 1e-4) << c;
                EXPECT_EQ(at.z, 1 + double(k));
            }
    }
}

}  // namespace
}  // namespace timeseries::netcdf_icon
