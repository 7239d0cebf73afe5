// xrWaitFrame on a thread of its own: a runtime that is stopped, not dead, never returns from it.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <thread>

#include "xr/api.h"

namespace xr {

class FrameWaiter {
 public:
    FrameWaiter(XrSession session, std::chrono::nanoseconds patience);
    // Ends the thread; one that is still inside the runtime is left behind.
    ~FrameWaiter();
    FrameWaiter(const FrameWaiter&) = delete;
    FrameWaiter& operator=(const FrameWaiter&) = delete;

    struct Answer {
        XrResult result;
        XrFrameState frame;
    };
    // Interrupts the runtime after `patience`; none when it does not come back even then, and it is
    // not to be called any more. REQUIRES: there is a Watchman.
    std::optional<Answer> wait();

 private:
    struct Desk;
    std::chrono::nanoseconds patience_;
    std::shared_ptr<Desk> desk_;
    std::thread::native_handle_type thread_;
};

}  // namespace xr
