// By Xlib's default whatever an X server complains of ends the program on the spot. Here nothing
// does but the end of the connection, which Xlib does not survive. Without X11 nothing happens.
#pragma once

#include <functional>

struct GLFWwindow;

namespace app::desktop {

// From here on complaints are only counted. GLFW puts the default back where it makes a context.
void surviveXErrors();
// Something was complained of since the last call, and the window is not there any more.
bool isGone(GLFWwindow* window);

// While it lives, `keep` is called before the process ends because the connection has: on this
// object's thread, or not at all. Such a process says a sentence and ends with 1.
class AtConnectionsEnd {
 public:
    explicit AtConnectionsEnd(std::function<void()> keep);
    ~AtConnectionsEnd();
    AtConnectionsEnd(const AtConnectionsEnd&) = delete;
    AtConnectionsEnd& operator=(const AtConnectionsEnd&) = delete;
};

}  // namespace app::desktop
