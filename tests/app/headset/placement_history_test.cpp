#include "app/headset/placement_history.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace app::headset {
namespace {

xr::Placement at(double x) { return {.stageFromVolume = {{1, 0, 0, 0}, {x, 0, 0}}}; }

TEST(PlacementHistory, WhereTheVolumeFirstRestedCannotBeUndone) {
    PlacementHistory history;
    EXPECT_FALSE(history.canUndo());
    history.settle(at(1));
    EXPECT_FALSE(history.canUndo());
    history.settle(at(1));
    EXPECT_FALSE(history.canUndo()) << "it has not moved";
}

// Against a plain list of all that it rested at.
TEST(PlacementHistory, GoesBackThroughItsLastRests) {
    std::mt19937 random(3);
    PlacementHistory history;
    std::vector<xr::Placement> rests{at(0)};
    history.settle(rests.back());
    bool wasFull = false;
    for (int i = 0; i < 2000; ++i) {
        // Rarely more steps back than forth, so that the oldest are forgotten.
        if (random() % 3 != 0) {
            const xr::Placement next = at(static_cast<double>(random() % 4));
            history.settle(next);
            if (!(next == rests.back())) rests.push_back(next);
            if (rests.size() > PlacementHistory::kSteps + 1) {
                rests.erase(rests.begin());
                wasFull = true;
            }
        } else if (history.canUndo()) {
            rests.pop_back();
            ASSERT_EQ(history.undo(), rests.back()) << i;
        }
        ASSERT_EQ(history.canUndo(), rests.size() > 1) << i;
    }
    EXPECT_TRUE(wasFull);
}

}  // namespace
}  // namespace app::headset
