// The pages below the instrument, and the fields of numbers.
#include <set>

#include "tests/ui/demo_values.h"
#include "tests/ui/desk_test.h"

namespace ui {
namespace {

using app::panels::Rect;

class DeskPages : public DeskTest {
 protected:
    void SetUp() override {
        DeskTest::SetUp();
        if (IsSkipped()) return;
        desk_.emplace(screen(), folder(),
                      std::vector<std::string>{demo().string(), "--range", "600:1000"});
        desk_->waitForTitle("pool_fire_T.nc · T");
        at_ = placesOf(desk_->size());
        side_ = app::panels::sideLayout(at_.window, 1);
    }
    // The middle of a page's row, of which all have the same height.
    float row(std::size_t i) const { return side_.page.min.y + 24 + 36 * static_cast<float>(i); }
    void enter(glm::vec2 field, std::string_view text) {
        desk_->click(field);
        desk_->press("ctrl+a");
        desk_->type(text);
        desk_->press("Return");
    }
    app::Explorer now() { return saved(*desk_, folder() / fmt::format("{}.json", ++saves_)); }
    Shot picture() {
        desk_->moveAway();
        return desk_->settled(at_.clear);
    }

    std::optional<Driver> desk_;
    Places at_;
    app::panels::SideLayout side_;
    int saves_ = 0;
};

TEST_F(DeskPages, AFieldOfANumberSaysWhatItExpected) {
    const glm::vec2 speed(at_.timeBar.speed.min.x + 20, at_.timeBar.speed.centre().y);
    const Shot quiet = desk_->settled(at_.messages);
    enter(speed, "25");
    EXPECT_EQ(differing(desk_->settled(at_.messages), quiet), 0u);
    enter(speed, "abc");
    desk_->waitFor("it is told",
                   [&] { return differing(desk_->shot(at_.messages), quiet) > 1000; });
    EXPECT_EQ(now().play.time.stepsPerSecond, 25);
}

TEST_F(DeskPages, PlayKeepsToItsInAndOutPointsAndStride) {
    desk_->press("Home");
    for (int i = 0; i < 3; ++i) desk_->press("period");
    desk_->press("i");
    for (int i = 0; i < 5; ++i) desk_->press("period");
    desk_->press("o");
    enter({side_.page.max.x - app::panels::kMargin - 28, row(2)}, "2");
    const timeseries::CursorSettings set = now().play.time;
    ASSERT_EQ(set.first, 3u);
    ASSERT_EQ(set.last, 8u);
    ASSERT_EQ(set.stride, 2u);
    ASSERT_EQ(set.ending, timeseries::Ending::Loop);
    const std::filesystem::path file = demo();
    const auto reader = timeseries::openReader(std::span(&file, 1));
    const auto& times = reader->variables()[0].time->points;
    // Steps 3, 5 and 7, and no other.
    const std::vector<double> wanted = {times[3].value, times[5].value, times[7].value};
    std::vector<double> seen;
    const auto look = [&] {
        const double time = std::stod(parse(desk_->title()).time);
        if (seen.empty() || seen.back() != time) seen.push_back(time);
    };
    desk_->press("space");
    desk_->waitFor("the in point", [&] {
        return std::abs(std::stod(parse(desk_->title()).time) - wanted[0]) < 1e-3;
    });
    desk_->waitFor("it has gone round twice", [&] {
        look();
        return seen.size() > 2 * wanted.size();
    });
    desk_->press("space");
    std::set<std::size_t> shown;
    for (const double time : seen) {
        const auto which =
            std::ranges::find_if(wanted, [&](double each) { return std::abs(each - time) < 1e-3; });
        ASSERT_NE(which, wanted.end()) << time;
        shown.insert(static_cast<std::size_t>(which - wanted.begin()));
    }
    EXPECT_EQ(shown.size(), wanted.size());
}

TEST_F(DeskPages, PlayStopsAtTheOutPointWhereLSaysOnce) {
    using timeseries::Ending;
    std::set<Ending> endings{now().play.time.ending};
    while (now().play.time.ending != Ending::Once) {
        desk_->press("l");
        ASSERT_TRUE(endings.insert(now().play.time.ending).second);
    }
    desk_->press("End");
    for (int i = 0; i < 3; ++i) desk_->press("comma");
    desk_->settled();
    const std::string out = parse(desk_->title()).time;
    desk_->press("o");
    for (int i = 0; i < 4; ++i) desk_->press("comma");
    desk_->waitFor("it is before", [&] { return parse(desk_->title()).time != out; });
    desk_->press("space");
    desk_->waitFor("the out point", [&] { return parse(desk_->title()).time == out; });
    const Shot still = picture();
    EXPECT_EQ(parse(desk_->title()).time, out);
    EXPECT_EQ(differing(picture(), still), 0u);
}

}  // namespace
}  // namespace ui
