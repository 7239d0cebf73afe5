// Levels above the nodes and faces of a mesh whose heights a formula gives, or a variable.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/support/array_builder.h"
#include "tests/support/netcdf_builder.h"
#include "tests/support/read_variables.h"
#include "tests/support/ugrid.h"
#include "tests/support/unstructured.h"

namespace timeseries {
namespace list_heights {
namespace {

using namespace tests;

constexpr int kLatticeSide = 3, kLatticeNodes = kLatticeSide * kLatticeSide,
              kFaces = 2 * (kLatticeSide - 1) * (kLatticeSide - 1);
constexpr std::size_t kLayers = 4, kSteps = 2;
constexpr double kFill = 1e30;

// Two triangles in each square of a lattice of unit steps.
std::array<std::array<int, 3>, kFaces> faces() {
    std::array<std::array<int, 3>, kFaces> all{};
    std::size_t at = 0;
    for (int j = 0; j + 1 < kLatticeSide; ++j)
        for (int i = 0; i + 1 < kLatticeSide; ++i) {
            const int first = i + kLatticeSide * j;
            all[at++] = {first, first + 1, first + kLatticeSide + 1};
            all[at++] = {first, first + kLatticeSide + 1, first + kLatticeSide};
        }
    return all;
}

enum class By { Sigma, SigmaOfEach, Zcor, Coordinates };

struct Layers {
    By by;
    bool atNodes = true;
    bool layersFastest = false;  // as SCHISM writes them
    // Of the faces' nodes, which are counted from one, and nobody says so, as FVCOM writes them.
    bool cornersFirst = false;
    int places() const { return atNodes ? kLatticeNodes : kFaces; }
};

double sigmaOf(std::size_t layer) { return -1 + double(layer) * double(layer) / 9; }
double depthOf(int place) { return 40 + 3 * place; }
double surfaceOf(std::size_t step, int place) { return 0.5 * double(step) + 0.125 * place; }
// CF 1.10, appendix D: the ocean's sigma.
double heightOf(std::size_t step, std::size_t layer, int place) {
    const double eta = surfaceOf(step, place);
    return eta + sigmaOf(layer) * (depthOf(place) + eta);
}
// Below the sea's floor there is nothing, where a variable says so.
bool isThere(By by, std::size_t layer, int place) {
    return by != By::Zcor || place != 4 || layer > 0;
}

std::filesystem::path written(const Layers& what) {
    NetcdfBuilder file(fmt::format("layers{}{}{}{}.nc", static_cast<int>(what.by), what.atNodes,
                                   what.cornersFirst, what.layersFastest));
    const int n = file.dimension("node", kLatticeNodes), f = file.dimension("face", kFaces),
              three = file.dimension("three", 3), layer = file.dimension("layer", kLayers);
    const auto time = file.coordinate("time", kSteps, "s");
    const auto [x, y, list] = what.cornersFirst ? declareUgrid(file, n, three, f, "m", "m")
                                                : declareUgrid(file, n, f, three, "m", "m");
    const int place = what.atNodes ? n : f;
    const std::vector<int> all = what.layersFastest ? std::vector{time.dimension, place, layer}
                                                    : std::vector{time.dimension, layer, place};
    const int t = file.variable("T", NC_INT, all);
    file.text(t, "mesh", "mesh");
    file.text(t, "location", what.atNodes ? "node" : "face");

    const int depth = file.variable("depth", NC_DOUBLE, {place}),
              eta = file.variable("elev", NC_DOUBLE, {time.dimension, place});
    file.text(depth, "units", "m");
    int sigma = -1, given = -1;
    switch (what.by) {
        case By::Sigma:
            sigma = file.variable("layer", NC_DOUBLE, {layer});
            break;
        case By::SigmaOfEach:
            // Named as FVCOM names it: a coordinate that says it is vertical, and is no height.
            sigma = file.variable("layer", NC_DOUBLE, {layer, place});
            file.text(sigma, "positive", "up");
            file.text(t, "coordinates", "layer x y");
            break;
        case By::Zcor:
            given = file.variable("zcor", NC_DOUBLE, all);
            file.number(given, "_FillValue", kFill);
            file.text(given, "mesh", "mesh");
            file.text(given, "location", what.atNodes ? "node" : "face");
            break;
        case By::Coordinates:
            given = file.variable("z_of_layers", NC_DOUBLE, all);
            file.text(given, "units", "m");
            file.text(given, "positive", "up");
            file.text(t, "coordinates", "z_of_layers");
            break;
    }
    if (sigma >= 0) {
        file.text(sigma, "standard_name", "ocean_sigma_coordinate");
        file.text(sigma, "formula_terms", "sigma: layer eta: elev depth: depth");
    }

    file.write(time.variable, std::vector<double>{0, 10});
    std::vector<double> xs, ys, depths, surfaces, sigmas, heights;
    for (int p = 0; p < kLatticeNodes; ++p)
        xs.push_back(p % kLatticeSide), ys.push_back(p / kLatticeSide);
    std::vector<std::int32_t> corners;
    for (std::size_t i = 0; i < 3 * faces().size(); ++i)
        corners.push_back(what.cornersFirst ? 1 + faces()[i % kFaces][i / kFaces]
                                            : faces()[i / 3][i % 3]);
    for (int p = 0; p < what.places(); ++p) depths.push_back(depthOf(p));
    for (std::size_t s = 0; s < kSteps; ++s)
        for (int p = 0; p < what.places(); ++p) surfaces.push_back(surfaceOf(s, p));
    for (std::size_t k = 0; k < kLayers; ++k)
        for (int p = 0; p < (what.by == By::SigmaOfEach ? what.places() : 1); ++p)
            sigmas.push_back(sigmaOf(k));
    const std::size_t each = kLayers * std::size_t(what.places());
    heights.resize(kSteps * each);
    std::vector<std::int32_t> values(heights.size());
    for (std::size_t s = 0; s < kSteps; ++s)
        for (std::size_t k = 0; k < kLayers; ++k)
            for (int p = 0; p < what.places(); ++p) {
                const std::size_t own = k * std::size_t(what.places()) + std::size_t(p),
                                  at = s * each +
                                       (what.layersFastest ? std::size_t(p) * kLayers + k : own);
                heights[at] = isThere(what.by, k, p) ? heightOf(s, k, p) : kFill;
                values[at] = static_cast<std::int32_t>(s * each + own);
            }
    file.write(x, xs);
    file.write(y, ys);
    file.write(list, corners);
    file.write(t, values);
    file.write(depth, depths);
    file.write(eta, surfaces);
    if (sigma >= 0) file.write(sigma, sigmas);
    if (given >= 0) file.write(given, heights);
    return file.close();
}

// What a place stands for in the plane.
double areaOf(const Layers& what, int place) {
    if (!what.atNodes) return 0.5;
    double area = 0;
    for (const auto& face : faces()) area += double(std::ranges::count(face, place)) * 0.5 / 3;
    return area;
}

glm::dvec2 planeOf(const Layers& what, int place) {
    if (what.atNodes) return {place % kLatticeSide, place / kLatticeSide};
    glm::dvec2 sum(0);
    const auto face = faces()[std::size_t(place)];
    for (const int node : face) sum += glm::dvec2(node % kLatticeSide, node / kLatticeSide);
    return sum / 3.0;
}

void expectColumns(const Layers& what) {
    const auto reader = open(written(what));
    const std::size_t v = tests::indexOf(*reader, "T");
    const Variable& variable = reader->variables()[v];
    EXPECT_EQ(variable.grid->size(),
              (std::array<std::size_t, 3>{std::size_t(what.places()), 1, kLayers}));
    EXPECT_FALSE(variable.grid->axes()[2].down);
    for (const std::size_t step : {1u, 0u, 1u}) {
        const Field field = reader->read(v, step);
        const Mesh& mesh = *field.grid->mesh();
        const auto& values = std::get<std::vector<std::int32_t>>(field.values);
        ASSERT_EQ(mesh.count(), values.size());
        for (std::size_t k = 0; k < kLayers; ++k)
            for (int p = 0; p < what.places(); ++p) {
                const std::size_t index = k * std::size_t(what.places()) + std::size_t(p);
                EXPECT_EQ(values[index], static_cast<std::int32_t>(step * values.size() + index));
                const glm::dvec3 at = mesh.position(index);
                if (!isThere(what.by, k, p)) {
                    EXPECT_TRUE(std::isnan(at.z));
                    continue;
                }
                EXPECT_NEAR(at.x, planeOf(what, p).x, 1e-5) << p;
                EXPECT_NEAR(at.y, planeOf(what, p).y, 1e-5) << p;
                EXPECT_NEAR(at.z, heightOf(step, k, p), 1e-5) << k << ' ' << p;
                // Halfway to the points above and below it, or as far beyond.
                const auto height = [&](std::size_t layer) { return heightOf(step, layer, p); };
                const bool hasBelow = k > 0 && isThere(what.by, k - 1, p),
                           hasAbove = k + 1 < kLayers;
                const double below =
                    hasBelow ? height(k) - height(k - 1) : height(k + 1) - height(k);
                const double above =
                    hasAbove ? height(k + 1) - height(k) : height(k) - height(k - 1);
                const double volume = areaOf(what, p) * 0.5 * (below + above);
                EXPECT_NEAR(tests::volume(mesh, index), volume, 1e-5 * volume) << k << ' ' << p;
            }
        // Between faces' middles are a ring of six about the node within, and three at each of the
        // lattice's four sides: as many triangles as faces.
        EXPECT_EQ(mesh.solids()->count(), std::uint64_t{(kLayers - 1) * kFaces});
        // Between nodes are the faces' prisms, as high as their columns are on average.
        if (what.atNodes && what.by != By::Zcor) {
            double expected = 0;
            for (const auto& face : faces())
                for (const int p : face)
                    expected += 0.5 / 3 * (heightOf(step, kLayers - 1, p) - heightOf(step, 0, p));
            EXPECT_NEAR(tests::volumeBetween(mesh), expected, 1e-5 * expected);
        }
    }
}

TEST(NetcdfListHeights, AreThoseOfTheFormulaAboveEachPlaceInEveryStep) {
    for (const bool atNodes : {true, false})
        for (const bool fastest : {false, true})
            for (const By by : {By::Sigma, By::SigmaOfEach}) expectColumns({by, atNodes, fastest});
}

TEST(NetcdfListHeights, AreThoseOfAVariable) {
    for (const bool atNodes : {true, false})
        for (const bool fastest : {false, true})
            for (const By by : {By::Zcor, By::Coordinates}) expectColumns({by, atNodes, fastest});
}

TEST(NetcdfListHeights, AreThoseOfFvcomWhichSaysLittle) {
    for (const bool atNodes : {true, false})
        expectColumns({.by = By::SigmaOfEach, .atNodes = atNodes, .cornersFirst = true});
}

// Also where they themselves are drawn.
TEST(NetcdfListHeights, OfSchismAreMetres) {
    const auto reader = open(written({By::Zcor}));
    for (const char* name : {"T", "zcor"}) {
        const Field field = reader->read(tests::indexOf(*reader, name), 1);
        EXPECT_EQ(field.grid->axes()[2].units, "m") << name;
        EXPECT_NEAR(field.grid->position(kLatticeNodes + 2).z, heightOf(1, 1, 2), 1e-5) << name;
    }
}

TEST(NetcdfListHeights, PointsBelowTheFloorAreTold) {
    const auto reader = open(written({By::Zcor}));
    const Variable& variable = reader->variables()[tests::indexOf(*reader, "T")];
    EXPECT_THAT(variable.notes,
                testing::ElementsAre("1 of 36 points are not drawn: the file gives them no place"));
}

// What a slab of a level holds is what all of it holds there.
TEST(NetcdfListHeights, SlabsAreOfLevels) {
    for (const bool fastest : {false, true}) {
        const auto reader = open(written({By::Sigma, true, fastest}));
        const std::size_t v = tests::indexOf(*reader, "T");
        const Field some = reader->slab(v, 1, {2, 1, 2});
        const auto& values = std::get<std::vector<std::int32_t>>(some.values);
        ASSERT_EQ(values.size(), std::size_t(2 * kLatticeNodes));
        for (std::size_t i = 0; i < values.size(); ++i)
            EXPECT_EQ(values[i], static_cast<std::int32_t>(kLatticeNodes * (kLayers + 1) + i));
    }
}

}  // namespace
}  // namespace list_heights
}  // namespace timeseries
