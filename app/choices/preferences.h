// What a user prefers in every session: no part of any picture.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/choices/rung.h"
#include "render/frame/frame_pace.h"

namespace app {

// What a user named to open one series: a file, a folder, a pattern, or several of them. Not empty.
using Named = std::vector<std::filesystem::path>;
// For a list of such: "run_*.nc", "a.nc and 3 more".
std::string shortName(const Named& named);

// What a picture keeps while it moves: the pace of frames, and leaves out what does not fit; what
// an error allows; one way to be drawn; or all that it has at rest.
enum class Moving { Pace, Error, Fixed, All };

// What drawing was found to cost on this machine, for the next start; absent: not known.
struct DrawingCosts {
    std::optional<render::FramePace::Cost> points, cells;
    friend bool operator==(const DrawingCosts&, const DrawingCosts&) = default;
};

struct Preferences {
    static constexpr std::size_t kRecent = 10;

    std::vector<Named> recent;               // absolute, newest first, at most kRecent
    std::optional<double> uiScale;           // in 0.5 .. 4; absent: the monitor's
    double frameMilliseconds = 1000.0 / 60;  // to draw a frame in; 1 .. 1000
    Moving moving = Moving::Pace;
    double movingError = 0.03;  // of optical depth, relative; 1e-4 .. 1
    Rung movingRung = {};       // of those that ladder() has, or with all pixels
    DrawingCosts costs = {};
    friend bool operator==(const Preferences&, const Preferences&) = default;
};

// It comes first among the recent ones, once.
void remember(Preferences& preferences, Named named);

// Where they are kept: preferences.json in configFolder() (user_files.h).
std::filesystem::path preferencesFile();

struct ReadPreferences {
    Preferences preferences;
    std::string problem;  // one sentence, when the file is damaged: the preferences are the usual
};
// A file that is not there is no problem. Recent files that are not there any more are left out,
// and patterns whose folder is not; costs that cannot be are not known.
ReadPreferences readPreferences(const std::filesystem::path& file);
// Throws std::runtime_error, one sentence.
void writePreferences(const Preferences& preferences, const std::filesystem::path& file);

}  // namespace app
