// What pixels have of splats by their own rays, against the sums of whole pictures.
#include "render/reference/splats_on_pixels.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "render/frame/plain_frame.h"
#include "render/splat/tile_layout.h"
#include "tests/support/scenes.h"

namespace render {
namespace {

struct SplatsWorld {
    timeseries::SortedStep step = tests::noise(tests::cube(12));
    PlacedPoints placed{step.grid()};
    Scene scene{.step = step,
                .placed = placed,
                .layers = {},
                .footprint = {},
                .order = Order::None,
                .clip = {}};
    View view = tests::lookFrom({1.2, -2.5, 1}, {40, 30});
    SplatsWorld() {
        for (const char* range : {"0.2:0.5", "0.4:0.9"})
            scene.layers.push_back({step.select(timeseries::RangeSet::parse(range)),
                                    {Constant{glm::dvec3(1)}, scene.layers.empty() ? 0.2 : 0.6}});
        scene.clip = indexBox(step.grid(), glm::dvec3(1), glm::dvec3(10.5));
    }
    std::vector<glm::ivec2> all() const {
        std::vector<glm::ivec2> pixels;
        for (int y = 0; y < view.size.y; ++y)
            for (int x = 0; x < view.size.x; ++x) pixels.emplace_back(x, y);
        return pixels;
    }
};

// Of a picture with so many rays a pixel as pixels of its own, each pixel's mean.
std::vector<double> meansOf(const Scene& scene, const View& view, int rays) {
    const std::vector<float> fine = opticalDepthOf(scene, finer(view, rays));
    std::vector<double> means(static_cast<std::size_t>(view.size.x * view.size.y));
    for (int y = 0; y < rays * view.size.y; ++y)
        for (int x = 0; x < rays * view.size.x; ++x)
            means[std::size_t(y / rays * view.size.x + x / rays)] +=
                double{fine[std::size_t(y * rays * view.size.x + x)]} / (rays * rays);
    return means;
}

TEST(SplatsOnPixels, HaveWhatIsSummedForAllPixels) {
    SplatsWorld world;
    for (const bool inside : {false, true})
        for (const std::uint32_t stride : {1u, 4u})
            for (const int rays : {1, 3}) {
                if (inside) world.view = tests::lookFrom({0.1, -0.2, 0.05}, {40, 30});
                world.scene.stride = stride;
                const auto pixels = world.all();
                const auto depth = splatDepthAt(world.scene, world.view, pixels, rays, 3);
                const auto expected = meansOf(world.scene, world.view, rays);
                const double most = *std::ranges::max_element(expected);
                ASSERT_GT(most, 0.1);
                for (std::size_t i = 0; i < depth.size(); ++i)
                    ASSERT_NEAR(depth[i], expected[i], 1e-5 * most) << i << ", " << rays;
            }
}

// Squares of pixels keep their side.
TEST(SplatsOnPixels, HaveSquaresAsLargeAsAPictureOfOneRay) {
    SplatsWorld world;
    world.scene.footprint = {.kernel = Kernel::Point, .size = 3};
    const auto pixels = world.all();
    for (const int rays : {1, 2}) {
        Scene fine = world.scene;
        fine.footprint.size = 3 * rays;
        const auto expected = meansOf(fine, world.view, rays);
        const auto depth = splatDepthAt(world.scene, world.view, pixels, rays, 2);
        const double most = *std::ranges::max_element(expected);
        for (std::size_t i = 0; i < depth.size(); ++i)
            ASSERT_NEAR(depth[i], expected[i], 1e-5 * most) << i;
    }
}

TEST(SplatsOnPixels, DoNotDependOnThreadsNorOnOtherPixels) {
    const SplatsWorld world;
    const auto pixels = world.all();
    const auto all = splatDepthAt(world.scene, world.view, pixels, 2, 1);
    EXPECT_EQ(all, splatDepthAt(world.scene, world.view, pixels, 2, 5));
    const std::vector<glm::ivec2> some{pixels[600], pixels[31], pixels[640]};
    const auto alone = splatDepthAt(world.scene, world.view, some, 2, 2);
    EXPECT_EQ(alone, (std::vector<double>{all[600], all[31], all[640]}));
}

TEST(SplatsOnPixels, AreNoneOnceNobodyWantsThem) {
    const SplatsWorld world;
    EXPECT_TRUE(splatDepthAt(world.scene, world.view, world.all(), 1, 1, false).empty());
}

}  // namespace
}  // namespace render
