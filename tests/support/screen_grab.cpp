#include "tests/support/screen_grab.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <memory>
#include <stdexcept>

namespace tests {

ScreenGrab grabScreen() {
    const std::unique_ptr<Display, int (*)(Display*)> display(XOpenDisplay(nullptr), XCloseDisplay);
    if (!display) throw std::runtime_error("no X display answers");
    ScreenGrab grab;
    grab.size = {DisplayWidth(display.get(), 0), DisplayHeight(display.get(), 0)};
    XImage* image = XGetImage(display.get(), DefaultRootWindow(display.get()), 0, 0,
                              static_cast<unsigned>(grab.size.x),
                              static_cast<unsigned>(grab.size.y), AllPlanes, ZPixmap);
    if (image == nullptr) throw std::runtime_error("the X display does not tell its pixels");
    for (int y = 0; y < grab.size.y; ++y)
        for (int x = 0; x < grab.size.x; ++x) {
            const unsigned long rgb = XGetPixel(image, x, y);  // 24 bits, as Xvfb has them here
            grab.pixels.emplace_back(rgb >> 16 & 255, rgb >> 8 & 255, rgb & 255);
        }
    XDestroyImage(image);
    return grab;
}

}  // namespace tests
