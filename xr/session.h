// A headset session: the only folder that knows OpenXR. Frames come from the runtime's clock; eyes
// are views and framebuffers to draw into; hands are values.
#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "xr/pose.h"
#include "xr/session_state.h"

namespace xr {

// One sentence: no runtime, a broken manifest, no service, no headset.
struct NoHeadset {
    std::string why;
};
// The runtime went away in mid-session. what() is one sentence. Everything of the session is then
// dead; the program goes on elsewhere.
struct LostError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// The current GL context, as the runtime wants to know it. Plain pointers of EGL and Xlib; 0 where
// absent.
struct EglBinding {
    void *display, *config, *context;
};
struct XlibBinding {
    void* display;
    unsigned visual;
    void* fbConfig;
    unsigned long drawable;
    void* context;
};
using Binding = std::variant<EglBinding, XlibBinding>;

// What the user's hands do in one frame, by intention and not by button. The two hands: left,
// right.
struct Hand {
    std::optional<Pose> grip, aim;  // in the stage; absent when not tracked
    bool grab = false;              // holds the volume
    bool select = false;            // trigger: play, or click on the panel
    bool menu = false;              // help
    glm::dvec2 stick{0};            // [-1, 1]
};

// One eye of one frame: draw into `framebuffer` (sRGB, linear writes encoded by GL) with `view`'s
// frustum and size, then call nothing: Frame's end submits it. Depth goes to `depth` if not 0.
struct Eye {
    Pose stageFromEye;
    Fov fov;
    glm::ivec2 size;  // pixels to draw now, the lower left of the image
    unsigned framebuffer = 0;
};

class Session {
 public:
    // Looks for a runtime and a headset without any GL context; says why there is none.
    static std::optional<NoHeadset> whyNone();

    // REQUIRES: the binding's context is current now and in every call that follows, until
    // destruction.
    static std::variant<std::unique_ptr<Session>, NoHeadset> open(const Binding& binding);
    ~Session();

    const std::string& runtimeName() const;
    const SessionState& state() const;
    const std::string& bindingsText() const;  // of the profile in force, for the help panel

    // Handles events, waits for the runtime's next frame (at most a few seconds: a runtime that
    // does not answer is lost) and begins it. None while the session does not run: call again.
    // Throws LostError. After an event that ends the session, ended() is true.
    class Frame;
    std::unique_ptr<Frame> beginFrame();
    bool ended() const;
    void requestExit();

    void vibrate(int hand, double amplitude, std::chrono::nanoseconds duration);

 private:
    struct Impl;
    explicit Session(std::unique_ptr<Impl>);
    std::unique_ptr<Impl> impl_;
};

// Ends on every path: what was not drawn is submitted as no layer at all.
class Session::Frame {
 public:
    ~Frame();

    std::chrono::nanoseconds displayTime() const;  // predicted; monotonic
    bool shouldRender() const;
    // Empty when nothing is to be drawn or the head's pose is not valid. `scale` in (0, 1]: the
    // share of the recommended size to draw, per side.
    std::span<const Eye> eyes(double scale);
    const std::array<Hand, 2>& hands() const;
    const std::optional<Pose>& head() const;
    // Submits the eyes. Throws LostError. near and far in metres, of the depth that was drawn.
    void submit(double near, double far);

 private:
    friend class Session;
    struct Impl;
    explicit Frame(std::unique_ptr<Impl>);
    std::unique_ptr<Impl> impl_;
};

}  // namespace xr
