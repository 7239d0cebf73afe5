// Pictures of an animation written by a child process, `isochron render --session FILE`: the same
// code as without a window, and the window's GL is never shared.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <string>

#include "app/exploration/exploration.h"
#include "app/files/frame_files.h"

namespace app {

// What plays, once, as pictures: the steps from the in to the out point by the stride where time
// moves, else the one asked for; one cycle of the sweep where it moves, else its window as a layer.
// Which way, how fast and what comes at the end is for whoever plays the pictures.
Explorer animationOf(const Explorer& explorer, const Dataset& dataset);

// Nothing here blocks but its end. Everything is as poll() last saw it.
class ExportJob {
 public:
    enum class State { Running, Done, Failed, Cancelled };

    // Starts it: `isochron render` makes these frames of the explorer. `program`: isochron. Throws
    // std::runtime_error, one sentence, when it cannot be started.
    ExportJob(const Explorer& explorer, FrameFiles frames,
              const std::filesystem::path& program = "/proc/self/exe");
    // Cancels what still runs, and waits for its end, for a moment: nothing of it is left.
    ~ExportJob();
    ExportJob(const ExportJob&) = delete;
    ExportJob& operator=(const ExportJob&) = delete;

    void poll();
    // The pictures that are done stay.
    void cancel();
    // Cancels what still runs. How far it has come, as outcome() says it.
    std::string end();

    State state() const { return state_; }
    std::size_t done() const { return done_; }  // pictures, of frames().size()
    const FrameFiles& frames() const { return frames_; }
    // One sentence, once it has ended: what was made and where, or why it failed.
    std::string outcome() const;

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

    FrameFiles frames_;
    std::filesystem::path session_;
    Pipe out_, errors_;
    pid_t child_ = -1;
    std::string outText_, errorText_;  // not used yet
    State state_ = State::Running;
    std::size_t done_ = 0;
    bool cancelled_ = false;
    std::string why_;  // when failed
};

}  // namespace app
