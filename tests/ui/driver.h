// isochron in a window, driven as a user drives it: keys, mouse, drops. Positions are pixels of the
// window, y down. Whatever waits throws std::runtime_error after kDeadline, and when the program
// has ended meanwhile, with what it said.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/panels/layout.h"
#include "tests/support/built_paths.h"
#include "tests/ui/process.h"
#include "tests/ui/screen.h"
#include "tests/ui/shot.h"

namespace ui {

enum class Button { Left = 1, Middle = 2, Right = 3 };

class Driver {
 public:
    // Starts `isochron ARGUMENTS...`, or another of the program's builds, in `folder`, which is
    // also its user's home, and waits for its window.
    Driver(const Screen& screen, const std::filesystem::path& folder,
           std::vector<std::string> arguments,
           std::map<std::string, std::optional<std::string>> environment = {},
           const std::filesystem::path& program = tests::program());

    Process& process() { return process_; }
    std::string title() const;
    glm::ivec2 size() const;

    // Everything sent before has been taken in and drawn.
    void sync();
    // How long the program took to answer: no frame took longer.
    std::chrono::nanoseconds ping();
    void waitFor(std::string_view what, const std::function<bool()>& holds,
                 std::chrono::milliseconds pause = std::chrono::milliseconds(5));
    void waitForTitle(std::string_view piece);

    Shot shot() const;
    Shot shot(const app::panels::Rect& place) const;
    // Once nothing is left to be drawn: two alike, farther apart than a picture needs to be
    // refined.
    Shot settled();
    Shot settled(const app::panels::Rect& place) { return part(settled(), place); }

    // "space", "F12", "ctrl+s", "ctrl+shift+z": names of X keysyms.
    void press(std::string_view keys);
    void pressOnly(std::string_view keys);  // without sync(): keys that end the window
    void hold(std::string_view modifier) { key(modifierOf(modifier), true); }
    void release(std::string_view modifier) { key(modifierOf(modifier), false); }
    void type(std::string_view text);  // letters, digits and ./-_:
    void move(glm::vec2 to);
    void moveOnly(glm::vec2 to);  // without sync()
    void moveAway();              // where nothing is under the pointer
    void down(Button button = Button::Left);
    void up(Button button = Button::Left);
    void click(glm::vec2 at);
    void doubleClick(glm::vec2 at);
    void drag(glm::vec2 from, glm::vec2 to, Button button = Button::Left);
    void wheel(int clicks);  // > 0 is away from the user

    // exchange.cpp
    void drop(const std::vector<std::filesystem::path>& files, glm::vec2 at);  // XDND
    std::string clipboard();

    // What a window manager does.
    void close();
    void resize(glm::ivec2 size);
    void minimise();
    void restore();
    // What nobody should do.
    void destroyWindow();
    void killConnection();

 private:
    static unsigned long modifierOf(std::string_view name);  // "ctrl" or "shift"
    void key(unsigned long keysym, bool isDown);

    const Screen& screen_;
    Process process_;
    XWindow window_ = 0;
    long pings_ = 0;
};

}  // namespace ui
