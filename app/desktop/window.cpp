#include "app/desktop/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <glm/common.hpp>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "app/desktop/x_errors.h"

namespace app::desktop {
namespace {

constexpr const char* kHeadlessWay = "`isochron render FILE -o OUT.png` draws without a window";

// What GLFW said last; its error callback has no user pointer.
std::string& lastError() {
    static std::string error;
    return error;
}

// Whether GLFW can be woken; wake() comes from any thread, also while there is no window.
struct Awake {
    std::mutex mutex;
    bool is = false;

    void set(bool to) {
        const std::lock_guard lock(mutex);
        is = to;
    }
};
Awake& awake() {
    static Awake awake;
    return awake;
}

// GLFW is process-wide.
struct Library {
    explicit Library([[maybe_unused]] Platform platform) {
        glfwSetErrorCallback([](int, const char* what) { lastError() = what; });
#ifdef GLFW_PLATFORM  // 3.4; before, a GLFW is built for X11 or for Wayland
        glfwInitHint(GLFW_PLATFORM,
                     platform == Platform::X11 ? GLFW_PLATFORM_X11 : GLFW_ANY_PLATFORM);
#endif
        if (glfwInit() == GLFW_FALSE)
            throw std::runtime_error(
                fmt::format("no display: {}; {}",
                            std::getenv("DISPLAY") == nullptr ? "DISPLAY is not set" : lastError(),
                            kHeadlessWay));
        awake().set(true);
    }
    ~Library() {
        awake().set(false);
        glfwTerminate();
    }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
};

// The newest context that the display gives, in words.
std::string offeredContext() {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    GLFWwindow* plain = glfwCreateWindow(64, 64, "isochron", nullptr, nullptr);
    if (plain == nullptr) return "none: " + lastError();
    const std::string offered =
        fmt::format("{}.{}", glfwGetWindowAttrib(plain, GLFW_CONTEXT_VERSION_MAJOR),
                    glfwGetWindowAttrib(plain, GLFW_CONTEXT_VERSION_MINOR));
    glfwDestroyWindow(plain);
    return offered;
}

// Nothing is larger than the screen it opens on, whose scale it will have.
glm::ivec2 fittingTheScreen(glm::ivec2 size) {
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    if (monitor == nullptr) return size;
    glm::ivec2 at, room;
    glm::vec2 scale(1);
    glfwGetMonitorWorkarea(monitor, &at.x, &at.y, &room.x, &room.y);
    glfwGetMonitorContentScale(monitor, &scale.x, &scale.y);
    for (int c = 0; c < 2; ++c)
        if (room[c] > 0 && scale[c] > 0)
            size[c] = std::min(size[c], static_cast<int>(static_cast<float>(room[c]) / scale[c]));
    return size;
}

GLFWwindow* createWindow(glm::ivec2 size, const std::string& title) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "isochron");
    glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "isochron");
    size = fittingTheScreen(size);
    GLFWwindow* window = glfwCreateWindow(size.x, size.y, title.c_str(), nullptr, nullptr);
    if (window == nullptr)
        throw std::runtime_error(
            fmt::format("a window needs OpenGL 4.5 and this display gives {}; {}", offeredContext(),
                        kHeadlessWay));
    glfwSetWindowSizeLimits(window, 800, 640, GLFW_DONT_CARE, GLFW_DONT_CARE);
    return window;
}

constexpr std::array kCursorShapes = {GLFW_ARROW_CURSOR,   GLFW_HAND_CURSOR,
                                      GLFW_IBEAM_CURSOR,   GLFW_HRESIZE_CURSOR,
                                      GLFW_VRESIZE_CURSOR, GLFW_CROSSHAIR_CURSOR};

}  // namespace

struct Window::State {
    Library library;
    GLFWwindow* window;
    std::array<GLFWcursor*, kCursorShapes.size()> cursors{};
    Cursor cursor = Cursor::Arrow;
    std::string title;
    std::deque<Event> events;
    bool exposed = false;

    State(glm::ivec2 size, const std::string& name, Platform platform)
        : library(platform), window(createWindow(size, name)), title(name) {
        for (std::size_t i = 0; i < cursors.size(); ++i)
            cursors[i] = glfwCreateStandardCursor(kCursorShapes[i]);
    }
    ~State() { glfwDestroyWindow(window); }
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    static State& of(GLFWwindow* w) { return *static_cast<State*>(glfwGetWindowUserPointer(w)); }
    void listen();
    void listenToKeys();
};

