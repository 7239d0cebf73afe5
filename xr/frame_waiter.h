// xrWaitFrame on a thread of its own: a runtime that is stopped, not dead, never returns from it.
#pragma once

#include <memory>
#include <optional>

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
    // None when the runtime did not answer within kPatience; then it is not to be asked again.
    std::optional<Answer> wait();

 private:
    struct Desk;
    std::shared_ptr<Desk> desk_;
};

}  // namespace xr
