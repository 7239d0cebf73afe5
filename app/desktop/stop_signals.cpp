#include "app/desktop/stop_signals.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <system_error>

namespace app::desktop {
namespace {

constexpr std::array kSignals = {SIGTERM, SIGINT, SIGHUP};
constexpr char kSignal = 's', kEnd = 'e';

// Where the handler writes: it is given nothing but the signal's number.
std::atomic<int> handlerWritesTo = -1;

void handle(int) {
    const int saved = errno;
    [[maybe_unused]] const auto written = write(handlerWritesTo, &kSignal, 1);
    errno = saved;
}

void setAll(void (*handler)(int)) {
    struct sigaction action {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    for (const int number : kSignals) sigaction(number, &action, nullptr);
}

}  // namespace

StopSignals::StopSignals(std::function<void()> stop) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
        throw std::system_error(errno, std::generic_category(), "a pipe for signals");
    readEnd_ = ends[0];
    writeEnd_ = ends[1];
    handlerWritesTo = writeEnd_;
    thread_ = std::thread([fd = readEnd_, stop = std::move(stop)] {
        char what = kEnd;
        while (read(fd, &what, 1) == 1 && what == kSignal) stop();
    });
    setAll(handle);
}

StopSignals::~StopSignals() {
    setAll(SIG_DFL);
    [[maybe_unused]] const auto written = write(writeEnd_, &kEnd, 1);
    thread_.join();
    close(readEnd_);
    close(writeEnd_);
}

}  // namespace app::desktop
