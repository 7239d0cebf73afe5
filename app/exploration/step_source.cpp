#include "app/exploration/step_source.h"

#include "app/files/memory_budget.h"
#include "app/files/step_cache.h"

namespace app {

StepSource::StepSource(OpenDataset& dataset, timeseries::RangeSet kept, timeseries::RangeSet asked)
    : series_(dataset.stepCount(), memoryBudget(), timeseries::Quantiles::None),
      stores_(storesFor(dataset.reader->files())),
      loader_(
          std::move(dataset.reader), dataset.variableIndex, std::move(kept), [] {},
          timeseries::Ready::WithField, stores_, std::move(asked)) {}

StepSource::~StepSource() { tellNotes(stores_); }

std::shared_ptr<const timeseries::SortedStep> StepSource::get(std::size_t step, std::size_t next) {
    series_.recount();  // steps that were drawn have their cells now
    loader_.want(series_.want({step, next}));
    for (;;) {
        if (series_.state(step) == timeseries::SlotState::Failed)
            throw timeseries::FileError(series_.why(step));
        if (auto sorted = series_.use(step)) return sorted;
        auto result = loader_.waitAndPoll().value();
        if (auto* failed = std::get_if<timeseries::Failed>(&result)) {
            series_.failed(failed->step, failed->why);  // the next one's is told at its turn
        } else {
            auto& loaded = std::get<timeseries::Loaded>(result);
            series_.loaded(loaded.step, std::move(loaded.sorted));
        }
    }
}

}  // namespace app
