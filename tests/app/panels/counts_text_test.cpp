#include "app/panels/counts_text.h"

#include <gtest/gtest.h>

namespace app::panels {
namespace {

TEST(DrawnText, CountsPointsWhereEachIsDrawnOnce) {
    EXPECT_EQ(drawnText({.splats = 100, .allSplats = 100, .points = 100}), "100 points drawn");
    EXPECT_EQ(drawnText({.splats = 30, .allSplats = 1200, .points = 1200}),
              "30 of 1,200 points drawn");
}

TEST(DrawnText, CallsSplatsSplatsWherePointsAreDrawnInSeveralLayers) {
    EXPECT_EQ(drawnText({.splats = 120, .allSplats = 120, .points = 100}),
              "100 points drawn, as 120 splats");
    EXPECT_EQ(drawnText({.splats = 30, .allSplats = 120, .points = 100}), "30 of 120 splats drawn");
}

TEST(CellsText, CountsCellsAndThePointsBesideThem) {
    EXPECT_EQ(cellsText(0), "0 cells drawn");
    EXPECT_EQ(cellsText(1), "1 cell drawn");
    EXPECT_EQ(cellsText(3321), "3,321 cells drawn");
    EXPECT_EQ(cellsText(3321, 20518), "3,321 cells and 20,518 points drawn");
    EXPECT_EQ(cellsText(1, 1), "1 cell and 1 point drawn");
}

TEST(PercentText, TellsNoneFromFew) {
    EXPECT_EQ(percentText(0, 2000), "0 %");
    EXPECT_EQ(percentText(1, 2'000'000'000), "below 0.0001 %");
    EXPECT_EQ(percentText(1, 100'000), "0.0010 %");
    EXPECT_EQ(percentText(1, 400), "0.25 %");
    EXPECT_EQ(percentText(246, 2000), "12.3 %");
    EXPECT_EQ(percentText(0, 0), "");
}

}  // namespace
}  // namespace app::panels
