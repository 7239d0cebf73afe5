#include "timeseries/series/series.h"

#include <algorithm>
#include <cassert>
#include <stdexcept>
#include <unordered_set>
#include <utility>

namespace timeseries {

Series::Series(std::size_t steps, std::uint64_t budgetBytes, Quantiles quantiles)
    : slots_(steps), budget_(budgetBytes), quantiles_(quantiles) {
    if (steps == 0) throw std::invalid_argument("a series needs at least one time step");
}

std::shared_ptr<const SortedStep> Series::use(std::size_t step) {
    Slot& slot = slots_[step];
    if (slot.state == SlotState::Loaded) slot.lastUse = ++uses_;
    return slot.sorted;
}

std::vector<std::size_t> Series::want(std::vector<std::size_t> mostUrgentFirst) {
    std::unordered_set<std::size_t> seen;
    std::erase_if(mostUrgentFirst, [&](std::size_t step) {
        assert(step < slots_.size());
        return !seen.insert(step).second;
    });
    wishes_ = std::move(mostUrgentFirst);

    for (const std::size_t step : loading_)
        if (slots_[step].state == SlotState::Loading) slots_[step].state = SlotState::Empty;
    loading_ = missingWishes();
    for (const std::size_t step : loading_) slots_[step].state = SlotState::Loading;
    return loading_;
}

std::vector<std::size_t> Series::missingWishes() const {
    std::vector<std::size_t> steps;
    std::uint64_t left = budget_;
    bool first = true;  // is kept whatever it takes
    int wished = 0;
    for (const std::size_t step : wishes_) {
        const Slot& slot = slots_[step];
        if (slot.state == SlotState::Failed) continue;
        if (wished++ == kMostOpen) break;  // more would push each other out
        const std::uint64_t bytes = slot.summary ? slot.summary->bytes : largest_;
        if (bytes > left && !first) break;
        if (slot.state != SlotState::Loaded) steps.push_back(step);
        left -= std::min(left, bytes);
        first = false;
    }
    return steps;
}

Series::Steps Series::loaded(std::size_t step, std::shared_ptr<const SortedStep> sorted) {
    Steps left;
    if (auto before = drop(step)) left.push_back(std::move(before));
    Slot& slot = slots_[step];
    slot.summary = std::make_unique<StepSummary>(
        StepSummary{sorted->quantiles(quantiles_ == Quantiles::Kept ? kQuantiles : 0),
                    sorted->statistics(), sorted->size(), sorted->finite(), sorted->bytes()});
    slot.state = SlotState::Loaded;
    slot.sorted = std::move(sorted);
    slot.lastUse = ++uses_;
    inMemory_.push_back(step);
    bytes_ += slot.summary->bytes;
    largest_ = std::max(largest_, slot.summary->bytes);
    evict(left);
    return left;
}

Series::Steps Series::recount() {
    for (const std::size_t step : inMemory_) {
        StepSummary& summary = *slots_[step].summary;
        const std::uint64_t now = slots_[step].sorted->bytes();
        bytes_ = bytes_ - summary.bytes + now;
        summary.bytes = now;
        largest_ = std::max(largest_, now);
    }
    Steps left;
    evict(left);
    return left;
}

std::shared_ptr<const SortedStep> Series::replace(std::size_t step,
                                                  std::shared_ptr<const SortedStep> fewer) {
    Slot& slot = slots_[step];
    auto left = std::exchange(slot.sorted, std::move(fewer));
    bytes_ = bytes_ - slot.summary->bytes + slot.sorted->bytes();
    slot.summary->bytes = slot.sorted->bytes();
    largest_ = 0;
    for (const Slot& each : slots_)
        if (each.summary) largest_ = std::max(largest_, each.summary->bytes);
    return left;
}

void Series::failed(std::size_t step, std::string why) {
    drop(step);
    slots_[step].state = SlotState::Failed;
    slots_[step].why = std::move(why);
}

void Series::retry(std::size_t step) {
    if (slots_[step].state == SlotState::Failed) drop(step);
}

std::shared_ptr<const SortedStep> Series::drop(std::size_t step) {
    Slot& slot = slots_[step];
    if (slot.state == SlotState::Loaded) {
        bytes_ -= slot.summary->bytes;
        std::erase(inMemory_, step);
    }
    slot.state = SlotState::Empty;
    slot.why.clear();
    return std::exchange(slot.sorted, nullptr);
}

std::size_t Series::urgency(std::size_t step) const {
    const auto wish = std::find(wishes_.begin(), wishes_.end(), step);
    return wish == wishes_.end() ? kUnwanted : static_cast<std::size_t>(wish - wishes_.begin());
}

void Series::evict(Steps& left) {
    const auto stored = [this](std::size_t step) { return isStored(step); };
    while (inMemory_.size() > 1) {
        const bool isOver = bytes_ > budget_;
        if (!isOver && std::ranges::count_if(inMemory_, stored) <= kMostOpen) return;
        // Those on disk first, where it is files that are too many; kUnwanted is greater than any
        // place among the wishes.
        const auto leavesLater = [&](std::size_t a, std::size_t b) {
            if (!isOver && stored(a) != stored(b)) return stored(b);
            const std::size_t ua = urgency(a), ub = urgency(b);
            return ua != ub ? ua < ub : slots_[a].lastUse > slots_[b].lastUse;
        };
        left.push_back(drop(*std::max_element(inMemory_.begin(), inMemory_.end(), leavesLater)));
    }
}

}  // namespace timeseries
