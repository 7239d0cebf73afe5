// What becomes of a GL error.
#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include "render/gl/debug_output.h"
#include "render/gl/headless_context.h"

namespace render::gl {
namespace {

constexpr GLenum kNoCapability = GL_DEBUG_TYPE_ERROR;

TEST(GlErrors, AreThrownOnceWithTheDriversWords) {
    const HeadlessContext context;
    EXPECT_NO_THROW(throwOnError());
    glEnable(kNoCapability);
    glBindBuffer(kNoCapability, 0);  // the first one is told
    try {
        throwOnError();
        FAIL() << "no error was thrown";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), testing::StartsWith("GL: "));
        EXPECT_THAT(error.what(), testing::HasSubstr("GL_INVALID_ENUM"));
    }
    while (glGetError() != GL_NO_ERROR) {
    }
    EXPECT_NO_THROW(throwOnError());
}

// Run by CTest, which expects it to fail; see tests/support/gl_errors.cpp.
TEST(GlErrors, DISABLED_ThatNobodyAsksFor) {
    const HeadlessContext context;
    glEnable(kNoCapability);
}

}  // namespace
}  // namespace render::gl
