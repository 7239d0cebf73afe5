#include "app/choices/preferences.h"
#include "tests/ui/desk_test.h"
#include "tests/ui/stand_in.h"

namespace ui {
namespace {

constexpr glm::ivec2 kSize{1500, 950};

class DeskScale : public DeskTest {
 protected:
    // What of the window does not tell times: the column beside the picture, and the picture.
    struct Seen {
        Shot side, picture;
        friend bool operator==(const Seen&, const Seen&) = default;
    };
    void start(StandIn& standIn) {
        desk_.reset();
        desk_.emplace(screen(), folder(), std::vector{demo().string()}, standIn.environment());
        desk_->waitForTitle("pool_fire_T.nc · T");
        desk_->resize(kSize);
    }
    Seen seen(float scale) {
        const Places at = placesOf(kSize, true, scale);
        desk_->moveAway();
        const Shot shot = desk_->settled();
        return {part(shot, at.window.side), part(shot, at.clear)};
    }
    std::optional<Driver> desk_;
};

TEST_F(DeskScale, FollowsTheMonitorWhileItRuns) {
    StandIn standIn(folder());
    start(standIn);
    waitUntilSeen(*desk_, 31);
    const Seen small = seen(1);
    const std::string title = desk_->title();
    app::Explorer before = saved(*desk_, folder() / "before.json");
    standIn.scale(1.5);
    const Seen large = seen(1.5f);
    EXPECT_NE(large.picture.size, small.picture.size);
    EXPECT_EQ(desk_->title(), title);
    const app::Explorer after = saved(*desk_, folder() / "after.json");
    before.size = after.size;  // the column has left it less room
    EXPECT_EQ(after, before);
    // Fonts and places are those of a window that has known no other scale.
    desk_->close();
    ASSERT_EQ(desk_->process().exitCode(), 0) << desk_->process().errors();
    start(standIn);
    desk_->waitFor("the same is seen", [&] { return seen(1.5f) == large; });
    // And back.
    standIn.scale(1);
    EXPECT_EQ(seen(1), small);
}

TEST_F(DeskScale, OfTheUsersOwnIsNotTheMonitors) {
    const auto preferences = folder() / ".config/isochron/preferences.json";
    std::filesystem::create_directories(preferences.parent_path());
    app::Preferences own;
    own.uiScale = 1.25;
    app::writePreferences(own, preferences);
    StandIn standIn(folder());
    start(standIn);
    waitUntilSeen(*desk_, 31, 1.25f);
    const Seen before = seen(1.25f);
    standIn.scale(2);
    desk_->sync();
    EXPECT_EQ(seen(1.25f), before);
}

}  // namespace
}  // namespace ui
