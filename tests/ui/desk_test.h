// What the tests of the window share: a screen, a folder that is the user's home, and where things
// are.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "app/session.h"
#include "tests/support/files.h"
#include "tests/ui/driver.h"
#include "timeseries/reader.h"

namespace ui {

class DeskTest : public testing::Test {
 protected:
    void SetUp() override {
        if (!Screen::isInstalled())
            GTEST_SKIP() << "Xvfb is not installed, so no window can be tested (Debian: xvfb)";
        screen_.emplace(folder());
    }
    // A failed test leaves what the window showed.
    const std::filesystem::path& folder() const { return folder_; }
    const Screen& screen() const { return *screen_; }

 private:
    std::filesystem::path folder_ = tests::freshFolder();
    std::optional<Screen> screen_;
};

inline std::filesystem::path demo() { return SOURCE_DIR "/datasets/pool_fire_T.nc"; }

// As the program starts: one layer, the column's usual width.
struct Places {
    app::panels::Layout window;
    app::panels::InstrumentLayout instrument;
    app::panels::TimeBarLayout timeBar;
    // Of the picture, what lies clear of labels, messages and figures.
    app::panels::Rect clear;
};
inline Places placesOf(glm::ivec2 size, bool hasMap = true, float scale = 1) {
    Places out;
    out.window = app::panels::layoutOf(glm::vec2(size), scale);
    out.instrument = app::panels::instrumentLayout(
        app::panels::sideLayout(out.window, 1).instrument, scale, hasMap);
    out.timeBar = app::panels::timeBarLayout(out.window.timeBar, scale);
    out.clear = out.window.picture;
    out.clear.min.y += 100 * scale;
    out.clear.max.y -= 160 * scale;
    return out;
}

// What a title tells: "NAME · VARIABLE · TIME · 1,234 points".
struct Title {
    std::string file, variable, time;
    std::uint64_t points = 0;
};
inline Title parse(const std::string& title) {
    constexpr std::string_view kDot = " · ";
    std::vector<std::string> pieces;
    for (std::size_t at = 0, dot; at != std::string::npos;
         at = dot == std::string::npos ? dot : dot + kDot.size()) {
        dot = title.find(kDot, at);
        pieces.push_back(title.substr(at, dot - at));
    }
    if (pieces.size() != 4) return {};
    std::string digits = pieces[3];
    std::erase(digits, ',');
    return {pieces[0], pieces[1], pieces[2], std::stoull(digits)};
}

// Saves the session by Ctrl+S under a name in the user's folder and reads it.
inline app::Explorer saved(Driver& desk, const std::filesystem::path& file) {
    desk.press("ctrl+s");
    desk.press("ctrl+a");
    desk.type(file.filename().string());
    desk.press("Return");
    desk.waitFor("the session is saved", [&] { return std::filesystem::exists(file); });
    return app::readSession(file);
}

}  // namespace ui
