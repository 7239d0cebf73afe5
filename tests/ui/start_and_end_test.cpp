#include <csignal>

#include "app/choices/autosave.h"
#include "tests/support/built_paths.h"
#include "tests/ui/desk_test.h"

namespace ui {
namespace {

class DeskEnds : public DeskTest {
 protected:
    bool leftSomething() const {
        const auto state = folder() / ".local/state/isochron";
        return std::filesystem::exists(state) && !std::filesystem::is_empty(state);
    }
};
class DeskStarts : public DeskTest {
 protected:
    // What it says where there is no window to be had; it ends with exit code 1.
    std::string refusal(std::map<std::string, std::optional<std::string>> environment) {
        environment.insert({{"WAYLAND_DISPLAY", std::nullopt}, {"LIBGL_ALWAYS_SOFTWARE", "1"}});
        Process process({.program = tests::program(),
                         .arguments = {demo().string()},
                         .folder = folder(),
                         .environment = environment});
        EXPECT_EQ(process.exitCode(), 1);
        return process.errors();
    }
};

TEST_F(DeskEnds, CleanlyWhenClosed) {
    Driver desk(screen(), folder(), {demo().string()});
    desk.waitForTitle("pool_fire_T.nc · T");
    desk.close();
    EXPECT_EQ(desk.process().exitCode(), 0);
    EXPECT_EQ(desk.process().errors(), "");
    EXPECT_FALSE(leftSomething());
}

TEST_F(DeskEnds, CleanlyWhenTerminated) {
    for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
        Driver desk(screen(), folder(), {demo().string()});
        desk.waitForTitle("pool_fire_T.nc · T");
        desk.process().signal(signal);
        EXPECT_EQ(desk.process().exitCode(), 0) << signal;
        EXPECT_EQ(desk.process().errors(), "") << signal;
        EXPECT_FALSE(leftSomething()) << signal;
    }
}

// What it had not written yet is kept.
TEST_F(DeskEnds, WithTheSessionWhereItsWindowOrItsConnectionIsTakenAway) {
    for (const auto take : {&Driver::destroyWindow, &Driver::killConnection}) {
        Driver desk(screen(), folder(), {demo().string()});
        desk.waitForTitle("pool_fire_T.nc · T");
        desk.press("Home");
        desk.waitForTitle("0.50 s");
        (desk.*take)();
        EXPECT_EQ(desk.process().exitCode(), 1);
        EXPECT_THAT(desk.process().errors(),
                    testing::MatchesRegex("isochron: [^\n]* is offered at the next start\n"));
        const auto left = app::leftSessions(folder() / ".local/state/isochron");
        ASSERT_EQ(left.size(), 1u);
        EXPECT_EQ(left.front().explorer.steps->first, 0u);
        std::filesystem::remove(left.front().file);
    }
}

TEST_F(DeskStarts, NowhereWithoutADisplay) {
    const auto isOneLineThatNames = [](const std::string& what) {
        return testing::AllOf(testing::StartsWith("isochron: "), testing::HasSubstr(what),
                              testing::HasSubstr("isochron render FILE"),
                              testing::ContainsRegex("^[^\n]*\n$"));
    };
    EXPECT_THAT(refusal({{"DISPLAY", std::nullopt}}), isOneLineThatNames("no display"));
    EXPECT_THAT(refusal({{"DISPLAY", ":4711"}}), isOneLineThatNames("no display"));
    EXPECT_THAT(refusal({{"DISPLAY", screen().name()}, {"MESA_GL_VERSION_OVERRIDE", "3.3"}}),
                isOneLineThatNames("OpenGL 4.5 and this display gives 3.3"));
}

TEST_F(DeskStarts, WithTheMonitorsScale) {
    // As a desktop says it: 144 dots an inch are one and a half times the usual.
    screen().setResource("Xft.dpi: 144");
    Driver desk(screen(), folder(), {demo().string()});
    desk.waitForTitle("pool_fire_T.nc · T");
    // Half as large again it would not fit the screen.
    EXPECT_LE(desk.size().x, Screen::kSize.x);
    EXPECT_LE(desk.size().y, Screen::kSize.y);
    desk.resize({1500, 950});
    const std::string title = desk.title();
    desk.settled();
    desk.click(placesOf({1500, 950}, true, 1.5f).timeBar.play.centre());
    desk.waitFor("time goes on", [&] { return desk.title() != title; });
}

}  // namespace
}  // namespace ui
