// Soft light makes a colour lighter or darker and keeps its hue: all channels by one factor.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "render/model/light.h"
#include "render/reference/interval_truth.h"
#include "tests/support/cell_worlds.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace render {
namespace soft_light {
namespace {

using tests::CellWorld;

const std::array<glm::dvec3, 6> kColors = {{{0.9, 0.2, 0.05},
                                            {0.1, 0.8, 0.3},
                                            {0.02, 0.05, 1},
                                            {0.5, 0.5, 0.5},
                                            {1, 0.6, 1e-3},
                                            {0.3, 0, 0}}};
const std::array<Lamp, 3> kLamps = {std::nullopt, glm::normalize(glm::dvec3(1, -2, 2)),
                                    glm::normalize(glm::dvec3(-1, 3, 1))};

glm::dvec3 anyWay(std::mt19937& random) {
    std::normal_distribution<double> along;
    return glm::dvec3(along(random), along(random), along(random));
}

// The sine between both colours, which one factor of all channels leaves at 0.
double hueLost(const glm::dvec3& color, const glm::dvec3& lit) {
    const glm::dvec3 across = glm::cross(color, lit);
    return glm::length(across) / (glm::length(color) * glm::length(lit));
}

TEST(SoftLight, IsOneFactorOfAllChannels) {
    std::mt19937 random(5);
    double least = 1, most = 0, ofFull = 0;
    for (int i = 0; i < 500; ++i) {
        // Of a plateau, too.
        const glm::dvec3 gradient =
            i % 20 == 0 ? glm::dvec3(0) : std::pow(10, i % 7 - 3) * anyWay(random);
        const glm::dvec3 way = anyWay(random);
        for (const Lamp& lamp : kLamps)
            for (const double steepness : {0.0, 0.1, 10.0}) {
                const auto litBy = [&](Light light, const glm::dvec3& color) {
                    return shadeOf(light, lamp, gradient, way, steepness).of(color);
                };
                const double factor = litBy(Light::Soft, glm::dvec3(1)).g;
                for (const glm::dvec3& color : kColors) {
                    const glm::dvec3 lit = litBy(Light::Soft, color);
                    for (int c = 0; c < 3; ++c) ASSERT_DOUBLE_EQ(lit[c], factor * color[c]);
                    ofFull = std::max(ofFull, hueLost(color, litBy(Light::Full, color)));
                }
                least = std::min(least, factor);
                most = std::max(most, factor);
            }
    }
    // From where no lamp shines to a surface that faces it.
    EXPECT_GE(least, kAmbient);
    EXPECT_LT(least, 0.3);
    EXPECT_LE(most, 1);
    EXPECT_GT(most, 0.95);
    EXPECT_GT(ofFull, 0.1) << "or highlights would pass, too";
}

struct Pixel {
    glm::dvec3 color;
    double alpha;
};

// draw(): the picture of a world's one layer, in order.
template <typename Draw>
void expectHueStays(CellWorld& world, double tolerance, const Draw& draw) {
    world.scene.order = Order::BackToFront;
    double least = 1, most = 0, ofFull = 0;
    for (const glm::dvec3& color : kColors) {
        world.scene.layers[0].style.color = Constant{color};
        for (const Lamp& lamp : kLamps) {
            world.scene.lamp = lamp;
            const auto drawnBy = [&](Light light) {
                world.scene.light = light;
                return draw();
            };
            const std::vector<Pixel> dark = drawnBy(Light::Off), lit = drawnBy(Light::Soft),
                                     full = drawnBy(Light::Full);
            ASSERT_EQ(dark.size(), lit.size());
            int seen = 0;
            for (std::size_t i = 0; i < dark.size(); ++i) {
                ASSERT_NEAR(lit[i].alpha, dark[i].alpha, tolerance);
                if (dark[i].alpha < 0.1) continue;
                ++seen;
                const double factor =
                    glm::dot(lit[i].color, dark[i].color) / glm::dot(dark[i].color, dark[i].color);
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(lit[i].color[c], factor * dark[i].color[c],
                                tolerance * dark[i].color[c])
                        << "channel " << c << " of pixel " << i;
                least = std::min(least, factor);
                most = std::max(most, factor);
                ofFull = std::max(ofFull, hueLost(dark[i].color, full[i].color));
            }
            EXPECT_GT(seen, 80);
        }
    }
    EXPECT_GT(least, kAmbient - 1e-3);
    EXPECT_LT(most, 1 + 1e-3);
    EXPECT_GT(most - least, 0.2) << "or all of it was lit evenly";
    EXPECT_GT(ofFull, 0.01) << "or highlights would pass, too";
}

const View kView = tests::lookFrom({1.1, -2.5, 0.8}, {40, 30});

std::vector<Pixel> pictureOf(const Scene& scene) {
    const std::vector<float> plane = tests::drawn(scene, kView, Channels::Over);
    std::vector<Pixel> pixels;
    for (std::size_t i = 0; i < plane.size(); i += 4)
        pixels.push_back(
            {{plane[i], plane[i + 1], plane[i + 2]}, static_cast<double>(plane[i + 3])});
    return pixels;
}

// A ball's shell, whose sides face all ways; sums are of floats.
CellWorld ballIn(const std::shared_ptr<const timeseries::Grid>& grid) {
    return CellWorld(
        tests::stepOfPlaces(
            grid, [](const glm::dvec3& p) { return glm::distance(p, glm::dvec3(3.1, 2.9, 3)); }),
        {"1.5:2.5"});
}

TEST(SoftLight, OfCellsKeepsTheHue) {
    CellWorld world = ballIn(tests::cube(7));
    expectHueStays(world, 1e-4, [&] { return pictureOf(world.scene); });
}

TEST(SoftLight, OfTetrahedraKeepsTheHue) {
    CellWorld world = ballIn(tests::curvilinear({7, 7, 7}, [](double i, double j, double k) {
        return glm::dvec3(i + 0.1 * std::sin(j + k), j, k + 0.1 * std::cos(i));
    }));
    expectHueStays(world, 1e-4, [&] { return pictureOf(world.scene); });
}

TEST(SoftLight, OfTheTruthKeepsTheHue) {
    CellWorld world = ballIn(tests::cube(7));
    expectHueStays(world, 1e-12, [&] {
        std::vector<Pixel> pixels;
        for (const glm::dvec4& p :
             IntervalTruth(world.scene, world.scene.cells->field(), 1, 2).light(kView))
            pixels.push_back({glm::dvec3(p), p.a});
        return pixels;
    });
}

}  // namespace
}  // namespace soft_light
}  // namespace render
