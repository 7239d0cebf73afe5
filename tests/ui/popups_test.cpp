// What opens before the window, operated with the mouse. tests/app/panels/every_control_test.cpp
// goes through all of it without a window.
#include "tests/ui/desk_test.h"

namespace ui {
namespace {

using app::panels::Rect;

class DeskPopups : public DeskWithFire {
 protected:
    // In the middle of the window; 640 x 520 where there is room.
    Rect files() const {
        const glm::vec2 middle = at_.window.window.centre(), half(320, 260);
        return {middle - half, middle + half};
    }
};

TEST_F(DeskPopups, TheVariablesOpenAndClose) {
    const Rect below{side_.layers.min, side_.layers.max};
    desk_->moveAway();
    const Shot before = desk_->settled(below);
    desk_->click(side_.header.min + glm::vec2(100, 63));
    desk_->waitFor("they are there", [&] { return differing(desk_->shot(below), before) > 1000; });
    desk_->press("Escape");
    desk_->moveAway();
    desk_->waitFor("they are gone", [&] { return differing(desk_->shot(below), before) == 0; });
}

// Where it stands depends on the figures before it: whatever else is pressed there does nothing.
TEST_F(DeskPopups, TheErrorOpensWhereItComesFrom) {
    const Rect &picture = at_.window.picture, &status = at_.window.status;
    const Rect above{{picture.min.x, picture.max.y - 160}, picture.max};
    desk_->moveAway();
    const Shot before = desk_->settled(above);
    const auto changed = [&] { return differing(desk_->shot(above), before); };
    desk_->waitFor("the error is told, and opens", [&] {
        for (float x = status.min.x + 40; x < status.max.x; x += 40) {
            desk_->click({x, status.min.y + 13});
            desk_->moveAway();
            if (changed() > 3000) return true;
        }
        return false;
    });
    const Shot open = desk_->settled(above);
    desk_->press("Escape");
    desk_->waitFor("it is gone", [&] { return changed() == 0; });
    EXPECT_GT(differing(open, before), 20'000u);
}

TEST_F(DeskPopups, TheFilesCloseWithTheirButtonAndSaveWithTheOther) {
    const Rect at = files();
    const float y = at.max.y - 31, right = at.max.x - 20;
    desk_->moveAway();
    const Shot before = desk_->settled(at_.clear);
    desk_->press("ctrl+s");
    desk_->waitFor("it is there", [&] { return differing(desk_->shot(at_.clear), before) > 1000; });
    desk_->click({right - 158, y});
    desk_->moveAway();
    desk_->waitFor("it is gone", [&] { return differing(desk_->shot(at_.clear), before) == 0; });
    desk_->press("ctrl+s");
    desk_->press("ctrl+a");
    desk_->type("kept.json");
    desk_->click({right - 50, y});
    desk_->waitFor("the session is saved",
                   [&] { return std::filesystem::exists(folder() / "kept.json"); });
}

}  // namespace
}  // namespace ui
