// What frames cost in, what the next ones may hold out; of modelled machines.
#include "app/drawing/governor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace app {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

// 100 ns a splat, beside nothing.
nanoseconds taking(std::uint64_t splats) { return nanoseconds(100 * splats); }

// All that it may draw and a little less by turns, which tells what a splat costs; so many frames,
// 10 ms apart.
void draw(Governor& governor, unsigned frames, bool cells = false) {
    for (unsigned i = 0; i < frames; ++i) {
        const CanvasLimits limits = governor.limits(nullptr);
        const std::uint64_t most = cells ? *limits.cells : limits.splats;
        const std::uint64_t splats = most - i % 2 * (most / 4);
        governor.took({splats, cells}, taking(splats), 10ms);
    }
}

TEST(Governor, FillsItsTimeWithPointsOrCellsWhichAreLearntApart) {
    Governor governor;
    governor.setTarget(10ms);
    draw(governor, 20, true);
    EXPECT_NEAR(static_cast<double>(*governor.limits(nullptr).cells), 1e5, 1e4);
    EXPECT_EQ(governor.limits(nullptr).splats, render::FramePace::kFirst);
    governor.setTarget(5ms);
    EXPECT_NEAR(static_cast<double>(*governor.limits(nullptr).cells), 5e4, 5e3);
    EXPECT_EQ(governor.limits(nullptr).splats, render::FramePace::kFirst);
}

// Twenty frames a second leave 40 ms for drawing; a display has no time to give.
TEST(Governor, KnowsWhatFitsASlowerPaceThatStillMoves) {
    for (const auto target : {10ms, 80ms}) {
        Governor governor;
        governor.setTarget(target);
        draw(governor, 20);
        draw(governor, 20, true);
        const auto slower = governor.limits(nullptr).slower;
        ASSERT_TRUE(slower);
        const auto taking = [](nanoseconds time) {
            return static_cast<double>(time.count()) / 100;
        };
        const double fit = taking(std::max<nanoseconds>(target, 40ms));
        const double known = std::min(fit, 3 * taking(target));  // of more points nothing is known
        EXPECT_NEAR(static_cast<double>(slower->splats), known, 0.1 * known);
        EXPECT_NEAR(static_cast<double>(slower->cells), fit, 0.1 * fit);
    }
    EXPECT_FALSE(Governor(Governor::Rise::Proven).limits(nullptr).slower);
}

// Four times as much fits from now on. A hand that drags gets it in the next frames, a picture
// that never rests once twice as much has fitted for half a second; both fall at once.
TEST(Governor, RisesAtOnceOrWhereAWhileHasShownThatMoreFits) {
    for (const auto rise : {Governor::Rise::AtOnce, Governor::Rise::Proven}) {
        Governor governor(rise);
        const auto splats = [&] { return governor.limits(nullptr).splats; };
        governor.setTarget(5ms);
        draw(governor, 300);
        const std::uint64_t before = splats();
        EXPECT_GT(before, 22'500) << "half, and a tenth of hysteresis";
        EXPECT_LT(before, 55'000);
        governor.setTarget(20ms);
        draw(governor, 30);  // 0.3 s
        if (rise == Governor::Rise::AtOnce)
            EXPECT_GT(splats(), 180'000);
        else
            EXPECT_EQ(splats(), before);
        draw(governor, 300);
        EXPECT_GT(splats(), 90'000);
        EXPECT_LT(splats(), 220'000);
        governor.setTarget(5ms);
        draw(governor, 2);
        EXPECT_LT(splats(), 55'000);
    }
}

// Frames of a picture of so many cells, or of points where these do not fit; how many had cells.
unsigned withCells(Governor& governor, std::uint64_t cells, nanoseconds taking, unsigned frames) {
    unsigned with = 0;
    for (unsigned i = 0; i < frames; ++i) {
        const bool fit = cells <= *governor.limits(nullptr).cells;
        governor.took({fit ? cells : 9'000, fit}, fit ? taking : 5ms);
        with += fit;
    }
    return with;
}

// As of a shell that is swept without an end, whose first two frames made room for it. In a headset
// none is tried that was late.
TEST(Governor, CellsThatWereSlowAtFirstAreDrawnSoonInAWindow) {
    for (const auto rise : {Governor::Rise::AtOnce, Governor::Rise::Proven}) {
        Governor governor(rise);
        governor.setTarget(13ms);
        for (const auto time : {88ms, 34ms}) governor.took({380'000, true}, time);
        ASSERT_LT(*governor.limits(nullptr).cells, 150'000u);
        const unsigned with = withCells(governor, 150'000, 7ms, 100);
        EXPECT_TRUE(rise == Governor::Rise::AtOnce ? with >= 80 : with == 0) << with;
    }
}

TEST(Governor, CellsThatStaySlowAreTriedEverLessOften) {
    Governor governor;
    governor.setTarget(13ms);
    const unsigned soon = withCells(governor, 350'000, 21ms, 1000),
                   later = withCells(governor, 350'000, 21ms, 1000);
    EXPECT_GE(soon, 4u);
    EXPECT_LE(soon, 12u);
    EXPECT_LE(later, 2u);
    EXPECT_EQ(withCells(governor, 450'000, 26ms, 5000), 0u) << "more than a first frame may have";
}

TEST(Governor, BegunFromWhatAnotherLearntItsFirstFramesFit) {
    Governor taught;
    taught.setTarget(20ms);
    for (std::uint64_t splats = 30'000; splats < 200'000; splats += 30'000) {
        taught.took({splats, false}, taking(splats), 10ms);
        taught.took({splats, true}, 2 * taking(splats), 10ms);
    }
    ASSERT_TRUE(taught.costs().points && taught.costs().cells);
    for (const auto rise : {Governor::Rise::AtOnce, Governor::Rise::Proven}) {
        Governor governor(rise);
        governor.setTarget(20ms);
        governor.beginFrom(taught.costs());
        const CanvasLimits limits = governor.limits(nullptr);
        EXPECT_NEAR(static_cast<double>(limits.splats), 2e5, 2e4);
        EXPECT_NEAR(static_cast<double>(*limits.cells), 1e5, 1e4);
    }
}

// What fits, over what is drawn, decides: a finer subset of which pixels are what costs is not
// twice as dear.
TEST(Governor, RisesWhereTheNextFinerSubsetFits) {
    constexpr std::uint64_t kDrawn = 100'000;
    const auto after = [](double finer) {
        Governor governor(Governor::Rise::Proven);
        governor.setTarget(std::chrono::milliseconds(8));
        for (int i = 0; i < 120; ++i)
            governor.took({kDrawn, false, finer}, std::chrono::milliseconds(5),
                          std::chrono::milliseconds(16));
        return governor;
    };
    const double fits = static_cast<double>(after(2).points().budget()) / kDrawn;
    ASSERT_GT(fits, 1.3);
    const std::uint64_t before = Governor(Governor::Rise::Proven).limits(nullptr).splats;
    EXPECT_EQ(after(1.1 * fits).limits(nullptr).splats, before);
    EXPECT_GT(after(0.9 * fits).limits(nullptr).splats, before);
}

}  // namespace
}  // namespace app
