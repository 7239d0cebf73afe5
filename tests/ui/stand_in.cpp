// What no X server does by itself, put between the program and GLFW (LD_PRELOAD; stand_in.h): a
// monitor whose content scale changes, and a call that the GL driver refuses. The file that
// ISOCHRON_STAND_IN names says which, and is asked every time.
#include <dlfcn.h>
#include <epoxy/gl.h>

#include <cstdlib>
#include <fstream>

struct GLFWwindow;

namespace {

struct Said {
    float scale = 1;
    bool glError = false;
};

Said said() {
    Said out;
    const char* const file = std::getenv("ISOCHRON_STAND_IN");
    if (file != nullptr) std::ifstream(file) >> out.scale >> out.glError;
    return out;
}

}  // namespace

extern "C" {

// GLFW's own functions by these names are found after these.
void glfwGetWindowContentScale(GLFWwindow*, float* x, float* y) { *x = *y = said().scale; }

void glfwSwapBuffers(GLFWwindow* window) {
    if (said().glError) glEnable(GL_DEBUG_TYPE_ERROR);  // no capability
    using Swap = void (*)(GLFWwindow*);
    static const auto swap = reinterpret_cast<Swap>(dlsym(RTLD_NEXT, "glfwSwapBuffers"));
    swap(window);
}
}
