// A globe whose mesh comes to the GPU in slices.
#include <gtest/gtest.h>

#include "tests/support/canvas_of_noise.h"
#include "tests/support/measured_axis.h"

namespace app {
namespace {

using render::Image;
using render::Map;
using namespace app::canvas_of_noise;
using tests::measuredAxis;

class CanvasOfAGlobe : public CanvasOfNoise {
 protected:
    CanvasOfAGlobe() {
        const auto grid = std::make_shared<const timeseries::Grid>(
            std::array{measuredAxis("lon", "degrees_east", 0, 350, 36),
                       measuredAxis("lat", "degrees_north", -85, 85, 18),
                       measuredAxis("depth", "m", 0, 4000, 9, true)});
        world_.steps = {std::make_shared<const timeseries::SortedStep>(tests::noise(grid))};
        world_.dataset.variable.grid = grid;
        meshBytes_ = grid->count() * sizeof(timeseries::Mesh::Point);
    }
    // As a canvas draws it that has drawn nothing else.
    Image alone(const Explorer& explorer) {
        Canvas canvas(render::SplatterChoice::Gl);
        const Shown shown{explorer, world_.dataset, 0, world_.steps[0]};
        Image image;
        canvas.draw(shown, canvas.eyesOf(shown), {}, false,
                    [&](std::size_t, const render::Targets& light) { image = light.readLight(); });
        return image;
    }
    std::uint64_t meshBytes_ = 0;
};

TEST_F(CanvasOfAGlobe, TheFlatPictureStaysAsItIsAskedForUntilTheMeshIsThere) {
    for (const render::Order order : {render::Order::None, render::Order::BackToFront}) {
        world_.explorer.order = order;
        world_.explorer.map = Map::Flat;
        draw(world_.shown());
        Explorer flat = world_.explorer;
        world_.explorer.map = Map::Globe;
        // Of colour by value, which needs no more of the GPU.
        world_.explorer.layers[0].opacity = flat.layers[0].opacity = 0.4;
        const Image before = alone(flat), after = alone(world_.explorer);
        ASSERT_NE(before, after);
        int frames = 0;
        for (; frames < 100; ++frames) {
            const auto eyes = draw(world_.shown(), {.uploadBytes = meshBytes_ / 5});
            ASSERT_EQ(eyes.size(), 1u);
            if (report_.whole) {
                EXPECT_EQ(eyes[0], after) << frames;
                break;
            }
            ASSERT_EQ(eyes[0], before) << frames;
            EXPECT_LT(report_.uploaded, 1);
        }
        EXPECT_GE(frames, 5);
        EXPECT_LT(frames, 20);
        // And back again.
        world_.explorer.map = Map::Flat;
        const Image back = draw(world_.shown()).at(0);
        EXPECT_EQ(back, report_.whole ? before : after) << "where points are to come, too";
        EXPECT_EQ(draw(world_.shown()).at(0), before);
        world_.steps[0] = std::make_shared<const timeseries::SortedStep>(
            tests::noise(world_.steps[0]->sharedGrid()));
    }
}

// On the screen another stretch waits, too.
TEST_F(CanvasOfAGlobe, AnotherStretchTakesOverOnceItsMeshIsThere) {
    world_.explorer.map = Map::Globe;
    world_.explorer.scale = glm::dvec3(1, 1, 50);
    draw(world_.shown());
    Explorer before = world_.explorer;
    world_.explorer.scale = glm::dvec3(1, 1, 200);
    world_.explorer.layers[0].opacity = before.layers[0].opacity = 0.4;
    const Image first = alone(before), last = alone(world_.explorer);
    ASSERT_EQ(draw(world_.shown(), {.uploadBytes = meshBytes_ / 5}).at(0), first);
    EXPECT_FALSE(report_.whole);
    Image drawn;
    for (int frame = 0; frame < 20 && !report_.whole; ++frame)
        drawn = draw(world_.shown(), {.uploadBytes = meshBytes_ / 5}).at(0);
    EXPECT_EQ(drawn, last);
}

}  // namespace
}  // namespace app
