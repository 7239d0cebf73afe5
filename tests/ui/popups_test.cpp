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
