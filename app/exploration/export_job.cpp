#include "app/exploration/export_job.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "app/choices/session.h"
#include "app/json_text.h"
#include "app/picture/picture.h"
#include "render/image/picture_file.h"
#include "timeseries/together.h"

namespace app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostText = 64 * 1024;  // kept of what the child says
constexpr std::chrono::milliseconds kLongestEnd{2000};

[[noreturn]] void fail(const std::string& what, int error) {
    throw std::runtime_error(
        fmt::format("the export cannot be started: {}: {}", what, std::strerror(error)));
}

// The system's error does not say which folder it is about.
fs::path temporaryFolder() {
    std::error_code error;
    fs::path folder = fs::temp_directory_path(error);
    if (!error) return folder;
    for (const char* name : {"TMPDIR", "TMP", "TEMP", "TEMPDIR"})  // in the order of the library
        if (const char* const value = std::getenv(name))
            fail(fmt::format("'{}', which {} names", value, name), error.value());
    fail("/tmp", error.value());
}

// A new file that only this user reads, with the session in it.
fs::path writeSession(const Explorer& explorer) {
    const fs::path folder = temporaryFolder();
    std::string name = (folder / "isochron-export-XXXXXX.json").string();
    const int descriptor = mkostemps(name.data(), 5, O_CLOEXEC);
    if (descriptor < 0) fail(name, errno);
    const std::string text = jsonText(toJson(explorer, folder), 2);
    std::FILE* const file = fdopen(descriptor, "wb");
    std::fwrite(text.data(), 1, text.size(), file);
    if (std::fclose(file) != 0) {
        const int error = errno;
        unlink(name.c_str());
        fail(name, error);
    }
    return name;
}

// What posix_spawn is told, freed at the end.
class Spawn {
 public:
    Spawn() {
        posix_spawn_file_actions_init(&actions_);
        posix_spawnattr_init(&attributes_);
        // The child dies of SIGTERM and SIGPIPE whatever the window does with them.
        sigset_t signals;
        sigemptyset(&signals);
        posix_spawnattr_setsigmask(&attributes_, &signals);
        sigaddset(&signals, SIGTERM);
        sigaddset(&signals, SIGPIPE);
        posix_spawnattr_setsigdefault(&attributes_, &signals);
        posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
    }
    ~Spawn() {
        posix_spawn_file_actions_destroy(&actions_);
        posix_spawnattr_destroy(&attributes_);
    }
    Spawn(const Spawn&) = delete;
    Spawn& operator=(const Spawn&) = delete;

    void redirect(int from, int to) { posix_spawn_file_actions_adddup2(&actions_, from, to); }
    pid_t run(const fs::path& program, std::vector<std::string> arguments) {
        std::vector<char*> argv;
        for (std::string& argument : arguments) argv.push_back(argument.data());
        argv.push_back(nullptr);
        pid_t child = -1;
        const int error =
            posix_spawn(&child, program.c_str(), &actions_, &attributes_, argv.data(), environ);
        if (error != 0) fail(program.string(), error);
        return child;
    }

 private:
    posix_spawn_file_actions_t actions_;
    posix_spawnattr_t attributes_;
};

// What a child that was killed leaves of the picture it was writing.
void removePartial(const FrameFiles& frames) {
    const fs::path& output = frames.output();
    const fs::path folder = output.has_parent_path() ? output.parent_path() : ".";
    std::vector<fs::path> partial;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
        if (frames.has(render::PartialFile::destinationOf(at->path().filename())))
            partial.push_back(at->path());
    for (const fs::path& file : partial) render::PartialFile::removeLeft(file);
}

// The last line that says something, without the program's name.
std::string lastLine(std::string_view text) {
    while (!text.empty() && text.back() == '\n') text.remove_suffix(1);
    if (const std::size_t at = text.rfind('\n'); at != std::string_view::npos)
        text.remove_prefix(at + 1);
    constexpr std::string_view kName = "isochron: ";
    if (text.starts_with(kName)) text.remove_prefix(kName.size());
    return std::string(text);
}

}  // namespace

Explorer animationOf(const Explorer& explorer, const Dataset& dataset) {
    const PlayChoice& play = explorer.play;
    Explorer e = explorer;
    e.oneTick = sweepOf(e) != nullptr && !play.sweepMoves;
    if (play.timeMoves)
        e.steps = StepChoice{play.time.first, std::min(play.time.last, dataset.stepCount() - 1),
                             play.time.stride};
    return e;
}

