// What is measured of GL's frames is what is measured of the program's, but for float.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "render/frame/plain_frame.h"
#include "render/gl/headless_context.h"
#include "render/reference/image_compare.h"
#include "tests/support/cell_worlds.h"

namespace render {
namespace {

TEST(PlainFrameByGl, IsTheProgramsPictureAndDepth) {
    const gl::HeadlessContext context;
    const View view = tests::lookFrom({0.7, -3, 1.1}, {97, 75});
    for (const bool byCells : {false, true}) {
        tests::CellWorld world(tests::noise(tests::cube(12)), {"0:0.3", "0.5:0.6"}, 0.4);
        if (!byCells) world.scene.cells.reset();
        for (Layer& layer : world.scene.layers) layer.style.color = ByValue{{}, 0, 0.6};
        PlainFrame onGpu(world.step, world.placed, glm::dvec3(0.1), SplatterChoice::Gl),
            here(world.step, world.placed, glm::dvec3(0.1));
        for (const Order order : {Order::None, Order::BackToFront})
            for (const int across : {1, 2}) {
                world.scene.order = order;
                onGpu.draw(world.scene, view, across);
                here.draw(world.scene, view, across);
                EXPECT_LE(comparePictures(onGpu.light(), here.light()).maxAbsolute, 1e-3)
                    << byCells << ' ' << across;
                const auto drawn = onGpu.depth(world.scene, view, across),
                           expected = here.depth(world.scene, view, across);
                ASSERT_EQ(drawn.size(), expected.size());
                EXPECT_LE(compareScalars(drawn, expected).relativeL2, 1e-5);
                EXPECT_GT(*std::ranges::max_element(expected), 0.5f);
            }
    }
}

}  // namespace
}  // namespace render
