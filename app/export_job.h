// Pictures of an animation written by a child process, `isochron render --session FILE`: the same
// code as without a window, and the window's GL is never shared.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <string>

#include "app/exploration.h"

namespace app {

// What plays, as pictures: the steps from the in to the out point where time moves, else the one
// asked for; one cycle of the sweep where it moves, else its window as a layer. (Every step: a
// stride is the play's alone.)
Explorer animationOf(const Shown& shown);

// Nothing here blocks. Everything is as poll() last saw it.
class ExportJob {
 public:
    enum class State { Running, Done, Failed, Cancelled };

    // Starts it: numbered files beside `output` (OUT.png, OUT.exr), as `isochron render` names
    // them. `program`: isochron. Throws std::runtime_error, one sentence, when it cannot be
    // started.
    ExportJob(const Explorer& explorer, std::filesystem::path output,
              const std::filesystem::path& program = "/proc/self/exe");
    // Cancels what still runs.
    ~ExportJob();
    ExportJob(const ExportJob&) = delete;
    ExportJob& operator=(const ExportJob&) = delete;

    void poll();
    // The pictures that are done stay.
    void cancel();

    State state() const { return state_; }
    std::size_t done() const { return done_; }       // pictures
    std::size_t count() const { return count_; }     // of so many; 0 until the first is done
    const std::string& why() const { return why_; }  // one sentence, when failed

 private:
    // The reading end of a pipe from the child.
    struct Pipe {
        ~Pipe();
        void drain(std::string& into);
        int reading = -1, writing = -1;
    };

    void start(const std::filesystem::path& program);
    void readProgress();
    void ended(int status);
    void removeSession() const;

    std::filesystem::path output_, session_;
    Pipe out_, errors_;
    pid_t child_ = -1;
    std::string outText_, errorText_;  // not used yet
    State state_ = State::Running;
    std::size_t done_ = 0, count_ = 0;
    bool cancelled_ = false;
    std::string why_;
};

}  // namespace app
