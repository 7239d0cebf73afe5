#include "tests/support/monado_service.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "tests/ui/waiting.h"

extern char** environ;

namespace tests {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

// True when `holds` did before the time was over.
template <typename Holds>
bool within(std::chrono::milliseconds limit, Holds holds) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (!holds()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(10ms);
    }
    return true;
}

std::array<int, 2> closedOnExec() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe is left");
    return ends;
}

// Descriptors of the child, from ours; output goes to `log`.
struct Streams {
    int input, log;
    std::optional<int> third = {};
};

pid_t spawned(const std::vector<std::string>& words,
              const std::map<std::string, std::string>& extra, const Streams& streams) {
    std::vector<std::string> variables;
    for (char** v = environ; *v != nullptr; ++v) variables.emplace_back(*v);
    for (const auto& [name, value] : extra) variables.push_back(name + "=" + value);
    const auto pointers = [](const std::vector<std::string>& texts) {
        std::vector<char*> all;
        for (const std::string& text : texts) all.push_back(const_cast<char*>(text.c_str()));
        all.push_back(nullptr);
        return all;
    };
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, streams.input, 0);
    posix_spawn_file_actions_adddup2(&actions, streams.log, 1);
    posix_spawn_file_actions_adddup2(&actions, streams.log, 2);
    if (streams.third) posix_spawn_file_actions_adddup2(&actions, *streams.third, 3);
    pid_t child = 0;
    const int error = posix_spawnp(&child, words.front().c_str(), &actions, nullptr,
                                   pointers(words).data(), pointers(variables).data());
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) throw std::runtime_error(fmt::format("cannot start {}", words.front()));
    return child;
}

int openedLog(const fs::path& path) {
    return open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
}

