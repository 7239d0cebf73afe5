// Monado's real compositor, and a session over GLX watched by OpenXR's validation layer.
#include <gmock/gmock.h>
#include <stdlib.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <glm/common.hpp>
#include <string>

#include "tests/support/files.h"
#include "tests/support/glx_context.h"
#include "tests/support/headset.h"
#include "tests/support/monado_service.h"
#include "tests/support/screen_grab.h"

namespace xr {
namespace {

// Sixty frames in focus, as a program has them, to the end.
void live(Session& session) {
    ASSERT_TRUE(tests::framesUntilFocused(session));
    int frames = 0;
    ASSERT_TRUE(tests::framesUntil(
        session, [&](auto&) { ++frames; }, [&] { return frames == 60; }));
    session.vibrate(1, 0.3, std::chrono::milliseconds(10));
    session.requestExit();
    EXPECT_TRUE(tests::framesUntil(
        session, [](auto&) {}, [&] { return session.ended(); }));
}

// The upper and the lower half of the left eye, then of the right.
constexpr std::array kHalves{glm::vec3(1, 0, 0), glm::vec3(0, 0, 1), glm::vec3(0, 1, 0),
                             glm::vec3(1, 1, 0)};

void submitHalves(Session::Frame& frame) {
    const auto eyes = frame.eyes(1);
    for (std::size_t i = 0; i < 2 * eyes.size(); ++i) {
        const Eye& eye = eyes[i / 2];
        const int half = eye.size.y / 2, from = i % 2 == 0 ? half : 0;
        render::gl::begin({.framebuffer = eye.framebuffer,
                           .size = {eye.size.x, half},
                           .at = {0, from},
                           .clearColor = glm::vec4(kHalves[i], 1),
                           .clearDepth = 1.0f,
                           .depth = render::gl::DepthTest::TestAndWrite,
                           .srgbWrite = true});
    }
    frame.submit(0.05, 100);
}

// Pixels of a screen that have a full colour, and their middle.
struct Patch {
    int count = 0;
    glm::dvec2 middle{0};
};
Patch patchOf(const tests::ScreenGrab& grab, const glm::vec3& color) {
    Patch patch;
    for (std::size_t i = 0; i < grab.pixels.size(); ++i) {
        const glm::vec3 off = glm::abs(glm::vec3(grab.pixels[i]) - 255.0f * color);
        if (std::max({off.r, off.g, off.b}) > 40) continue;
        ++patch.count;
        const auto width = static_cast<std::size_t>(grab.size.x);
        patch.middle += glm::dvec2(i % width, i / width);
    }
    if (patch.count > 0) patch.middle /= patch.count;
    return patch;
}

bool hasValidationLayer() {
    std::error_code none;
    for (const auto& file :
         std::filesystem::directory_iterator("/usr/share/openxr/1/api_layers/explicit.d", none))
        if (file.path().filename().string().starts_with("XrApiLayer_core_validation")) return true;
    return false;
}

TEST(RealCompositor, TakesFramesOfFullSizeFromEgl) {
    tests::MonadoService service(tests::Monado::Window);
    render::gl::HeadlessContext context;
    const auto session = tests::openHeadset(context);
    ASSERT_TRUE(session);
    ASSERT_TRUE(tests::framesUntilFocused(*session));
    const auto frame = session->beginFrame();
    ASSERT_TRUE(frame);
    ASSERT_EQ(frame->eyes(1).size(), 2u);
    EXPECT_EQ(frame->eyes(1)[0].size, glm::ivec2(896, 1007));
    tests::submitColor(*frame);
    live(*session);
}

TEST(RealCompositor, ShowsBothEyesBesideEachOtherTheRightWayUp) {
    tests::MonadoService service(tests::Monado::Window);
    render::gl::HeadlessContext context;
    const auto session = tests::openHeadset(context);
    ASSERT_TRUE(session);
    ASSERT_TRUE(tests::framesUntilFocused(*session));
    std::array<Patch, 4> seen;
    const auto isAllThere = [&] {
        const tests::ScreenGrab grab = tests::grabScreen();
        std::ranges::transform(kHalves, seen.begin(),
                               [&](const glm::vec3& color) { return patchOf(grab, color); });
        return std::ranges::all_of(seen, [](const Patch& p) { return p.count > 50'000; });
    };
    const auto end = std::chrono::steady_clock::now() + ui::kDeadline;
    while (!isAllThere()) {
        ASSERT_LT(std::chrono::steady_clock::now(), end) << seen[0].count << ' ' << seen[3].count;
        if (const auto frame = session->beginFrame(); frame && frame->shouldRender())
            submitHalves(*frame);
    }
    const auto& [leftUpper, leftLower, rightUpper, rightLower] = seen;
    EXPECT_LT(leftUpper.middle.y + 100, leftLower.middle.y) << "rows count from the top";
    EXPECT_LT(rightUpper.middle.y + 100, rightLower.middle.y);
    EXPECT_LT(leftUpper.middle.x + 100, rightUpper.middle.x);
    EXPECT_LT(leftLower.middle.x + 100, rightLower.middle.x);
}

TEST(RealCompositor, AndTheValidationLayerFindNoFaultInASessionOverGlx) {
    if (!hasValidationLayer()) GTEST_SKIP() << "no validation layer here";
    const auto told = tests::testFolder() / "validation.txt";
    setenv("XR_ENABLE_API_LAYERS", "XR_APILAYER_LUNARG_core_validation", 1);
    setenv("XR_CORE_VALIDATION_EXPORT_TYPE", "text", 1);
    setenv("XR_CORE_VALIDATION_FILE_NAME", told.c_str(), 1);
    {
        tests::MonadoService service(tests::Monado::Window);
        tests::GlxContext context;
        auto opened = Session::open(context.binding());
        auto* session = std::get_if<0>(&opened);
        ASSERT_TRUE(session) << std::get<NoHeadset>(opened).why;
        live(**session);
    }
    unsetenv("XR_ENABLE_API_LAYERS");
    const std::string text = tests::readBytes(told);
    EXPECT_THAT(text, testing::HasSubstr("Core Validation Layer is initialized"));
    EXPECT_THAT(text, testing::Not(testing::HasSubstr("VALID_ERROR")));
    EXPECT_THAT(text, testing::Not(testing::HasSubstr("VALID_WARNING")));
}

}  // namespace
}  // namespace xr
