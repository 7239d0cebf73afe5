// The depth that the compositor gets with each eye's picture, against where things are.
#include <epoxy/gl.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "app/headset/eyes.h"
#include "tests/xr/monado/api_layer.h"
#include "tests/xr/monado/front_end.h"

namespace app::headset {
namespace {

// The submitted part of a depth image, [y][x], from below.
std::vector<float> depthOf(const tests::SubmittedView& view) {
    const auto& [x, y, width, height] = view.depthRect;
    std::vector<float> depth(std::size_t(width) * height);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureSubImage(view.depthTexture, 0, x, y, 0, width, height, 1, GL_DEPTH_COMPONENT,
                         GL_FLOAT, GLsizei(depth.size() * sizeof(float)), depth.data());
    return depth;
}

// Metres before the eye, along its axis (XrCompositionLayerDepthInfoKHR: nearZ is at minDepth, farZ
// at maxDepth, and 1/z is linear between them).
double distanceOf(float depth, const tests::SubmittedView& view) {
    const double share = (depth - view.minDepth) / (view.maxDepth - view.minDepth);
    return 1 / (1 / double(view.near) + share * (1 / double(view.far) - 1 / double(view.near)));
}

// Metres before the eye where the ray through the middle of a pixel meets a plate, away from its
// edges; none where it does not.
std::optional<double> distanceOf(const Plate& plate, const tests::SubmittedView& view, int x,
                                 int y) {
    const auto between = [](double from, double to, double share) {
        return std::tan(from) + share * (std::tan(to) - std::tan(from));
    };
    const glm::dvec3 inEye(between(view.left, view.right, (x + 0.5) / view.depthRect[2]),
                           between(view.down, view.up, (y + 0.5) / view.depthRect[3]), -1);
    const auto& o = view.orientation;
    const glm::dvec3 along = glm::dquat(o[3], o[0], o[1], o[2]) * inEye;
    const glm::dvec3 eye = glm::make_vec3(view.position.data());
    const auto& [turn, middle] = plate.stageFromPlate;
    const glm::dvec3 normal = turn * glm::dvec3(0, 0, 1);
    const double distance = glm::dot(middle - eye, normal) / glm::dot(along, normal);
    const glm::dvec3 met = glm::inverse(turn) * (eye + distance * along - middle);
    if (distance <= 0 || std::abs(met.x) > 0.97 * plate.half.x ||
        std::abs(met.y) > 0.97 * plate.half.y)
        return std::nullopt;
    return distance;
}

class Depth : public FrontEndWithHands {
 protected:
    void SetUp() override {
        if (!tests::ApiLayer::isBuilt()) GTEST_SKIP() << tests::ApiLayer::kNotBuilt;
        FrontEndWithHands::SetUp();
    }
    tests::ApiLayer layer_;
};

// The panel is opaque and where Room says; splats leave no depth, and neither does nothing.
TEST_F(Depth, OfTheOpaqueSceneIsGivenWithTheNearAndFarThatItWasDrawnWith) {
    const std::size_t before = layer_.submitted().size();
    framesUntil([&] { return layer_.submitted().size() >= before + 4; });
    const auto all = layer_.submitted();
    const Plate panel = *headset_->interaction().panel();
    for (std::size_t eye = all.size() - 2; eye < all.size(); ++eye) {
        const tests::SubmittedView& view = all[eye];
        ASSERT_TRUE(view.hasDepth);
        EXPECT_NEAR(view.near, kNear, 1e-7);
        EXPECT_EQ(view.far, kFar);
        EXPECT_EQ(view.minDepth, 0);
        EXPECT_EQ(view.maxDepth, 1);
        const std::vector<float> depth = depthOf(view);
        const auto& [left, lower, width, height] = view.depthRect;
        int onPanel = 0, ofPanel = 0, elsewhere = 0, ofNothing = 0;
        for (int y = 0; y < height; ++y)
            // The lenses hide corners of an eighth of each side (session_test.cpp).
            for (int x = width / 8; x < width - width / 8; ++x) {
                const float at = depth[std::size_t(y) * width + x];
                const auto expected = distanceOf(panel, view, x, y);
                if (!expected) {
                    ++elsewhere;
                    ofNothing += at == view.maxDepth ? 1 : 0;
                    continue;
                }
                ++onPanel;
                const double off = distanceOf(at, view) - *expected;
                ofPanel += std::abs(off) < 1e-3 ? 1 : 0;
                ASSERT_LT(off, 1e-3) << "nothing is seen through the panel: " << x << ' ' << y;
            }
        EXPECT_GT(onPanel, width * height / 50);
        EXPECT_GT(ofPanel, 0.95 * onPanel) << "but for rays and a hand before it";
        EXPECT_GT(ofNothing, 0.5 * elsewhere);
        EXPECT_LT(ofNothing, elsewhere) << "the text at the hand is opaque, too";
    }
}

}  // namespace
}  // namespace app::headset
