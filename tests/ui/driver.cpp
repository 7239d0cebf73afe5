#include "tests/ui/driver.h"
#include "tests/support/built_paths.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/extensions/XTest.h>
#include <X11/keysym.h>
#include <malloc.h>

#include "tests/ui/waiting.h"

namespace ui {
namespace {

using Clock = std::chrono::steady_clock;

std::map<std::string, std::optional<std::string>> withScreen(
    std::map<std::string, std::optional<std::string>> environment, const Screen& screen,
    const std::filesystem::path& home) {
    environment.insert({{"DISPLAY", screen.name()},
                        {"WAYLAND_DISPLAY", std::nullopt},
                        {"LIBGL_ALWAYS_SOFTWARE", "1"},
                        {"HOME", home.string()},
                        // Where it is not set, libraries that look for Wayland say so.
                        {"XDG_RUNTIME_DIR", home.string()},
                        {"XDG_CONFIG_HOME", std::nullopt},
                        {"XDG_STATE_HOME", std::nullopt}});
    return environment;
}

bool needsShift(char c) { return (c >= 'A' && c <= 'Z') || c == '_' || c == ':'; }

KeySym keysymOf(std::string_view name) {
    const KeySym found = XStringToKeysym(std::string(name).c_str());
    if (found == NoSymbol) throw std::runtime_error(fmt::format("no key is called {}", name));
    return found;
}

KeySym keysymOf(char c) {
    return static_cast<KeySym>(static_cast<unsigned char>(c));  // Latin-1 is its own keysym
}

// In a window, also where a headset answers.
std::vector<std::string> inWindow(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"view", "--display", "desktop"});
    return arguments;
}

// Shots come and go, a few megabytes each: given back and taken anew, page by page, they would take
// a sixth of a test's time.
void keepMemory() {
    constexpr int kBytes = 1 << 28;
    mallopt(M_MMAP_THRESHOLD, kBytes);
    mallopt(M_TRIM_THRESHOLD, kBytes);
}

}  // namespace

Driver::Driver(const Screen& screen, const std::filesystem::path& folder,
               std::vector<std::string> arguments,
               std::map<std::string, std::optional<std::string>> environment,
               const std::filesystem::path& program)
    : screen_(screen),
      process_({.program = program,
                .arguments = inWindow(std::move(arguments)),
                .folder = folder,
                .environment = withScreen(std::move(environment), screen, folder)}) {
    keepMemory();
    waitFor("a window appears", [&] {
        const auto found = screen_.windowOf(process_.id());
        window_ = found.value_or(0);
        return found.has_value();
    });
    XSetInputFocus(screen_.connection(), window_, RevertToPointerRoot, CurrentTime);
    sync();
}

void Driver::waitFor(std::string_view what, const std::function<bool()>& holds,
                     std::chrono::milliseconds pause) {
    waitUntil(
        what,
        [&] {
            if (holds()) return true;
            if (!process_.isRunning())
                throw std::runtime_error(fmt::format("the program ended while waiting: {}: {}",
                                                     what, process_.errors()));
            return false;
        },
        pause);
}

void Driver::waitForTitle(std::string_view piece) {
    waitFor(fmt::format("the title holds {}", piece),
            [&] { return title().find(piece) != std::string::npos; });
}

std::string Driver::title() const { return screen_.property(window_, "_NET_WM_NAME"); }

glm::ivec2 Driver::size() const {
    XWindowAttributes attributes{};
    XGetWindowAttributes(screen_.connection(), window_, &attributes);
    return {attributes.width, attributes.height};
}

// The program answers pings where it takes in events, once a frame (EWMH, _NET_WM_PING).
std::chrono::nanoseconds Driver::ping() {
    const Clock::time_point begin = Clock::now();
    const auto number = ++pings_;
    const auto protocol = static_cast<long>(screen_.atom("_NET_WM_PING"));
    screen_.send(window_, "WM_PROTOCOLS", {protocol, number, static_cast<long>(window_)});
    const auto answered = [&](const XEvent& event) {
        return event.type == ClientMessage && event.xclient.data.l[0] == protocol &&
               event.xclient.data.l[1] == number;
    };
    waitFor("the program answers", [&] { return screen_.hasEvent(answered); });
    return Clock::now() - begin;
}

// The second answer is given after the frame that the first one belongs to.
void Driver::sync() {
    ping();
    ping();
}

Shot Driver::shot() const { return shot({{0, 0}, glm::vec2(size())}); }

Shot Driver::shot(const app::panels::Rect& place) const {
    const glm::ivec2 from(place.min);
    Shot out{.size = glm::ivec2(place.max) - from, .pixels = {}};
    XImage* const image =
        XGetImage(screen_.connection(), window_, from.x, from.y, static_cast<unsigned>(out.size.x),
                  static_cast<unsigned>(out.size.y), AllPlanes, ZPixmap);
    if (image == nullptr) throw std::runtime_error("the window cannot be read");
    out.pixels.reserve(static_cast<std::size_t>(out.size.x) * static_cast<std::size_t>(out.size.y));
    for (int y = 0; y < out.size.y; ++y) {
        // 24 bits deep: a word of 0x00RRGGBB a pixel, here in bytes from the lowest.
        const char* row = image->data + static_cast<std::ptrdiff_t>(y) * image->bytes_per_line;
        for (int x = 0; x < out.size.x; ++x, row += 4)
            out.pixels.push_back({static_cast<std::uint8_t>(row[2]),
                                  static_cast<std::uint8_t>(row[1]),
                                  static_cast<std::uint8_t>(row[0])});
    }
    XDestroyImage(image);
    return out;
}

