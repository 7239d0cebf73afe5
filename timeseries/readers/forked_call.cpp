#include "timeseries/readers/forked_call.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <ctime>

namespace timeseries {
namespace {

// Dies quietly: no report, no core file, no handler of the program's.
[[noreturn]] void runCopy(const std::function<void()>& work, std::chrono::seconds limit) {
    for (const int fault : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) std::signal(fault, SIG_DFL);
    const rlimit none{0, 0};
    setrlimit(RLIMIT_CORE, &none);
    // Of computing, not of waiting for a slow disk; at the hard limit SIGKILL comes.
    const auto seconds = static_cast<rlim_t>(limit.count());
    const rlimit computing{seconds, seconds};
    setrlimit(RLIMIT_CPU, &computing);
    if (const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC); nowhere >= 0) {
        dup2(nowhere, STDOUT_FILENO);
        dup2(nowhere, STDERR_FILENO);
    }
    try {
        work();
    } catch (...) {
        // Told by the work itself, when it is done in earnest.
    }
    _exit(0);
}

std::chrono::nanoseconds computed(pid_t process) {
    clockid_t clock = 0;
    timespec time{};
    if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &time) != 0) return {};
    return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

// Until the copy has ended, or has not computed for `patience`; true in the first case. Where the
// kernel (before 5.3) cannot tell, that is at once: who asks for its status then waits.
bool ends(pid_t copy, std::chrono::seconds patience) {
    const int ended = static_cast<int>(syscall(SYS_pidfd_open, copy, 0));
    if (ended < 0) return true;
    pollfd one{ended, POLLIN, 0};
    const int wait = static_cast<int>(std::chrono::milliseconds(patience).count());
    int found = 0;
    for (std::chrono::nanoseconds before{-1}; found == 0 && computed(copy) > before;) {
        before = computed(copy);
        do found = poll(&one, 1, wait);
        while (found < 0 && errno == EINTR);
    }
    close(ended);
    return found != 0;
}

}  // namespace

std::string endOfForked(const std::function<void()>& work, std::chrono::seconds limit) {
    const pid_t copy = fork();
    if (copy == 0) runCopy(work, limit);
    if (copy < 0) return "";
    const bool tried = ends(copy, limit);
    if (!tried) kill(copy, SIGKILL);
    int status = 0;
    while (waitpid(copy, &status, 0) < 0)
        if (errno != EINTR) return "";
    if (!tried) return "";
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return "";
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL)
        return fmt::format("does not end within {} s", limit.count());
    return "crashes";
}

}  // namespace timeseries
