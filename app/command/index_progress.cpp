#include "app/command/index_progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "app/say.h"

namespace app {

IndexProgress::IndexProgress(std::size_t steps, Shown shown, std::size_t processes)
    : steps_(steps), processes_(processes), isShown_(shown == Shown::Yes) {}

void IndexProgress::add(double share) {
    const std::lock_guard lock(mutex_);
    added_ += share;
    show();
}

void IndexProgress::finish(double added, bool isQuick) {
    const std::lock_guard lock(mutex_);
    added_ -= added;
    ++finished_;
    if (isQuick) ++quick_;
    show();
}

void IndexProgress::end() {
    const std::lock_guard lock(mutex_);
    isShown_ = false;
    line_.wipe();
}

void IndexProgress::show() {
    constexpr auto kBetweenLines = std::chrono::seconds(30);
    const auto now = Clock::now();
    if (!isShown_ || (!line_.isThere() && now < last_ + kBetweenLines)) return;
    last_ = now;
    const std::size_t finished = std::min(steps_, finished_ * processes_);
    if (finished == steps_) return;
    const std::string text =
        indexProgressText(steps_, finished, std::min(finished, quick_ * processes_),
                          added_ * static_cast<double>(processes_),
                          std::chrono::duration<double>(now - begin_).count());
    if (line_.isThere())
        line_.show(text);
    else
        sayTo(stderr, "{}\n", text);
}

std::string indexProgressText(std::size_t steps, std::size_t finished, std::size_t quick,
                              double written, double seconds) {
    const auto all = static_cast<double>(steps);
    const double there = std::min(all, static_cast<double>(finished) + written),
                 slow = there - static_cast<double>(quick);
    std::string text =
        steps > 1 ? fmt::format("step {} of {}, ", std::min(finished + 1, steps), steps) : "";
    text += fmt::format("{:.0f} %", 100 * there / all);
    if (slow > 0) text += fmt::format(", at most {:.0f} s left", seconds / slow * (all - there));
    return text;
}

}  // namespace app
