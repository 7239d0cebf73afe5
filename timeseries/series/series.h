// The time steps of one variable as the main thread holds them: a slot per step, under a budget of
// bytes. Bookkeeping only: no reader, no thread; the front end carries steps from a StepLoader
// here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "timeseries/index/sorted_step.h"

namespace timeseries {

enum class SlotState { Empty, Loading, Loaded, Failed };

// Whether summaries have them: they are of points in order, which is more than a picture needs.
enum class Quantiles { Kept, None };

// What stays known of a step after it has left memory.
struct StepSummary {
    // At the fractions 0, 1/1024, ..., 1 of the kept points that are finite; empty when there is
    // none, or Quantiles::None.
    std::vector<double> quantiles;
    StepStatistics statistics;  // of the whole step, before anything was dropped
    std::uint64_t points = 0;   // kept
    Run finite;                 // of these; before it stand those at -inf, behind it at +inf
    std::uint64_t bytes = 0;    // that the step takes when loaded, or took last
};

// Invariant: what is loaded took at most the budget when it was counted last, or is one step alone.
class Series {
 public:
    static constexpr std::size_t kQuantiles = kStepQuantiles;
    // Steps on disk that are loaded, each of which has its file open: of files that a process may
    // have open a part.
    static constexpr int kMostOpen = 256;

    // Throws std::invalid_argument when there is no step.
    Series(std::size_t steps, std::uint64_t budgetBytes, Quantiles quantiles = Quantiles::Kept);

    std::size_t stepCount() const { return slots_.size(); }
    std::uint64_t bytes() const {
        return bytes_;
    }  // of the steps loaded; whoever shares one may hold more
    std::uint64_t budgetBytes() const { return budget_; }

    // REQUIRES in all that follows: every step < stepCount().
    SlotState state(std::size_t step) const { return slots_[step].state; }
    // Whether it is loaded from a file of sorted points.
    bool isStored(std::size_t step) const {
        return slots_[step].sorted && slots_[step].sorted->file();
    }
    const std::string& why(std::size_t step) const { return slots_[step].why; }  // "" unless failed
    const StepSummary* summary(std::size_t step) const {
        return slots_[step].summary.get();
    }  // or null
    // Null unless loaded. Counts as use.
    std::shared_ptr<const SortedStep> use(std::size_t step);

    // Replaces the wishes, and returns those to hand to a loader, most urgent first, now Loading:
    // neither loaded nor failed, and only so many that each fits the budget beside all more urgent
    // ones (a step never seen counts as the largest seen). Else the last one loaded would push out
    // another, for ever. What was Loading and is not returned is Empty again.
    std::vector<std::size_t> want(std::vector<std::size_t> mostUrgentFirst);

    // Takes the step in, wished or not, then evicts down to the budget, and to kMostOpen: first
    // what is not wished, by least recent use, then the least urgent wish; which may be `step`
    // itself. The summaries stay. Returns what left: freeing a large step takes long enough to be
    // done elsewhere.
    using Steps = std::vector<std::shared_ptr<const SortedStep>>;
    Steps loaded(std::size_t step, std::shared_ptr<const SortedStep> sorted);
    // Steps grow while they are looked at: takes note of what they take now, and evicts.
    Steps recount();
    // Puts the same step with fewer points in memory (SortedStep::reopened) where it is, and
    // returns what left. REQUIRES: it is loaded.
    std::shared_ptr<const SortedStep> replace(std::size_t step,
                                              std::shared_ptr<const SortedStep> fewer);
    // Takes a step out that nobody will look at soon; returns what was there, or null.
    std::shared_ptr<const SortedStep> drop(std::size_t step);
    // A step that failed is not handed out again before retry().
    void failed(std::size_t step, std::string why);
    void retry(std::size_t step);

 private:
    struct Slot {
        SlotState state = SlotState::Empty;
        std::shared_ptr<const SortedStep> sorted;  // when loaded
        std::string why;                           // when failed
        std::unique_ptr<StepSummary> summary;
        std::uint64_t lastUse = 0;
    };
    static constexpr std::size_t kUnwanted = static_cast<std::size_t>(-1);

    std::vector<std::size_t> missingWishes() const;
    std::size_t urgency(std::size_t step) const;  // place among the wishes, or kUnwanted
    void evict(Steps& left);

    std::vector<Slot> slots_;
    std::vector<std::size_t> inMemory_;  // the loaded steps, in no order
    std::vector<std::size_t> wishes_;    // most urgent first, each once
    std::vector<std::size_t> loading_;   // as want() returned them; some may have come since
    std::uint64_t budget_;
    Quantiles quantiles_;
    std::uint64_t bytes_ = 0;
    std::uint64_t largest_ = 0;  // bytes of the largest step seen
    std::uint64_t uses_ = 0;
};

}  // namespace timeseries
