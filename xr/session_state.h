// What a session may do, from the runtime's state events (OpenXR 1.0, 9.3 Session Lifecycle). Pure.
#pragma once

namespace xr {

enum class State {
    Unknown,
    Idle,
    Ready,
    Synchronized,
    Visible,
    Focused,
    Stopping,
    LossPending,
    Exiting
};

// What the caller must do upon an event, at once.
enum class Duty { None, BeginSession, EndSession, Leave, Lost };

class SessionState {
 public:
    // Events in any order, as a broken runtime may send them: never begins a running session nor
    // ends one that does not run. After Leave or Lost nothing changes any more.
    Duty on(State next);

    State state() const { return state_; }
    bool running() const { return running_; }  // frames are to be waited for
    bool visible() const;                      // what is drawn may be seen
    bool focused() const;                      // hands answer, animations go on

 private:
    State state_ = State::Unknown;
    bool running_ = false;
};

}  // namespace xr