std::string textOf(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

// Ended, or ended by force when it takes its time.
void endProcess(pid_t child) {
    if (child == 0) return;
    ::kill(child, SIGCONT);
    ::kill(child, SIGTERM);
    if (!within(2s, [&] { return waitpid(child, nullptr, WNOHANG) == child; })) {
        ::kill(child, SIGKILL);
        waitpid(child, nullptr, 0);
    }
}

// One service starts at a time on this machine, also of tests that run beside this one. While it
// does, its shared memory has a name that is the same for all (Monado 25's ipc_shmem.c), and two
// would share one; and nobody else's port is the one that it is about to take.
class AloneInStarting {
 public:
    AloneInStarting() : file_(open("/dev/shm", O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
        while (flock(file_, LOCK_EX) != 0)
            if (errno != EINTR) throw std::runtime_error("/dev/shm cannot be locked");
    }
    ~AloneInStarting() { close(file_); }
    AloneInStarting(const AloneInStarting&) = delete;
    AloneInStarting& operator=(const AloneInStarting&) = delete;

 private:
    int file_;
};

}  // namespace

MonadoService::MonadoService(Monado mode) {
    try {
        start(mode);
    } catch (const std::exception&) {
        end();
        throw;
    }
}

MonadoService::~MonadoService() { end(); }

void MonadoService::start(Monado mode) {
    std::string name = (fs::temp_directory_path() / "isochron_monado_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make " + name);
    folder_ = name;
    fs::create_directories(folder_ / "config" / "monado");
    setenv("XDG_RUNTIME_DIR", folder_.c_str(), 1);
    setenv("XR_RUNTIME_JSON", MONADO_MANIFEST, 1);
    // As the service, whose images it shares: the same software renderer on both sides.
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    std::map<std::string, std::string> environment{
        {"XDG_CONFIG_HOME", (folder_ / "config").string()}};
    for (const auto& driver : fs::directory_iterator("/usr/share/vulkan/icd.d"))
        if (driver.path().filename().string().starts_with("lvp_icd"))
            environment["VK_DRIVER_FILES"] = driver.path().string();
    if (mode != Monado::Remote) {
        environment["SIMULATED_ENABLE"] = "1";
        environment["SIMULATED_LEFT"] = environment["SIMULATED_RIGHT"] = "simple";
    }
    if (mode == Monado::Window) {
        startDisplay();
        environment["XRT_COMPOSITOR_FORCE_XCB"] = "1";
    } else {
        environment["XRT_COMPOSITOR_NULL"] = "1";
    }
    const AloneInStarting alone;
    if (mode == Monado::Remote)
        startRemote(environment);
    else
        startService(environment);
}

void MonadoService::end() {
    endService();
    endProcess(display_);
    std::error_code left;
    fs::remove_all(folder_, left);
}

void MonadoService::startDisplay() {
    const auto [read, write] = closedOnExec();
    const int log = openedLog(folder_ / "display.log");
    const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
    // It ends with this process, however that ends; -terminate would end it with its first client,
    // and without -noreset it turns away, for a moment, who comes just after its last one went.
    display_ = spawned({"setpriv", "--pdeathsig", "TERM", "Xvfb", "-displayfd", "3", "-screen", "0",
                        "1600x1100x24", "-nolisten", "tcp", "-noreset"},
                       {}, {nothing, log, write});
    close(write), close(log), close(nothing);
    std::string number;
    for (char c = 0; ::read(read, &c, 1) == 1 && c != '\n';) number += c;
    close(read);
    if (number.empty())
        throw std::runtime_error("Xvfb does not start: " + textOf(folder_ / "display.log"));
    setenv("DISPLAY", (":" + number).c_str(), 1);
}

// On a port that was free; a service that finds it taken since goes on without it, and gets
// another.
void MonadoService::startRemote(const std::map<std::string, std::string>& environment) {
    for (int tries = 0; tries < 10; ++tries) {
        configureRemote();
        startService(environment);
        const auto says = [this](const char* what) {
            return log().find(what) != std::string::npos;
        };
        bool listens = false;
        ui::waitUntil("the remote devices listen", [&] {
            listens = says("Listening on port");
            return listens || says("Leaving thread");
        });
        if (listens) return;
        endService();
    }
    throw std::runtime_error("every port is taken that was free for Monado's remote devices");
}

void MonadoService::configureRemote() {
    const int probe = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    bind(probe, reinterpret_cast<sockaddr*>(&address), size);
    getsockname(probe, reinterpret_cast<sockaddr*>(&address), &size);
    close(probe);
    remotePort_ = ntohs(address.sin_port);
    std::ofstream(folder_ / "config" / "monado" / "config_v0.json") << fmt::format(
        R"({{"active": "remote", "remote": {{"version": 0, "port": {}, "view_count": 2}}}})",
        remotePort_);
}

void MonadoService::startService(const std::map<std::string, std::string>& environment) {
    const auto [read, write] = closedOnExec();
    for (const char* left : {"service.log", "monado_comp_ipc"})  // by one that got no port
        fs::remove(folder_ / left);
    const int log = openedLog(folder_ / "service.log");
    serviceInput_ = write;
    service_ = spawned({MONADO_SERVICE}, environment, {read, log});
    close(read), close(log);
    const bool serves = within(ui::kDeadline, [&] {
        return waitpid(service_, nullptr, WNOHANG) == service_ ||
               (MonadoService::log().find("The Monado service has started") != std::string::npos &&
                fs::exists(folder_ / "monado_comp_ipc"));
    });
    if (!serves || ::kill(service_, 0) != 0)
        throw std::runtime_error("monado-service does not start: " + MonadoService::log());
}

void MonadoService::endService() {
    endProcess(std::exchange(service_, 0));
    if (serviceInput_ >= 0) close(std::exchange(serviceInput_, -1));
}

void MonadoService::kill() {
    ::kill(service_, SIGKILL);
    waitpid(service_, nullptr, 0);
    service_ = 0;
}

void MonadoService::stop() {
    ::kill(service_, SIGSTOP);
    int status = 0;
    waitpid(service_, &status, WUNTRACED);  // until it stands still
}

std::string MonadoService::log() const { return textOf(folder_ / "service.log"); }

}  // namespace tests
