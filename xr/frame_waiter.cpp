#include "xr/frame_waiter.h"

#include <condition_variable>
#include <mutex>
#include <thread>

#include "xr/watchman.h"

namespace xr {

// What the asker and the thread share; kept alive by whichever stays longest.
struct FrameWaiter::Desk {
    explicit Desk(XrSession of) : session(of) {}

    const XrSession session;
    std::mutex mutex;
    std::condition_variable changed;
    bool asked = false, closed = false;
    std::optional<Answer> answer;

    void serve() {
        std::unique_lock lock(mutex);
        while (true) {
            changed.wait(lock, [&] { return asked || closed; });
            if (closed) return;
            asked = false;
            lock.unlock();
            Answer next{XR_SUCCESS, typed<XrFrameState>(XR_TYPE_FRAME_STATE)};
            const auto info = typed<XrFrameWaitInfo>(XR_TYPE_FRAME_WAIT_INFO);
            next.result = xrWaitFrame(session, &info, &next.frame);
            lock.lock();
            answer = next;
            changed.notify_all();
        }
    }
};

FrameWaiter::FrameWaiter(XrSession session, std::chrono::nanoseconds patience)
    : patience_(patience), desk_(std::make_shared<Desk>(session)) {
    std::thread thread([desk = desk_] { desk->serve(); });
    thread_ = thread.native_handle();
    // Joining one that never comes back would hang the program instead.
    thread.detach();
}

FrameWaiter::~FrameWaiter() {
    const std::lock_guard lock(desk_->mutex);
    desk_->closed = true;
    desk_->changed.notify_all();
}

std::optional<FrameWaiter::Answer> FrameWaiter::wait() {
    std::unique_lock lock(desk_->mutex);
    desk_->answer.reset();
    desk_->asked = true;
    desk_->changed.notify_all();
    const auto answered = [&] { return desk_->answer.has_value(); };
    desk_->changed.wait_for(lock, patience_, answered);
    // A second for what lies between the interrupted system call and here.
    for (auto left = std::chrono::seconds(1) / kInterruptAgain; !answered() && left > 0; --left) {
        interrupt(thread_);
        desk_->changed.wait_for(lock, kInterruptAgain, answered);
    }
    return desk_->answer;
}

}  // namespace xr
