// `isochron index`: steps sorted ahead, into files that are opened at once.
#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <thread>

#include "app/command/commands.h"
#include "app/files/dataset.h"
#include "app/files/progress.h"
#include "app/files/step_cache.h"
#include "app/say.h"
#include "timeseries/together.h"

namespace app {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using timeseries::FileError;
using timeseries::StepMaker;
using timeseries::StepStore;

struct Task {
    std::string variable;
    std::size_t step;
};

struct Done {
    std::size_t before = 0, written = 0, notKept = 0, failed = 0;  // steps
};

// Shared by the jobs.
struct Work {
    Work(const IndexOptions& of, std::shared_ptr<StepStore> in, std::vector<Task> all)
        : options(of),
          store(std::move(in)),
          tasks(std::move(all)),
          progress("step", tasks.size()) {}

    const IndexOptions& options;
    std::shared_ptr<StepStore> store;
    std::vector<Task> tasks;
    std::atomic<std::size_t> next{0};
    std::mutex mutex;
    Done done;  // guarded by mutex, as what follows
    std::size_t finished = 0;
    Progress progress;
    Clock::time_point begin = Clock::now();

    // What became of a step; none where it cannot be read.
    void finish(std::optional<StepMaker::Kept> kept) {
        const std::lock_guard lock(mutex);
        if (!kept) ++done.failed;
        if (kept == StepMaker::Kept::Before) ++done.before;
        if (kept == StepMaker::Kept::Written) ++done.written;
        if (kept == StepMaker::Kept::Not) ++done.notKept;
        ++finished;
        const auto spent = std::chrono::duration<double>(Clock::now() - begin).count();
        const std::size_t slow = done.written + done.notKept;  // the others take no time
        if (slow == 0 || finished == tasks.size()) return;
        const double left =
            spent / static_cast<double>(slow) * static_cast<double>(tasks.size() - finished);
        progress.at(finished, fmt::format("at most {:.0f} s left", left));
    }
};

// A file that changed a moment ago may change again and have the same time: it is waited for, so
// that what is read now is known to be what is there.
void waitUntilSettled(const std::vector<fs::path>& files) {
    const auto now = std::chrono::system_clock::now();
    auto until = now;
    for (const fs::path& file : files) {
        const auto changed = StepStore::changedAt(file);
        if (changed && *changed <= now) until = std::max(until, *changed + StepStore::kSettled);
    }
    std::this_thread::sleep_until(until + std::chrono::milliseconds(10));
}

// Opens the files for itself and takes tasks until none is left.
void work(Work& work) {
    std::unique_ptr<StepMaker> maker;
    std::string variable;
    for (std::size_t i; (i = work.next++) < work.tasks.size();) {
        const Task& task = work.tasks[i];
        if (!maker || variable != task.variable) {
            Dataset dataset = openDataset(work.options.files, task.variable);
            variable = task.variable;
            maker = std::make_unique<StepMaker>(
                std::move(dataset.reader), dataset.variable, timeseries::RangeSet::everything(),
                timeseries::StepStores{{work.store}, work.store, 1});
        }
        std::optional<StepMaker::Kept> kept;
        try {
            kept = maker->keep(task.step);
        } catch (const FileError& error) {  // the others are no worse for it
            sayTo(stderr, "isochron: {}\n", error.what());
        }
        work.finish(kept);
    }
}

int check(const IndexOptions& options) {
    int code = 0;
    for (const fs::path& file : options.files) {
        try {
            auto bytes = timeseries::openBytes(file);
            if (!bytes)
                throw timeseries::StepFileError(fmt::format("{}: no such file", file.string()));
            const timeseries::StepFile step(std::move(bytes));
            step.check();
            say("{}: {} points, all as they were written\n", file.string(),
                withCommas(step.statistics().points));
        } catch (const timeseries::StepFileError& error) {
            sayTo(stderr, "isochron: {}\n", error.what());
            code = 1;
        }
    }
    return code;
}

// "" stands for the variable that is shown first.
std::vector<Task> tasksOf(const IndexOptions& options) {
    std::vector<std::string> names = options.variables;
    if (names.empty()) names.emplace_back();
    std::vector<Task> tasks;
    for (const std::string& name : names) {
        const Dataset dataset = openDataset(options.files, name);
        for (const std::size_t step : stepsOf(dataset, options.steps))
            tasks.push_back({dataset.about.name, step});
    }
    return tasks;
}

}  // namespace

int index(const IndexOptions& options) {
    if (options.check) return check(options);
    const auto files = openSeries(options.files).series.files;
    waitUntilSettled(files);
    auto store = options.beside ? storeBeside(files) : stepCache();
    if (!store) throw FileError("there is no folder to keep sorted steps in: --cache names one");

    Work all(options, std::move(store), tasksOf(options));
    const auto jobs = static_cast<unsigned>(std::min<std::size_t>(options.jobs, all.tasks.size()));
    if (jobs > 1)  // each sorts on its share of the cores
        timeseries::threadLimit = std::max(1u, timeseries::sharingThreads() / jobs);
    timeseries::sharing(jobs, [&](unsigned) { work(all); });

    std::uint64_t bytes = 0;
    for (const StepStore::Entry& entry : all.store->list()) bytes += entry.bytes;
    say("{} step{}: {} written, {} there before{}; {} holds {}\n", all.tasks.size(),
        all.tasks.size() == 1 ? "" : "s", all.done.written, all.done.before,
        all.done.notKept == 0
            ? ""
            : fmt::format(", {} that cannot be kept: their points move, or their files changed",
                          all.done.notKept),
        all.store->folder().string(), megabytesText(bytes));
    return all.done.failed == 0 ? 0 : 1;
}

}  // namespace app
