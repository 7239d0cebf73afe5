// Light of cells of grids whose points lie one by one: against what rays meet of their tetrahedra,
// one behind another, and against upright grids.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "render/reference/interval_truth.h"
#include "render/reference/tets_on_pixels.h"
#include "tests/support/cell_rays.h"
#include "tests/support/meshes.h"

namespace render {
namespace mesh_cells_light {
namespace {

using tests::CellWorld;
using tests::drawn;
using tests::stepOfPlaces;
using tests::cells::kFrom;
using timeseries::Grid;

// Light of what the rays of a pixel pass, the nearest first, in steps of one colour: the mean of
// 4 x 4 rays.
glm::dvec4 lightOf(const Scene& scene, const View& view, const glm::ivec2& pixel) {
    constexpr int kSteps = 8;
    constexpr std::size_t kRays = 4;
    const CellsView seen(scene.placed, view);
    struct Passed {
        double depth, opticalDepth;
        glm::dvec3 color;
    };
    std::array<std::vector<Passed>, kRays * kRays> passed;
    const Layer& layer = scene.layers.front();
    const auto& range = layer.cells.ranges.front();
    const auto pass = [&](const TetSplat<double>& s, std::size_t ray) {
        const glm::dvec2 within(double(ray % kRays) + 0.5, double(ray / kRays) + 0.5);
        const glm::dvec2 window = glm::dvec2(pixel) + within / double(kRays);
        const auto in = partOnRay(seen, s, window);
        if (!in) return;
        const double length = (in->to - in->from) * lengthPerDepth(seen, window);
        for (int k = 0; k < kSteps; ++k) {
            const double share = (k + 0.5) / kSteps;
            passed[ray].push_back({std::lerp(in->from, in->to, share),
                                   opticalDepthPerWeight(layer.style.opacity) * length / kSteps,
                                   colorOf(layer.style, std::lerp(in->begin, in->end, share))});
        }
    };
    forEachTetBefore(scene, scene.cells->field(), seen, PixelBins(std::span(&pixel, 1), view.size),
                     1,
                     [&](std::size_t, std::uint32_t, const MeshCells::Tetrahedron& tet, std::size_t,
                         const WindowBox&) {
                         const auto s = tetSplatAt<double>(
                             seen, {tet.at, tet.values, range.lo, range.hi, OpacityPer::Length});
                         for (std::size_t ray = 0; s.visible && ray < passed.size(); ++ray)
                             pass(s, ray);
                     });
    glm::dvec4 mean(0);
    for (auto& ofRay : passed) {
        std::ranges::sort(ofRay, {}, &Passed::depth);
        glm::dvec4 light(0);
        for (const Passed& p : ofRay)
            light += (1 - light.a) * -std::expm1(-p.opticalDepth) * glm::dvec4(p.color, 1);
        mean += light / double(passed.size());
    }
    return mean;
}

// From outside, pixels that see an edge are what is off; from within, cells that lean and grow are
// passed a little out of their order.
TEST(MeshCellsLight, HideWhatIsBehindThem) {
    CellWorld world(stepOfPlaces(tests::twisted(),
                                 [](const glm::dvec3& p) {
                                     return 0.5 +
                                            0.5 * std::sin(p.x + 0.4) * std::cos(0.9 * p.y - p.z);
                                 }),
                    {"0.3:0.9"}, 0.9);
    world.scene.layers[0].style.color = ByValue{ColorMap(), 0.2, 0.8};
    world.scene.order = Order::BackToFront;
    for (const glm::dvec3& from : kFrom) {
        const View view = tests::lookFrom(from, {12, 10}, 0.1);  // pixels far smaller than cells
        const auto over = drawn(world.scene, view, Channels::Over);
        double squares = 0;
        for (int y = 0; y < 10; ++y)
            for (int x = 0; x < 12; ++x) {
                const glm::dvec4 light = lightOf(world.scene, view, {x, y});
                for (int c = 0; c < 4; ++c)
                    squares +=
                        std::pow(double(over[std::size_t(4 * (y * 12 + x) + c)]) - light[c], 2);
            }
        EXPECT_LT(std::sqrt(squares / (12 * 10 * 4)), from == kFrom[2] ? 0.008 : 0.035) << from.x;
    }
}

// A linear field is the same between the points of an upright grid and in the tetrahedra of one
// whose points lie there one by one: so is the light of layers that overlap, and of colours by
// value but for how often along its way a ray takes them.
TEST(MeshCellsLight, LightIsThatOfAnUprightGridWhereTheFieldIs) {
    const std::array<timeseries::Axis, 3> axes{tests::axis(6), tests::axis(5, 0, 1.3),
                                               tests::axis(7, 2, 0.8)};
    const auto upright = std::make_shared<const Grid>(axes);
    const auto oneByOne = tests::curvilinear({6, 5, 7}, [&](double i, double j, double k) {
        return glm::dvec3(i, 1.3 * j, 2 + 0.8 * k);
    });
    const auto field = [](const glm::dvec3& p) { return p.x + 2 * p.y - 0.5 * p.z; };
    for (const bool byValue : {false, true}) {
        const std::vector<std::string> layers{"1:5", "3:3.5", "6:9"};
        CellWorld one(stepOfPlaces(upright, field), layers),
            other(stepOfPlaces(oneByOne, field), layers);
        for (CellWorld* world : {&one, &other}) {
            world->scene.layers[1].style.opacity = 0.9;
            world->scene.layers[2].style.opacity = 1;
            if (byValue) world->scene.layers[0].style.color = ByValue{{}, 1, 5};
        }
        for (const glm::dvec3& from : kFrom) {
            const View view = tests::lookFrom(from, {28, 24}, 0.3);
            const auto lightOf = [&](const CellWorld& world, unsigned threads) {
                return IntervalTruth(world.scene, world.scene.cells->field(), 2, threads)
                    .light(view);
            };
            const auto expected = lightOf(one, 2), light = lightOf(other, 2);
            EXPECT_EQ(light, lightOf(other, 1));
            double brightest = 0;
            for (std::size_t i = 0; i < light.size(); ++i)
                for (int c = 0; c < 4; ++c) {
                    ASSERT_NEAR(light[i][c], expected[i][c], byValue ? 5e-3 : 1e-4) << i;
                    brightest = std::max(brightest, light[i][c]);
                }
            EXPECT_GT(brightest, 0.5);
        }
    }
}

}  // namespace
}  // namespace mesh_cells_light
}  // namespace render
