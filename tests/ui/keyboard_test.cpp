// The window without a mouse.
#include "app/panels/theme.h"
#include "tests/support/array_builder.h"
#include "tests/ui/demo_values.h"
#include "tests/ui/desk_test.h"

namespace ui {
namespace {

using app::panels::Rect;

// Whether the ring of the focus stands around a place: on its left side, in the theme's accent.
bool isRinged(Driver& desk, const Rect& at) {
    const Shot shot = desk.shot();
    const glm::ivec2 beside(static_cast<int>(at.min.x) - 2, static_cast<int>(at.centre().y));
    const ImU32 accent = app::panels::kAccent;
    const Shot::Pixel wanted = {static_cast<std::uint8_t>((accent >> IM_COL32_R_SHIFT) & 255),
                                static_cast<std::uint8_t>((accent >> IM_COL32_G_SHIFT) & 255),
                                static_cast<std::uint8_t>((accent >> IM_COL32_B_SHIFT) & 255)};
    const Shot::Pixel& seen = shot.at(beside);
    for (std::size_t i = 0; i < 3; ++i)
        if (std::abs(seen[i] - wanted[i]) > 6) return false;
    return true;
}

// Presses Tab until the place has the focus; the window has fewer controls than that.
void tabTo(Driver& desk, const Rect& at, std::string_view keys = "Tab") {
    for (int i = 0; i < 60; ++i) {
        desk.press(keys);
        if (isRinged(desk, at)) return;
    }
    FAIL() << "no ring at " << at.min.x << ", " << at.min.y;
}

class DeskKeyboard : public DeskWithFire {};

TEST_F(DeskKeyboard, ReachesAndChangesALayersOpacity) {
    const Rect opacity =
        app::panels::layerRow(side_.layers, side_.layers.min.y + app::panels::kLayersTitle, 1)
            .opacity;
    const auto before = saved(*desk_, newFile()).layers.at(0).opacity;
    tabTo(*desk_, opacity);
    desk_->press("shift+Right");
    const auto after = saved(*desk_, newFile()).layers.at(0).opacity;
    EXPECT_GT(*after, *before);
    EXPECT_TRUE(isRinged(*desk_, opacity)) << "back from the files";
    desk_->press("Left");
    EXPECT_LT(*saved(*desk_, newFile()).layers.at(0).opacity, *after);
    // The picture's keys again.
    desk_->press("Escape");
    EXPECT_FALSE(isRinged(*desk_, opacity));
    desk_->press("Home");
    desk_->waitFor("the first time", [&] { return seconds() == 0.5; });
}

TEST_F(DeskKeyboard, ReachesAndChangesTheStep) {
    desk_->press("Home");
    desk_->waitFor("the first time", [&] { return seconds() == 0.5; });
    const std::string first = desk_->title();
    tabTo(*desk_, at_.timeBar.rail, "shift+Tab");
    desk_->press("Right");
    desk_->waitFor("the next time", [&] { return desk_->title() != first; });
    desk_->press("Left");
    desk_->waitFor("the first time again", [&] { return desk_->title() == first; });
    desk_->press("End");
    desk_->waitFor("the last time", [&] { return seconds() == 2; });
}

TEST_F(DeskKeyboard, ReachesAndMovesTheEndOfARange) {
    const app::panels::ValueAxis axis = axisOf(*desk_);
    const auto hi = [&](const app::Explorer& e) {
        return timeseries::toDouble(e.layers.at(0).ranges.ranges()[0].hi.value);
    };
    const std::uint64_t before = points();
    tabTo(*desk_, app::panels::endHandle(at_.histogramPanel, 1, axis.y(1000), true));
    desk_->press("Up");
    const app::Explorer once = saved(*desk_, newFile());
    EXPECT_GT(hi(once), 1000);
    EXPECT_NEAR(hi(once), 1000 + axis.perPixel(), axis.perPixel());
    EXPECT_EQ(points(), countIn(once));
    EXPECT_GT(countIn(once), before);
    desk_->press("shift+Up");
    const app::Explorer more = saved(*desk_, newFile());
    EXPECT_NEAR(hi(more), hi(once) + 10 * axis.perPixel(), 2 * axis.perPixel());
    EXPECT_EQ(points(), countIn(more));
    EXPECT_EQ(timeseries::toDouble(more.layers.at(0).ranges.ranges()[0].lo.value), 600);
    // Each press is a step of undo.
    desk_->press("ctrl+z");
    desk_->press("ctrl+z");
    EXPECT_EQ(points(), before);
}

TEST_F(DeskKeyboard, OpensAFileFromTheMenu) {
    tests::writeBytes(folder() / "ramp.nrrd",
                      tests::nrrd("type: uint8\ndimension: 3\nsizes: 8 8 8\nencoding: raw\n",
                                  tests::bytesOf(tests::ramp<std::uint8_t>(512))));
    const Rect header = side_.header;
    const float right = header.max.x - app::panels::kMargin;
    tabTo(*desk_, {{right - 28, header.min.y + 12}, {right, header.min.y + 40}});
    desk_->press("Return");
    desk_->press("Return");  // its first line: Open
    // It begins beside what is open.
    desk_->type(std::filesystem::relative(folder() / "ramp.nrrd", demo().parent_path()).string());
    desk_->press("Return");
    desk_->waitForTitle("ramp.nrrd · ");
}

TEST_F(DeskKeyboard, LeavesThePictureItsKeysWhereTheMouseWasUsed) {
    desk_->press("Home");
    desk_->waitFor("the first time", [&] { return seconds() == 0.5; });
    const std::string first = desk_->title();
    desk_->click(at_.timeBar.ending.centre());
    desk_->press("Right");
    desk_->waitFor("the next time", [&] { return desk_->title() != first; });
    desk_->press("Left");
    desk_->waitFor("the first time", [&] { return desk_->title() == first; });
    desk_->press("space");
    desk_->waitFor("time goes on", [&] { return desk_->title() != first; });
}

}  // namespace
}  // namespace ui
