// The pages below the histogram, and the fields of numbers.
#include <set>

#include "tests/ui/demo_values.h"
#include "tests/ui/desk_test.h"

namespace ui {
namespace {

using app::panels::Rect;

class DeskPages : public DeskWithFire {};

TEST_F(DeskPages, AFieldOfANumberSaysWhatItExpected) {
    const glm::vec2 speed(at_.timeBar.speed.min.x + 20, at_.timeBar.speed.centre().y);
    enter(speed, "25");
    // The field is at the bottom of the window: the sentence stands above it.
    const Rect above{{speed.x - 200, speed.y - 80}, {speed.x, speed.y - 16}};
    const Shot quiet = desk_->settled(above);
    enter(speed, "abc");
    desk_->waitFor("it is told", [&] { return differing(desk_->shot(above), quiet) > 1000; });
    EXPECT_EQ(now().play.time.stepsPerSecond, 25);
    // Until another number is entered.
    enter(speed, "30");
    desk_->waitFor("it goes", [&] { return differing(desk_->shot(above), quiet) == 0; });
    EXPECT_EQ(now().play.time.stepsPerSecond, 30);
}

TEST_F(DeskPages, PlayKeepsToItsInAndOutPointsAndStride) {
    desk_->press("Home");
    for (int i = 0; i < 3; ++i) desk_->press("period");
    desk_->press("i");
    for (int i = 0; i < 5; ++i) desk_->press("period");
    desk_->press("o");
    const Rect steps = pageRow(side_, 2);
    enter({steps.max.x - 28, steps.centre().y}, "2");
    const timeseries::CursorSettings set = now().play.time;
    ASSERT_EQ(set.first, 3u);
    ASSERT_EQ(set.last, 8u);
    ASSERT_EQ(set.stride, 2u);
    ASSERT_EQ(set.ending, timeseries::Ending::Loop);
    const std::vector<double> times = demoTimes();
    // Steps 3, 5 and 7, and no other.
    const std::vector<double> wanted = {times[3], times[5], times[7]};
    std::vector<double> seen;
    const auto look = [&] {
        const double time = seconds();
        if (seen.empty() || seen.back() != time) seen.push_back(time);
    };
    desk_->press("space");
    desk_->waitFor("the in point", [&] { return std::abs(seconds() - wanted[0]) < 1e-3; });
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
