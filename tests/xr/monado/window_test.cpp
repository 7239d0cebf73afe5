// Monado's real compositor, and a session over GLX watched by OpenXR's validation layer.
#include <gmock/gmock.h>
#include <stdlib.h>

#include <filesystem>
#include <string>

#include "tests/support/files.h"
#include "tests/support/glx_context.h"
#include "tests/support/headset.h"
#include "tests/support/monado_service.h"

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
