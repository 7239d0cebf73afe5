// Picking against the truth's splats drawn one by one.
#include "render/model/pick.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "render/reference/cpu_splatter.h"
#include "tests/support/scenes.h"

namespace render {
namespace {

using timeseries::RangeSet;

struct PickedWorld {
    explicit PickedWorld(std::shared_ptr<const timeseries::Grid> grid) : step(tests::noise(grid)) {}
    timeseries::SortedStep step;
    PlacedPoints placed{step.grid()};
    Scene scene{.step = step,
                .placed = placed,
                .layers = {{step.select(RangeSet::parse("0.1:0.4")), {Constant{}, 0.2}},
                           {step.select(RangeSet::parse("0.3:0.5")), {ByValue{{}, 0, 1}, 0.02}}},
                .footprint = {},
                .order = Order::None,
                .clip = {}};
};

// Brute force over pictures: every drawn point alone, in front to back order, until the light that
// they add passes half of the ray's.
std::optional<std::pair<std::uint64_t, std::size_t>> expected(const Scene& scene, const View& view,
                                                              glm::ivec2 pixel) {
    struct Seen {
        double depth, tau, brightness;
        std::uint64_t point;
        std::size_t layer;
    };
    std::vector<Seen> seen;
    for (std::size_t k = 0; k < scene.layers.size(); ++k)
        for (const auto& run : scene.layers[k].runs)
            for (std::uint64_t p = run.first; p < run.first + run.count; ++p) {
                if (!inSubset(p, scene.stride)) continue;
                Scene alone = scene;
                alone.stride = 1;
                alone.layers = {{{{p, 1}}, scene.layers[k].style}};
                Accumulator<double> sums(view.size, {Channels::Weight});
                splat(alone, Runs{}, view, {}, sums);
                const double w = sums.planes[0][std::size_t(pixel.y) * view.size.x + pixel.x];
                if (w == 0) continue;
                const double tau = w * opticalDepthPerWeight(scene.layers[k].style.opacity) *
                                   pointsPerSplat(scene.layers[k], scene.stride);
                const double depth =
                    project(view, scene.placed.position(scene.step.gridIndex()[p])).depth;
                const glm::dvec3 rgb =
                    colorOf(scene.layers[k].style, timeseries::toDouble(scene.step.value(p)));
                // Rec. 709's luminance, and what black counts.
                const double brightness = 0.2126 * rgb.r + 0.7152 * rgb.g + 0.0722 * rgb.b + 0.01;
                seen.push_back({depth, tau, brightness, p, k});
            }
    std::ranges::stable_sort(seen, {}, &Seen::depth);
    // One layer of one colour looks the same in any order.
    const bool hides =
        scene.order == Order::BackToFront ||
        (scene.layers.size() == 1 && std::holds_alternative<Constant>(scene.layers[0].style.color));
    const auto light = [&](std::size_t count) {
        double sum = 0, left = 1;
        for (std::size_t i = 0; i < count; ++i) {
            const double opacity = 1 - std::exp(-seen[i].tau);
            sum += (hides ? left * opacity : seen[i].tau) * seen[i].brightness;
            left *= 1 - opacity;
        }
        return sum;
    };
    for (std::size_t i = 0; i < seen.size(); ++i)
        if (light(i + 1) >= light(seen.size()) / 2) return std::pair(seen[i].point, seen[i].layer);
    return std::nullopt;
}

void expectBruteForce(const Scene& scene, const View& view, unsigned seed) {
    std::mt19937 random(seed);
    int found = 0;
    for (int i = 0; i < 40; ++i) {
        const glm::ivec2 pixel(random() % view.size.x, random() % view.size.y);
        const auto picked = pick(scene, view, glm::dvec2(pixel) + 0.5);
        const auto truth = expected(scene, view, pixel);
        ASSERT_EQ(picked.has_value(), truth.has_value()) << pixel.x << ' ' << pixel.y;
        if (!picked) continue;
        ++found;
        const auto& [point, layer] = *truth;
        EXPECT_EQ(picked->layer, layer) << pixel.x << ' ' << pixel.y;
        EXPECT_EQ(picked->gridIndex, scene.step.gridIndex()[point]) << pixel.x << ' ' << pixel.y;
        EXPECT_EQ(picked->value, scene.step.value(point));
        EXPECT_FALSE(picked->between);
        EXPECT_EQ(picked->world, scene.placed.position(picked->gridIndex));
        EXPECT_NEAR(picked->depth, project(view, picked->world).depth, 1e-12);
    }
    EXPECT_GE(found, 3) << "or little was compared";
}

std::shared_ptr<const timeseries::Grid> unevenGrid() {
    timeseries::Axis uneven = tests::axis(6);
    for (double& x : uneven.coordinates) x = x * x + x;
    return std::make_shared<timeseries::Grid>(
        std::array{tests::axis(9), tests::axis(7, 0, 2), uneven});
}

TEST(Pick, IsBruteForceOverSplats) {
    const PickedWorld cubes(tests::cube(8)), uneven(unevenGrid());
    for (const PickedWorld* world : {&cubes, &uneven}) {
        expectBruteForce(world->scene, tests::lookFrom({0.3, -3, 0.5}, {41, 31}), 1);
        expectBruteForce(world->scene, tests::lookFrom({0.1, -0.2, 0.3}, {41, 31}), 2);  // inside
        View view = tests::lookFrom({0, -2, 0}, {41, 31});
        view.clipFromView = clipFromView({-0.9, 0.2, -0.2, 0.8, 1.8, 2.2});  // cuts both ends off
        expectBruteForce(world->scene, view, 3);
        Scene ordered = world->scene, alone = world->scene;
        ordered.order = Order::BackToFront;
        expectBruteForce(ordered, tests::lookFrom({0.3, -3, 0.5}, {41, 31}), 8);
        alone.layers.pop_back();
        alone.layers[0].style.opacity = 0.7;
        expectBruteForce(alone, tests::lookFrom({0.3, -3, 0.5}, {41, 31}), 9);
    }
}

TEST(Pick, IsBruteForceOverSubPixelAndPointSplats) {
    PickedWorld world(tests::cube(8));
    expectBruteForce(world.scene, tests::lookFrom({0, -60, 5}, {9, 9}, 0.02), 4);
    for (const double size : {1.0, 4.0, 5.0}) {
        world.scene.footprint = {Kernel::Point, size};
        expectBruteForce(world.scene, tests::lookFrom({0.3, -3, 0.5}, {25, 21}), 5);
    }
}

TEST(Pick, IsBruteForceInsideAClipBoxAndOfASubset) {
    PickedWorld world(tests::cube(8));
    world.scene.clip = {glm::uvec3(2, 0, 1), glm::uvec3(6, 5, 6)};
    expectBruteForce(world.scene, tests::lookFrom({0.3, -3, 0.5}, {41, 31}), 6);
    world.scene.stride = 4;
    expectBruteForce(world.scene, tests::lookFrom({0.3, -3, 0.5}, {41, 31}), 7);
}

// Five points along x, seen along x from -5: the first is nearest.
struct Row {
    explicit Row(double opacity) { scene.layers[0].style.opacity = opacity; }
    timeseries::SortedStep step =
        tests::stepOf(std::make_shared<timeseries::Grid>(
                          std::array{tests::axis(5), tests::axis(1), tests::axis(1)}),
                      [](std::size_t i) { return static_cast<double>(i); });
    PlacedPoints placed{step.grid()};
    Scene scene{.step = step,
                .placed = placed,
                .layers = {{step.select(RangeSet::everything()), {}}},
                .footprint = {},
                .order = Order::None,
                .clip = {}};
    View view = tests::lookFrom({-50, 0, 0}, {21, 21}, 0.05);
};

TEST(Pick, TakesTheFrontOfWhatIsOpaqueAndTheMiddleOfWhatIsThin) {
    // A splat's W on its axis is 5 / (pi R^2) = 0.82: opaque, the first one hides all others.
    const Row opaque(1), thin(0.01);
    EXPECT_EQ(pick(opaque.scene, opaque.view, {10.5, 10.5})->gridIndex, 0u);
    EXPECT_EQ(pick(thin.scene, thin.view, {10.5, 10.5})->gridIndex, 2u);
}

TEST(Pick, TakesABrightColumnRatherThanTheHazeBeforeIt) {
    // The last of the row is bright and as thick as the four dark ones before it together: half of
    // the optical depth lies before it, and hardly any light.
    Row row(0.2);
    ByValue map{*colorMapNamed("inferno"), 0, 4};
    ASSERT_GT(map.map.at(1).g, 10 * map.map.at(0.2).g);
    row.scene.layers = {{row.step.select(RangeSet::parse("0:0.5")), {map, 0.5}},
                        {row.step.select(RangeSet::parse("4:4")), {map, 0.5}}};
    for (const Order order : {Order::None, Order::BackToFront}) {
        row.scene.order = order;
        EXPECT_EQ(pick(row.scene, row.view, {10.5, 10.5})->gridIndex, 4u);
    }
}

TEST(Pick, MissesWhereNothingIsSeen) {
    const Row beside(0.5), invisible(0);
    EXPECT_FALSE(pick(beside.scene, beside.view, {0.5, 0.5}));
    EXPECT_FALSE(pick(invisible.scene, invisible.view, {10.5, 10.5}));
    Row empty(0.5);
    empty.scene.layers.clear();
    EXPECT_FALSE(pick(empty.scene, empty.view, {10.5, 10.5}));
    const View away = tests::lookFrom({-50, 0, 0}, {21, 21}, 0.05);
    View turned = away;
    turned.viewFromWorld[3].z += 100;  // all points behind the eye
    EXPECT_FALSE(pick(beside.scene, turned, {10.5, 10.5}));
}

}  // namespace
}  // namespace render