void Window::State::listen() {
    glfwSetWindowUserPointer(window, this);
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
        glm::ivec2 size{1}, pixels{1};
        glfwGetWindowSize(w, &size.x, &size.y);
        glfwGetFramebufferSize(w, &pixels.x, &pixels.y);
        const glm::vec2 ratio = glm::vec2(pixels) / glm::vec2(glm::max(size, glm::ivec2(1)));
        of(w).events.push_back(MouseMoved{glm::vec2(x, y) * ratio});
    });
    glfwSetCursorEnterCallback(window, [](GLFWwindow* w, int entered) {
        // A drag goes on outside.
        if (entered == GLFW_TRUE || glfwGetMouseButton(w, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS ||
            glfwGetMouseButton(w, GLFW_MOUSE_BUTTON_MIDDLE) == GLFW_PRESS)
            return;
        of(w).events.push_back(MouseMoved{glm::vec2(-std::numeric_limits<float>::max())});
    });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int) {
        if (button < 3) of(w).events.push_back(MouseButton{button, action == GLFW_PRESS});
    });
    glfwSetScrollCallback(window, [](GLFWwindow* w, double x, double y) {
        of(w).events.push_back(Wheel{glm::vec2(x, y)});
    });
    glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int focused) {
        of(w).events.push_back(FocusChanged{focused == GLFW_TRUE});
    });
    glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { of(w).exposed = true; });
    glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
        of(w).events.push_back(Dropped{{paths, paths + count}});
    });
    listenToKeys();
}

void Window::State::listenToKeys() {
    glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int mods) {
        if (key < 0) return;
        // By what is printed on the key, as the keyboard's layout has it, where GLFW knows.
        if (const char* name = glfwGetKeyName(key, 0); name != nullptr && name[1] == '\0') {
            if (name[0] >= 'a' && name[0] <= 'z') key = name[0] - 'a' + 'A';
            if (name[0] == ',' || name[0] == '.') key = name[0];
        }
        of(w).events.push_back(KeyChanged{.key = key,
                                          .down = action != GLFW_RELEASE,
                                          .repeated = action == GLFW_REPEAT,
                                          .ctrl = (mods & GLFW_MOD_CONTROL) != 0,
                                          .shift = (mods & GLFW_MOD_SHIFT) != 0,
                                          .alt = (mods & GLFW_MOD_ALT) != 0});
    });
    glfwSetCharCallback(window, [](GLFWwindow* w, unsigned code) {
        of(w).events.push_back(Character{static_cast<char32_t>(code)});
    });
}

Window::Window(glm::ivec2 size, const std::string& title, Platform platform)
    : state_(std::make_unique<State>(size, title, platform)) {
    state_->listen();
    surviveXErrors();
    glfwMakeContextCurrent(state_->window);
    glfwSwapInterval(1);
}
Window::~Window() = default;

void Window::throwIfGone() const {
    if (isGone(state_->window))
        throw std::runtime_error(
            "another program has destroyed the window; what was open is offered at the next start");
}

void Window::poll() {
    glfwPollEvents();
    throwIfGone();
}

void Window::wait(std::optional<std::chrono::nanoseconds> atMost) {
    const double seconds = atMost ? std::chrono::duration<double>(*atMost).count() : 0;
    if (!atMost)
        glfwWaitEvents();
    else
        seconds > 0 ? glfwWaitEventsTimeout(seconds) : glfwPollEvents();
    throwIfGone();
}

bool Window::takeExposed() { return std::exchange(state_->exposed, false); }
std::deque<Event>& Window::events() { return state_->events; }
bool Window::shouldClose() const { return glfwWindowShouldClose(state_->window) == GLFW_TRUE; }
void Window::close() { glfwSetWindowShouldClose(state_->window, GLFW_TRUE); }
void Window::wake() {
    const std::lock_guard lock(awake().mutex);
    if (awake().is) glfwPostEmptyEvent();
}

glm::ivec2 Window::framebufferSize() const {
    glm::ivec2 size{0};
    if (glfwGetWindowAttrib(state_->window, GLFW_ICONIFIED) == GLFW_TRUE) return size;
    glfwGetFramebufferSize(state_->window, &size.x, &size.y);
    throwIfGone();
    return size;
}

float Window::contentScale() const {
    float x = 1, y = 1;
    glfwGetWindowContentScale(state_->window, &x, &y);
    return y;
}

void Window::setTitle(const std::string& title) {
    if (title == state_->title) return;
    state_->title = title;
    glfwSetWindowTitle(state_->window, title.c_str());
}

void Window::setCursor(Cursor cursor) {
    if (cursor == state_->cursor) return;
    state_->cursor = cursor;
    glfwSetCursor(state_->window, state_->cursors[static_cast<std::size_t>(cursor)]);
}

void Window::setClipboard(const std::string& text) {
    glfwSetClipboardString(state_->window, text.c_str());
}
const char* Window::clipboard() const { return glfwGetClipboardString(state_->window); }
void Window::waitForScreen(bool waits) { glfwSwapInterval(waits ? 1 : 0); }
void Window::swap() {
    glfwSwapBuffers(state_->window);
    throwIfGone();
}

}  // namespace app::desktop
