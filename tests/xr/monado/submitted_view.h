// What the API layer of the tests (api_layer.cpp) writes down: one of these for each eye of each
// frame with a picture, into the file that kRecordVariable names.
#pragma once

#include <array>

namespace tests {

inline constexpr const char* kPretenceVariable = "ISOCHRON_TEST_PRETENCE";
inline constexpr const char* kRecordVariable = "ISOCHRON_TEST_RECORD";
// Values of kPretenceVariable.
inline constexpr const char* kNoHeadset = "no headset";
inline constexpr const char* kNoFloor = "no floor";
inline constexpr const char* kNoIndex = "no index";    // as if nobody knew its profile
inline constexpr const char* kGlErrors = "gl errors";  // left in each frame

// As xrEndFrame was given it: XrCompositionLayerProjectionView and XrCompositionLayerDepthInfoKHR.
struct SubmittedView {
    std::array<float, 4> orientation{};  // x, y, z, w
    std::array<float, 3> position{};
    float left = 0, right = 0, up = 0, down = 0;  // radians
    bool hasDepth = false;                        // what follows is only then something
    float near = 0, far = 0, minDepth = 0, maxDepth = 0;
    std::array<int, 4> depthRect{};  // x, y, width, height in the image
    unsigned depthTexture = 0;       // the image last acquired of the depth's swapchain
};

}  // namespace tests
