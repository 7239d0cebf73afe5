// Files dropped on the window (XDND, version 5) and what it put on the clipboard (ICCCM 2.4), as
// another program of the desktop does it.
#include <X11/Xatom.h>
#include <X11/Xlib.h>

#include "tests/ui/driver.h"
#include "tests/ui/waiting.h"

namespace ui {
namespace {

// "file:///a/b%20c", a line each (RFC 2483, RFC 3986).
std::string uriList(const std::vector<std::filesystem::path>& files) {
    std::string list;
    for (const auto& file : files) {
        list += "file://";
        for (const char c : std::filesystem::absolute(file).string()) {
            const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                               std::string_view("/-._~").find(c) != std::string_view::npos;
            list += plain ? std::string(1, c) : fmt::format("%{:02X}", c & 0xff);
        }
        list += "\r\n";
    }
    return list;
}

bool isMessage(const XEvent& event, XAtom type) {
    return event.type == ClientMessage && event.xclient.message_type == type;
}

}  // namespace

void Driver::drop(const std::vector<std::filesystem::path>& files, glm::vec2 at) {
    Display* const x = screen_.connection();
    const XWindow source = screen_.own();
    const auto word = [](unsigned long value) { return static_cast<long>(value); };
    const XAtom list = screen_.atom("text/uri-list"), copy = screen_.atom("XdndActionCopy");
    XSetSelectionOwner(x, screen_.atom("XdndSelection"), source, CurrentTime);
    int rootX = 0, rootY = 0;
    XWindow child = 0;
    XTranslateCoordinates(x, window_, screen_.root(), static_cast<int>(at.x),
                          static_cast<int>(at.y), &rootX, &rootY, &child);
    screen_.send(window_, "XdndEnter", {word(source), 5L << 24, word(list)});
    screen_.send(window_, "XdndPosition",
                 {word(source), 0, (long{rootX} << 16) | rootY, CurrentTime, word(copy)});
    const XAtom status = screen_.atom("XdndStatus"), finished = screen_.atom("XdndFinished");
    XEvent answer;
    waitFor("the window says whether it takes the files", [&] {
        return screen_.hasEvent([&](const XEvent& event) {
            answer = event;
            return isMessage(event, status);
        });
    });
    if ((answer.xclient.data.l[1] & 1) == 0) throw std::runtime_error("the drop was refused");
    screen_.send(window_, "XdndDrop", {word(source), 0, CurrentTime});
    waitFor("the window asks for the files", [&] {
        return screen_.hasEvent([&](const XEvent& event) {
            answer = event;
            return event.type == SelectionRequest;
        });
    });
    const XSelectionRequestEvent& request = answer.xselectionrequest;
    const std::string text = uriList(files);
    XChangeProperty(x, request.requestor, request.property, request.target, 8, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(text.data()),
                    static_cast<int>(text.size()));
    XEvent notice{};
    notice.xselection.type = SelectionNotify;
    notice.xselection.requestor = request.requestor;
    notice.xselection.selection = request.selection;
    notice.xselection.target = request.target;
    notice.xselection.property = request.property;
    notice.xselection.time = request.time;
    XSendEvent(x, request.requestor, False, NoEventMask, &notice);
    waitFor("the window has taken the files", [&] {
        return screen_.hasEvent([&](const XEvent& event) { return isMessage(event, finished); });
    });
    sync();
}

std::string Driver::clipboard() {
    Display* const x = screen_.connection();
    const char* const place = "ISOCHRON_TEST";
    XConvertSelection(x, screen_.atom("CLIPBOARD"), screen_.atom("UTF8_STRING"),
                      screen_.atom(place), screen_.own(), CurrentTime);
    waitFor("the clipboard's owner answers", [&] {
        return screen_.hasEvent([](const XEvent& event) { return event.type == SelectionNotify; });
    });
    return screen_.property(screen_.own(), place);
}

}  // namespace ui
