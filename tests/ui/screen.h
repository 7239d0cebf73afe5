// An X server of the test's own that nobody looks at (Xvfb), and the test's connection to it. There
// is no window manager: the test does what one would do.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>

#include "tests/ui/process.h"

struct _XDisplay;  // Xlib's Display
union _XEvent;     // Xlib's XEvent

namespace ui {

using XWindow = unsigned long;
using XAtom = unsigned long;

class Screen {
 public:
    static constexpr glm::ivec2 kSize{1600, 1000};

    static bool isInstalled();
    // Answers as soon as programs can connect. Files go into `folder`. Throws std::runtime_error.
    explicit Screen(const std::filesystem::path& folder);
    ~Screen();
    Screen(const Screen&) = delete;
    Screen& operator=(const Screen&) = delete;

    const std::string& name() const { return name_; }  // for DISPLAY
    _XDisplay* connection() const { return connection_; }
    XWindow root() const;
    XWindow own() const { return own_; }  // a window of the test itself, never seen
    XAtom atom(const char* name) const;

    // Sends the window a client message of 32-bit words (ICCCM 4.2.8).
    void send(XWindow to, const char* type, std::array<long, 5> words) const;
    // A property's bytes; empty when it has none.
    std::string property(XWindow window, const char* name) const;
    // What programs that start later read of the user's desktop, "NAME: VALUE".
    void setResource(const std::string& line) const;
    // While another program's window stands there, before all others.
    void cover(glm::ivec2 at, glm::ivec2 size, const std::function<void()>& meanwhile) const;
    // Takes the first event that has come and for which `isIt` holds; false when there is none.
    bool hasEvent(const std::function<bool(const _XEvent&)>& isIt) const;
    // The window that a process has made; none yet.
    std::optional<XWindow> windowOf(pid_t process) const;

 private:
    std::unique_ptr<Process> server_;
    std::string name_;
    _XDisplay* connection_ = nullptr;
    XWindow own_ = 0;
};

}  // namespace ui
