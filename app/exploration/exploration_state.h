// What an Exploration holds beside its history; for exploration*.cpp alone.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "app/exploration/exploration.h"
#include "app/exploration/globe_maker.h"
#include "timeseries/series/opened_files.h"

namespace app {

struct Exploration::Open {
    Open(OpenDataset opened, const Explorer& wish, const Settings& settings, const Wake& wake)
        : dataset(opened),
          files(fewOf(opened)),
          steps(opened, wish.keep.value_or(timeseries::RangeSet::everything()),
                settings.budgetBytes, wake.callable()),
          globes(wake.callable()) {}

    // A series of many is not looked through: its steps' files are when they are read.
    static std::span<const std::filesystem::path> fewOf(const OpenDataset& opened) {
        const auto all = opened.reader->files();
        return all.first(all.size() <= timeseries::OpenedFiles::kFew ? all.size() : 0);
    }

    Dataset dataset;
    timeseries::OpenedFiles files;
    LiveSteps steps;
    std::size_t step = 0;  // shown
    std::shared_ptr<const timeseries::SortedStep> sorted;
    PointCounts counts;
    GlobeMaker globes;
    // What is shown lies so while it is to lie on a globe: flat without a mesh, stretched as asked.
    struct Globe {
        GlobeMaker::Made made;
        std::optional<glm::dvec3> stretch;
    } globe;
    LiveSteps::Arrival awaited = {};   // shown once its globe is there, or null
    Explorer laid;                     // what laid() tells where that is not explorer()
    std::set<std::size_t> passed;      // asked for since the step asked for was last there
    std::set<std::size_t> toldFailed;  // steps that were asked for, and whose failure was told
};

struct Exploration::Pending {
    Explorer wish;
    // What else than the data is to be shown. Again: all of now, of data that are read anew.
    enum class Rest { AsWished, LookOfNow, AllOfNow, Again } rest = Rest::AsWished;
    int travel = 0;  // states of the history to go back (-) or forward; 0: a new one
    std::optional<Opening> opening = {};
    std::unique_ptr<Open> opened = {};  // nothing to show yet
    std::size_t failedSteps = 0;        // of `opened`
};

}  // namespace app
