// Cells that are much wider than they are high, as those of air and sea in their true proportions:
// a pixel sees several of them one above the other, and a layer of the field is no fainter for it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <string>

#include "render/reference/interval_truth.h"
#include "tests/support/cell_rays.h"
#include "tests/support/meshes.h"

namespace render {
namespace {

using tests::CellWorld;
using tests::drawn;

// Layers one above the other, 20 cells wide, all together as high as so much of their width.
std::shared_ptr<const timeseries::Grid> flatLayers(double height, bool placedOneByOne) {
    constexpr std::array<std::size_t, 3> kSize{21, 21, 11};
    const double between = 20 * height / 10;
    if (!placedOneByOne)
        return std::make_shared<timeseries::Grid>(std::array{
            tests::axis(kSize[0]), tests::axis(kSize[1]), tests::axis(kSize[2], 0, between)});
    return tests::curvilinear(
        kSize, [&](double i, double j, double k) { return glm::dvec3(i, j, k * between); });
}

// Rises by 1 a layer, and a little to and fro beside it.
CellWorld worldOf(double height, const std::string& range, bool placedOneByOne, OpacityPer per) {
    CellWorld world(tests::stepOf(flatLayers(height, placedOneByOne),
                                  [&](std::size_t i) {
                                      const double x = static_cast<double>(i % 21),
                                                   y = static_cast<double>(i / 21 % 21);
                                      return static_cast<double>(i / 441) +
                                             0.4 * std::sin(0.4 * x) * std::cos(0.3 * y);
                                  }),
                    {range});
    world.scene.opacityPer = per;
    return world;
}

// Rays that are the truth's own, so that the rim is no matter.
constexpr int kRays = 2;
std::vector<float> allOf(const Scene& scene, const View& view) {
    return drawn(scene, view, Channels::Weight, 0, 2, tests::kAllCells, {}, kRays);
}

// A range, and what an error of it may be: where cells are so flat that a pixel's steps lead along
// them, and where they are not, or tetrahedra, whose faces lean: thin ranges have that of few rays
// then however high cells are, and lose what a ramp has beyond a ray's own values.
struct RangeAndErrors {
    const char* range;
    double flat, other;
};

TEST(FlatCells, ALayerIsPassedOnceHoweverFlatItIs) {
    // As wide as several layers, between the values of points, beside one, and one alone.
    for (const RangeAndErrors& layer : {RangeAndErrors{"3:7", 0.02, 0.05},
                                        {"4.3:4.9", 0.02, 0.05},
                                        {"4.52:4.53", 0.02, 0.15},
                                        {"3.97:4", 0.05, 0.15},
                                        {"5", 0.05, 0.2}})
        for (const bool placedOneByOne : {false, true})
            for (const double height : {0.3, 0.02, 1e-3, 1e-5}) {
                const double error = placedOneByOne || height > 0.1 ? layer.other : layer.flat;
                const CellWorld world =
                    worldOf(height, layer.range, placedOneByOne, OpacityPer::Crossing);
                for (const glm::dvec3& from :
                     {glm::dvec3(0.5, -2.4, 1), glm::dvec3(0.2, 0.1, 2.6)}) {
                    const View view = tests::lookFrom(from, {60, 45});
                    const IntervalTruth truth(world.scene, world.scene.cells->field(), kRays);
                    const std::vector<double> wanted = truth.weight(view, 0);
                    const std::vector<float> is = allOf(world.scene, view);
                    SCOPED_TRACE(fmt::format("{} of a height of {}, seen from {}{}", layer.range,
                                             height, from.z,
                                             placedOneByOne ? ", by tetrahedra" : ""));
                    EXPECT_LT(tests::cells::relativeL2(is, wanted), error);
                    const double mass = std::accumulate(wanted.begin(), wanted.end(), 0.0);
                    EXPECT_NEAR(std::accumulate(is.begin(), is.end(), 0.0), mass, error * mass);
                }
            }
}

// Ends of ranges of whole numbers lie at a hundredth of what a cell changes, and at other shares.
TEST(FlatCells, RoundingDoesNotDecideHowWideARampIs) {
    const auto widthOf = []<typename Real>(Real end) {
        struct {
            Real least, most;
        } const ends{end, 0};
        return static_cast<double>(cell::widestRamp(ends, true, false, Real(1)));
    };
    for (int extent = 1; extent <= 255; ++extent)
        for (int above = 0; above < extent; ++above) {
            const double end = -1 + (above + 0.5) / extent;
            EXPECT_NEAR(widthOf(static_cast<float>(end)), widthOf(end), 1e-4)
                << above << " of " << extent;
        }
    EXPECT_NEAR(widthOf(-1.0), kSharedRamp, 1e-12) << "at the end of the cell";
    EXPECT_NEAR(widthOf(-0.5), 1, 1e-12) << "the cell has room for it on both sides";
}

TEST(FlatCells, ALayersLengthIsItsOwn) {
    for (const bool placedOneByOne : {false, true})
        for (const double height : {0.3, 0.02, 1e-3}) {
            const CellWorld world = worldOf(height, "4.3:4.9", placedOneByOne, OpacityPer::Length);
            const View view = tests::lookFrom({0.5, -2.4, 1}, {60, 45});
            const IntervalTruth truth(world.scene, world.scene.cells->field(), kRays);
            EXPECT_LT(tests::cells::relativeL2(allOf(world.scene, view), truth.weight(view, 0)),
                      0.05)
                << height;
        }
}

}  // namespace
}  // namespace render
