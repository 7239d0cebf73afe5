// What a window draws: the same pictures as files, in time.
#include "app/canvas.h"

#include <gtest/gtest.h>

#include "render/gl/debug_output.h"
#include "render/gl/headless_context.h"
#include "tests/support/shown_steps.h"

namespace app {
namespace {

class CanvasOfNoise : public testing::Test {
 protected:
    std::vector<render::Image> draw(const Shown& shown, const CanvasLimits& limits = {},
                                    bool moving = false) {
        std::vector<render::Image> eyes;
        const auto views = canvas_.eyesOf(shown);
        report_ = canvas_.draw(shown, views, limits, moving,
                               [&](std::size_t eye, const render::Targets& light) {
                                   EXPECT_EQ(eye, eyes.size());
                                   eyes.push_back(light.readLight());
                               });
        render::gl::throwOnError();
        return eyes;
    }

    render::gl::HeadlessContext context_;
    tests::ShownSteps world_{20};
    Canvas canvas_;
    CanvasReport report_;
};

TEST_F(CanvasOfNoise, AtRestAllPointsAreDrawnForEveryEye) {
    world_.explorer.stereo.mode = Stereo::SideBySide;
    const auto eyes = draw(world_.shown());
    ASSERT_EQ(eyes.size(), 2u);
    EXPECT_NE(eyes[0], eyes[1]);
    EXPECT_EQ(report_.drawn, report_.selected);
    EXPECT_TRUE(report_.whole);
}

}  // namespace
}  // namespace app
