// xrWaitFrame on a thread of its own: a runtime that is stopped, not dead, never returns from it.
#pragma once

#include <memory>
#include <optional>
#include <thread>

#include "xr/api.h"

namespace xr {

class FrameWaiter {
 public:
    explicit FrameWaiter(XrSession session);
    // Ends the thread; one that is still inside the runtime is left behind.
    ~FrameWaiter();
    FrameWaiter(const FrameWaiter&) = delete;
    FrameWaiter& operator=(const FrameWaiter&) = delete;

    struct Answer {
        XrResult result;
        XrFrameState frame;
    };
    // Interrupts the runtime after kPatience; none when it does not come back even then, and it is
    // not to be called any more. REQUIRES: there is a Watchman.
    std::optional<Answer> wait();

 private:
    struct Desk;
    std::shared_ptr<Desk> desk_;
    std::thread::native_handle_type thread_;
};

}  // namespace xr
