#include <csignal>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/support/built_paths.h"
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

TEST_F(DeskOpens, ASessionWhoseDataAreGoneOnceTheyAreDropped) {
    const auto data = writeRamp(folder() / "ramp.nrrd"),
               elsewhere = folder() / "away" / "ramp.nrrd";
    app::Explorer e;
    e.files = {data};
    e.layers = {{timeseries::RangeSet::parse("100:109"), {}, {}}};
    const auto session = folder() / "s.json";
    tests::writeBytes(session, app::toJson(e, folder()).dump());
    std::filesystem::create_directory(folder() / "away");
    std::filesystem::rename(data, elsewhere);
    Driver desk(screen(), folder(), {demo().string()});
    desk.waitForTitle("pool_fire_T.nc · T");
    const Places at = placesOf(desk.size());
    waitUntilSeen(desk, 31);
    const Shot before = desk.settled();
    desk.drop({session}, {500, 400});
    desk.waitFor("it is asked for", [&] {
        return differing(part(desk.shot(), at.messages), part(before, at.messages)) > 1000;
    });
    EXPECT_THAT(desk.title(), testing::HasSubstr("pool_fire_T.nc"));
    desk.drop({elsewhere}, {500, 400});
    desk.waitForTitle("ramp.nrrd · ");
    // The ramp is 0 to 255 twice.
    EXPECT_EQ(parse(desk.title()).points, 20u);
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
        desk.waitForTitle("0.50 s");
        first = desk.settled(at.clear);
        saved(desk, file);
    }
    Driver desk(screen(), folder(), {"--session", file.string()});
    desk.waitForTitle("0.50 s");
    EXPECT_EQ(differing(desk.settled(at.clear), first), 0u);
}

TEST_F(DeskOpens, ARecentSeriesAsItWasNamed) {
    for (const char* name : {"ramp_1.nrrd", "ramp_2.nrrd", "ramp_3.nrrd"})
        writeRamp(folder() / name);
    // The demo is offered also where the program was built outside its source.
    std::filesystem::create_directory(folder() / "datasets");
    std::filesystem::create_symlink(tests::demo(), folder() / "datasets/pool_fire_T.nc");
    {
        Driver desk(screen(), folder(), {"ramp_[13].nrrd"});
        desk.waitForTitle("ramp_[13].nrrd · ");
        desk.close();
        EXPECT_EQ(desk.process().exitCode(), 0);
    }
    Driver desk(screen(), folder(), {});
    desk.settled();
    desk.click(startOffer(desk.size(), 2, 1));  // after the file panel and the demo
    desk.waitForTitle("ramp_[13].nrrd · ");
    desk.press("End");
    const app::Explorer e = saved(desk, folder() / "recent.json");
    EXPECT_EQ(e.files, std::vector{folder() / "ramp_[13].nrrd"});
    EXPECT_EQ(e.steps, (app::StepChoice{1, 1})) << "two steps, where the whole series has three";
}

class DeskGoesOn : public DeskOpens {
 protected:
    // The sessions that processes have left, or keep.
    std::vector<std::filesystem::path> kept() const {
        std::vector<std::filesystem::path> files;
        const auto state = folder() / ".local/state/isochron";
        if (std::filesystem::exists(state))
            for (const auto& entry : std::filesystem::directory_iterator(state))
                if (entry.path().extension() == ".json") files.push_back(entry.path());
        return files;
    }
    // Opens a file, and is killed; returns its title.
    std::string leave(const std::filesystem::path& file) {
        Driver desk(screen(), folder(), {file.string(), "--range", "100:200"});
        desk.waitForTitle(" points");
        const std::string title = desk.title();
        desk.waitFor("the session is kept", [&] { return !kept().empty(); });
        desk.process().signal(SIGKILL);
        EXPECT_EQ(desk.process().exitCode(), 128 + SIGKILL);
        return title;
    }
};

TEST_F(DeskGoesOn, WithWhatWasLeftByAProcessThatWasKilled) {
    const std::string title = leave(writeRamp(folder() / "ramp.nrrd"));
    Driver desk(screen(), folder(), {});
    desk.settled();
    desk.click(startOffer(desk.size(), 1, 1));
    desk.waitFor("the session goes on", [&] { return desk.title() == title; });
}

TEST_F(DeskGoesOn, AlsoWhereAnotherFileWasOpened) {
    const std::string title = leave(writeRamp(folder() / "ramp.nrrd"));
    Driver desk(screen(), folder(), {demo().string()});
    desk.waitForTitle("pool_fire_T.nc · T");
    const auto offer = app::panels::recoveryOfferLayout(placesOf(desk.size()).window.picture, 1);
    const Shot offered = desk.settled(offer.whole);
    desk.click(offer.goOn.centre());
    desk.waitFor("the session goes on", [&] { return desk.title() == title; });
    EXPECT_GT(differing(desk.settled(offer.whole), offered), 1000u);
    desk.waitFor("it is not offered again", [&] { return kept().size() == 1; });
}

TEST_F(DeskGoesOn, UnlessItIsDiscarded) {
    leave(writeRamp(folder() / "ramp.nrrd"));
    Driver desk(screen(), folder(), {demo().string()});
    desk.waitForTitle("pool_fire_T.nc · T");
    const auto offer = app::panels::recoveryOfferLayout(placesOf(desk.size()).window.picture, 1);
    desk.click(offer.discard.centre());
    desk.waitFor("it is not offered again", [&] { return kept().size() == 1; });
    EXPECT_THAT(desk.title(), testing::HasSubstr("pool_fire_T.nc"));
}

TEST_F(DeskGoesOn, OnceItsDataAreThereAgain) {
    const auto file = folder() / "ramp.nrrd", away = folder() / "away.nrrd";
    const std::string title = leave(writeRamp(file));
    Driver desk(screen(), folder(), {});
    const Shot before = desk.settled();
    std::filesystem::rename(file, away);
    desk.click(startOffer(desk.size(), 1, 1));
    desk.waitFor("a message appears", [&] { return differing(desk.shot(), before) > 5000; });
    desk.settled();
    EXPECT_EQ(kept().size(), 1u);
    std::filesystem::rename(away, file);
    desk.click(startOffer(desk.size(), 1, 1));
    desk.waitFor("the session goes on", [&] { return desk.title() == title; });
}

TEST_F(DeskGoesOn, WithTheLastChangeThoughNothingHappenedAfterIt) {
    Driver desk(screen(), folder(), {writeRamp(folder() / "ramp.nrrd").string()});
    desk.waitForTitle(" points");
    desk.waitFor("the session is kept", [&] { return !kept().empty(); });
    desk.press("2");
    desk.waitFor("the change is kept", [&] {
        return !kept().empty() && app::readSession(kept()[0]).view.azimuthDegrees == 180;
    });
}

}  // namespace
}  // namespace ui
