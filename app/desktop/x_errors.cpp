#include "app/desktop/x_errors.h"

#include <X11/Xlib.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <utility>

#include "app/say.h"

// As GLFW/glfw3native.h, which would need Xrandr's headers beside Xlib's.
extern "C" Display* glfwGetX11Display();
extern "C" Window glfwGetX11Window(GLFWwindow*);

namespace app::desktop {
namespace {

std::atomic<int> complaints = 0;

// Xlib's handlers have no user pointer.
struct Keeper {
    std::function<void()> keep;
    std::thread::id thread;
};
Keeper& keeper() {
    static Keeper keeper;
    return keeper;
}

int count(Display*, XErrorEvent*) {
    ++complaints;
    return 0;
}

int end(Display*) {
    const Keeper& k = keeper();
    if (k.keep && k.thread == std::this_thread::get_id()) k.keep();
    sayTo(stderr,
          "isochron: the display has gone away; what was open is offered at the next start\n");
    std::fflush(nullptr);
    std::_Exit(EXIT_FAILURE);
}

}  // namespace

void surviveXErrors() { XSetErrorHandler(count); }

bool isGone(GLFWwindow* window) {
    if (complaints.exchange(0) == 0) return false;
    XWindowAttributes attributes{};
    const bool is =
        XGetWindowAttributes(glfwGetX11Display(), glfwGetX11Window(window), &attributes) != 0;
    complaints = 0;
    return !is;
}

AtConnectionsEnd::AtConnectionsEnd(std::function<void()> keep) {
    keeper() = {std::move(keep), std::this_thread::get_id()};
    XSetIOErrorHandler(end);
}
AtConnectionsEnd::~AtConnectionsEnd() { keeper().keep = {}; }

}  // namespace app::desktop
