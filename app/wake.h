// A call into a front end from threads that may outlive it.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <utility>

namespace app {

class Wake {
 public:
    // `call` must be thread-safe.
    explicit Wake(std::function<void()> call) : target_(std::make_shared<Target>()) {
        target_->call = std::move(call);
    }
    // Afterwards nothing is called any more. Waits for a call that is running.
    ~Wake() {
        const std::lock_guard lock(target_->mutex);
        target_->call = nullptr;
    }
    Wake(const Wake&) = delete;
    Wake& operator=(const Wake&) = delete;

    // For any thread, also after this is gone: then it does nothing.
    std::function<void()> callable() const {
        return [target = target_] {
            const std::lock_guard lock(target->mutex);
            if (target->call) target->call();
        };
    }

 private:
    struct Target {
        std::mutex mutex;
        std::function<void()> call;
    };
    std::shared_ptr<Target> target_;
};

}  // namespace app
