#include "render/model/covered.h"

#include <gtest/gtest.h>

#include <random>

#include "render/reference/cpu_splatter.h"
#include "tests/support/scenes.h"

namespace {

using namespace render;

struct CoveredWorld {
    explicit CoveredWorld(const glm::dmat3& directions, const Footprint& footprint = {})
        : step(tests::stepOf(std::make_shared<timeseries::Grid>(
                                 std::array{tests::axis(4), tests::axis(3), tests::axis(5, 0, 0.5)},
                                 timeseries::CoordinateFrame{.directions = directions}),
                             [](std::size_t) { return 1.0; })),
          placed(step.grid()),
          scene{.step = step,
                .placed = placed,
                .layers = {{step.select(timeseries::RangeSet::parse("0:2")),
                            {Constant{glm::dvec3(1)}, 0.5}}},
                .footprint = footprint,
                .order = Order::None,
                .clip = {}} {}
    timeseries::SortedStep step;
    PlacedPoints placed;
    Scene scene;
};

// Touched pixels outside `box`, and inside it.
std::array<int, 2> touched(const Scene& scene, const View& view, const PixelBox& box) {
    Accumulator<double> sums(view.size, {Channels::Weight});
    splat(scene, Runs{}, view, {}, sums);
    std::array<int, 2> counts{};
    for (int y = 0; y < view.size.y; ++y)
        for (int x = 0; x < view.size.x; ++x) {
            const glm::ivec2 from = glm::ivec2(x, y) - box.at;
            const bool inside =
                from.x >= 0 && from.y >= 0 && from.x < box.size.x && from.y < box.size.y;
            counts[inside] += sums.planes[0][std::size_t(y) * view.size.x + x] > 0;
        }
    return counts;
}

TEST(CoveredPixels, NoSplatTouchesAnyOther) {
    const std::array worlds{
        CoveredWorld(glm::dmat3(1)),
        CoveredWorld(tests::rotation(0.7)),
        CoveredWorld(tests::leaning({1, 0.4, 0}, {0, 1, 0.5}, {0.3, 0, 1})),
        CoveredWorld(glm::dmat3(1), {.size = 2.5}),
        CoveredWorld(glm::dmat3(1), {.kernel = Kernel::Point, .size = 7}),
    };
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1, 1);
    int parts = 0;  // pictures that hold a part of the volume's rectangle, or all
    for (int trial = 0; trial < 60; ++trial) {
        const CoveredWorld& world = worlds[static_cast<std::size_t>(trial) % worlds.size()];
        View view = tests::lookFrom({3 * uniform(random), 3 * uniform(random), 3 * uniform(random)},
                                    {97, 64}, 0.3);
        // Turned away from the middle, so that the picture's sides cut the volume.
        view.viewFromWorld = glm::translate(glm::dmat4(1), {uniform(random), uniform(random), 0}) *
                             view.viewFromWorld;
        const PixelBox box = coveredPixels(world.scene, view);
        const auto [outside, inside] = touched(world.scene, view, box);
        EXPECT_EQ(outside, 0) << trial;
        parts += inside > 0 && box != PixelBox{{0, 0}, view.size};
    }
    EXPECT_GT(parts, 20);
}

TEST(CoveredPixels, AreLittleMoreThanThoseOfADistantVolume) {
    const CoveredWorld world(glm::dmat3(1), {.kernel = Kernel::Point});
    const View view = tests::lookFrom({0, -40, 0}, {400, 300}, 0.1);
    const PixelBox box = coveredPixels(world.scene, view);
    const glm::dvec3 half = world.placed.boxHalf();
    // Its nearest face is the widest; 300 pixels are 2 * 0.1 of the distance.
    const glm::dvec2 face = glm::dvec2(half.x, half.z) * 2.0 * 150.0 / (0.1 * (40 - half.y));
    for (int i = 0; i < 2; ++i) {
        EXPECT_GE(box.size[i], face[i]);
        EXPECT_LE(box.size[i], face[i] + 8) << "a point and roundings on either side";
    }
}

TEST(CoveredPixels, AreTheWholePictureFromWithinAndNoneOfWhatIsBeside) {
    const CoveredWorld world(glm::dmat3(1));
    const glm::ivec2 size(64, 48);
    const View within = tests::lookFrom({0.1, 0.1, 0}, size);
    EXPECT_EQ(coveredPixels(world.scene, within), (PixelBox{{0, 0}, size}));
    View beside = tests::lookFrom({0, -5, 0}, size, 0.1);
    beside.viewFromWorld =
        glm::translate(glm::dmat4(1), glm::dvec3(-50, 0, 0)) * beside.viewFromWorld;
    EXPECT_EQ(coveredPixels(world.scene, beside).size.x, 0);
}

}  // namespace
