// What a session holds between frames, shared by session.cpp and frame.cpp.
#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "xr/actions.h"
#include "xr/api.h"
#include "xr/display_period.h"
#include "xr/frame_waiter.h"
#include "xr/runtime.h"
#include "xr/session.h"
#include "xr/session_state.h"
#include "xr/swapchain.h"
#include "xr/watchman.h"

namespace xr {

struct Session::Impl {
    Impl(Runtime opened, const Binding& binding, const Patience& patience);
    ~Impl();
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    // What the runtime has to tell since the last call, up to one change of state.
    void handleEvents();
    void onState(State next);
    // Throws LostError when none comes in time.
    XrFrameState waitFrame();
    // The rate that the runtime tells of its display, if it does.
    void takeRate();
    std::string unanswered(std::chrono::nanoseconds limit) const;
    // Makes `calls` into the runtime, which may take so long together. Throws LostError when one
    // fails or they take longer; that is the end of the session, and is kept.
    void orLost(const std::function<void()>& calls, std::chrono::nanoseconds limit);
    void orLost(const std::function<void()>& calls) { orLost(calls, patience.calls); }

    const Patience patience;
    Watchman watchman;
    Runtime runtime;
    XrSession session;
    XrSpace stage, head;
    XrEnvironmentBlendMode blendMode;
    std::vector<EyeImages> eyes;                                      // left, right
    std::array<std::shared_ptr<const render::HiddenArea>, 2> hidden;  // of each eye; may be null
    std::vector<double> refreshRates;
    double requestedRate = 0;  // the last; 0 before the first
    DisplayPeriod period;
    Actions actions;
    FrameWaiter waiter;
    SessionState state;
    bool ended = false;
    std::optional<std::string> lost;  // why
    Controls controls;
};

struct Session::Frame::Impl {
    Session::Impl& session;
    XrFrameState timing;
    bool open = true;  // begun, not yet ended
    std::array<Hand, 2> hands{};
    std::optional<Pose> head = {};
    std::vector<Eye> eyes = {};

    // Where the head and the hands are at the time of display.
    void locate();
    // Empty when a pose is not valid.
    std::vector<Eye> located() const;
    void end(const std::vector<const XrCompositionLayerBaseHeader*>& layers);
};

}  // namespace xr
