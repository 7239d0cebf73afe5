#include <glm/common.hpp>

#include "tests/ui/desk_test.h"

namespace ui {
namespace {

class DeskView : public DeskWithFire {
 protected:
    DeskView() : DeskWithFire({}) {}  // with the program's first choice
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

// Nobody keeps what was there.
TEST_F(DeskView, IsWholeAgainWhereAnotherWindowStoodBeforeIt) {
    const Shot before = picture();
    screen().cover({200, 200}, {300, 200}, [&] {
        desk_->waitFor("it stands there", [&] { return desk_->shot(at_.clear) != before; });
    });
    desk_->waitFor("all is seen again", [&] { return desk_->shot(at_.clear) == before; });
}

// Where a picture is most colourful, away from its right and lower edge: in the fire, for lines and
// text are grey.
glm::vec2 mostColorful(const Shot& shot, const app::panels::Rect& place) {
    glm::ivec2 best(place.min);
    int most = -1;
    for (int y = static_cast<int>(place.min.y); y < static_cast<int>(place.max.y) - 150; ++y)
        for (int x = static_cast<int>(place.min.x); x < static_cast<int>(place.max.x) - 350; ++x) {
            const auto [least, highest] = std::ranges::minmax(shot.at({x, y}));
            if (highest - least <= most) continue;
            most = highest - least;
            best = {x, y};
        }
    return best;
}

TEST_F(DeskView, TellsWhatThePointerRestsOn) {
    const Shot before = picture(), whole = desk_->shot();
    const app::panels::Rect& clear = at_.clear;
    const glm::vec2 found = mostColorful(whole, clear);
    desk_->move(found);
    desk_->waitFor("a card appears", [&] { return differing(desk_->shot(clear), before) > 1000; });
    const Shot with = desk_->settled();
    const auto changed = [&](const app::panels::Rect& place) {
        return differing(part(with, place), part(whole, place));
    };
    EXPECT_GT(changed({found + glm::vec2(14), found + glm::vec2(340, 130)}), 1000u);
    EXPECT_EQ(changed({clear.min, {found.x, clear.max.y}}), 0u);
    EXPECT_EQ(changed({clear.min, {clear.max.x, found.y}}), 0u);
    EXPECT_EQ(differing(picture(), before), 0u) << "gone with the pointer";
}

TEST_F(DeskView, ReadsThePointUnderTheCursorInEitherEyesPicture) {
    const app::panels::Rect& page = side_.page;
    const app::panels::Rect& picture = at_.window.picture;
    desk_->press("s");
    desk_->doubleClick(picture.min + glm::vec2(8));  // nothing is there
    const Shot nothing = desk_->settled(page);
    for (const float eye : {0.25f, 0.75f}) {
        const Shot before = this->picture();
        const glm::vec2 place = picture.min + glm::vec2(eye, 0.5f) * picture.size();
        desk_->move(place);
        desk_->waitFor("a card stands beside the pointer that rests",
                       [&] { return differing(desk_->shot(at_.clear), before) > 1000; });
        desk_->doubleClick(place);
        EXPECT_GT(differing(desk_->settled(page), nothing), 1000u) << eye;
    }
    desk_->doubleClick(picture.min + glm::vec2(8));
    EXPECT_EQ(differing(desk_->settled(page), nothing), 0u);
}

// Seen from either eye, the same place comes as much nearer.
TEST_F(DeskView, ZoomsToTheCursorInEitherEyesPicture) {
    const app::panels::Rect& picture = at_.window.picture;
    desk_->press("s");
    std::vector<Shot> zoomed;
    for (const float eye : {0.15f, 0.65f}) {
        desk_->press("f");
        desk_->move(glm::floor(picture.min + glm::vec2(eye, 0.4f) * picture.size()));
        desk_->wheel(4);
        zoomed.push_back(this->picture());
    }
    EXPECT_EQ(differing(zoomed[0], zoomed[1]), 0u);
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
