#include "app/choices/autosave.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <exception>
#include <fstream>
#include <iterator>
#include <string_view>
#include <utility>

#include "app/choices/session.h"
#include "app/choices/user_files.h"
#include "app/json_text.h"

namespace app {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "autosave-", kSuffix = ".json";

// Field 22 of /proc/PID/stat (proc(5)): clock ticks from the system's start to the process's. None
// when there is no such process.
std::optional<std::uint64_t> startOf(std::int64_t pid) {
    std::ifstream in(fmt::format("/proc/{}/stat", pid));
    std::string text{std::istreambuf_iterator<char>(in), {}};
    // The second field, the program's name in brackets, may itself hold anything.
    const std::size_t name = text.rfind(')');
    if (name == std::string::npos) return std::nullopt;
    std::size_t at = name + 1;
    for (int field = 3; field <= 22 && at != std::string::npos; ++field)
        at = text.find(' ', at + (field > 3 ? 1 : 0));
    if (at == std::string::npos) return std::nullopt;
    std::uint64_t start = 0;
    const char* const begin = text.data() + at + 1;
    const auto [end, error] = std::from_chars(begin, text.data() + text.size(), start);
    if (error != std::errc()) return std::nullopt;
    return start;
}

std::string nameOf(std::int64_t pid, std::uint64_t start) {
    return fmt::format("{}{}-{}{}", kPrefix, pid, start, kSuffix);
}

// Whether the process that a file is named after is gone; false for any other file.
bool isLeft(const std::string& name) {
    if (!name.starts_with(kPrefix) || !name.ends_with(kSuffix)) return false;
    std::int64_t pid = 0;
    const char* const begin = name.data() + kPrefix.size();
    if (std::from_chars(begin, name.data() + name.size(), pid).ec != std::errc()) return false;
    const auto start = startOf(pid);
    return !start || name != nameOf(pid, *start);
}

}  // namespace

Autosave::Autosave(fs::path folder)
    : file_(std::move(folder) / nameOf(getpid(), startOf(getpid()).value_or(0))) {}

std::optional<std::string> Autosave::save(const Explorer& explorer, Clock::time_point now) {
    const auto wait = untilSaved(explorer, now);
    if (!wait || *wait > std::chrono::nanoseconds(0)) return std::nullopt;
    saved_ = explorer;
    lastWrite_ = now;
    try {
        writeWhole(file_, jsonText(toJson(explorer, file_.parent_path()), 2) + "\n");
    } catch (const std::exception& error) {
        if (!std::exchange(failed_, true))
            return fmt::format("the session cannot be kept in case the program ends: {}",
                               error.what());
    }
    return std::nullopt;
}

std::optional<std::chrono::nanoseconds> Autosave::untilSaved(const Explorer& explorer,
                                                             Clock::time_point now) const {
    if (explorer.files.empty() || (saved_ && *saved_ == explorer)) return std::nullopt;
    if (!saved_) return std::chrono::nanoseconds(0);
    return std::max<std::chrono::nanoseconds>(kPause - (now - lastWrite_),
                                              std::chrono::nanoseconds(0));
}

void Autosave::discard() {
    std::error_code ignored;
    fs::remove(file_, ignored);
}

std::vector<LeftSession> leftSessions(const fs::path& folder) {
    std::vector<LeftSession> left;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        if (!isLeft(at->path().filename().string())) continue;
        try {
            left.push_back({at->path(), readSession(at->path()), fs::last_write_time(at->path())});
        } catch (const std::exception&) {
            // Written by another version, or just removed by another process.
        }
    }
    std::ranges::sort(left, std::greater(), &LeftSession::saved);
    return left;
}

}  // namespace app
