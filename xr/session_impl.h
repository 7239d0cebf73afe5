// What a session holds between frames, shared by session.cpp and frame.cpp.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "xr/actions.h"
#include "xr/api.h"
#include "xr/frame_waiter.h"
#include "xr/runtime.h"
#include "xr/session.h"
#include "xr/session_state.h"
#include "xr/swapchain.h"

namespace xr {

struct Session::Impl {
    Impl(Runtime opened, const Binding& binding);
    ~Impl();
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    // All that the runtime has to tell since the last call.
    void handleEvents();
    void onState(State next);
    // Throws LostError when none comes in time.
    XrFrameState waitFrame();
    // Runs `calls`; a LostError that leaves them is the end of the session, and is kept.
    template <typename Calls>
    auto orLost(Calls calls) {
        if (lost) throw LostError(*lost);
        try {
            return calls();
        } catch (const LostError& error) {
            lost = error.what();
            throw;
        }
    }

    Runtime runtime;
    XrSession session;
    XrSpace stage, head;
    XrEnvironmentBlendMode blendMode;
    std::vector<EyeImages> eyes;  // left, right
    Actions actions;
    FrameWaiter waiter;
    SessionState state;
    bool ended = false;
    std::optional<std::string> lost;  // why
    std::string bindings;
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
