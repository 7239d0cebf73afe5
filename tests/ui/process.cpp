#include "tests/ui/process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <system_error>

#include "tests/ui/waiting.h"

namespace ui {
namespace {

// Made before fork(): between fork() and exec() nothing may be allocated.
std::vector<char*> pointers(std::vector<std::string>& texts) {
    std::vector<char*> out;
    for (std::string& text : texts) out.push_back(text.data());
    out.push_back(nullptr);
    return out;
}

std::vector<std::string> environmentWith(
    const std::map<std::string, std::optional<std::string>>& changes) {
    std::vector<std::string> all;
    for (char** each = environ; *each != nullptr; ++each) {
        const std::string entry = *each;
        if (!changes.contains(entry.substr(0, entry.find('=')))) all.push_back(entry);
    }
    for (const auto& [name, value] : changes)
        if (value) all.push_back(fmt::format("{}={}", name, *value));
    return all;
}

// What proc(5) tells of a process; none when there is no such process.
struct Stat {
    char state = '?';
    pid_t parent = 0;
};
std::optional<Stat> statOf(pid_t process) {
    std::ifstream in(fmt::format("/proc/{}/stat", process));
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    // The name stands in parentheses and may hold any character.
    const std::size_t name = text.rfind(')');
    Stat stat;
    if (name == std::string::npos ||
        std::sscanf(text.c_str() + name, ") %c %d", &stat.state, &stat.parent) != 2)
        return std::nullopt;
    return stat;
}

bool runs(const Stat& stat) { return stat.state != 'Z' && stat.state != 'X'; }

}  // namespace

std::vector<pid_t> childrenOf(pid_t parent) {
    std::vector<pid_t> children;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
        const pid_t process = std::atoi(entry.path().filename().c_str());
        if (process <= 0) continue;
        const auto stat = statOf(process);
        if (stat && stat->parent == parent && runs(*stat)) children.push_back(process);
    }
    return children;
}

bool isRunning(pid_t process) {
    const auto stat = statOf(process);
    return stat && runs(*stat);
}

Process::Process(const Start& start) {
    static std::atomic<int> count = 0;
    errorFile_ = start.folder / fmt::format("stderr-{}.txt", count++);
    std::vector<std::string> arguments = {start.program};
    arguments.insert(arguments.end(), start.arguments.begin(), start.arguments.end());
    std::vector<std::string> environment = environmentWith(start.environment);
    const std::vector<char*> argv = pointers(arguments), env = pointers(environment);
    const std::string errors = errorFile_.string(), folder = start.folder.string();
    child_ = fork();
    if (child_ < 0) throw std::system_error(errno, std::generic_category(), start.program);
    if (child_ > 0) return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // a test that is killed leaves nothing running
    const int out = open(errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(out, STDERR_FILENO);
    if (start.keptOpen >= 0) fcntl(start.keptOpen, F_SETFD, 0);
    if (chdir(folder.c_str()) == 0) execvpe(argv[0], argv.data(), env.data());
    _exit(127);
}

Process::~Process() {
    if (!isRunning()) return;
    signal(SIGKILL);
    waitpid(child_, nullptr, 0);
}

void Process::signal(int number) const { kill(child_, number); }

bool Process::isRunning() {
    int status = 0;
    if (exitCode_ || waitpid(child_, &status, WNOHANG) != child_) return !exitCode_;
    exitCode_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return false;
}

int Process::exitCode() {
    waitUntil("the program ends", [this] { return !isRunning(); });
    return *exitCode_;
}

std::string Process::errors() const {
    std::ifstream in(errorFile_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace ui
