// Places whose longitudes begin anew are laid out as if these went on; values stay where they are.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/support/netcdf_axes.h"
#include "tests/support/ugrid.h"
#include "tests/support/unstructured.h"

namespace timeseries::netcdf_seam {
namespace {

using namespace timeseries::netcdf_axes;

// As a file has it whose longitudes begin at `least`.
double wrapped(double longitude, double least) {
    return longitude - 360 * std::floor((longitude - least) / 360);
}

using Place = std::function<glm::dvec2(double i, double j)>;
constexpr std::size_t kI = 12, kJ = 9;

// v(j, i) = 100 j + i at lon(j, i), lat(j, i).
std::unique_ptr<Reader> columnsAt(const Place& place, double least) {
    NetcdfBuilder file("a.nc");
    const int j = file.dimension("j", kJ), i = file.dimension("i", kI);
    const int lon = file.variable("lon", NC_DOUBLE, {j, i}),
              lat = file.variable("lat", NC_DOUBLE, {j, i}),
              v = file.variable("v", NC_FLOAT, {j, i});
    file.text(lon, "units", "degrees_east");
    file.text(lat, "units", "degrees_north");
    std::vector<double> lons, lats;
    std::vector<float> values;
    for (std::size_t n = 0; n < kI * kJ; ++n) {
        const glm::dvec2 at = place(double(n % kI), double(n / kI));
        lons.push_back(wrapped(at.x, least));
        lats.push_back(at.y);
        values.push_back(float(n / kI * 100 + n % kI));
    }
    file.write(lon, lons);
    file.write(lat, lats);
    file.write(v, values);
    return open(file.close());
}

void expectAt(Reader& reader, const Place& place, const std::string& of) {
    const Field field = reader.read(0, 0);
    const auto& values = std::get<std::vector<float>>(field.values);
    ASSERT_EQ(values.size(), kI * kJ);
    for (std::size_t n = 0; n < values.size(); ++n) {
        EXPECT_EQ(values[n], float(n / kI * 100 + n % kI));
        const glm::dvec2 at = place(double(n % kI), double(n / kI));
        const glm::dvec3 found = field.grid->position(n);
        ASSERT_EQ(std::isfinite(at.x), std::isfinite(found.x)) << of << ' ' << n;
        if (!std::isfinite(at.x)) continue;
        EXPECT_NEAR(found.x, at.x, 1e-4) << of << ' ' << n;
        EXPECT_NEAR(found.y, at.y, 1e-4) << of << ' ' << n;
    }
}

TEST(NetcdfSeam, OfTwoDimensionsLongitudesGoOn) {
    const auto region = [](double west) -> Place {
        return [west](double i, double j) { return glm::dvec2(west + 4 * i + 0.5 * j, 2 * j - i); };
    };
    expectAt(*columnsAt(region(150), -180), region(150), "the Pacific");
    expectAt(*columnsAt(region(150), 0), region(150), "the Pacific, without a seam");
    expectAt(*columnsAt(region(-20), 0), region(-20), "Greenwich");
    const Place holes = [&](double i, double j) {
        return i == 5 && j != 4 ? glm::dvec2(NAN) : region(150)(i, j);
    };
    expectAt(*columnsAt(holes, -180), holes, "with one way across");
    const Place backwards = [](double i, double j) { return glm::dvec2(190 - 3 * i, j); };
    expectAt(*columnsAt(backwards, -180), backwards, "backwards");
    const Place around = [](double i, double j) { return glm::dvec2(73 + 30 * i, 8 * j); };
    expectAt(*columnsAt(around, -180), around, "once around");
}

// There is no way to lay it out without one.
TEST(NetcdfSeam, AboutAPoleTheSeamStays) {
    const Place pole = [](double i, double j) {
        const double x = i - 5.5, y = j - 4.2;
        return glm::dvec2(wrapped(std::atan2(y, x) * 180 / std::numbers::pi, -180),
                          90 - std::hypot(x, y));
    };
    expectAt(*columnsAt(pole, -180), pole, "pole");
}

// Squares of 5 degrees along i and j, at their nodes and as faces.
std::unique_ptr<Reader> mesh(double west, double least, std::size_t across, bool atFaces) {
    NetcdfBuilder file("mesh.nc");
    const std::size_t ni = across + 1, nj = 4;
    const int node = file.dimension("node", ni * nj),
              face = file.dimension("face", across * (nj - 1)),
              corner = file.dimension("corner", 4);
    const auto variables = declareUgrid(file, node, face, corner, "degrees_east", "degrees_north");
    const int v = file.variable("v", NC_DOUBLE, {atFaces ? face : node});
    file.text(v, "mesh", "mesh");
    file.text(v, "location", atFaces ? "face" : "node");
    std::vector<double> x, y, values;
    std::vector<int> corners;
    for (std::size_t n = 0; n < ni * nj; ++n) {
        x.push_back(wrapped(west + 5 * double(n % ni), least));
        y.push_back(5 * double(n / ni));
        const bool isFace = n % ni < across && n / ni + 1 < nj;
        if (!atFaces || isFace) values.push_back(west + 5 * double(n % ni) + (atFaces ? 2.5 : 0));
        if (isFace)
            for (const std::size_t each : {n, n + 1, n + ni + 1, n + ni})
                corners.push_back(int(each));
    }
    file.write(variables.x, x);
    file.write(variables.y, y);
    file.write(variables.nodes, corners);
    file.write(v, values);
    return open(file.close());
}

TEST(NetcdfSeam, AMeshOfARegionIsInOnePiece) {
    for (const bool atFaces : {false, true})
        for (const auto& [west, least] :
             {std::pair(160.0, -180.0), {-20.0, 0.0}, {100.0, -180.0}}) {
            const auto reader = mesh(west, least, 9, atFaces);
            const Field field = reader->read(0, 0);
            const auto& values = std::get<std::vector<double>>(field.values);
            ASSERT_EQ(values.size(), atFaces ? 27u : 40u);
            for (std::size_t n = 0; n < values.size(); ++n)
                EXPECT_NEAR(field.grid->position(n).x, values[n], 1e-4) << west << ' ' << n;
            // As thick as cells are wide.
            EXPECT_NEAR(tests::volume(*field.grid->mesh()), 27 * 125, 1e-2);
        }
}

// Places of all longitudes stay where the file has them, and whole.
TEST(NetcdfSeam, AMeshOfAllLongitudesStays) {
    const auto reader = mesh(-177.5, -180, 71, false);
    const Field field = reader->read(0, 0);
    const auto& values = std::get<std::vector<double>>(field.values);
    for (std::size_t n = 0; n < values.size(); ++n)
        EXPECT_NEAR(field.grid->position(n).x, values[n], 1e-4);
}

}  // namespace
}  // namespace timeseries::netcdf_seam
