#include "xr/session_state.h"

namespace xr {

Duty SessionState::on(State next) {
    if (state_ == State::Exiting || state_ == State::LossPending) return Duty::None;
    state_ = next;
    switch (next) {
        case State::Ready:
            if (running_) return Duty::None;
            running_ = true;
            return Duty::BeginSession;
        case State::Stopping:
            if (!running_) return Duty::None;
            running_ = false;
            return Duty::EndSession;
        case State::Exiting:
            running_ = false;
            return Duty::Leave;
        case State::LossPending:
            running_ = false;
            return Duty::Lost;
        default:
            return Duty::None;
    }
}

bool SessionState::visible() const {
    return running_ && (state_ == State::Visible || state_ == State::Focused);
}

bool SessionState::focused() const { return running_ && state_ == State::Focused; }

}  // namespace xr
