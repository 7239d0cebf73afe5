// The window beside a headset, which shows what the left eye sees: on a screen that makes who asks
// for it wait for its refresh, which Xvfb's never does; and with EGL's context, as in a Wayland
// session.
#include <dlfcn.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <gmock/gmock.h>

#include "app/headset/graphics.h"
#include "render/gl/current_egl.h"
#include "render/gl/current_glx.h"
#include "tests/xr/monado/front_end.h"

namespace {

int interval = 0;  // that the program asked for last
int swaps = 0, waits = 0;
bool egl = false;  // windows get its contexts

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

GLFWwindow* glfwCreateWindow(int width, int height, const char* title, GLFWmonitor* monitor,
                             GLFWwindow* share) {
    if (egl) glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
    static const auto real =
        glfws<GLFWwindow*(int, int, const char*, GLFWmonitor*, GLFWwindow*)>("glfwCreateWindow");
    return real(width, height, title, monitor, share);
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

class FrontEndOfEgl : public FrontEnd {
 protected:
    FrontEndOfEgl() { egl = true; }
    ~FrontEndOfEgl() override { egl = false; }
    tests::MonadoService service_{tests::Monado::Window};
};

TEST_F(FrontEndOfEgl, ARuntimeThatTakesEglGetsIt) {
    swaps = 0;
    open();
    EXPECT_FALSE(render::gl::currentGlx());
    EXPECT_TRUE(render::gl::currentEgl());
    framesUntil([] { return swaps >= 10; });
    headset_.reset();  // before its runtime goes
}

TEST_F(FrontEndOfEgl, ForOneThatTakesOnlyX11sItIsSaidSo) {
    const Graphics graphics(xr::Session::Offer{.takesEgl = false});
    try {
        graphics.binding();
        FAIL() << "a binding";
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(
            error.what(),
            "the headset's runtime takes OpenGL from X11 only, and this display is another");
    }
}

}  // namespace
}  // namespace app::headset
