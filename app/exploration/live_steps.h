// The steps of a dataset for those who never wait: wishes in, steps out as they come.
#pragma once

#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <vector>

#include "app/files/dataset.h"
#include "timeseries/series/series.h"
#include "timeseries/series/step_loader.h"

namespace app {

// One thread. When all that is wished is there, the loader goes on to read steps never seen, one
// after the other, only for their summaries (Series::summary): the map of values by time fills,
// also where the steps do not all fit the budget.
class LiveSteps {
 public:
    // Takes the dataset's reader. `wake` is called from the loader's thread when a step is there,
    // also after this is gone.
    LiveSteps(OpenDataset& dataset, const timeseries::RangeSet& kept, std::uint64_t budgetBytes,
              std::function<void()> wake);
    // Waits for nothing: a read that is running ends on a thread of its own, see exploration.h.
    ~LiveSteps();

    // What is to be in memory, most urgent first, and what will be looked at of it. Cheap to call
    // every frame.
    void want(std::vector<std::size_t> mostUrgentFirst, timeseries::RangeSet looked = {});

    // A step that came. Null when it failed: series().why(step).
    struct Arrival {
        std::size_t step;
        std::shared_ptr<const timeseries::SortedStep> sorted;
    };
    // Takes in what has come since the last call. The budget may already have dropped a step
    // that nobody wished for any more: the arrival still has it.
    std::vector<Arrival> poll();
    void retry(std::size_t step);
    // What the steps on disk have to tell, each once.
    std::vector<std::string> takeNotes();

    // Null unless loaded. Counts as use.
    std::shared_ptr<const timeseries::SortedStep> use(std::size_t step) {
        return series_.use(step);
    }
    const timeseries::Series& series() const { return series_; }
    // Begins to make the step anew with fewer points in memory: those in `looked`, and of the
    // others those last looked at, by so many bytes in all. It comes, as the others do, unless the
    // step has left until then. Nothing while one is being made. REQUIRES: series().isStored(step).
    void reopen(std::size_t step, timeseries::RangeSet looked, std::uint64_t bytes);

 private:
    void ask();
    void takeReopened(std::vector<Arrival>& arrivals);
    void freeLeaving();

    timeseries::Series series_;
    const timeseries::StepStores stores_;
    // Dropped by the budget, but perhaps still shown: whoever looks at them last must not be the
    // one who frees them, on the interface's thread.
    timeseries::Series::Steps leaving_;
    std::function<void()> wake_;
    std::unique_ptr<timeseries::StepLoader> loader_;
    // What is made of a step that is loaded.
    struct Reopening {
        std::size_t step;
        std::shared_ptr<const timeseries::SortedStep> from;
        std::future<std::shared_ptr<const timeseries::SortedStep>> made;
    };
    std::optional<Reopening> reopening_;
    std::string whyNotKept_;  // what is sorted; until it is told
    std::vector<std::string> notes_;
    std::vector<std::size_t> wished_;
    timeseries::RangeSet looked_;
    std::size_t seenBelow_ = 0;  // all steps before it are seen, or failed
};

}  // namespace app
