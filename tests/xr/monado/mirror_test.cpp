// The window beside a headset, which shows what the left eye sees, on a screen that makes who asks
// for it wait for its refresh: Xvfb's never does.
#include <dlfcn.h>

#include "tests/xr/monado/front_end.h"

struct GLFWwindow;

namespace {

int interval = 0;  // that the program asked for last
int swaps = 0, waits = 0;

template <typename Function>
Function* glfws(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

// GLFW's own functions by these names are found after these.
void glfwSwapInterval(int refreshes) {
    interval = refreshes;
    static const auto real = glfws<void(int)>("glfwSwapInterval");
    real(refreshes);
}

void glfwSwapBuffers(GLFWwindow* window) {
    ++swaps;
    waits += interval != 0 ? 1 : 0;
    static const auto real = glfws<void(GLFWwindow*)>("glfwSwapBuffers");
    real(window);
}
}

namespace app::headset {
namespace {

TEST_F(FrontEnd, TheMirrorNeverWaitsForItsScreen) {
    const tests::MonadoService service(tests::Monado::Window);
    interval = swaps = waits = 0;
    open();
    framesUntil([] { return swaps >= 10; });
    EXPECT_EQ(waits, 0);
    headset_.reset();  // before its runtime goes
}

}  // namespace
}  // namespace app::headset
