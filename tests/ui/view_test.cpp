#include "tests/ui/desk_test.h"

namespace ui {
namespace {

class DeskView : public DeskTest {
 protected:
    void SetUp() override {
        DeskTest::SetUp();
        if (IsSkipped()) return;
        desk_.emplace(screen(), folder(), std::vector{demo().string()});
        desk_->waitForTitle("pool_fire_T.nc · T");
        at_ = placesOf(desk_->size());
    }
    Shot picture() { return desk_->settled(at_.clear); }

    std::optional<Driver> desk_;
    Places at_;
};

TEST_F(DeskView, TurnsMovesZoomsAndFits) {
    const Shot first = picture();
    desk_->drag({500, 400}, {620, 400});
    const Shot turned = picture();
    EXPECT_GT(differing(turned, first), 1000u);
    desk_->press("f");
    const Shot fitted = picture();
    desk_->move({400, 300});
    desk_->wheel(4);
    const Shot zoomed = picture();
    EXPECT_GT(differing(zoomed, fitted), 1000u);
    desk_->drag({500, 400}, {560, 440}, Button::Middle);
    EXPECT_GT(differing(picture(), zoomed), 1000u);
    desk_->press("f");
    EXPECT_EQ(differing(picture(), fitted), 0u);
    for (int i = 0; i < 5; ++i) desk_->press("ctrl+z");
    EXPECT_EQ(differing(picture(), first), 0u);
}

TEST_F(DeskView, ShowsItsKeysAndHidesThem) {
    const Shot before = picture();
    desk_->press("h");
    EXPECT_GT(differing(picture(), before), 10000u);
    desk_->press("Escape");
    EXPECT_EQ(differing(picture(), before), 0u);
    desk_->press("h");
    desk_->press("h");
    EXPECT_EQ(differing(picture(), before), 0u);
}

TEST_F(DeskView, FollowsTheWindowsSize) {
    const Shot before = picture();
    const glm::ivec2 size = desk_->size(), smaller{1000, 700};
    desk_->resize(smaller);
    const Shot small = desk_->settled();
    ASSERT_EQ(small.size, smaller);
    // The time bar's play button stands where the smaller window has it: a click there plays.
    const std::string title = desk_->title();
    desk_->click(placesOf(smaller).timeBar.play.centre());
    desk_->waitFor("time goes on", [&] { return desk_->title() != title; });
    desk_->press("space");
    desk_->press("ctrl+z");
    desk_->waitFor("time is back", [&] { return desk_->title() == title; });
    desk_->resize(size);
    EXPECT_EQ(differing(picture(), before), 0u);
}

TEST_F(DeskView, ComesBackFromBeingMinimised) {
    const Shot before = picture();
    desk_->minimise();
    desk_->restore();
    desk_->waitFor("the picture is back", [&] { return picture() == before; });
}

TEST_F(DeskView, PlayAdvancesTheRealTime) {
    const auto seconds = [&] { return std::stod(parse(desk_->title()).time); };
    const double begin = seconds();
    desk_->press("space");
    double last = begin;
    for (int i = 0; i < 3; ++i)
        desk_->waitFor("the time goes on", [&] {
            // It starts again at the end.
            const double now = seconds();
            return now != last && (last = now, true);
        });
    desk_->press("space");
    const Shot paused = picture();
    const std::string title = desk_->title();
    EXPECT_EQ(differing(picture(), paused), 0u);
    EXPECT_EQ(desk_->title(), title);
    desk_->press("period");
    desk_->press("comma");
    desk_->waitFor("a step there and back", [&] { return desk_->title() == title; });
    EXPECT_EQ(differing(picture(), paused), 0u);
    desk_->press("Home");
    desk_->waitFor("the first time", [&] { return seconds() == 0.5; });
    desk_->press("End");
    desk_->waitFor("the last time", [&] { return seconds() == 2; });
}

}  // namespace
}  // namespace ui
