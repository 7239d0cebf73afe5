#include "app/live_steps.h"

#include <thread>
#include <utility>

namespace app {

using timeseries::SlotState;

LiveSteps::LiveSteps(Dataset& dataset, const timeseries::RangeSet& kept, std::uint64_t budgetBytes,
                     std::function<void()> wake)
    : series_(dataset.stepCount(), budgetBytes),
      loader_(std::make_unique<timeseries::StepLoader>(std::move(dataset.reader), dataset.variable,
                                                       kept, std::move(wake))) {}

LiveSteps::~LiveSteps() {
    // Freeing gigabytes of steps takes long enough to be seen, too.
    std::thread([loader = std::move(loader_), steps = std::move(series_)]() mutable {
        loader.reset();
    }).detach();
}

void LiveSteps::want(std::vector<std::size_t> mostUrgentFirst) {
    if (mostUrgentFirst == wished_) return;
    wished_ = std::move(mostUrgentFirst);
    ask();
}

std::vector<LiveSteps::Arrival> LiveSteps::poll() {
    std::vector<Arrival> arrivals;
    while (auto result = loader_->poll()) {
        if (auto* failed = std::get_if<timeseries::Failed>(&*result)) {
            series_.failed(failed->step, std::move(failed->why));
            arrivals.push_back({failed->step, nullptr});
        } else {
            const auto& loaded = std::get<timeseries::Loaded>(*result);
            series_.loaded(loaded.step, loaded.sorted);
            arrivals.push_back({loaded.step, loaded.sorted});
        }
    }
    if (!arrivals.empty()) ask();
    return arrivals;
}

void LiveSteps::retry(std::size_t step) {
    series_.retry(step);
    ask();
}

void LiveSteps::ask() {
    std::vector<std::size_t> missing = series_.want(wished_);
    if (missing.empty()) {
        const auto seen = [this](std::size_t step) {
            return series_.summary(step) != nullptr || series_.state(step) == SlotState::Failed;
        };
        while (seenBelow_ < series_.stepCount() && seen(seenBelow_)) ++seenBelow_;
        // Two, so that the loader does not wait for the next frame.
        for (std::size_t step = seenBelow_; step < series_.stepCount() && missing.size() < 2;
             ++step)
            if (!seen(step)) missing.push_back(step);
    }
    loader_->want(std::move(missing));
}

}  // namespace app
