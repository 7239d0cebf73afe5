// A canvas that draws noise by GL, for tests of what a window shows.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "app/drawing/canvas.h"
#include "app/picture/still.h"
#include "render/gl/debug_output.h"
#include "render/gl/headless_context.h"
#include "render/splat/splat_cost.h"
#include "tests/support/shown_steps.h"

namespace app::canvas_of_noise {

using render::Image;

class CanvasOfNoise : public testing::Test {
 protected:
    std::vector<Image> draw(const Shown& shown, const CanvasLimits& limits = {},
                            bool moving = false) {
        std::vector<Image> eyes;
        const auto views = canvas_.eyesOf(shown);
        report_ = canvas_.draw(shown, views, limits, moving,
                               [&](std::size_t eye, const render::Targets& light) {
                                   EXPECT_EQ(eye, eyes.size());
                                   eyes.push_back(light.readLight());
                               });
        render::gl::throwOnError();
        return eyes;
    }
    // Of what is shown, in every eye, where each point stands for so many.
    double cost(std::uint32_t stride) const {
        const Shown shown = world_.shown();
        const render::PlacedPoints placed(shown.sorted->grid());
        Picture picture =
            makePicture(shown.explorer, shown.dataset.variable, 0, *shown.sorted, placed);
        picture.scene.stride = stride;
        picture.scene.footprint.size *= std::cbrt(stride);
        double sum = 0;
        for (const render::View& view : canvas_.eyesOf(shown))
            sum += render::sceneCost(picture.scene, view, render::SummedBy::Gl);
        return sum;
    }
    // As `isochron render` makes it: a renderer and a step on the GPU that have seen nothing else.
    void drawApart(const Shown& shown, const std::filesystem::path& file) {
        render::FrameRenderer renderer(render::SplatterChoice::Gl);
        const render::PlacedPoints placed(shown.sorted->grid(), shown.explorer.scale);
        render::GlStep onGpu(*shown.sorted, placed);
        write(drawStill(
            {shown.explorer, shown.dataset.variable, shown.step, *shown.sorted, placed, 0},
            renderer, onGpu, {}, file));
    }

    render::gl::HeadlessContext context_;
    tests::ShownSteps world_{20};
    Canvas canvas_{render::SplatterChoice::Gl};
    CanvasReport report_;
    const std::uint64_t stepBytes_ = world_.steps[0]->size() * 10;  // points and values
};

// Noise on 64^3 points: eight blocks on the GPU, block b of the values [b / 8, (b + 1) / 8), near
// enough.
class CanvasOfBlocks : public CanvasOfNoise {
 protected:
    CanvasOfBlocks() { world_ = tests::ShownSteps(64); }
    static constexpr std::uint64_t kBlockBytes = render::GlStep::kBlock * 10;
};

}  // namespace app::canvas_of_noise
