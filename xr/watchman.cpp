#include "xr/watchman.h"

#include <pthread.h>
#include <signal.h>

namespace xr {
namespace {

void nothing(int) {}

// Without SA_RESTART: a system call that the signal finds returns EINTR.
void listen() {
    struct sigaction action {};
    action.sa_handler = nothing;
    sigaction(SIGURG, &action, nullptr);
}

}  // namespace

void interrupt(std::thread::native_handle_type thread) { pthread_kill(thread, SIGURG); }

Watchman::Watchman() {
    listen();
    thread_ = std::thread([this] { serve(); });
}

Watchman::~Watchman() {
    {
        const std::lock_guard lock(mutex_);
        closed_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void Watchman::serve() {
    std::unique_lock lock(mutex_);
    while (!closed_) {
        if (!deadline_) {
            changed_.wait(lock);
        } else if (Clock::now() < *deadline_) {
            changed_.wait_until(lock, *deadline_);
        } else {
            fired_ = true;
            interrupt(watched_);
            deadline_ = Clock::now() + kInterruptAgain;
        }
    }
}

Watchman::Watch::Watch(Watchman& watchman, std::chrono::nanoseconds patience)
    : watchman_(watchman) {
    const std::lock_guard lock(watchman.mutex_);
    watchman.watched_ = pthread_self();
    watchman.fired_ = false;
    watchman.deadline_ = Clock::now() + patience;
    watchman.changed_.notify_all();
}

Watchman::Watch::~Watch() {
    const std::lock_guard lock(watchman_.mutex_);
    watchman_.deadline_.reset();
}

bool Watchman::Watch::fired() const {
    const std::lock_guard lock(watchman_.mutex_);
    // Also where its thread has not come to do it yet.
    return watchman_.fired_ || Clock::now() >= *watchman_.deadline_;
}

}  // namespace xr
