// A window with an OpenGL 4.5 core context, current on the thread that made it. Events are kept in
// the order in which they came, so that none is lost while a frame is slow.
#pragma once

#include <chrono>
#include <deque>
#include <filesystem>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

struct GLFWwindow;

namespace app::desktop {

// Positions are framebuffer pixels, y down; far away (-FLT_MAX) once the mouse has left.
struct MouseMoved {
    glm::vec2 at;
};
struct MouseButton {
    int button;  // 0 left, 1 right, 2 middle
    bool down;
};
struct Wheel {
    glm::vec2 by;  // y > 0 is away from the user
};
struct KeyChanged {
    int key;  // GLFW's
    bool down, repeated, ctrl, shift, alt;
};
struct Character {
    char32_t code;
};
struct FocusChanged {
    bool focused;
};
struct Dropped {
    std::vector<std::filesystem::path> files;
};
using Event =
    std::variant<MouseMoved, MouseButton, Wheel, KeyChanged, Character, FocusChanged, Dropped>;

enum class Cursor { Arrow, Hand, Text, LeftRight, UpDown, Cross };

// Which displays will do: any, or only X11's (also a Wayland session's, if it has one), whose
// context is GLX's. A GLFW that knows but one kind of display takes that.
enum class Platform { Any, X11 };

class Window {
 public:
    // Throws std::runtime_error (one sentence) when there is no display or its OpenGL is too old;
    // both name the headless way.
    Window(glm::ivec2 size, const std::string& title, Platform platform = Platform::Any);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    // Takes in what has come; waits for something when told to, at most so long. Both, and what
    // asks or draws below, throw std::runtime_error (one sentence) once somebody else has destroyed
    // the window.
    void poll();
    void wait(std::optional<std::chrono::nanoseconds> atMost);
    std::deque<Event>& events();

    bool shouldClose() const;
    void close();  // from the thread that made it
    // From any thread: ends a wait(). Nothing while there is no window.
    static void wake();

    glm::ivec2 framebufferSize() const;  // 0 while minimised
    float contentScale() const;

    void setTitle(const std::string& title);
    void setCursor(Cursor cursor);
    void setClipboard(const std::string& text);
    const char* clipboard() const;
    void swap();
    // Whether what it showed was lost, as where another window stood before it, since the last time
    // that this was asked.
    bool takeExposed();
    // A swap waits for the screen, as it does at first, or not.
    void waitForScreen(bool waits);

 private:
    void throwIfGone() const;

    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace app::desktop
