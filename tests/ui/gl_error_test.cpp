#include "app/choices/autosave.h"
#include "tests/ui/desk_test.h"
#include "tests/ui/stand_in.h"

namespace ui {
namespace {

class DeskMeetsAGlError : public DeskTest {};

#ifdef NDEBUG
TEST_F(DeskMeetsAGlError, AndTellsItAndGoesOn) {
    StandIn standIn(folder());
    Driver desk(screen(), folder(), {demo().string()}, standIn.environment());
    desk.waitForTitle("pool_fire_T.nc · T");
    const Places at = placesOf(desk.size());
    desk.drag({400, 300}, {520, 340});
    desk.moveAway();
    const Shot before = desk.settled();
    standIn.glError(true);
    desk.move(tabPlace(app::panels::sideLayout(at.window, 1), Tab::View));  // it lights up: a frame
    desk.sync();
    standIn.glError(false);
    desk.moveAway();
    const Shot after = desk.settled();
    EXPECT_GT(differing(part(after, at.messages), part(before, at.messages)), 500u)
        << "a message is shown";
    EXPECT_EQ(differing(part(after, at.clear), part(before, at.clear)), 0u);
    const std::string title = desk.title();
    desk.press("End");
    desk.waitFor("it goes on", [&] { return desk.title() != title; });
}
#else
TEST_F(DeskMeetsAGlError, AndEndsWithTheDriversWordsAndLosesNothing) {
    StandIn standIn(folder());
    Driver desk(screen(), folder(), {demo().string()}, standIn.environment());
    desk.waitForTitle("pool_fire_T.nc · T");
    desk.drag({400, 300}, {520, 340});
    desk.settled();
    const app::Explorer before = saved(desk, folder() / "before.json");
    standIn.glError(true);
    EXPECT_EQ(desk.process().exitCode(), 1);
    EXPECT_THAT(desk.process().errors(),
                testing::MatchesRegex("isochron: GL: [^\n]*GL_INVALID_ENUM[^\n]*\n"));
    // The next start offers what was there, up to the last moment.
    const auto left = app::leftSessions(folder() / ".local/state/isochron");
    ASSERT_EQ(left.size(), 1u);
    EXPECT_EQ(left[0].explorer, before);
}
#endif

}  // namespace
}  // namespace ui
