#include "timeseries/together.h"

#include <unistd.h>

#include <chrono>
#include <exception>
#include <memory>

namespace timeseries {
namespace {

using SharedWork = std::function<void(unsigned)>;

// Waits while `held` is this. A core that has gone to sleep takes a tenth of a millisecond to come
// back, the parts of a frame less than one: so it is looked at for a while before.
void waitWhile(const std::atomic<const SharedWork*>& held, const SharedWork* value) {
    constexpr auto kAwake = std::chrono::microseconds(500);
    const auto until = std::chrono::steady_clock::now() + kAwake;
    while (held.load(std::memory_order_acquire) == value) {
        if (std::chrono::steady_clock::now() > until) return held.wait(value);
        std::this_thread::yield();
    }
}

// One thread more, kept from call to call.
class Helper {
 public:
    explicit Helper(unsigned k) : thread_([this, k] { help(k); }) {}
    ~Helper() {
        begin(kStop);
        thread_.join();
    }
    Helper(const Helper&) = delete;
    Helper& operator=(const Helper&) = delete;

    void begin(const SharedWork& work) {
        work_.store(&work, std::memory_order_release);
        work_.notify_one();
    }
    void end() const {
        for (const SharedWork* work; (work = work_.load(std::memory_order_acquire));)
            waitWhile(work_, work);
    }
    static bool isOne() { return isOne_; }

 private:
    void help(unsigned k) {
        isOne_ = true;
        for (;;) {
            waitWhile(work_, nullptr);
            const SharedWork* const work = work_.load(std::memory_order_acquire);
            if (work == &kStop) return;
            (*work)(k);
            work_.store(nullptr, std::memory_order_release);
            work_.notify_one();
        }
    }

    static const SharedWork kStop;
    static thread_local bool isOne_;
    std::atomic<const SharedWork*> work_ = nullptr;
    std::thread thread_;
};

const SharedWork Helper::kStop;
thread_local bool Helper::isOne_ = false;

// Those of one thread, which calls for them one call after another.
class Helpers {
 public:
    // What a copy of the process has of them has no threads.
    ~Helpers() {
        if (isCopy())
            for (auto& one : all_) static_cast<void>(one.release());
    }
    bool canHelp() const { return !busy_ && !isCopy(); }
    void run(unsigned threads, const SharedWork& work) {
        while (all_.size() + 1 < threads)
            all_.push_back(std::make_unique<Helper>(static_cast<unsigned>(all_.size() + 1)));
        const Call call(*this, threads);
        for (unsigned k = 1; k < threads; ++k) all_[k - 1]->begin(work);
        work(0);
    }

 private:
    // Ends when all have, however it ends.
    class Call {
     public:
        Call(Helpers& helpers, unsigned threads) : helpers_(helpers), threads_(threads) {
            helpers_.busy_ = true;
        }
        ~Call() {
            for (unsigned k = 1; k < threads_; ++k) helpers_.all_[k - 1]->end();
            helpers_.busy_ = false;
        }
        Call(const Call&) = delete;
        Call& operator=(const Call&) = delete;

     private:
        Helpers& helpers_;
        unsigned threads_;
    };
    bool isCopy() const { return getpid() != of_; }

    const pid_t of_ = getpid();
    bool busy_ = false;
    std::vector<std::unique_ptr<Helper>> all_;
};

}  // namespace

void together(unsigned threads, const SharedWork& work) {
    if (threads <= 1) return work(0);
    thread_local Helpers helpers;
    if (!Helper::isOne() && helpers.canHelp()) return helpers.run(threads, work);
    std::vector<std::jthread> others;
    for (unsigned k = 1; k < threads; ++k) others.emplace_back(work, k);
    work(0);
}

void sharing(unsigned threads, const SharedWork& work) {
    std::vector<std::exception_ptr> failures(threads);
    together(threads, [&](unsigned k) {
        try {
            work(k);
        } catch (...) {
            failures[k] = std::current_exception();
        }
    });
    for (const std::exception_ptr& failure : failures)
        if (failure) std::rethrow_exception(failure);
}

}  // namespace timeseries
