// Gets a thread out of a runtime that has stopped answering. Calls wait for the runtime's service
// without any limit of time; a signal ends the system call that they wait in, upon which Monado and
// its kin answer that the instance is lost.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

namespace xr {

// Ends the system call that a thread waits in, if it waits in one now: by SIGURG, whose default is
// to do nothing. REQUIRES: there is a Watchman.
void interrupt(std::thread::native_handle_type thread);
// One that comes between two system calls is in vain, so they are repeated until the thread is out.
inline constexpr std::chrono::milliseconds kInterruptAgain(20);

// Interrupts the thread that it watches when that takes too long.
class Watchman {
 public:
    Watchman();
    ~Watchman();
    Watchman(const Watchman&) = delete;
    Watchman& operator=(const Watchman&) = delete;

    // While it lives, the calls of this thread are to take no longer than `patience` together. One
    // at a time.
    class Watch {
     public:
        Watch(Watchman& watchman, std::chrono::nanoseconds patience);
        ~Watch();
        Watch(const Watch&) = delete;
        Watch& operator=(const Watch&) = delete;
        // Patience came to its end: what was called may never answer again.
        bool fired() const;

     private:
        Watchman& watchman_;
    };

 private:
    using Clock = std::chrono::steady_clock;
    void serve();

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<Clock::time_point> deadline_;
    std::thread::native_handle_type watched_{};
    bool fired_ = false, closed_ = false;
    std::thread thread_;
};

}  // namespace xr
