// "picture 3 of 31" on the terminal's last line; nothing where stderr is not a terminal. The line
// is wiped when it goes out of scope, also before an error's sentence.
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <string>
#include <utility>

namespace app {

class Progress {
 public:
    Progress(std::string what, std::size_t count)
        : what_(std::move(what)), count_(count), shown_(count > 1 && isatty(STDERR_FILENO)) {}
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress() {
        if (shown_) std::fputs("\r\033[K", stderr);
    }
    // The i-th, from 0, has begun.
    void at(std::size_t i) const {
        if (shown_) std::fputs(fmt::format("\r{} {} of {} ", what_, i + 1, count_).c_str(), stderr);
    }

 private:
    std::string what_;
    std::size_t count_;
    bool shown_;
};

}  // namespace app
