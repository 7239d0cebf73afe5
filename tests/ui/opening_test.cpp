#include <csignal>
#include <set>

#include "tests/ui/desk_test.h"
#include "tests/ui/slow_file.h"

namespace ui {
namespace {

class DeskOpens : public DeskTest {};

// How many colours there are: a picture has many, ground has one.
std::size_t colors(const Shot& shot) {
    return std::set<Shot::Pixel>(shot.pixels.begin(), shot.pixels.end()).size();
}

// A file of one step: a ramp of 8^3 bytes.
std::filesystem::path writeRamp(const std::filesystem::path& file) {
    tests::writeBytes(file, tests::nrrd("type: uint8\ndimension: 3\nsizes: 8 8 8\nencoding: raw\n",
                                        tests::bytesOf(tests::ramp<std::uint8_t>(512))));
    return file;
}

TEST_F(DeskOpens, AFileNamedAsAnArgument) {
    Driver desk(screen(), folder(), {demo().string()});
    desk.waitForTitle("pool_fire_T.nc · T · ");
    const Shot shown = desk.settled();
    EXPECT_GT(colors(part(shown, placesOf(shown.size).clear)), 1000u);
}

TEST_F(DeskOpens, AFileThatIsDropped) {
    Driver desk(screen(), folder(), {demo().string()});
    desk.waitForTitle("pool_fire_T.nc · T");
    desk.drop({writeRamp(folder() / "a ramp.nrrd")}, {500, 400});
    desk.waitForTitle("a ramp.nrrd · ");
    desk.press("ctrl+z");
    desk.waitForTitle("pool_fire_T.nc · T");
}

TEST_F(DeskOpens, NothingOfADamagedFileButAMessage) {
    Driver desk(screen(), folder(), {demo().string()});
    desk.waitForTitle("pool_fire_T.nc · T");
    const std::string title = desk.title();
    const Places at = placesOf(desk.size());
    waitUntilSeen(desk, 31);
    const Shot before = desk.settled();
    const auto broken = folder() / "broken.nc";
    std::string bytes = tests::readBytes(demo());
    tests::writeBytes(broken, bytes.substr(0, bytes.size() / 2));
    desk.drop({broken}, {30, 500});
    desk.waitFor("a message appears", [&] {
        return differing(part(desk.shot(), at.messages), part(before, at.messages)) > 1000;
    });
    const Shot after = desk.settled();
    EXPECT_EQ(desk.title(), title);
    EXPECT_EQ(differing(part(after, at.besideMessages), part(before, at.besideMessages)), 0u);
    EXPECT_EQ(differing(part(after, at.window.side), part(before, at.window.side)), 0u);
    desk.press("Escape");
    EXPECT_EQ(differing(desk.settled(at.messages), part(before, at.messages)), 0u);
}

TEST_F(DeskOpens, NothingOfALongMessageButItsBegin) {
    // The file's name is part of the sentence.
    std::string name = "broken";
    for (int i = 0; i < 40; ++i) name += " file";
    const auto broken = folder() / (name + ".nc");
    tests::writeBytes(broken, "CDF");
    Driver desk(screen(), folder(), {demo().string()});
    desk.waitForTitle("pool_fire_T.nc · T");
    const Places at = placesOf(desk.size());
    waitUntilSeen(desk, 31);
    desk.moveAway();
    const Shot before = desk.settled();
    desk.drop({broken}, {30, 500});
    desk.waitFor("a message appears", [&] {
        return differing(part(desk.shot(), at.messages), part(before, at.messages)) > 1000;
    });
    const Shot after = desk.settled();
    // Four lines and two buttons: half of the picture's height stays as it was.
    const app::panels::Rect& picture = at.window.picture;
    const app::panels::Rect upper{picture.min, {picture.max.x, picture.centre().y}};
    EXPECT_EQ(differing(part(after, upper), part(before, upper)), 0u);
    EXPECT_EQ(differing(part(after, at.besideMessages), part(before, at.besideMessages)), 0u);
    // Its buttons, with the keyboard: opened, then copied whole.
    for (const char* key : {"Tab", "Return", "Tab", "Return"}) desk.press(key);
    EXPECT_GT(differing(desk.settled(), after), 1000u);
    EXPECT_THAT(desk.clipboard(), testing::HasSubstr(name));
}

TEST_F(DeskOpens, ASlowFileWhileFramesGoOn) {
    const auto slow = writeSlowFile(folder() / "slow.nrrd");
    Driver desk(screen(), folder(), {demo().string()});
    desk.waitForTitle("pool_fire_T.nc · T");
    const Places at = placesOf(desk.size());
    desk.settled();
    desk.drop({slow}, {500, 400});
    desk.waitForTitle("opening slow.nrrd");
    desk.move({300, 400});
    desk.down();
    Shot last = desk.shot(at.clear);
    for (int i = 1; i <= 5; ++i) {
        desk.move({300 + 40 * i, 400});
        const Shot now = desk.shot(at.clear);
        EXPECT_GT(differing(now, last), 1000u) << i;
        last = now;
    }
    desk.up();
    EXPECT_THAT(desk.title(), testing::HasSubstr("pool_fire_T.nc"));
    EXPECT_THAT(desk.title(), testing::HasSubstr("opening slow.nrrd"));
    // A read that goes on keeps no window open.
    desk.close();
    EXPECT_EQ(desk.process().exitCode(), 0) << desk.process().errors();
}

TEST_F(DeskOpens, ASavedSessionAsTheSamePixels) {
    const auto file = folder() / "fire.json";
    Shot first;
    Places at;
    {
        Driver desk(screen(), folder(), {demo().string()});
        desk.waitForTitle("pool_fire_T.nc · T");
        at = placesOf(desk.size());
        desk.drag({400, 300}, {520, 340});
        desk.moveAway();
        desk.press("Home");
        desk.waitForTitle("0.5 s");
        first = desk.settled(at.clear);
        saved(desk, file);
    }
    Driver desk(screen(), folder(), {"--session", file.string()});
    desk.waitForTitle("0.5 s");
    EXPECT_EQ(differing(desk.settled(at.clear), first), 0u);
}

TEST_F(DeskOpens, WhatWasLeftByAProcessThatWasKilled) {
    const auto state = folder() / ".local/state/isochron";
    std::string title;
    {
        Driver desk(screen(), folder(), {demo().string(), "--range", "700:900"});
        desk.waitForTitle("pool_fire_T.nc · T");
        title = desk.title();
        desk.waitFor("the session is kept", [&] {
            return std::filesystem::exists(state) && !std::filesystem::is_empty(state);
        });
        desk.process().signal(SIGKILL);
        EXPECT_EQ(desk.process().exitCode(), 128 + SIGKILL);
    }
    Driver desk(screen(), folder(), {});
    desk.settled();
    desk.click(startOffer(desk.size(), 1, 1));
    desk.waitFor("the session goes on", [&] { return desk.title() == title; });
}

}  // namespace
}  // namespace ui
