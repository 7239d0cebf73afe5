#include "timeseries/series/step_loader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <exception>
#include <new>
#include <stdexcept>
#include <utility>

#include "timeseries/sentence.h"

namespace timeseries {

namespace {

// A step that waits to be polled takes memory outside any budget, so there are few: one that was
// just finished and one more, so that the disk does not wait for the next frame.
constexpr std::size_t kMostResults = 2;
// Of a step on disk that nobody has looked into little is in memory.
constexpr std::uint64_t kLittle = std::uint64_t{1} << 20;

bool takesLittle(const LoadResult& result) {
    const auto* loaded = std::get_if<Loaded>(&result);
    if (!loaded || !loaded->sorted->file()) return false;
    return loaded->sorted->pointBytes() + loaded->sorted->file()->blocks().size_bytes() < kLittle;
}

std::size_t stepOf(const LoadResult& result) {
    return std::visit([](const auto& r) { return r.step; }, result);
}

}  // namespace

StepLoader::StepLoader(std::unique_ptr<Reader> reader, std::size_t variable, RangeSet kept,
                       std::function<void()> wake, Ready ready, StepStores stores, RangeSet asked)
    : maker_(std::move(reader), variable, std::move(kept), std::move(stores),
             ready == Ready::WithField ? StepMaker::Holds::Field : StepMaker::Holds::Points,
             std::move(asked)),
      stepCount_(maker_.variable().time->points.size()),
      wake_(std::move(wake)),
      ready_(ready),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

StepLoader::~StepLoader() = default;  // jthread asks to stop, which ends its waits, and joins

void StepLoader::want(std::vector<std::size_t> mostUrgentFirst, Haste haste, RangeSet looked) {
    for (const std::size_t step : mostUrgentFirst)
        if (step >= stepCount_)
            throw std::out_of_range(
                fmt::format("step {} was asked for, but the series has {}", step, stepCount_));
    {
        const std::lock_guard lock(mutex_);
        std::vector<bool> underWay(stepCount_);
        if (reading_) underWay[*reading_] = true;
        for (const LoadResult& result : results_) underWay[stepOf(result)] = true;
        haste_ = haste;
        looked_ = std::move(looked);
        wishes_.clear();
        for (const std::size_t step : mostUrgentFirst) {
            if (underWay[step]) continue;
            underWay[step] = true;  // each once
            wishes_.push_back(step);
        }
        if (!wishes_.empty()) calmFrom_ = std::chrono::steady_clock::now() + kCalm;
    }
    work_.notify_one();
}

std::optional<LoadResult> StepLoader::poll() {
    const std::lock_guard lock(mutex_);
    return takeFirst();
}

std::optional<LoadResult> StepLoader::waitAndPoll(std::chrono::nanoseconds timeout) {
    using Clock = std::chrono::steady_clock;
    std::unique_lock lock(mutex_);
    const auto something = [this] { return !results_.empty() || idle(); };
    const auto now = Clock::now();
    if (timeout < Clock::time_point::max() - now)
        done_.wait_until(lock, now + timeout, something);
    else
        done_.wait(lock, something);
    return takeFirst();
}

bool StepLoader::idle() const { return wishes_.empty() && !reading_; }

std::optional<LoadResult> StepLoader::takeFirst() {
    if (results_.empty()) return std::nullopt;
    LoadResult result = std::move(results_.front());
    results_.pop_front();
    work_.notify_one();
    return result;
}

void StepLoader::run(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    const auto something = [this] {
        return mayBegin() || (wishes_.empty() && maker_.canWrite(again()));
    };
    while (!stop.stop_requested()) {
        if (!something()) {
            const auto calm = calmFrom_;  // a copy: it is read while others may change it
            if (wishes_.empty() && maker_.hasUnwritten())
                work_.wait_until(lock, stop, calm, something);
            else
                work_.wait(lock, stop, something);
            continue;
        }
        if (!mayBegin()) {
            const StepMaker::Again how = again();
            lock.unlock();
            write(how, stop);
            lock.lock();
            continue;
        }
        const std::size_t step = wishes_.front();
        wishes_.pop_front();
        reading_ = step;
        const RangeSet looked = looked_;
        lock.unlock();
        LoadResult result = load(step, looked);
        lock.lock();
        reading_.reset();
        calmFrom_ = std::chrono::steady_clock::now() + kCalm;
        results_.push_back(std::move(result));
        done_.notify_one();
        lock.unlock();
        wake_();
        write(StepMaker::Again::Leave, stop);
        lock.lock();
    }
}

bool StepLoader::mayBegin() const {
    const auto little = static_cast<std::size_t>(std::ranges::count_if(results_, takesLittle));
    return !wishes_.empty() && results_.size() < kMostAhead &&
           results_.size() - little < kMostResults;
}

StepMaker::Again StepLoader::again() const {
    return std::chrono::steady_clock::now() < calmFrom_ ? StepMaker::Again::Leave
                                                        : StepMaker::Again::Read;
}

// What is there to be written, as long as nobody waits for anything else.
void StepLoader::write(StepMaker::Again again, const std::stop_token& stop) {
    const bool keeps = maker_.writeOne(again, [&](double) {
        const std::lock_guard lock(mutex_);
        return !stop.stop_requested() && (wishes_.empty() || haste_ == Haste::Nobody);
    });
    if (!keeps) wake_();  // there is something to tell
}

LoadResult StepLoader::load(std::size_t step, const RangeSet& looked) {
    try {
        auto sorted = maker_.make(step);
        if (sorted->file())
            sorted->columns(sorted->select(sorted->keptPart(looked)));
        else if (ready_ == Ready::Whole)
            sorted->columns();
        return Loaded{step, std::move(sorted)};
    } catch (const std::bad_alloc&) {
        return Failed{step, fmt::format("there is not enough memory for step {}", step)};
    } catch (const std::exception& e) {
        return Failed{step, sentenceOf(e)};
    }
}

}  // namespace timeseries
