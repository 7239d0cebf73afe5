#include "xr/forked_answer.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <exception>
#include <optional>
#include <stdexcept>

namespace xr {
namespace {

using Clock = std::chrono::steady_clock;

// Ends an answer: without it, whoever asked died on the way.
constexpr char kEnd = '\0';

void writeAll(int to, const std::string& text) {
    for (std::size_t done = 0; done < text.size();) {
        const ssize_t n = write(to, text.data() + done, text.size() - done);
        if (n < 0 && errno != EINTR) return;
        done += static_cast<std::size_t>(std::max<ssize_t>(n, 0));
    }
}

// Dies quietly: no report, no core file, no handler of the program's.
[[noreturn]] void runCopy(const std::function<std::string()>& ask, int to) {
    for (const int fault : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTERM, SIGINT})
        signal(fault, SIG_DFL);
    const rlimit none{0, 0};
    setrlimit(RLIMIT_CORE, &none);
    if (const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC); nowhere >= 0) {
        dup2(nowhere, STDOUT_FILENO);
        dup2(nowhere, STDERR_FILENO);
    }
    try {
        writeAll(to, ask() + kEnd);
    } catch (const std::exception&) {
        _exit(1);
    }
    _exit(0);
}

// All up to kEnd; none when it is not to come any more. Waits no longer than that.
std::optional<std::string> readUntil(int from, Clock::time_point deadline) {
    std::string text;
    while (Clock::now() < deadline) {
        pollfd one{from, POLLIN, 0};
        const auto left =
            std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
        if (poll(&one, 1, static_cast<int>(std::max<std::int64_t>(left, 0))) <= 0) continue;
        std::array<char, 4096> buffer;
        const ssize_t n = read(from, buffer.data(), buffer.size());
        if (n == 0) return std::nullopt;
        if (n > 0) text.append(buffer.data(), static_cast<std::size_t>(n));
        if (!text.empty() && text.back() == kEnd) return text.substr(0, text.size() - 1);
    }
    return std::nullopt;
}

}  // namespace

std::variant<std::string, NoAnswer> forkedAnswer(const std::function<std::string()>& ask,
                                                 std::chrono::milliseconds limit) {
    const Clock::time_point deadline = Clock::now() + limit;
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe is left");
    const pid_t copy = fork();
    if (copy == 0) runCopy(ask, ends[1]);
    close(ends[1]);
    std::optional<std::string> answer;
    if (copy > 0) answer = readUntil(ends[0], deadline);
    close(ends[0]);
    if (copy < 0) throw std::runtime_error("no process is left to ask a headset's runtime in");
    const bool late = !answer && Clock::now() >= deadline;
    // What it would do beyond its answer, nobody needs.
    kill(copy, SIGKILL);
    while (waitpid(copy, nullptr, 0) < 0 && errno == EINTR) {
    }
    if (answer) return *std::move(answer);
    return late ? NoAnswer::TookTooLong : NoAnswer::Crashed;
}

}  // namespace xr
