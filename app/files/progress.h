// How far long work is, on the terminal's last line; nothing where stderr is none.
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <string>
#include <utility>

namespace app {

// It is wiped when it goes out of scope, also before an error's sentence.
class TerminalLine {
 public:
    TerminalLine() = default;
    TerminalLine(const TerminalLine&) = delete;
    TerminalLine& operator=(const TerminalLine&) = delete;
    ~TerminalLine() { wipe(); }
    bool isThere() const { return isThere_; }
    void show(const std::string& text) const {
        if (isThere_) std::fputs(fmt::format("\r\033[K{} ", text).c_str(), stderr);
    }
    void wipe() const {
        if (isThere_) std::fputs("\r\033[K", stderr);
    }

 private:
    bool isThere_ = isatty(STDERR_FILENO) != 0;
};

// "picture 3 of 31, 40 % drawn"; of one alone only the share.
class Progress {
 public:
    Progress(std::string what, std::size_t count) : what_(std::move(what)), count_(count) {}
    // The i-th, from 0, has begun.
    void at(std::size_t i) {
        now_ = count_ > 1 ? fmt::format("{} {} of {}", what_, i + 1, count_) : "";
        if (!now_.empty()) line_.show(now_);
    }
    // Of it, [0, 1].
    void drawn(double share) const {
        line_.show(fmt::format("{}{}{:.0f} % drawn", now_, now_.empty() ? "" : ", ", 100 * share));
    }

 private:
    std::string what_, now_;
    std::size_t count_;
    TerminalLine line_;
};

}  // namespace app
