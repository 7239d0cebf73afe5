#include "app/exploration/live_steps.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <iterator>
#include <new>
#include <thread>
#include <utility>

#include "app/files/step_cache.h"

namespace app {

using timeseries::SlotState;
using namespace std::chrono_literals;
using StepPtr = std::shared_ptr<const timeseries::SortedStep>;

namespace {

timeseries::StepStores writable(timeseries::StepStores stores) {
    stores.write = stepCache();
    return stores;
}

// What cannot be copied, or is not to be read any more, is read again by whoever looks. Null where
// there is no memory for that either.
StepPtr withFewerPoints(const timeseries::SortedStep& step, const timeseries::RangeSet& looked,
                        std::uint64_t bytes) {
    try {
        const auto runs = step.select(step.keptPart(looked));
        return std::make_shared<const timeseries::SortedStep>(step.reopened(runs, bytes));
    } catch (const std::exception&) {
    }
    try {
        return std::make_shared<const timeseries::SortedStep>(step.reopened());
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}

// A read that runs, and freeing large steps, takes long enough to be seen.
template <typename... T>
void endElsewhere(T... things) {
    std::thread([... ending = std::move(things)] {}).detach();
}

}  // namespace

LiveSteps::LiveSteps(OpenDataset& dataset, const timeseries::RangeSet& kept,
                     std::uint64_t budgetBytes, std::function<void()> wake)
    : series_(dataset.stepCount(), budgetBytes),
      stores_(writable(storesFor(dataset.reader->files()))),
      wake_(std::move(wake)),
      loader_(std::make_unique<timeseries::StepLoader>(std::move(dataset.reader),
                                                       dataset.variableIndex, kept, wake_,
                                                       timeseries::Ready::Whole, stores_)),
      whyNotKept_(whyNoStepCache()) {}

LiveSteps::~LiveSteps() {
    endElsewhere(std::move(loader_), std::move(series_), std::move(leaving_),
                 std::move(reopening_));
}

void LiveSteps::want(std::vector<std::size_t> mostUrgentFirst, timeseries::RangeSet looked) {
    looked_ = std::move(looked);
    if (mostUrgentFirst == wished_) return;
    wished_ = std::move(mostUrgentFirst);
    ask();
}

std::vector<LiveSteps::Arrival> LiveSteps::poll() {
    std::vector<Arrival> arrivals;
    takeReopened(arrivals);
    while (auto result = loader_->poll()) {
        if (auto* failed = std::get_if<timeseries::Failed>(&*result)) {
            series_.failed(failed->step, std::move(failed->why));
            arrivals.push_back({failed->step, nullptr});
        } else {
            const auto& loaded = std::get<timeseries::Loaded>(*result);
            for (auto& left : series_.loaded(loaded.step, loaded.sorted))
                leaving_.push_back(std::move(left));
            if (!whyNotKept_.empty() && !series_.isStored(loaded.step) &&
                loaded.sorted->kept() == timeseries::RangeSet::everything() &&
                loaded.sorted->size() >= stores_.worthWriting)
                notes_.push_back("sorted steps are not kept: " + std::exchange(whyNotKept_, {}));
            arrivals.push_back({loaded.step, loaded.sorted});
        }
    }
    for (auto& left : series_.recount()) leaving_.push_back(std::move(left));
    freeLeaving();
    if (!arrivals.empty()) ask();
    return arrivals;
}

void LiveSteps::reopen(std::size_t step, timeseries::RangeSet looked, std::uint64_t bytes) {
    if (reopening_) return;
    std::promise<StepPtr> made;
    Reopening reopening{step, series_.use(step), made.get_future()};
    std::thread([from = reopening.from, looked = std::move(looked), bytes, made = std::move(made),
                 wake = wake_]() mutable {
        made.set_value(withFewerPoints(*from, looked, bytes));
        from.reset();  // before the interface's thread has the last one
        wake();
    }).detach();
    reopening_ = std::move(reopening);
}

void LiveSteps::takeReopened(std::vector<Arrival>& arrivals) {
    if (!reopening_ || !reopening_->made.valid() ||
        reopening_->made.wait_for(0s) != std::future_status::ready)
        return;
    const StepPtr fewer = reopening_->made.get(), from = std::exchange(reopening_->from, nullptr);
    const std::size_t step = reopening_->step;
    leaving_.push_back(from);
    if (!fewer) return;  // and none will be made
    reopening_.reset();
    if (series_.use(step) != from) return leaving_.push_back(fewer);
    leaving_.push_back(series_.replace(step, fewer));
    arrivals.push_back({step, fewer});
}

void LiveSteps::freeLeaving() {
    const auto isShared = [](const auto& step) { return step.use_count() > 1; };
    const auto alone = std::partition(leaving_.begin(), leaving_.end(), isShared);
    if (alone == leaving_.end()) return;
    endElsewhere(
        timeseries::Series::Steps(std::move_iterator(alone), std::move_iterator(leaving_.end())));
    leaving_.erase(alone, leaving_.end());
}

std::vector<std::string> LiveSteps::takeNotes() {
    std::vector<std::string> notes = std::exchange(notes_, {});
    for (const auto& store : stores_.read)
        for (std::string& note : store->takeNotes()) notes.push_back(std::move(note));
    return notes;
}

void LiveSteps::retry(std::size_t step) {
    series_.retry(step);
    ask();
}

void LiveSteps::ask() {
    using timeseries::StepLoader;
    using Haste = StepLoader::Haste;
    std::vector<std::size_t> missing = series_.want(wished_);
    const Haste haste = missing.empty() ? Haste::Nobody : Haste::Waited;
    if (missing.empty()) {
        const auto seen = [this](std::size_t step) {
            return series_.summary(step) != nullptr || series_.state(step) == SlotState::Failed;
        };
        while (seenBelow_ < series_.stepCount() && seen(seenBelow_)) ++seenBelow_;
        // As many as the loader goes ahead, so that it does not wait for the next frame.
        constexpr std::size_t kMost = StepLoader::kMostAhead;
        for (std::size_t step = seenBelow_; step < series_.stepCount() && missing.size() < kMost;
             ++step)
            if (!seen(step)) missing.push_back(step);
    }
    // Of a step that only its summary is read of, nothing else.
    loader_->want(std::move(missing), haste,
                  haste == Haste::Waited ? looked_ : timeseries::RangeSet());
}

}  // namespace app
