#include "app/command/index_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <span>
#include <thread>
#include <utility>

#include "app/files/dataset.h"
#include "app/files/step_cache.h"
#include "app/say.h"

namespace app {

namespace fs = std::filesystem;
using timeseries::FileError;
using timeseries::StepMaker;
using timeseries::StepStore;

namespace {

// One that changed a moment ago may change again and have the same time.
void waitForSettled(std::span<const fs::path> files) {
    const auto now = std::chrono::system_clock::now();
    auto until = now;
    for (const fs::path& file : files) {
        const auto changed = StepStore::changedAt(file);
        if (changed && *changed <= now) until = std::max(until, *changed + StepStore::kSettled);
    }
    std::this_thread::sleep_until(until + std::chrono::milliseconds(10));
}

}  // namespace

// "" stands for the variable that is shown first.
std::vector<IndexTask> indexTasksOf(const IndexOptions& options) {
    std::vector<std::string> names = options.variables;
    if (names.empty()) names.emplace_back();
    std::vector<IndexTask> tasks;
    for (const std::string& name : names) {
        const OpenDataset dataset = openDataset(options.files, name);
        const std::vector<std::size_t> steps = stepsOf(dataset, options.steps);
        for (const std::size_t step : steps) tasks.push_back({dataset.variable.name, step});
        if (steps.empty()) continue;
        try {  // of headers that name other files; those of the last step may be the newest
            waitForSettled(dataset.reader->sources(dataset.variableIndex, steps.back()).files);
        } catch (const FileError&) {  // told where it is sorted
        }
    }
    return tasks;
}

std::shared_ptr<StepStore> indexStoreOf(const IndexOptions& options) {
    const std::vector<fs::path> files = openSeries(options.files).series.files;
    waitForSettled(files);
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
    ++(kept ? done_.of(*kept) : done_.failed);
    const auto spent = std::chrono::duration<double>(Clock::now() - begin_).count();
    const std::size_t finished = done_.all();
    // The others take no time.
    const std::size_t slow = finished - done_.failed - done_.of(StepMaker::Kept::Before);
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
    std::string others;
    for (const auto& [how, what] :
         {std::pair(StepMaker::Kept::Moves, "whose points move"),
          {StepMaker::Kept::Empty, "without a value"},
          {StepMaker::Kept::Changed, "whose files changed meanwhile, or are of the future"},
          {StepMaker::Kept::Unknown, "of a format whose steps are sorted each time"}})
        if (const std::size_t count = done.of(how); count > 0)
            others += fmt::format("{} {} {}", others.empty() ? "; not kept:" : ",", count, what);
    say("{} step{}: {} written, {} there before{}; {} holds {}\n", done.all(),
        done.all() == 1 ? "" : "s", done.of(StepMaker::Kept::Written),
        done.of(StepMaker::Kept::Before), others, store.folder().string(), megabytesText(bytes));
    if (done.lost > 0)
        sayTo(stderr,
              "isochron: {} has no room for all of them: it takes {} (a tenth of its disk, 64 GiB "
              "at most), for which {} of these steps had to go; --cache names another folder, "
              "--beside writes beside the data, with no such limit\n",
              store.folder().string(), megabytesText(store.budget()), withCommas(done.lost));
    return done.failed + done.lost == 0 ? 0 : 1;
}

}  // namespace app
