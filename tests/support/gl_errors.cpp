// In a test program: a GL error that a test leaves behind, recorded and not asked for, fails it
// with the driver's message.
#include <gtest/gtest.h>

#include "render/gl/debug_output.h"

namespace tests {
namespace {

class NoGlErrors : public testing::EmptyTestEventListener {
    void OnTestEnd(const testing::TestInfo&) override {
        if (const auto error = render::gl::takeRecordedError())
            ADD_FAILURE() << "a GL error that nobody asked for: " << *error;
    }
};

const bool listening = [] {
    testing::UnitTest::GetInstance()->listeners().Append(new NoGlErrors);  // which owns it
    return true;
}();

}  // namespace
}  // namespace tests