ExportJob::Pipe::~Pipe() {
    for (const int end : {reading, writing})
        if (end >= 0) close(end);
}

void ExportJob::Pipe::drain(std::string& into) {
    std::array<char, 4096> buffer;
    for (ssize_t n = 0; (n = read(reading, buffer.data(), buffer.size())) > 0;) {
        into.append(buffer.data(), static_cast<std::size_t>(n));
        if (into.size() > kMostText) into.erase(0, into.size() - kMostText);
    }
}

ExportJob::ExportJob(const Explorer& explorer, FrameFiles frames, const fs::path& program)
    : frames_(std::move(frames)) {
    for (Pipe* const pipe : {&out_, &errors_}) {
        std::array<int, 2> ends{};
        if (pipe2(ends.data(), O_CLOEXEC) != 0) fail("a pipe", errno);
        pipe->reading = ends[0];
        pipe->writing = ends[1];
        fcntl(pipe->reading, F_SETFL, O_NONBLOCK);
    }
    session_ = writeSession(explorer);
    try {
        start(program);
    } catch (...) {
        removeSession();
        throw;
    }
}

void ExportJob::start(const fs::path& program) {
    Spawn spawn;
    spawn.redirect(out_.writing, STDOUT_FILENO);
    spawn.redirect(errors_.writing, STDERR_FILENO);
    std::vector<std::string> arguments = {"isochron",
                                          "render",
                                          "--session",
                                          session_.string(),
                                          "--progress",
                                          "-o",
                                          frames_.output().string()};
    if (const unsigned limit = timeseries::threadLimit)
        arguments.push_back(fmt::format("--threads={}", limit));
    child_ = spawn.run(program, arguments);
    // The child alone holds these, so that their end is its end.
    for (Pipe* const pipe : {&out_, &errors_}) close(std::exchange(pipe->writing, -1));
}

ExportJob::~ExportJob() {
    if (state_ != State::Running) return;
    cancel();
    // A pipe's end is the child's. One that a driver or a disk holds back is left to the system.
    pollfd end{out_.reading, 0, 0};
    int ends = 0;
    do ends = ::poll(&end, 1, kLongestEnd.count());
    while (ends < 0 && errno == EINTR);
    if (ends == 1) waitpid(child_, nullptr, 0);
    removePartial(frames_);
    removeSession();
}

void ExportJob::cancel() {
    if (state_ != State::Running) return;
    cancelled_ = true;
    kill(child_, SIGTERM);
}

std::string ExportJob::end() {
    poll();
    cancel();
    return outcome();
}

void ExportJob::poll() {
    if (state_ != State::Running) return;
    int status = 0;
    const bool hasEnded = waitpid(child_, &status, WNOHANG) == child_;
    // What it said before it ended is in the pipes by now.
    out_.drain(outText_);
    errors_.drain(errorText_);
    readProgress();
    if (hasEnded) ended(status);
}

// Lines "picture 3 of 31", as `render --progress` tells them.
void ExportJob::readProgress() {
    for (std::size_t end = 0; (end = outText_.find('\n')) != std::string::npos;) {
        std::size_t done = 0;
        if (std::sscanf(outText_.c_str(), "picture %zu of", &done) == 1) done_ = done;
        outText_.erase(0, end + 1);
    }
}

void ExportJob::ended(int status) {
    removeSession();
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
        state_ = State::Done;
        return;
    }
    removePartial(frames_);
    state_ = cancelled_ ? State::Cancelled : State::Failed;
    if (cancelled_) return;
    why_ = lastLine(errorText_);
    if (!why_.empty()) return;
    why_ = WIFSIGNALED(status)
               ? fmt::format("the export was ended by signal {}", WTERMSIG(status))
               : fmt::format("the export ended with exit code {}", WEXITSTATUS(status));
}

std::string ExportJob::outcome() const {
    if (state_ == State::Failed) return why_;
    const auto pictures = [](std::size_t n) {
        return fmt::format("{} {}", n, n == 1 ? "picture" : "pictures");
    };
    if (state_ == State::Done)
        return fmt::format("Exported {}: {}", pictures(frames_.size()), frames_.names());
    if (done_ == 0) return "Export cancelled before its first picture";
    return fmt::format("Export cancelled after {} of {}, which stay in {}", done_,
                       pictures(frames_.size()), frames_.output().parent_path().string());
}

void ExportJob::removeSession() const {
    std::error_code ignored;
    fs::remove(session_, ignored);
}

}  // namespace app
