// The steps of a dataset for those who never wait: wishes in, steps out as they come.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "app/dataset.h"
#include "timeseries/series.h"
#include "timeseries/step_loader.h"

namespace app {

// One thread. When all that is wished is there, the loader goes on to read steps never seen, one
// after the other, only for their summaries (Series::summary): the map of values by time fills.
class LiveSteps {
 public:
    // Takes the dataset's reader. `wake` is called from the loader's thread when a step is there.
    LiveSteps(Dataset& dataset, const timeseries::RangeSet& kept, std::uint64_t budgetBytes,
              std::function<void()> wake);

    // What is to be in memory, most urgent first. Cheap to call every frame.
    void want(const std::vector<std::size_t>& mostUrgentFirst);
    // Takes in what has come. Returns the steps that came, or failed, since the last call.
    std::vector<std::size_t> poll();
    void retry(std::size_t step);

    // Null unless loaded. Counts as use.
    std::shared_ptr<const timeseries::SortedStep> use(std::size_t step) { return series_.use(step); }
    const timeseries::Series& series() const { return series_; }

 private:
    void ask();

    timeseries::Series series_;
    timeseries::StepLoader loader_;
    std::vector<std::size_t> wished_;
};

}  // namespace app
