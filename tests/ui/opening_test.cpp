#include "tests/ui/desk_test.h"

namespace ui {
namespace {

class DeskOpens : public DeskTest {};

// How many colours there are: a picture has many, ground has one.
std::size_t colors(const Shot& shot) {
    std::vector<Shot::Pixel> all = shot.pixels;
    std::ranges::sort(all);
    const auto rest = std::ranges::unique(all);
    return all.size() - rest.size();
}

TEST_F(DeskOpens, AFileNamedAsAnArgument) {
    Driver desk(screen(), folder(), {demo().string()});
    desk.waitForTitle("pool_fire_T.nc · T · ");
    const Shot shown = desk.settled();
    writeShot("/tmp/uitest_first.png", shown);
    EXPECT_GT(colors(part(shown, placesOf(shown.size).clear)), 1000u);
}

}  // namespace
}  // namespace ui
