// Light on tetrahedra: by the gradients of a mesh's points, linear between them.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <vector>

#include "render/reference/interval_truth.h"
#include "tests/support/lit_sphere.h"
#include "tests/support/meshes.h"
#include "tests/support/unstructured.h"

namespace render {
namespace tet_light {
namespace {

using tests::CellWorld;
using timeseries::Grid;

const glm::dvec3 kCentre(6, 5.8, 5.5);
constexpr double kRadius = 3.7;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// A lattice of steps of about 1, bent.
glm::dvec3 place(double i, double j, double k) {
    return {i + 0.1 * std::sin(j + k), j + 0.1 * std::sin(0.7 * k - i), k + 0.1 * std::cos(i - j)};
}

std::vector<std::shared_ptr<const Grid>> grids() {
    std::vector<std::shared_ptr<const Grid>> all{tests::curvilinear({13, 13, 12}, place)};
    for (const tests::Cut cut : tests::kCuts)
        all.push_back(tests::gridOf(tests::atPoints(tests::bricks({13, 13, 12}, cut, place))));
    return all;
}

CellWorld sphereIn(const std::shared_ptr<const Grid>& grid, const char* range = "3.7~0.1",
                   double opacity = 0.999) {
    return CellWorld(
        tests::stepOfPlaces(grid, [](const auto& p) { return glm::distance(p, kCentre); }), {range},
        opacity);
}

TEST(TetLight, ASphereIsLitAsItsNormalsSay) {
    for (const auto& grid : grids()) {
        CellWorld world = sphereIn(grid);
        world.scene.opacityPer = OpacityPer::Crossing;
        world.scene.order = Order::BackToFront;
        const auto smooth = world.scene.gradients;
        for (const Lamp& lamp : {Lamp(), Lamp(glm::normalize(glm::dvec3(1, -1, 2)))}) {
            world.scene.gradients = smooth;
            const auto is = tests::lightErrorOfSphere(world, kCentre, kRadius, lamp);
            world.scene.gradients = nullptr;
            const auto faceted = tests::lightErrorOfSphere(world, kCentre, kRadius, lamp);
            ASSERT_GT(is.pixels, 200);
            EXPECT_LT(is.rms, 0.02);
            EXPECT_LT(is.most, 0.08);
            EXPECT_GT(faceted.rms, 2 * is.rms) << "or it was as good before";
        }
    }
}

// Of the same gradients, taken all along a ray: what it makes of what is drawn without, where
// surfaces face the eye. Elsewhere they may turn away within a tetrahedron.
TEST(TetLight, IsThatOfTheTruth) {
    const View view = tests::lookFrom({1.1, -2.5, 0.8}, {60, 45});
    for (const auto& grid : grids()) {
        CellWorld world = sphereIn(grid, "2:4.5", 0.2);
        world.scene.order = Order::BackToFront;
        const auto shares = [&](const auto& draw) {
            std::vector<double> of;
            world.scene.light = Light::Off;
            const auto dark = draw();
            world.scene.light = Light::Soft;
            const auto lit = draw();
            for (std::size_t i = 0; i < dark.size(); ++i)
                of.push_back(dark[i] > 0.05 ? lit[i] / dark[i] : kNan);
            return of;
        };
        const auto drawnShares = [&] {
            return shares([&] {
                const auto all = tests::drawn(world.scene, view, Channels::Over);
                std::vector<double> red;
                for (std::size_t i = 0; i < all.size(); i += 4) red.push_back(double(all[i]));
                return red;
            });
        };
        const auto truth = shares([&] {
            std::vector<double> red;
            for (const glm::dvec4& pixel :
                 IntervalTruth(world.scene, world.scene.cells->field(), 1, 2).light(view))
                red.push_back(pixel.r);
            return red;
        });
        const auto rms = [&](const std::vector<double>& is) {
            double square = 0;
            int count = 0;
            for (std::size_t i = 0; i < is.size(); ++i) {
                if (!std::isfinite(is[i]) || !(truth[i] > 0.75)) continue;
                square += (is[i] - truth[i]) * (is[i] - truth[i]);
                ++count;
            }
            EXPECT_GT(count, 40);
            return std::sqrt(square / count);
        };
        const double smooth = rms(drawnShares());
        EXPECT_LT(smooth, 6e-3);
        world.scene.gradients = nullptr;
        EXPECT_GT(rms(drawnShares()), 1.5 * smooth) << "or gradients were not looked at";
    }
}

// Where corners are missing or clipped, what is left of a tetrahedron is lit as it was.
TEST(TetLight, IsTheSameOfWhatIsLeftOfTetrahedra) {
    const View view = tests::lookFrom({1.1, -2.5, 0.8}, {40, 30});
    for (const auto& grid : grids()) {
        CellWorld whole = sphereIn(grid), clipped = sphereIn(grid);
        clipped.scene.clip.to.x = 6.2;
        for (CellWorld* world : {&whole, &clipped}) {
            world->scene.order = Order::BackToFront;
            world->scene.light = Light::Soft;
            world->scene.opacityPer = OpacityPer::Crossing;
        }
        const auto all = tests::drawn(whole.scene, view, Channels::Over);
        const auto left = tests::drawn(clipped.scene, view, Channels::Over);
        // Points of the last column that is left lie before 6.1, and of tetrahedra beyond them a
        // quarter of an edge at least is left.
        const double scale = std::abs(whole.placed.scale().x);
        const auto xOf = [&](double x) { return whole.placed.axesFromGrid({x, 0, 0}).x; };
        int same = 0, ofSome = 0;
        for (int y = 0; y < 30; ++y)
            for (int x = 0; x < 40; ++x) {
                const auto ray = tests::cells::rayOf(whole, view, {x + 0.5, y + 0.5});
                const glm::dvec3 d = glm::normalize(ray.along);
                const glm::dvec3 from = ray.from - whole.placed.axesFromGrid(kCentre);
                const double along = glm::dot(d, from), of = kRadius * scale;
                const double under = along * along - glm::dot(from, from) + of * of;
                if (under < 0.1 * of * of) continue;
                const double back = std::sqrt(under);
                const double farthest = std::max((ray.from + (-along + back) * d).x,
                                                 (ray.from + (-along - back) * d).x);
                if (farthest > xOf(6.15)) continue;
                ++same;
                ofSome += farthest > xOf(6.05);
                for (std::size_t c = 0; c < 4; ++c) {
                    const std::size_t at = 4 * (std::size_t(y) * 40 + std::size_t(x)) + c;
                    ASSERT_NEAR(all[at], left[at], 5e-3);
                }
            }
        EXPECT_GT(same, 15);
        EXPECT_GT(ofSome, 0);
        for (const float v : left) ASSERT_TRUE(std::isfinite(v));
    }
}

}  // namespace
}  // namespace tet_light
}  // namespace render
