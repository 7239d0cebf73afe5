// How far the sorting of steps is, and how long the rest takes at most: on the terminal's last
// line, else, for a job's log, a line every half minute. The terminal's is wiped at the end.
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

#include "app/files/progress.h"

namespace app {

// Every member is safe to call from any thread.
class IndexProgress {
 public:
    enum class Shown { Yes, No };
    // Of so many steps, of which each that is told stands for one of each process's.
    explicit IndexProgress(std::size_t steps, Shown shown = Shown::Yes, std::size_t processes = 1);
    IndexProgress(const IndexProgress&) = delete;
    IndexProgress& operator=(const IndexProgress&) = delete;

    // So much more of a step is written, of 1.
    void add(double share);
    // A step has ended, of which so much was added; quick ones tell nothing of the others.
    void finish(double added, bool isQuick);
    // Nothing is told any more.
    void end();

 private:
    using Clock = std::chrono::steady_clock;
    void show();

    const std::size_t steps_, processes_;
    const TerminalLine line_;
    const Clock::time_point begin_ = Clock::now();
    std::mutex mutex_;
    Clock::time_point last_ = begin_;  // line; guarded by mutex_, as what follows
    std::size_t finished_ = 0, quick_ = 0;
    double added_ = 0;  // to steps that have not ended
    bool isShown_;
};

// "step 3 of 10, 25 %, at most 12 s left"; of one alone without the first part, and without the
// last where nothing tells it. `finished` and `quick` among them, and what of the others is
// written, in steps.
std::string indexProgressText(std::size_t steps, std::size_t finished, std::size_t quick,
                              double written, double seconds);

}  // namespace app
