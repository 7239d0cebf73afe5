#include "tests/ui/screen.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>

#include "tests/ui/waiting.h"

namespace ui {
namespace {

// The number that Xvfb writes once it listens.
std::string displayNumber(int descriptor, Process& server) {
    std::string text;
    waitUntil("Xvfb starts", [&] {
        if (!server.isRunning()) throw std::runtime_error("Xvfb ended: " + server.errors());
        pollfd one{.fd = descriptor, .events = POLLIN, .revents = 0};
        char c = 0;
        while (poll(&one, 1, 0) > 0 && read(descriptor, &c, 1) == 1) text += c;
        return text.ends_with('\n');
    });
    return text.substr(0, text.size() - 1);
}

// Windows come and go while they are asked about.
int ignoreError(Display*, XErrorEvent*) { return 0; }

}  // namespace

bool Screen::isInstalled() { return std::system("command -v Xvfb >/dev/null 2>&1") == 0; }

Screen::Screen(const std::filesystem::path& folder) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe for Xvfb");
    const auto& [reading, writing] = ends;
    server_ = std::make_unique<Process>(Process::Start{
        .program = "Xvfb",
        .arguments = {"-displayfd", std::to_string(writing), "-screen", "0",
                      fmt::format("{}x{}x24", kSize.x, kSize.y), "-nolisten", "tcp", "-noreset"},
        .folder = folder,
        .environment = {{"LIBGL_ALWAYS_SOFTWARE", "1"}},
        .keptOpen = writing});
    close(writing);
    name_ = ":" + displayNumber(reading, *server_);
    close(reading);
    connection_ = XOpenDisplay(name_.c_str());
    if (connection_ == nullptr) throw std::runtime_error("no connection to Xvfb " + name_);
    XSetErrorHandler(ignoreError);
    // Answers to _NET_WM_PING are sent to the root window.
    XSelectInput(connection_, root(), SubstructureNotifyMask);
    own_ = XCreateSimpleWindow(connection_, root(), 0, 0, 1, 1, 0, 0, 0);
    XSelectInput(connection_, own_, PropertyChangeMask);
    XSync(connection_, False);
}

Screen::~Screen() {
    if (connection_ != nullptr) XCloseDisplay(connection_);
}

XWindow Screen::root() const { return DefaultRootWindow(connection_); }
XAtom Screen::atom(const char* name) const { return XInternAtom(connection_, name, False); }

void Screen::send(XWindow to, const char* type, std::array<long, 5> words) const {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = to;
    event.xclient.message_type = atom(type);
    event.xclient.format = 32;
    std::copy(words.begin(), words.end(), event.xclient.data.l);
    XSendEvent(connection_, to, False, NoEventMask, &event);
    XFlush(connection_);
}

std::string Screen::property(XWindow window, const char* name) const {
    Atom type = None;
    int format = 0;
    unsigned long count = 0, left = 0;
    unsigned char* bytes = nullptr;
    const int status = XGetWindowProperty(connection_, window, atom(name), 0, 1 << 20, False,
                                          AnyPropertyType, &type, &format, &count, &left, &bytes);
    std::string text;
    if (status == Success && bytes != nullptr) {
        // Xlib keeps words of 32 bits as long.
        const std::size_t width =
            format == 32 ? sizeof(long) : static_cast<std::size_t>(format) / 8;
        text.assign(reinterpret_cast<char*>(bytes), count * width);
    }
    if (bytes != nullptr) XFree(bytes);
    return text;
}

void Screen::setResource(const std::string& line) const {
    XChangeProperty(connection_, root(), XA_RESOURCE_MANAGER, XA_STRING, 8, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(line.data()),
                    static_cast<int>(line.size()));
    XSync(connection_, False);
}

void Screen::cover(glm::ivec2 at, glm::ivec2 size, const std::function<void()>& meanwhile) const {
    const auto pixels = glm::uvec2(size);
    const unsigned long white = WhitePixel(connection_, DefaultScreen(connection_));
    const XWindow window =
        XCreateSimpleWindow(connection_, root(), at.x, at.y, pixels.x, pixels.y, 0, 0, white);
    XMapRaised(connection_, window);
    XSync(connection_, False);
    meanwhile();
    XDestroyWindow(connection_, window);
    XSync(connection_, False);
}

bool Screen::hasEvent(const std::function<bool(const _XEvent&)>& isIt) const {
    using IsIt = std::function<bool(const _XEvent&)>;
    const auto matches = [](Display*, XEvent* event, XPointer asked) -> Bool {
        return (*reinterpret_cast<const IsIt*>(asked))(*event) ? True : False;
    };
    auto condition = isIt;
    XEvent event;
    return XCheckIfEvent(connection_, &event, matches, reinterpret_cast<XPointer>(&condition)) ==
           True;
}

std::optional<XWindow> Screen::windowOf(pid_t process) const {
    Window rootReturned = 0, parent = 0, *children = nullptr;
    unsigned count = 0;
    std::optional<XWindow> found;
    XQueryTree(connection_, root(), &rootReturned, &parent, &children, &count);
    for (unsigned i = 0; i < count && !found; ++i) {
        const std::string owner = property(children[i], "_NET_WM_PID");
        long id = 0;
        if (owner.size() != sizeof id) continue;
        std::memcpy(&id, owner.data(), sizeof id);
        XWindowAttributes attributes{};
        XGetWindowAttributes(connection_, children[i], &attributes);
        if (id == process && attributes.map_state == IsViewable) found = children[i];
    }
    if (children != nullptr) XFree(children);
    return found;
}

}  // namespace ui
