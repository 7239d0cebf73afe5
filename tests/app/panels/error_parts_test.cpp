// A press on the error among the figures.
#include "app/panels/error_parts.h"

#include <gtest/gtest.h>

#include "app/panels/figures.h"
#include "tests/support/panels_desk.h"

namespace app::panels {
namespace {

class ErrorPartsDesk : public testing::Test {
 protected:
    ErrorPartsDesk() {
        desk_.performance.report.counts =
            PointCounts{.layers = {7}, .selected = 7, .kept = 64, .total = 64};
        tell(0.03);
    }
    void tell(double depth) {
        desk_.performance.errors =
            DepthErrors{.rungs = {{.rung = {Model::Points}, .depth = depth}}};
        desk_.frames(2);
    }
    std::optional<Rect> place() {
        return shownFigures(desk_.theme(), desk_.layout(), desk_.performance,
                            desk_.exploration.series())
            .error;
    }
    bool isOpen() const { return desk_.asked.errorParts; }
    tests::PanelsDesk desk_;
};

TEST_F(ErrorPartsDesk, OpensThemAndAsksForThemAsLongAsTheyAreOpen) {
    EXPECT_FALSE(isOpen());
    ASSERT_TRUE(place());
    desk_.click(place()->centre());
    EXPECT_TRUE(isOpen());
    desk_.frames(5);
    EXPECT_TRUE(isOpen());
    EXPECT_TRUE(desk_.asked.commands.empty());
    desk_.press(Key::Escape);
    desk_.frames(2);
    EXPECT_FALSE(isOpen());
}

TEST_F(ErrorPartsDesk, KeepsThePicturesKeysToItself) {
    desk_.click(place()->centre());
    ASSERT_TRUE(isOpen());
    desk_.press(Key::Space);
    EXPECT_FALSE(desk_.exploration.playback().playing);
    desk_.press(Key::Escape);
    desk_.frames(2);
    desk_.press(Key::Space);
    EXPECT_TRUE(desk_.exploration.playback().playing);
}

TEST_F(ErrorPartsDesk, TheErrorLiesBelowThePictureAndNothingElseOpensThem) {
    const Rect at = *place();
    EXPECT_GE(at.min.y, desk_.layout().status.min.y);
    EXPECT_LE(at.max.y, desk_.layout().status.max.y);
    EXPECT_GT(at.min.x, desk_.layout().status.min.x + 50) << "the count stands before it";
    desk_.click({desk_.layout().status.min.x + 30, at.centre().y});
    desk_.click({at.max.x + 20, at.centre().y});
    EXPECT_FALSE(isOpen());
}

TEST_F(ErrorPartsDesk, AClickBesideClosesThem) {
    desk_.click(place()->centre());
    ASSERT_TRUE(isOpen());
    desk_.click(desk_.layout().picture.min + glm::vec2(20));
    desk_.frames(2);
    EXPECT_FALSE(isOpen());
}

TEST_F(ErrorPartsDesk, WhereNoErrorIsToldNothingIsPressed) {
    const Rect at = *place();
    desk_.performance.errors.emplace();  // of a picture without anything
    desk_.frames(2);
    EXPECT_FALSE(place());
    desk_.click(at.centre());
    EXPECT_FALSE(isOpen());
}

TEST_F(ErrorPartsDesk, WhatIsNotKnownYetIsPressedToo) {
    desk_.performance.errors.reset();
    desk_.frames(2);
    ASSERT_TRUE(place());
    desk_.click(place()->centre());
    EXPECT_TRUE(isOpen());
}

// The picture moves on while it is open: what is not known any more is said not to be.
TEST_F(ErrorPartsDesk, StaysOpenWhileThePictureMoves) {
    desk_.click(place()->centre());
    desk_.performance.errors.reset();
    desk_.frames(3);
    EXPECT_TRUE(isOpen());
    tell(0.01);
    EXPECT_TRUE(isOpen());
}

}  // namespace
}  // namespace app::panels
