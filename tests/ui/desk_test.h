// What the tests of the window share: a screen, a folder that is the user's home, and where things
// are.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "app/choices/session.h"
#include "tests/support/built_paths.h"
#include "tests/support/files.h"
#include "tests/ui/places.h"
#include "timeseries/readers/reader.h"

namespace ui {

class DeskTest : public testing::Test {
 protected:
    void SetUp() override {
        if (!Screen::isInstalled())
            GTEST_SKIP() << "Xvfb is not installed, so no window can be tested (Debian: xvfb)";
        screen_.emplace(folder());
    }
    const std::filesystem::path& folder() const { return folder_; }
    const Screen& screen() const { return *screen_; }

 private:
    std::filesystem::path folder_ = tests::freshFolder();
    std::optional<Screen> screen_;
};

inline std::filesystem::path demo() { return tests::demo(); }

// What a title tells: "NAME · VARIABLE · TIME · 1,234 points", and perhaps what is being opened.
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
    if (pieces.size() < 4) return {};
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

// The demo in a window: a layer of 600 to 1000 K, or what the options say.
class DeskWithFire : public DeskTest {
 protected:
    explicit DeskWithFire(std::vector<std::string> options = {"--range", "600:1000"})
        : arguments_(std::move(options)) {
        arguments_.insert(arguments_.begin(), demo().string());
    }
    void SetUp() override {
        DeskTest::SetUp();
        if (IsSkipped()) return;
        desk_.emplace(screen(), folder(), arguments_);
        desk_->waitForTitle("pool_fire_T.nc · T");
        look(1);
    }
    // Finds out where things are, with so many rows of layers.
    void look(std::size_t layerRows) {
        at_ = placesOf(desk_->size());
        side_ = app::panels::sideLayout(at_.window, layerRows);
    }

    double seconds() const { return std::stod(parse(desk_->title()).time); }
    std::uint64_t points() const { return parse(desk_->title()).points; }
    // At rest, without what stands beside a pointer.
    Shot picture() {
        desk_->moveAway();
        return desk_->settled(at_.clear);
    }
    // The session, read from a file of its own. What is told of that is put away: messages lie over
    // the picture, and go when they will.
    app::Explorer now() {
        app::Explorer e = saved(*desk_, newFile());
        desk_->press("Escape");
        return e;
    }
    std::filesystem::path newFile() { return folder() / fmt::format("{}.json", ++saves_); }
    // In place of what a field says.
    void enter(glm::vec2 field, std::string_view text) {
        desk_->click(field);
        desk_->press("ctrl+a");
        desk_->type(text);
        desk_->press("Return");
    }

    std::optional<Driver> desk_;
    Places at_;
    app::panels::SideLayout side_;

 private:
    std::vector<std::string> arguments_;
    int saves_ = 0;
};

}  // namespace ui