Shot Driver::settled() {
    constexpr auto kRefined = std::chrono::milliseconds(250);
    sync();
    Shot last = shot();
    Clock::time_point since = Clock::now();
    // Each look makes the program draw twice.
    waitFor(
        "the window comes to rest",
        [&] {
            sync();
            Shot now = shot();
            const bool same = now == last;
            if (!same) since = Clock::now();
            last = std::move(now);
            return same && Clock::now() - since >= kRefined;
        },
        std::chrono::milliseconds(60));
    return last;
}

unsigned long Driver::modifierOf(std::string_view name) {
    return name == "ctrl" ? XK_Control_L : XK_Shift_L;
}

void Driver::key(unsigned long keysym, bool isDown) {
    XTestFakeKeyEvent(screen_.connection(), XKeysymToKeycode(screen_.connection(), keysym),
                      isDown ? True : False, CurrentTime);
}

void Driver::pressOnly(std::string_view keys) {
    std::vector<KeySym> held;
    for (std::size_t plus; (plus = keys.find('+')) != std::string_view::npos;) {
        held.push_back(modifierOf(keys.substr(0, plus)));
        keys.remove_prefix(plus + 1);
    }
    held.push_back(keysymOf(keys));
    for (const KeySym each : held) key(each, true);
    for (; !held.empty(); held.pop_back()) key(held.back(), false);
    XFlush(screen_.connection());
}

void Driver::press(std::string_view keys) {
    pressOnly(keys);
    sync();
}

void Driver::type(std::string_view text) {
    for (const char c : text) {
        if (needsShift(c)) key(XK_Shift_L, true);
        for (const bool isDown : {true, false}) key(keysymOf(c), isDown);
        if (needsShift(c)) key(XK_Shift_L, false);
    }
    sync();
}

void Driver::moveOnly(glm::vec2 to) {
    XWindow child = 0;
    int x = 0, y = 0;
    XTranslateCoordinates(screen_.connection(), window_, screen_.root(), static_cast<int>(to.x),
                          static_cast<int>(to.y), &x, &y, &child);
    XTestFakeMotionEvent(screen_.connection(), -1, x, y, CurrentTime);
    XFlush(screen_.connection());
}

void Driver::move(glm::vec2 to) {
    moveOnly(to);
    sync();
}

void Driver::moveAway() { move({3, 3}); }

void Driver::down(Button button) {
    XTestFakeButtonEvent(screen_.connection(), static_cast<unsigned>(button), True, CurrentTime);
    sync();
}

void Driver::up(Button button) {
    XTestFakeButtonEvent(screen_.connection(), static_cast<unsigned>(button), False, CurrentTime);
    sync();
}

void Driver::click(glm::vec2 at) {
    move(at);
    down();
    up();
}

void Driver::doubleClick(glm::vec2 at) {
    move(at);
    for (const int isDown : {True, False, True, False})
        XTestFakeButtonEvent(screen_.connection(), Button1, isDown, CurrentTime);
    sync();
}

void Driver::drag(glm::vec2 from, glm::vec2 to, Button button) {
    move(from);
    down(button);
    move(0.5f * (from + to));
    move(to);
    up(button);
}

void Driver::wheel(int clicks) {
    const unsigned button = clicks > 0 ? Button4 : Button5;
    for (int i = 0; i < std::abs(clicks); ++i)
        for (const int isDown : {True, False})
            XTestFakeButtonEvent(screen_.connection(), button, isDown, CurrentTime);
    sync();
}

void Driver::close() {
    screen_.send(window_, "WM_PROTOCOLS", {static_cast<long>(screen_.atom("WM_DELETE_WINDOW"))});
}

void Driver::resize(glm::ivec2 wanted) {
    XResizeWindow(screen_.connection(), window_, static_cast<unsigned>(wanted.x),
                  static_cast<unsigned>(wanted.y));
    sync();
}

// ICCCM 4.1.4: an iconic window is unmapped and says so.
void Driver::minimise() {
    const long state[] = {IconicState, None};
    XChangeProperty(screen_.connection(), window_, screen_.atom("WM_STATE"),
                    screen_.atom("WM_STATE"), 32, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(state), 2);
    XUnmapWindow(screen_.connection(), window_);
    sync();
}

void Driver::destroyWindow() {
    XDestroyWindow(screen_.connection(), window_);
    XFlush(screen_.connection());
}

void Driver::killConnection() {
    XKillClient(screen_.connection(), window_);
    XFlush(screen_.connection());
}

void Driver::restore() {
    const long state[] = {NormalState, None};
    XMapWindow(screen_.connection(), window_);
    XChangeProperty(screen_.connection(), window_, screen_.atom("WM_STATE"),
                    screen_.atom("WM_STATE"), 32, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(state), 2);
    XSetInputFocus(screen_.connection(), window_, RevertToPointerRoot, CurrentTime);
    sync();
}

}  // namespace ui
