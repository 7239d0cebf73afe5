// Frames whose planes are summed in coarser pixels than the picture's.
#include <gtest/gtest.h>

#include <cmath>

#include "render/frame/plain_frame.h"
#include "render/reference/image_compare.h"
#include "tests/support/frame_world.h"

namespace render {
namespace {

// Drawn by GL, by the program and in double.
class CoarsePlanes : public tests::FrameWorld, public testing::TestWithParam<SplatterChoice> {
 protected:
    Image drawn(const FrameContent& content, const View& view) {
        if (renderer_.splatters().takesPointsFromGpu(content.scene))
            onGpu_.upload(content.scene, neededScale(content.scene));
        const auto frame = renderer_.prepare(content, onGpu_, std::array{view});
        renderer_.drawEye(frame, view);
        return renderer_.targets().readLight();
    }
    FrameRenderer renderer_{GetParam()};
};

// Of a black picture of nothing else.
bool hasLineNear(const Image& lines, const glm::ivec2& at, int reach) {
    for (int y = std::max(at.y - reach, 0); y <= std::min(at.y + reach, lines.size.y - 1); ++y)
        for (int x = std::max(at.x - reach, 0); x <= std::min(at.x + reach, lines.size.x - 1); ++x)
            if (lines.at(x, y) != glm::vec4(0, 0, 0, 1)) return true;
    return false;
}

// White light of optical depth t is 1 - e^-t: here of the coarse picture's depth, between its
// pixels. Lines hide what lies behind them, in coarse pixels too, and texts have their ground about
// them: there nothing is looked at.
TEST_P(CoarsePlanes, HaveTheDepthOfTheCoarsePictureBetweenItsPixels) {
    constexpr int kGround = 8;
    for (const glm::ivec2 size : {glm::ivec2(200, 160), glm::ivec2(201, 161)})
        for (const int across : {2, 3}) {
            const View view = tests::lookFrom({0.4, -2.7, 0.9}, size);
            Scene white = scene_, none = scene_;
            for (Layer& layer : white.layers) layer.style.color = Constant{glm::dvec3(1)};
            none.layers.clear();
            const auto on = [&](const Scene& scene) {
                return drawn({scene, step_.grid(), {}, glm::dvec3(0), across}, view);
            };
            const Image light = on(white), lines = on(none);
            const std::vector<float> depth = enlargedDepthOf(white, view, across);
            double most = 0;
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x) {
                    if (hasLineNear(lines, {x, size.y - 1 - y}, kGround)) continue;
                    const double t = double(depth[std::size_t(y * size.x + x)]);
                    ASSERT_NEAR(light.at(x, size.y - 1 - y).r, 1 - std::exp(-t), 1e-3)
                        << x << ' ' << y << ' ' << across;
                    most = std::max(most, t);
                }
            EXPECT_GT(most, 0.5);
        }
}

// Lines, labels and the legend stay as they are; where splats are, light is that of the coarse
// picture, between its pixels.
TEST_P(CoarsePlanes, AreDrawnUnderTheSameLinesAndText) {
    const View odd = tests::lookFrom({0.4, -2.7, 0.9}, {201, 161});
    for (const bool cells : {false, true})
        for (const Order order : {Order::None, Order::BackToFront}) {
            scene_.order = order;
            if (cells) scene_.cells = step_.cells();
            for (std::size_t k = 0; cells && k < 2; ++k) {
                Cells& layer = scene_.layers[k].cells;
                layer.ranges = {{k == 0 ? 0.1 : 0.7, k == 0 ? 0.2 : 0.9}};
                layer.candidates = scene_.cells->select(layer.ranges);
            }
            Scene none = scene_;
            none.layers.clear();
            const Legend legend{"Temperature (K)", "step 3 of 9", {}, {"a note below"}};
            const auto picture = [&](const Scene& scene, int across) {
                return drawn({scene, step_.grid(), legend, glm::dvec3(0.02), across}, odd);
            };
            const Image fine = picture(scene_, 1), coarse = picture(scene_, 2);
            EXPECT_EQ(picture(none, 2), picture(none, 1));
            EXPECT_NE(fine, coarse);
            const auto difference = comparePictures(fine, coarse);
            EXPECT_LT(difference.rmseLinear, 0.04) << cells << static_cast<int>(order);
            // The same by the mean of the fine one's light, but for what is curved in a pixel, and
            // for noise in cells two coarse pixels wide, in each of which one ray is.
            glm::dvec4 sums[2] = {};
            for (int y = 0; y < odd.size.y; ++y)
                for (int x = 0; x < odd.size.x; ++x) {
                    sums[0] += glm::dvec4(fine.at(x, y));
                    sums[1] += glm::dvec4(coarse.at(x, y));
                }
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(sums[1][c] / sums[0][c], 1, 0.05);
        }
}

INSTANTIATE_TEST_SUITE_P(By, CoarsePlanes,
                         testing::Values(SplatterChoice::Gl, SplatterChoice::Cpu,
                                         SplatterChoice::Exact),
                         [](const auto& choice) { return tests::nameOf(choice.param); });

}  // namespace
}  // namespace render
