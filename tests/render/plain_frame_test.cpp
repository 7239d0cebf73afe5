// A scene alone is what its planes say: their optical depth, and their light on the background.
#include "render/frame/plain_frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/reference/accumulator.h"
#include "render/reference/cpu_splatter.h"
#include "render/reference/exact_order.h"
#include "tests/support/scenes.h"

namespace render {
namespace {

const glm::ivec2 kPicture(48, 36);
const glm::dvec3 kGround(0.1, 0.2, 0.4);

struct PlainWorld {
    PlainWorld()
        : scene{.step = step,
                .placed = placed,
                .layers = {},
                .footprint = {},
                .order = Order::None,
                .clip = {}} {
        for (const char* range : {"0:0.3", "0.5:0.6"})
            scene.layers.push_back({step.select(timeseries::RangeSet::parse(range)),
                                    {Constant{glm::dvec3(scene.layers.empty() ? 1 : 0, 0.5, 0.25)},
                                     scene.layers.empty() ? 0.4 : 0.2}});
    }
    timeseries::SortedStep step = tests::noise(tests::cube(8));
    PlacedPoints placed{step.grid()};
    Scene scene;
};

void expectTheTruth(const Scene& scene, const DrawList& list) {
    const View view = tests::lookFrom({0.7, -3, 1.1}, kPicture);
    Accumulator<double> sums(kPicture, channelsFor(scene));
    splat<double>(scene, list, view, {}, sums);
    PlainFrame frame(scene.step, scene.placed, kGround);
    frame.draw(scene, view);
    const Image light = frame.light();
    const std::vector<float> depth = opticalDepthOf(scene, view);
    double most = 0;
    for (int y = 0; y < kPicture.y; ++y)
        for (int x = 0; x < kPicture.x; ++x) {
            const Resolved wanted = resolvePixel(sums, scene.layers, x, y);
            const glm::dvec3 seen = wanted.rgb + (1 - wanted.alpha) * kGround;
            const glm::vec4& is = light.at(x, kPicture.y - 1 - y);
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(is[c], seen[c], 1e-4) << x << ' ' << y;
            ASSERT_NEAR(depth[std::size_t(y * kPicture.x + x)], wanted.opticalDepth,
                        1e-4 * (1 + wanted.opticalDepth));
            most = std::max(most, wanted.opticalDepth);
        }
    EXPECT_GT(most, 0.5);
}

TEST(PlainFrame, IsTheTruthsLightOnTheBackground) {
    PlainWorld world;
    expectTheTruth(world.scene, Runs{});
    world.scene.order = Order::BackToFront;
    const View view = tests::lookFrom({0.7, -3, 1.1}, kPicture);
    expectTheTruth(world.scene, orderExactly(world.scene, pixelRays(view).eye));
}

// White light of optical depth t on black is 1 - e^-t.
TEST(PlainFrame, InCoarsePixelsShowsTheirDepthEnlarged) {
    PlainWorld world;
    for (Layer& layer : world.scene.layers) layer.style.color = Constant{glm::dvec3(1)};
    for (const glm::ivec2 size : {kPicture, glm::ivec2(49, 37)})
        for (const int across : {1, 2, 3}) {
            const View view = tests::lookFrom({0.7, -3, 1.1}, size);
            PlainFrame frame(world.step, world.placed, glm::dvec3(0));
            frame.draw(world.scene, view, across);
            const Image light = frame.light();
            const std::vector<float> depth = enlargedDepthOf(world.scene, view, across);
            EXPECT_GT(*std::ranges::max_element(depth), 0.5);
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x)
                    ASSERT_NEAR(light.at(x, size.y - 1 - y).r,
                                1 - std::exp(-depth[std::size_t(y * size.x + x)]), 1e-4)
                        << x << ' ' << y << ' ' << across;
        }
}

TEST(PlainFrame, NothingSelectedIsTheBackground) {
    PlainWorld world;
    world.scene.layers.clear();
    const View view = tests::lookFrom({0.7, -3, 1.1}, kPicture);
    PlainFrame frame(world.step, world.placed, kGround);
    frame.draw(world.scene, view);
    EXPECT_EQ(frame.light(), Image(kPicture, glm::vec4(glm::vec3(kGround), 1)));
}

}  // namespace
}  // namespace render
