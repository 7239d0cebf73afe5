#include "app/command/index_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>
#include <span>
#include <thread>
#include <utility>

#include "app/files/dataset.h"
#include "app/files/step_cache.h"
#include "app/say.h"
#include "timeseries/grid/with_type.h"

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

// Where these steps are, or would be, in the store; of what cannot be opened none.
std::vector<fs::path> pathsOf(const IndexOptions& options, std::span<const IndexTask> tasks,
                              const StepStore& store) {
    std::vector<fs::path> paths;
    try {
        std::optional<OpenDataset> dataset;
        for (const IndexTask& task : tasks) {
            if (!dataset || dataset->variable.name != task.variable)
                dataset = openDataset(options.files, task.variable);
            const auto origin =
                timeseries::originOf(*dataset->reader, dataset->variableIndex, task.step);
            if (origin) paths.push_back(store.pathOf(*origin));
        }
    } catch (const FileError&) {  // told where it is sorted
    }
    return paths;
}

void tellErrors(const IndexedSteps& done) {
    for (const auto& [why, steps] : done.errors)
        sayTo(stderr, "isochron: {}{}\n", why,
              steps == 1 ? "" : fmt::format(" ({} steps)", withCommas(steps)));
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

bool fitsEach(const timeseries::Variable& variable, std::uint64_t memory, unsigned processes) {
    const std::uint64_t value =
        timeseries::withType(variable.type, [](auto of) { return std::uint64_t{sizeof of}; });
    return variable.grid->count() * (2 * value + 4) < memory / 4 * 3 / processes;
}

IndexWork::IndexWork(const IndexOptions& options, std::shared_ptr<StepStore> store,
                     std::vector<IndexTask> tasks, std::span<const IndexTask> all,
                     IndexProgress& progress)
    : options_(options), store_(std::move(store)), tasks_(std::move(tasks)), progress_(progress) {
    store_->room().hold([options, paths = std::vector(all.begin(), all.end()),
                         store = store_.get()] { return pathsOf(options, paths, *store); });
}

IndexWork::~IndexWork() {
    if (std::uncaught_exceptions() == 0) return;
    progress_.end();
    tellErrors(done_);
}

void IndexedSteps::fail(const std::string& why, std::size_t steps) {
    failed += steps;
    const auto told = std::ranges::find(errors, why, &std::pair<std::string, std::size_t>::first);
    if (told == errors.end())
        errors.emplace_back(why, steps);
    else
        told->second += steps;
}

void IndexWork::finish(std::optional<StepMaker::Kept> kept, const std::string& why) {
    const std::lock_guard lock(mutex_);
    if (kept)
        ++done_.of(*kept);
    else
        done_.fail(why);
}

void IndexWork::work() {
    std::unique_ptr<StepMaker> maker;
    std::string variable;
    for (std::size_t i; (i = next_++) < tasks_.size();) {
        const IndexTask& task = tasks_[i];
        if (!maker || variable != task.variable) {
            OpenDataset dataset = openDataset(options_.files, task.variable);
            variable = task.variable;
            maker = std::make_unique<StepMaker>(std::move(dataset.reader), dataset.variableIndex,
                                                timeseries::RangeSet::everything(),
                                                timeseries::StepStores{{store_}, store_, 1});
        }
        std::optional<StepMaker::Kept> kept;
        std::string why;
        double written = 0;
        const auto tell = [&](double share) {
            progress_.add(share - std::exchange(written, share));
            return true;
        };
        try {
            // The others are about as large: to sort them, too, would be in vain.
            kept = isFull_ ? maker->keepNoMore(task.step) : maker->keep(task.step, tell);
            if (kept == StepMaker::Kept::NoRoom) isFull_ = true;
        } catch (const FileError& error) {  // the others are no worse for it
            why = error.what();
        }
        finish(kept, why);
        progress_.finish(written, isQuick(kept));
    }
}

namespace {

void tellNoRoom(const IndexedSteps& done, StepStore& store) {
    const timeseries::StoreRoom::Held held = store.room().held();
    const std::uint64_t each = std::max({done.refusedBytes, store.room().refused(),
                                         held.bytes / std::max<std::uint64_t>(held.files, 1)});
    const std::size_t count = done.of(StepMaker::Kept::NoRoom);
    sayTo(stderr,
          "isochron: {} takes {} at most: {} of these steps did not fit, about --cache-size {}MB "
          "would hold all of them; --cache names another folder, --beside writes beside the data, "
          "with no such limit\n",
          store.folder().string(), megabytesText(store.budget()), withCommas(count),
          (held.bytes + count * each) / 1'000'000 + 1);
}

}  // namespace

int exitCodeOf(const IndexedSteps& done) {
    return done.failed + done.of(StepMaker::Kept::NoRoom) + done.of(StepMaker::Kept::Changed) == 0
               ? 0
               : 1;
}

int tellIndexed(IndexedSteps done, StepStore& store) {
    // What other programs, or processes of this one, wrote at the same time.
    for (std::size_t gone = store.room().settle(); gone > 0; --gone) {
        const auto from = done.of(StepMaker::Kept::Written) > 0 ? StepMaker::Kept::Written
                                                                : StepMaker::Kept::Before;
        --done.of(from);
        ++done.of(StepMaker::Kept::NoRoom);
    }
    for (const std::string& note : store.takeNotes()) sayTo(stderr, "note: {}\n", note);
    tellErrors(done);
    std::uint64_t bytes = 0;
    for (const timeseries::StoredFile& entry : timeseries::storedFiles(store.folder()))
        bytes += entry.bytes;
    std::string others;
    for (const auto& [how, what] :
         {std::pair(StepMaker::Kept::Moves, "whose points move"),
          {StepMaker::Kept::Empty, "without a value"},
          {StepMaker::Kept::Changed, "whose files changed meanwhile, or are of the future"},
          {StepMaker::Kept::Unknown, "that are sorted each time"},
          {StepMaker::Kept::NoRoom, "for want of room"}})
        if (const std::size_t count = done.of(how); count > 0)
            others += fmt::format("{} {} {}", others.empty() ? "; not kept:" : ",", count, what);
    say("{} step{}: {} written, {} there before{}; {} holds {}\n", done.all(),
        done.all() == 1 ? "" : "s", done.of(StepMaker::Kept::Written),
        done.of(StepMaker::Kept::Before), others, store.folder().string(), megabytesText(bytes));
    if (done.of(StepMaker::Kept::NoRoom) > 0) tellNoRoom(done, store);
    return exitCodeOf(done);
}

}  // namespace app
