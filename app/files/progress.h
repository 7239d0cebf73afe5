// "picture 3 of 31, 40 % drawn" on the terminal's last line; of one alone only the share, nothing
// where stderr is not a terminal. The line is wiped when it goes out of scope, also before an
// error's sentence.
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
        : what_(std::move(what)), count_(count), shown_(isatty(STDERR_FILENO)) {}
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress() {
        if (shown_) std::fputs("\r\033[K", stderr);
    }
    // The i-th, from 0, has begun.
    void at(std::size_t i, const std::string& more = "") {
        now_ = count_ > 1 ? fmt::format("{} {} of {}", what_, i + 1, count_) : "";
        show(more.empty() ? "" : ", " + more);
    }
    // Of it, [0, 1].
    void drawn(double share) const {
        show(fmt::format("{}{:.0f} % drawn", now_.empty() ? "" : ", ", 100 * share));
    }

 private:
    void show(const std::string& more) const {
        if (!shown_ || now_.size() + more.size() == 0) return;
        std::fputs(fmt::format("\r\033[K{}{} ", now_, more).c_str(), stderr);
    }

    std::string what_, now_;
    std::size_t count_;
    bool shown_;
};

}  // namespace app
