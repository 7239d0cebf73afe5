#include <set>

#include "tests/support/built_paths.h"
#include "tests/ui/desk_test.h"

namespace ui {
namespace {

// Runs a command line as it stands, as a shell in `folder` does.
int shell(const std::filesystem::path& folder, const std::string& line) {
    return std::system(fmt::format("cd '{}' && export LIBGL_ALWAYS_SOFTWARE=1 && {} >/dev/null",
                                   folder.string(), line)
                           .c_str());
}

class DeskTakesAway : public DeskTest {
 protected:
    // The screenshot, which is also what the copied command line makes.
    Shot checkedScreenshot(Driver& desk) {
        desk.press("F12");
        const auto file = folder() / "pool_fire_T_screenshot_0000.png";
        desk.waitFor("the screenshot is written", [&] { return std::filesystem::exists(file); });
        desk.press("ctrl+c");
        EXPECT_EQ(shell(folder(), desk.clipboard()), 0) << desk.clipboard();
        EXPECT_EQ(differing(readShot(folder() / "picture.png"), readShot(file)), 0u);
        return readShot(file);
    }
    // The command line of the picture shown, with another option or value in place of one.
    std::string commandLine(Driver& desk, std::string_view from, std::string_view to) {
        desk.press("ctrl+c");
        std::string line = desk.clipboard();
        const std::size_t at = line.find(from);
        if (at == std::string::npos)
            throw std::runtime_error("no " + std::string(from) + ": " + line);
        return line.replace(at, from.size(), to);
    }
    // Asks for the export of the animation under a name in the user's folder.
    void startExport(Driver& desk, std::string_view name) {
        desk.press("ctrl+e");
        desk.press("ctrl+a");
        desk.type(name);
        desk.press("Return");
    }
    std::set<std::string> namesThatBegin(std::string_view with) const {
        std::set<std::string> names;
        for (const auto& each : std::filesystem::directory_iterator(folder()))
            if (const std::string name = each.path().filename(); name.starts_with(with))
                names.insert(name);
        return names;
    }
};

TEST_F(DeskTakesAway, TheScreenshotThatTheCopiedCommandLineMakes) {
    Driver desk(screen(), folder(), {demo().string(), "--range", "350:500", "--range", "700:max"});
    desk.waitForTitle("pool_fire_T.nc · T");
    desk.drag({500, 400}, {640, 380});
    desk.moveAway();
    desk.press("End");
    desk.waitForTitle("2.00 s");
    const Places at = placesOf(desk.size());
    const Shot seen = desk.settled(at.clear);
    const Shot written = part(checkedScreenshot(desk), at.clear);
    // The screen's bytes may be one off where the light lies at the border of two
    // (render/frame/present.h).
    EXPECT_LE(greatestDifference(written, seen), 1);
    EXPECT_LE(differing(written, seen), seen.pixels.size() / 100);
}

TEST_F(DeskTakesAway, SessionsUnderTheNamesTyped) {
    Driver desk(screen(), folder(), {demo().string()});
    desk.waitForTitle("pool_fire_T.nc · T");
    for (const char* name : {"first", "second"}) {
        desk.press("ctrl+s");
        desk.type(name);  // in place of the name proposed
        desk.press("Return");
        const auto file = folder() / (name + std::string(".json"));
        desk.waitFor("the session is saved", [&] { return std::filesystem::exists(file); });
        EXPECT_EQ(app::readSession(file).variable, "T");
    }
}

// By a stride, between the in and out points.
TEST_F(DeskTakesAway, TheStepsThatPlayAsPictures) {
    Driver desk(screen(), folder(), {demo().string(), "--range", "600:1200", "--step", "2:17:6"});
    desk.waitForTitle("pool_fire_T.nc · T");
    desk.resize({900, 600});
    const Places at = placesOf({900, 600});
    const Shot quiet = desk.settled(at.messages);
    startExport(desk, "movie.png");
    const std::set<std::string> names = {"movie_02.png", "movie_08.png", "movie_14.png"};
    desk.waitFor("all is exported", [&] { return namesThatBegin("movie") == names; });
    desk.waitFor("it is told", [&] { return differing(desk.shot(at.messages), quiet) > 1000; });
    const std::string line = commandLine(desk, "--step=2 ", "--step=2:17:6 ");
    ASSERT_EQ(shell(folder(), line), 0) << line;
    for (const char* number : {"02", "08", "14"})
        EXPECT_EQ(differing(readShot(folder() / fmt::format("movie_{}.png", number)),
                            readShot(folder() / fmt::format("picture_{}.png", number))),
                  0u)
            << number;
}

// One cycle of the sweep, over which the steps pass once.
TEST_F(DeskTakesAway, TheSweepAndTheStepsThatPlayAsPictures) {
    const std::vector<std::string> choices = {
        demo().string(), "--sweep=400:1400", "--delta=100",     "--timer-steps=5",
        "--step=2:14:6", "--opacity=0.2",    "--color=#88aaff", "--range=1500:max",
        "--opacity=0.1", "--color=#ffaa44"};
    Driver desk(screen(), folder(), choices);
    desk.waitForTitle("pool_fire_T.nc · T");
    desk.resize({900, 600});
    desk.settled();
    startExport(desk, "movie.png");
    const std::set<std::string> names = {"movie_0.png", "movie_1.png", "movie_2.png", "movie_3.png",
                                         "movie_4.png"};
    desk.waitFor("all is exported", [&] { return namesThatBegin("movie") == names; });
    const glm::ivec2 size = readShot(folder() / "movie_0.png").size;
    std::string line = tests::program().string() + " render -o swept.png";
    for (const std::string& choice : choices) line += " '" + choice + "'";
    line += fmt::format(" --size {}x{}", size.x, size.y);
    ASSERT_EQ(shell(folder(), line), 0) << line;
    for (int i = 0; i < 5; ++i)
        EXPECT_EQ(differing(readShot(folder() / fmt::format("movie_{}.png", i)),
                            readShot(folder() / fmt::format("swept_{}.png", i))),
                  0u)
            << i;
}

// The picture shown, and not the sweep's whole cycle.
TEST_F(DeskTakesAway, TheCommandLineOfASweptPicture) {
    Driver desk(screen(), folder(), {demo().string(), "--sweep=400:1400", "--delta=100"});
    desk.waitForTitle("pool_fire_T.nc · T");
    desk.resize({900, 600});
    desk.press("space");
    const std::string title = desk.title();
    desk.waitFor("the window of values moves", [&] { return desk.title() != title; });
    desk.press("space");
    desk.settled();
    checkedScreenshot(desk);
}

}  // namespace
}  // namespace ui
