#include "tests/ui/desk_test.h"

namespace ui {
namespace {

class DeskTakesAway : public DeskTest {};

// Runs a command line as a shell in `folder` does, with `isochron` meaning the program under test.
int shell(const std::filesystem::path& folder, const std::string& line) {
    const std::string name = "isochron ";
    if (!line.starts_with(name)) return -1;
    return std::system(fmt::format("cd '{}' && LIBGL_ALWAYS_SOFTWARE=1 '{}' {} >/dev/null",
                                   folder.string(), PROGRAM, line.substr(name.size()))
                           .c_str());
}

TEST_F(DeskTakesAway, TheScreenshotThatTheCopiedCommandLineMakes) {
    Driver desk(screen(), folder(), {demo().string(), "--range", "350:500", "--range", "700:max"});
    desk.waitForTitle("pool_fire_T.nc · T");
    desk.drag({500, 400}, {640, 380});
    desk.moveAway();
    desk.press("End");
    desk.waitForTitle("2 s");
    const Places at = placesOf(desk.size());
    const Shot seen = desk.settled(at.clear);
    desk.press("F12");
    const auto screenshot = folder() / "pool_fire_T_0000.png";
    desk.waitFor("the screenshot is written", [&] { return std::filesystem::exists(screenshot); });
    desk.press("ctrl+c");
    ASSERT_EQ(shell(folder(), desk.clipboard()), 0) << desk.clipboard();
    EXPECT_EQ(differing(readShot(folder() / "picture.png"), readShot(screenshot)), 0u);
    // The screen's bytes may be one off where the light lies at the border of two
    // (render/present.h).
    const Shot written = part(readShot(screenshot), at.clear);
    EXPECT_LE(greatestDifference(written, seen), 1);
    EXPECT_LE(differing(written, seen), seen.pixels.size() / 100);
}

}  // namespace
}  // namespace ui
