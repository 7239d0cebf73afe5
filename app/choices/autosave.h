// The session of each running process, saved beside it, so that a crash loses little.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/choices/explorer.h"

namespace app {

// A file is a session (session.h) of its own, named autosave-PID-START.json: START is when the
// process started, as the system counts it, so that a later process of the same number is not
// mistaken for it.
class Autosave {
 public:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::seconds kPause{5};  // between two writes, at least

    // `folder`: stateFolder() (user_files.h). It is made when there is something to save.
    explicit Autosave(std::filesystem::path folder);

    // From the front end's loop: writes when the explorer has changed and kPause has passed. What
    // goes wrong is told once, as one sentence: a full disk must not end the program.
    std::optional<std::string> save(const Explorer& explorer, Clock::time_point now);
    // Until save() would write this explorer; none: it is written. A front end that sleeps wakes
    // then.
    std::optional<std::chrono::nanoseconds> untilSaved(const Explorer& explorer,
                                                       Clock::time_point now) const;
    // At a clean end: nothing is left to be offered.
    void discard();

    const std::filesystem::path& file() const { return file_; }

 private:
    std::filesystem::path file_;
    std::optional<Explorer> saved_;
    Clock::time_point lastWrite_{};
    bool failed_ = false;
};

// A session whose process is gone.
struct LeftSession {
    std::filesystem::path file;  // to be removed when the user has chosen
    Explorer explorer;
    std::filesystem::file_time_type saved;
};

// Newest first. What cannot be read as a session is passed over.
std::vector<LeftSession> leftSessions(const std::filesystem::path& folder);

}  // namespace app
