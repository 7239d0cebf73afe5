// A headset session: the only folder that knows OpenXR. Frames come from the runtime's clock; eyes
// are views and framebuffers to draw into; hands are values.
#pragma once

#include <array>
#include <chrono>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "render/annotate/hidden_area.h"
#include "xr/pose.h"
#include "xr/session_state.h"

namespace xr {

// How long a runtime may answer nothing before it is lost: it may be busy, or stopped for a moment.
struct Patience {
    std::chrono::nanoseconds calls = std::chrono::seconds(10);
    // The end of a frame also waits for what was drawn, which may be much.
    std::chrono::nanoseconds withDrawing = std::chrono::seconds(20);
};

// One sentence: no runtime, a broken manifest, no service, no headset.
struct NoHeadset {
    std::string why;
};
// The runtime went away in mid-session. what() is one sentence. Everything of the session is then
// dead; the program goes on elsewhere.
struct LostError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// The current GL context, as the runtime wants to know it. Plain pointers of EGL and Xlib. `config`
// is 0 of a context that was made without one.
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
// right. Without focus, nothing is held or pressed. A controller with one button
// (khr/simple_controller) reports a press as grab and select both: what the ray is on tells which
// is meant.
struct Hand {
    std::optional<Pose> grip, aim;  // in the stage; absent when not known
    bool grab = false;              // holds the volume
    bool select = false;            // trigger: play and pause, or click on the panel
    bool menu = false;              // help and panel
    bool swing = false;             // the sweep turns round at its ends
    bool bring = false;             // the volume comes here
    glm::dvec2 stick{0};            // [-1, 1]; right, forward
};

// One eye of one frame: draw into `framebuffer`, whose colour is sRGB (linear writes are encoded by
// GL) and whose depth, where the runtime takes one, goes to the compositor. Row 0 is the lowest.
struct Eye {
    Pose stageFromEye;
    Fov fov;
    glm::ivec2 size;  // pixels to draw now, the lower left of the image; an eye's own
    unsigned framebuffer = 0;
    std::shared_ptr<const render::HiddenArea> hidden = {};  // behind the lens's rim, if it is known
};

// What the controllers in force have.
struct Controls {
    // "Grab the volume: Squeeze", one a line; empty before the runtime has bound any.
    std::string text = {};
    bool sticks = false;
    bool oneButton = false;  // it grabs and selects
};

class Session {
 public:
    // Looks for a runtime and a headset without any GL context; says why there is none. In a copy
    // of this process, which alone goes down when the runtime's library crashes; a window waits.
    struct Offer {
        bool takesEgl;  // EglBinding, too; all take XlibBinding
    };
    static std::variant<Offer, NoHeadset> ask(
        std::chrono::seconds patience = std::chrono::seconds(3));

    // REQUIRES: the binding's context is current now and in every call that follows, until
    // destruction.
    static std::variant<std::unique_ptr<Session>, NoHeadset> open(const Binding& binding,
                                                                  const Patience& patience = {});
    ~Session();

    const std::string& runtimeName() const;
    const SessionState& state() const;
    const Controls& controls() const;

    // Handles events, at most one change of state, waits for the runtime's next frame (at most
    // Patience::calls) and begins it. None while the session does not run, after a hundredth of a
    // second: call again. Throws LostError, from then on each time. After an event that ends the
    // session, ended() is true.
    class Frame;
    std::unique_ptr<Frame> beginFrame();
    bool ended() const;
    // Asks the runtime to let the session end; go on with frames until ended().
    void requestExit();

    // In Hz; empty where the runtime offers no choice (XR_FB_display_refresh_rate).
    const std::vector<double>& refreshRates() const;
    // Asks for one of them; the frames' period tells whether and when the runtime follows. Asking
    // again for the same costs nothing.
    void requestRefreshRate(double rate);

    // `hand` 0 or 1, amplitude in [0, 1]. Nothing without focus.
    void vibrate(int hand, double amplitude, std::chrono::nanoseconds duration);

 private:
    struct Impl;
    explicit Session(std::unique_ptr<Impl>);
    std::unique_ptr<Impl> impl_;
};

// Between the runtime's begin and end of a frame. Ends on every path: what was not submitted is
// ended with no layer at all. Must not outlive the session; one at a time.
class Session::Frame {
 public:
    ~Frame();
    Frame(const Frame&) = delete;
    Frame& operator=(const Frame&) = delete;

    std::chrono::nanoseconds displayTime() const;  // predicted; monotonic
    // The display's own (display_period.h), however slow the program is; 0 where it is not known.
    std::chrono::nanoseconds period() const;
    bool shouldRender() const;
    // Left, right. Empty when nothing is to be drawn or the eyes' poses are not valid. `scale` in
    // (0, 1]: the share of the recommended size to draw, per side; of the first call, which the
    // later ones repeat. Throws LostError.
    std::span<const Eye> eyes(double scale);
    const std::array<Hand, 2>& hands() const;
    const std::optional<Pose>& head() const;  // in the stage
    // Ends the frame with what was drawn into its eyes. near and far in metres, of the depth that
    // was drawn (View's: 0 at near). REQUIRES: all of the eyes' pixels and depth were written.
    // Throws LostError.
    void submit(double near, double far);

 private:
    friend class Session;
    struct Impl;
    explicit Frame(std::unique_ptr<Impl>);
    std::unique_ptr<Impl> impl_;
};

}  // namespace xr
