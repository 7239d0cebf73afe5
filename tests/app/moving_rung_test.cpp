// Which rung of the ladder a picture that moves is drawn on.
#include "app/drawing/moving_rung.h"

#include <gtest/gtest.h>

namespace app {
namespace {

// Of cells, all points, one of two, one of four.
const std::vector<Rung> kRungs{
    {Model::Cells}, {Model::Points}, {Model::Points, 2}, {Model::Points, 4}};

DepthErrors errorsOf(const std::vector<double>& depths) {
    DepthErrors errors;
    for (std::size_t i = 0; i < depths.size(); ++i)
        errors.rungs.push_back({.rung = kRungs[i], .depth = depths[i]});
    return errors;
}

TEST(MovingRung, IsTheTruestThatFitsOrTheFirstWhereNoErrorIsKnown) {
    const DepthErrors errors = errorsOf({0.01, 0.5, 0.3, 0.4});
    const auto all = [](const Rung&, double) { return true; };
    const auto points = [](const Rung& rung, double) { return rung.model == Model::Points; };
    const auto none = [](const Rung&, double) { return false; };
    EXPECT_EQ(truestThatFits(kRungs, kRungs[0], &errors, all), kRungs[0]);
    EXPECT_EQ(truestThatFits(kRungs, kRungs[0], &errors, points), kRungs[2]);
    EXPECT_EQ(truestThatFits(kRungs, kRungs[0], nullptr, points), kRungs[1]);
    EXPECT_EQ(truestThatFits(kRungs, kRungs[0], &errors, none), kRungs[3]);
}

TEST(MovingRung, ShowsNothingWhereMostIsOffOrSomePointsStandForCells) {
    const DepthErrors errors = errorsOf({0.01, 0.4, 0.6});  // of the last rung none
    for (const bool ofCells : {true, false}) {
        EXPECT_FALSE(showsNothing(kRungs[0], ofCells, &errors));
        EXPECT_FALSE(showsNothing(kRungs[1], ofCells, &errors));
        EXPECT_TRUE(showsNothing(kRungs[2], ofCells, &errors));
        const DepthErrors unknown;  // they could not be worked out
        for (const DepthErrors* none : {static_cast<const DepthErrors*>(nullptr), &unknown}) {
            EXPECT_FALSE(showsNothing(kRungs[0], ofCells, none));
            EXPECT_FALSE(showsNothing(kRungs[1], ofCells, none));
            EXPECT_EQ(showsNothing(kRungs[2], ofCells, none), ofCells);
        }
    }
}

}  // namespace
}  // namespace app
