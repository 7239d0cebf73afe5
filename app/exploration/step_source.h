// Sorted steps for those who must wait for them: a headless render. Read on a loader's thread, held
// in a Series under a byte budget, the next one loading while this one is used.
#pragma once

#include <memory>

#include "app/files/dataset.h"
#include "timeseries/series/series.h"
#include "timeseries/series/step_loader.h"

namespace app {

class StepSource {
 public:
    // Takes the dataset's reader. Values beside the ranges that are `asked` for need not be there.
    StepSource(OpenDataset& dataset, timeseries::RangeSet kept, timeseries::RangeSet asked);
    ~StepSource();  // tells what the steps on disk have to tell

    // Waits until the step is there. `next` is what will be asked for after it.
    // Throws FileError when the step cannot be read.
    std::shared_ptr<const timeseries::SortedStep> get(std::size_t step, std::size_t next);
    // It will not be asked for again: its memory serves the next ones.
    void drop(std::size_t step) { series_.drop(step); }

 private:
    timeseries::Series series_;
    const timeseries::StepStores stores_;
    timeseries::StepLoader loader_;
};

}  // namespace app
