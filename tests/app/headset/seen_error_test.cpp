// The error that is told at the hand.
#include "app/headset/seen_error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "app/choices/camera.h"
#include "app/picture/error_text.h"
#include "tests/support/scenes.h"
#include "tests/support/sorted.h"

namespace app::headset {
namespace seen_error {
namespace {

using namespace std::chrono_literals;
using Clock = SeenError::Clock;

struct Seen {
    Screen screen;
    render::View view;
};
Seen ramps(const char* range, Model model) {
    const auto grid = tests::cube(12);
    const auto step =
        std::make_shared<const timeseries::SortedStep>(tests::stepOf(grid, [&](std::size_t i) {
            return double(grid->indices(i).x) + 0.4 * double(grid->indices(i).y);
        }));
    Explorer e;
    e.model = model;
    e.size = {120, 90};
    e.layers = {{.ranges = timeseries::RangeSet::parse(range),
                 .color = glm::dvec3(1, 0.5, 0),
                 .opacity = 0.4}};
    const render::PlacedPoints placed(*grid);
    return {{step, nullptr, e, {}, 0}, eyes(e.view, {}, placed.outline(), e.size).front()};
}

std::string toldOf(SeenError& error, const Seen& seen, const Rung& drawn, Clock::time_point from) {
    const auto end = Clock::now() + 60s;
    while (!error.errors() && Clock::now() < end) {
        error.update(seen.screen, seen.view, from + SeenError::kStands);
        std::this_thread::yield();
    }
    return error.text(drawn);
}

TEST(SeenError, IsThatOfWhatIsDrawnOfASelectionThatStands) {
    const Seen seen = ramps("3:5", Model::Points);
    SeenError error;
    const Clock::time_point now = Clock::now();
    error.update(seen.screen, seen.view, now);
    const Explorer& e = seen.screen.explorer;
    const timeseries::SortedStep& step = *seen.screen.sorted;
    const DepthErrors wanted = depthErrorsOf(e, step, seen.view, rungsOf(e, step));
    for (const std::uint32_t stride : {1u, 4u}) {
        const Rung drawn{Model::Points, stride};
        EXPECT_EQ(toldOf(error, seen, drawn, now), depthErrorText(*wanted.of(drawn))) << stride;
    }
}

TEST(SeenError, WaitsUntilTheSelectionStandsAndItsCellsAreThere) {
    const Seen seen = ramps("3:5", Model::Cells);
    SeenError error;
    const Clock::time_point now = Clock::now();
    for (const auto after : {0ms, 999ms}) {
        error.update(seen.screen, seen.view, now + after);
        std::this_thread::sleep_for(20ms);
    }
    EXPECT_FALSE(error.errors());
    for (int i = 0; i < 20; ++i) {
        error.update(seen.screen, seen.view, now + SeenError::kStands);
        std::this_thread::sleep_for(1ms);
    }
    EXPECT_FALSE(error.errors()) << "no cells are made for it";
    EXPECT_EQ(error.text({Model::Cells}), "error not known yet");
    seen.screen.sorted->cells();
    EXPECT_THAT(toldOf(error, seen, {Model::Cells}, now), testing::StartsWith("error about"));
}

// What it comes from is asked for anew, and what was known is told meanwhile.
TEST(SeenError, HasItsPartsWhereTheyAreLookedAt) {
    const Seen seen = ramps("3:5", Model::Points);
    SeenError error;
    const Clock::time_point now = Clock::now();
    error.update(seen.screen, seen.view, now);
    const Rung drawn{Model::Points};
    const std::string told = toldOf(error, seen, drawn, now);
    const auto parts = [&] { return error.errors()->find(drawn)->parts; };
    EXPECT_FALSE(parts());
    const auto end = now + 60s;
    while (!parts() && Clock::now() < end) {
        error.update(seen.screen, seen.view, now + 5s, Parts::All);
        ASSERT_EQ(error.text(drawn), told);
        std::this_thread::yield();
    }
    ASSERT_TRUE(parts());
    const Explorer& e = seen.screen.explorer;
    const timeseries::SortedStep& step = *seen.screen.sorted;
    const DepthErrors wanted = depthErrorsOf(e, step, seen.view, rungsOf(e, step), {Parts::All, 1});
    EXPECT_EQ(parts(), wanted.find(drawn)->parts);
    // Nobody looks any more: they stay.
    error.update(seen.screen, seen.view, now + 6s);
    EXPECT_TRUE(parts());
}

TEST(SeenError, SaysWhereNobodyKnowsIt) {
    Seen seen = ramps("3:5", Model::Points);
    timeseries::Field field = seen.screen.sorted->field();
    field.categories = true;
    seen.screen.sorted = std::make_shared<const timeseries::SortedStep>(tests::sorted(field));
    SeenError error;
    EXPECT_EQ(error.text({Model::Points}), "") << "nothing is seen yet";
    error.update(seen.screen, seen.view, Clock::now());
    EXPECT_EQ(error.text({Model::Points}), "error not known");
    EXPECT_EQ(error.errors()->whyNone, "nothing lies between categories");
}

// Neither where the head is nor how it is lit changes it; what is selected does.
TEST(SeenError, IsForgottenWithItsSelection) {
    Seen seen = ramps("3:5", Model::Points);
    SeenError error;
    const Clock::time_point now = Clock::now();
    error.update(seen.screen, seen.view, now);
    toldOf(error, seen, {Model::Points}, now);
    ASSERT_TRUE(error.errors());
    seen.screen.explorer.view.azimuthDegrees = 77;
    seen.screen.explorer.lamp = LampChoice{1, 2};
    error.update(seen.screen, seen.view, now + 5s);
    EXPECT_TRUE(error.errors());
    seen.screen.explorer.layers[0].ranges = timeseries::RangeSet::parse("3:6");
    error.update(seen.screen, seen.view, now + 5s);
    EXPECT_FALSE(error.errors());
}

}  // namespace
}  // namespace seen_error
}  // namespace app::headset
