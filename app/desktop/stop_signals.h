// SIGTERM, SIGINT and SIGHUP as an orderly end: what a signal handler may not do is done by a
// thread.
#pragma once

#include <functional>
#include <thread>

namespace app::desktop {

// One at a time in a program. Child processes get the signals as usual: none is blocked.
class StopSignals {
 public:
    // `stop` is called on another thread, at every such signal.
    explicit StopSignals(std::function<void()> stop);
    ~StopSignals();
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;

 private:
    int readEnd_ = -1, writeEnd_ = -1;
    std::thread thread_;
};

}  // namespace app::desktop
