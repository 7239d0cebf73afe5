// Pictures along the axes of a grid: rays that run along faces between cells have each cell once,
// and what lies beside a ray leaves no trace in its light.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/cell_rays.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace render {
namespace {

using namespace tests::cells;
using tests::CellWorld;
using tests::drawn;

// Along an axis, a face's diagonal and the cube's, near and from so far that all rays are one
// another's like; an odd picture has its middle on a pixel's, an even square one its diagonal.
std::vector<View> alongFaces() {
    std::vector<View> views;
    for (const glm::dvec3& from :
         {glm::dvec3(0, -1, 0), glm::dvec3(1, 0, 0), glm::dvec3(1, 1, 0), glm::dvec3(1, 1, 1)})
        for (const glm::ivec2& size : {glm::ivec2(49, 31), glm::ivec2(48, 48)}) {
            views.push_back(tests::lookFrom(3.0 * glm::normalize(from), size, 0.2));
            views.push_back(tests::lookFrom(1e3 * glm::normalize(from), size, 6e-4));
        }
    return views;
}

void expectEvenlyDeep(const CellWorld& world, const PlacedPoints::Box& domain) {
    for (const View& view : alongFaces()) {
        const std::vector<float> w = drawn(world.scene, view);
        for (int y = 0; y < view.size.y; ++y)
            for (int x = 0; x < view.size.x; ++x) {
                const double path = pathThrough(world, view, x, y, domain);
                ASSERT_NEAR(w[std::size_t(y * view.size.x + x)], path, 2e-3 * (1 + path))
                    << x << ' ' << y << " of " << view.size.x << " from "
                    << glm::length(glm::dvec3(view.viewFromWorld[3]));
            }
    }
}

TEST(CellFaces, OfAnUprightGridHaveEachCellOnce) {
    const CellWorld world(tests::stepOf(tests::cube(9), [](std::size_t) { return 3.0; }), {"2:4"});
    expectEvenlyDeep(world, world.placed.domain());
}

TEST(CellFaces, OfTetrahedraHaveEachOnce) {
    const auto grid = tests::curvilinear(
        {9, 9, 9}, [](double i, double j, double k) { return glm::dvec3(i, j, k); });
    const CellWorld world(tests::stepOf(grid, [](std::size_t) { return 3.0; }), {"2:4"});
    expectEvenlyDeep(world, {world.placed.axesFromGrid(glm::dvec3(-0.5)),
                             world.placed.axesFromGrid(glm::dvec3(8.5))});
}

// Of rays that miss a cell, in the same vector as some that meet it.
TEST(CellFaces, LightIsANumberAtEveryPixel) {
    for (const std::size_t side : {16u, 40u}) {
        CellWorld world(tests::stepOf(tests::cube(side),
                                      [&](std::size_t i) {
                                          const glm::dvec3 p(tests::cube(side)->indices(i));
                                          return std::sin(0.5 * p.x) * std::cos(0.4 * p.y) +
                                                 std::sin(0.3 * p.z * p.x / 10);
                                      }),
                        {"-0.5:0.5"});
        world.scene.order = Order::BackToFront;
        for (const Light light : {Light::Soft, Light::Full})
            for (const Lamp& lamp : {Lamp(), Lamp(glm::normalize(glm::dvec3(-2, -1, 2.5)))})
                for (const View& view : alongFaces()) {
                    world.scene.light = light;
                    world.scene.lamp = lamp;
                    for (const float v : drawn(world.scene, view, Channels::Over))
                        ASSERT_TRUE(std::isfinite(v));
                }
    }
}

}  // namespace
}  // namespace render
