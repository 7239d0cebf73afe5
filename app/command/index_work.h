// Steps to be sorted into a store, and what became of them.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/choices/options.h"
#include "app/command/index_progress.h"
#include "timeseries/series/step_maker.h"

namespace app {

struct IndexTask {
    std::string variable;
    std::size_t step;
};
// All that the options ask for; waits for their files as indexStoreOf(). Throws FileError.
std::vector<IndexTask> indexTasksOf(const IndexOptions& options);

// The store that they go to, once their files are settled: one that changed a moment ago may change
// again and have the same time, and is waited for, so that what is read now is known to be what is
// there. Throws FileError.
std::shared_ptr<timeseries::StepStore> indexStoreOf(const IndexOptions& options);

// Whether each of so many processes that share a machine's memory (bytes) can sort a step of its
// own: the field, its sorted list, which is made at once where most points have one value, and a
// quarter for all else.
bool fitsEach(const timeseries::Variable& variable, std::uint64_t memory, unsigned processes);

struct IndexedSteps {
    std::array<std::size_t, timeseries::StepMaker::kKept> kept{};  // by StepMaker::Kept
    std::size_t failed = 0;
    std::vector<std::pair<std::string, std::size_t>> errors;  // each once, with how many it is of
    void fail(const std::string& why, std::size_t steps = 1);
    std::uint64_t refusedBytes = 0;  // of the largest that there was no room for
    std::size_t& of(timeseries::StepMaker::Kept how) { return kept[static_cast<std::size_t>(how)]; }
    std::size_t of(timeseries::StepMaker::Kept how) const {
        return kept[static_cast<std::size_t>(how)];
    }
    std::size_t all() const { return std::accumulate(kept.begin(), kept.end(), failed); }
};

// Steps that are not written take little time, and tell nothing of the others'; without a value
// those that could not be read.
inline bool isQuick(std::optional<timeseries::StepMaker::Kept> kept) {
    return kept != timeseries::StepMaker::Kept::Written &&
           kept != timeseries::StepMaker::Kept::Changed;
}

// Shared by the threads that do it.
class IndexWork {
 public:
    // `all` of what is asked for, whoever sorts it: none of them makes room for another.
    IndexWork(const IndexOptions& options, std::shared_ptr<timeseries::StepStore> store,
              std::vector<IndexTask> tasks, std::span<const IndexTask> all,
              IndexProgress& progress);
    IndexWork(const IndexWork&) = delete;
    IndexWork& operator=(const IndexWork&) = delete;
    ~IndexWork();  // tells what went wrong before work() threw
    // Opens the files for itself and takes tasks until none is left; called from several threads.
    // What cannot be read is told with the rest. Throws FileError where nothing can be opened,
    // StepFileError where nothing can be written.
    void work();
    const IndexedSteps& done() const { return done_; }

 private:
    // What became of a step: how it is kept, or why it cannot be read.
    void finish(std::optional<timeseries::StepMaker::Kept> kept, const std::string& why);

    const IndexOptions& options_;
    const std::shared_ptr<timeseries::StepStore> store_;
    const std::vector<IndexTask> tasks_;
    std::atomic<std::size_t> next_{0};
    std::atomic<bool> isFull_ = false;  // the store
    IndexProgress& progress_;
    std::mutex mutex_;
    IndexedSteps done_;  // guarded by mutex_
};

// 1 where some are not kept that another time may be.
int exitCodeOf(const IndexedSteps& done);

// In a line, on stdout, when nobody writes any more; returns the exit code.
int tellIndexed(IndexedSteps done, timeseries::StepStore& store);

// `index` as one of the processes that mpirun started.
int indexByRanks(const IndexOptions& options);

}  // namespace app
