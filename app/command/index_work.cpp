#include "app/command/index_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "app/files/dataset.h"
#include "app/files/step_cache.h"
#include "app/say.h"

namespace app {

namespace fs = std::filesystem;
using timeseries::FileError;
using timeseries::StepMaker;
using timeseries::StepStore;

// "" stands for the variable that is shown first.
std::vector<IndexTask> indexTasksOf(const IndexOptions& options) {
    std::vector<std::string> names = options.variables;
    if (names.empty()) names.emplace_back();
    std::vector<IndexTask> tasks;
    for (const std::string& name : names) {
        const Dataset dataset = openDataset(options.files, name);
        for (const std::size_t step : stepsOf(dataset, options.steps))
            tasks.push_back({dataset.variable.name, step});
    }
    return tasks;
}

std::shared_ptr<StepStore> indexStoreOf(const IndexOptions& options) {
    const std::vector<fs::path> files = openSeries(options.files).series.files;
    const auto now = std::chrono::system_clock::now();
    auto until = now;
    for (const fs::path& file : files) {
        const auto changed = StepStore::changedAt(file);
        if (changed && *changed <= now) until = std::max(until, *changed + StepStore::kSettled);
    }
    std::this_thread::sleep_until(until + std::chrono::milliseconds(10));
    auto store = options.beside ? storeBeside(files) : stepCache();
    if (!store) throw FileError("there is no folder to keep sorted steps in: --cache names one");
    return store;
}

IndexWork::IndexWork(const IndexOptions& options, std::shared_ptr<StepStore> store,
                     std::vector<IndexTask> tasks)
    : options_(options),
      store_(std::move(store)),
      tasks_(std::move(tasks)),
      progress_("step", tasks_.size()) {}

void IndexWork::finish(std::optional<StepMaker::Kept> kept) {
    const std::lock_guard lock(mutex_);
    if (!kept) ++done_.failed;
    if (kept == StepMaker::Kept::Before) ++done_.before;
    if (kept == StepMaker::Kept::Written) ++done_.written;
    if (kept == StepMaker::Kept::Not) ++done_.notKept;
    const auto spent = std::chrono::duration<double>(Clock::now() - begin_).count();
    const std::size_t slow = done_.written + done_.notKept;  // the others take no time
    const std::size_t finished = done_.all();
    if (slow == 0 || finished == tasks_.size()) return;
    const double left =
        spent / static_cast<double>(slow) * static_cast<double>(tasks_.size() - finished);
    progress_.at(finished, fmt::format("at most {:.0f} s left", left));
}

void IndexWork::work() {
    std::unique_ptr<StepMaker> maker;
    std::string variable;
    // Where the store has begun to lose what it was given there is no end.
    for (std::size_t i; store_->lost() == 0 && (i = next_++) < tasks_.size();) {
        const IndexTask& task = tasks_[i];
        if (!maker || variable != task.variable) {
            OpenDataset dataset = openDataset(options_.files, task.variable);
            variable = task.variable;
            maker = std::make_unique<StepMaker>(std::move(dataset.reader), dataset.variableIndex,
                                                timeseries::RangeSet::everything(),
                                                timeseries::StepStores{{store_}, store_, 1});
        }
        std::optional<StepMaker::Kept> kept;
        try {
            kept = maker->keep(task.step);
        } catch (const FileError& error) {  // the others are no worse for it
            sayTo(stderr, "isochron: {}\n", error.what());
        }
        finish(kept);
    }
}

int tellIndexed(const IndexedSteps& done, const StepStore& store) {
    std::uint64_t bytes = 0;
    for (const StepStore::Entry& entry : store.list()) bytes += entry.bytes;
    say("{} step{}: {} written, {} there before{}; {} holds {}\n", done.all(),
        done.all() == 1 ? "" : "s", done.written, done.before,
        done.notKept == 0
            ? ""
            : fmt::format(
                  ", {} that cannot be kept: their points move, their files changed or are of the "
                  "future, all their values are missing, or they are of a format whose steps are "
                  "sorted each time",
                  done.notKept),
        store.folder().string(), megabytesText(bytes));
    if (done.lost > 0)
        sayTo(stderr,
              "isochron: {} has no room for all of them: it takes {} (a tenth of its disk, 64 GiB "
              "at most), for which {} of these steps had to go; --cache names another folder, "
              "--beside writes beside the data, with no such limit\n",
              store.folder().string(), megabytesText(store.budget()), withCommas(done.lost));
    return done.failed + done.lost == 0 ? 0 : 1;
}

}  // namespace app
