// Reads and sorts time steps on one background thread, the most urgent first. When nothing is asked
// for, it writes steps that were sorted to where they are found next time.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "timeseries/index/range_set.h"
#include "timeseries/index/sorted_step.h"
#include "timeseries/readers/reader.h"
#include "timeseries/series/step_maker.h"

namespace timeseries {

struct Loaded {
    std::size_t step = 0;
    std::shared_ptr<const SortedStep> sorted;
};

struct Failed {
    std::size_t step = 0;
    std::string why;  // one sentence
};

using LoadResult = std::variant<Loaded, Failed>;

// How much of a step is there when it can be polled.
enum class Ready {
    Asked,      // no order: points are put in order where somebody looks
    WithField,  // the same, and the field itself, until cells are made of it
    Whole       // all of the order, so that who looks, at a histogram above all, never waits
};

// Members may be called from one thread at a time: the main one. The Reader is used by the loader's
// own thread and nobody else. Destruction waits for a read that is running, no longer, and drops
// its result; a read may also be of a step that was sorted before and is to be written.
class StepLoader {
 public:
    // REQUIRES: variable < reader->variables().size(). `asked` is StepMaker's. `wake` is called
    // from the loader's thread after each result is there to be polled; it must not throw, nor call
    // the loader.
    StepLoader(
        std::unique_ptr<Reader> reader, std::size_t variable, RangeSet kept,
        std::function<void()> wake = [] {}, Ready ready = Ready::Asked, StepStores stores = {},
        RangeSet asked = RangeSet::everything());
    ~StepLoader();
    StepLoader(const StepLoader&) = delete;
    StepLoader& operator=(const StepLoader&) = delete;

    // Results that wait to be polled, at most: of steps on disk of which little is in memory. Of
    // others there are two.
    static constexpr std::size_t kMostAhead = 32;
    // Nothing was wished for so long before a step is read again to be written: who wishes then
    // waits for that.
    static constexpr std::chrono::seconds kCalm{1};

    std::size_t stepCount() const { return stepCount_; }

    // Replaces the wishes: what is not wished any more and not begun is not read. What is being
    // read, or read but not polled yet, is not read again. A step already polled is: wish for what
    // is missing. Throws std::out_of_range, and wishes nothing, for a step that the series does not
    // have. Steps that nobody waits for are written as they come. What is `looked` at of a step on
    // disk is read before it can be polled, so that who draws it need not.
    enum class Haste { Waited, Nobody };
    void want(std::vector<std::size_t> mostUrgentFirst, Haste haste = Haste::Waited,
              RangeSet looked = {});

    // A result, in the order in which they were finished; none when there is none yet.
    // The loader keeps few results ahead: it goes on when one is polled.
    std::optional<LoadResult> poll();
    // Waits for a result. None when the time is over, or at once when nothing is wished or being
    // read.
    std::optional<LoadResult> waitAndPoll(
        std::chrono::nanoseconds timeout = std::chrono::nanoseconds::max());

 private:
    void run(const std::stop_token& stop);
    LoadResult load(std::size_t step, const RangeSet& looked);
    bool mayBegin() const;           // REQUIRES: mutex_ is held
    StepMaker::Again again() const;  // REQUIRES: mutex_ is held
    void write(StepMaker::Again again, const std::stop_token& stop);
    bool idle() const;                      // REQUIRES: mutex_ is held
    std::optional<LoadResult> takeFirst();  // REQUIRES: mutex_ is held

    StepMaker maker_;
    const std::size_t stepCount_;
    const std::function<void()> wake_;
    const Ready ready_;

    std::mutex mutex_;
    std::condition_variable_any work_;  // the loader waits: wishes, or room for results
    std::condition_variable done_;      // waitAndPoll waits: a result
    // Those below are guarded by mutex_.
    std::deque<std::size_t> wishes_;  // most urgent first, each once
    Haste haste_ = Haste::Waited;
    RangeSet looked_;
    std::optional<std::size_t> reading_;
    std::deque<LoadResult> results_;
    std::chrono::steady_clock::time_point calmFrom_{};  // unless more is wished before

    std::jthread thread_;  // last: it ends before what it uses
};

}  // namespace timeseries
