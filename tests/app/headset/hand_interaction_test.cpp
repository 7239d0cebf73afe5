// Hands on the volume: what carries, turns, scales and clips it, and how that is undone.
#include "app/headset/hand_interaction.h"

#include "app/choices/choice_text.h"
#include "tests/app/headset/hands_of_an_exploration.h"

namespace app::headset {
namespace {

TEST_F(HandsOfAnExploration, VolumeAndPanelStandBeforeTheFirstHeadAndStay) {
    const xr::Placement expected = first();
    EXPECT_EQ(volume(), expected.stageFromVolume.position);
    input_.head->position += glm::dvec3(1, 0, 1);
    frame();
    EXPECT_EQ(volume(), expected.stageFromVolume.position);
}

TEST_F(HandsOfAnExploration, AVolumeThatComesLaterIsPlacedThen) {
    HandInteraction interaction;
    HandInput empty = input_;
    empty.drawn.reset();
    interaction.update(e_, empty);
    EXPECT_TRUE(interaction.panel());
    input_.head->position.x = 3;
    interaction.update(e_, input_);
    EXPECT_NEAR(interaction.placement().stageFromVolume.position.x, 3, 1e-12);
}

TEST_F(HandsOfAnExploration, AHandThatGrabsCarriesTheVolumeWithIt) {
    aim(right_, volume());
    frame();
    const glm::dvec3 before = volume();
    right_.grab = true;
    const auto pulses = frame();
    ASSERT_EQ(pulses.size(), 1u);
    EXPECT_EQ(pulses[0].hand, 1);
    EXPECT_TRUE(interaction_.holds(1));
    right_.grip->position += glm::dvec3(0.1, 0.2, -0.05);
    EXPECT_TRUE(frame().empty()) << "felt once";
    EXPECT_LT(glm::distance(volume(), before + glm::dvec3(0.1, 0.2, -0.05)), 1e-12);
    right_.grab = false;
    frame();
    right_.grip->position += glm::dvec3(1, 1, 1);
    frame();
    EXPECT_LT(glm::distance(volume(), before + glm::dvec3(0.1, 0.2, -0.05)), 1e-12);
    EXPECT_FALSE(playing());
}

TEST_F(HandsOfAnExploration, TheOtherHandJoinsWithoutAJumpAndScales) {
    left_.grip = xr::Pose{{1, 0, 0, 0}, {-0.2, 1.2, -0.5}};
    right_.grip = xr::Pose{{1, 0, 0, 0}, {0.2, 1.2, -0.5}};
    left_.grab = true;
    frame();
    frame();
    const xr::Placement before = interaction_.placement();
    right_.grab = true;
    frame();
    EXPECT_EQ(interaction_.placement().metresPerUnit, before.metresPerUnit);
    left_.grip->position.x = -0.4;
    right_.grip->position.x = 0.4;
    frame();
    EXPECT_NEAR(interaction_.placement().metresPerUnit, 2 * before.metresPerUnit, 1e-12);
}

TEST_F(HandsOfAnExploration, TheStickOfAHandThatHoldsTurnsTheVolumeAndMovesNothingElse) {
    const std::size_t step = e_.explorer().steps->first;
    left_.grip = xr::Pose{};
    left_.grab = true;
    frame();
    const xr::Placement before = interaction_.placement();
    left_.stick.x = 1;
    const auto pulses = frame();
    ASSERT_EQ(pulses.size(), 1u);
    EXPECT_EQ(pulses[0].hand, 0);
    EXPECT_EQ(interaction_.placement(), turned(before, 1));
    for (int i = 0; i < 100; ++i) frame();
    EXPECT_EQ(interaction_.placement(), turned(before, 1)) << "one step a flick";
    left_.grab = false;
    for (int i = 0; i < 100; ++i) frame();
    EXPECT_EQ(e_.explorer().steps->first, step) << "before the stick has come back";
    left_.stick.x = 0;
    frame();
    left_.stick.x = 1;
    for (int i = 0; i < 100; ++i) frame();
    EXPECT_GT(e_.explorer().steps->first, step);
}

TEST_F(HandsOfAnExploration, ATurnAmidACarryIsUndoneByItself) {
    right_.grip = xr::Pose{};
    right_.grab = true;
    frame();
    right_.grip->position = {0.3, 0, 0};
    frame();
    const xr::Placement carried = interaction_.placement();
    right_.stick.x = -1;
    frame();
    const xr::Placement turnedThere = interaction_.placement();
    EXPECT_EQ(turnedThere, turned(carried, -1));
    right_.grip->position = {0.3, 0.4, 0};
    frame();
    right_.grab = false;
    frame();
    ask(HandCommand::UndoMove);
    EXPECT_EQ(interaction_.placement(), turnedThere);
    ask(HandCommand::UndoMove);
    EXPECT_EQ(interaction_.placement(), carried);
}

TEST_F(HandsOfAnExploration, ThePressedStickBringsVolumeAndPanelBeforeTheHead) {
    carry(left_, {0, 0, -4});
    input_.head->position.x += 1;
    left_.bring = true;
    frame();
    EXPECT_EQ(interaction_.placement(), first());
    EXPECT_EQ(interaction_.panel()->stageFromPlate, panelBefore(*input_.head).stageFromPlate);
    input_.head->position.x += 1;
    frame();
    EXPECT_NEAR(volume().x, 1, 1e-12) << "once a press";
}

TEST_F(HandsOfAnExploration, EachMoveIsUndoneByItself) {
    EXPECT_FALSE(interaction_.canUndoMove()) << "it has only been placed";
    std::vector rests{interaction_.placement()};
    const auto rest = [&] {
        EXPECT_FALSE(interaction_.placement() == rests.back());
        rests.push_back(interaction_.placement());
    };
    carry(right_, {0.1, 0.2, 0.3});
    rest();
    stretch(3);
    rest();
    ask(HandCommand::ResetSize);
    rest();
    input_.head->position.x += 1;
    ask(HandCommand::Bring);
    rest();
    while (rests.size() > 1) {
        ASSERT_TRUE(interaction_.canUndoMove());
        rests.pop_back();
        ask(HandCommand::UndoMove);
        EXPECT_EQ(interaction_.placement(), rests.back());
    }
    EXPECT_FALSE(interaction_.canUndoMove());
    ask(HandCommand::UndoMove);
    EXPECT_EQ(interaction_.placement(), rests.back()) << "nothing is left to undo";
}

TEST_F(HandsOfAnExploration, UndoWhileAHandHoldsTheVolumeTakesBackThatHandsWay) {
    const xr::Placement first = interaction_.placement();
    right_.grip = xr::Pose{};
    right_.grab = true;
    frame();
    right_.grip->position.x = 0.5;
    frame();
    ask(HandCommand::UndoMove);
    EXPECT_EQ(interaction_.placement(), first);
    right_.grip->position.x = 0.6;
    frame();
    EXPECT_LT(glm::distance(volume(), first.stageFromVolume.position + glm::dvec3(0.1, 0, 0)),
              1e-12)
        << "it goes on from there";
}

TEST_F(HandsOfAnExploration, TheFirstSizeComesBackWhereTheVolumeIs) {
    const double first = interaction_.placement().metresPerUnit;
    stretch(0.5);
    const xr::Placement small = interaction_.placement();
    EXPECT_NEAR(small.metresPerUnit, 0.5 * first, 1e-12);
    ask(HandCommand::ResetSize);
    EXPECT_EQ(interaction_.placement(), (xr::Placement{small.stageFromVolume, first}));
}

TEST_F(HandsOfAnExploration, WithClipByHandAGrabMovesAFaceAndNotTheVolume) {
    const Explorer before = e_.explorer();
    const xr::Placement stood = interaction_.placement();
    // From the right, at the middle: the face at the greatest x.
    const auto grab = [&] {
        right_.aim = looking(volume() + glm::dvec3(1, 0, 0), volume());
        right_.grip = right_.aim;
        right_.grab = true;
        const auto pulses = frame();
        EXPECT_EQ(pulses.size(), 1u);
    };
    const auto moved = [&] {
        // A quarter of the box, whose sides are 0.6 m and three units.
        right_.aim->position.x -= 0.15;
        right_.grip = right_.aim;
        frame();
        right_.grab = false;
        frame();
    };
    EXPECT_TRUE(interaction_.clipEdges().empty());
    ask(HandCommand::ClipByHand);
    EXPECT_TRUE(interaction_.clipsByHand());
    EXPECT_EQ(interaction_.clipEdges().size(), 12u);
    grab();
    EXPECT_TRUE(interaction_.holdsFace(1));
    EXPECT_FALSE(interaction_.holds(1));
    moved();
    EXPECT_FALSE(interaction_.holdsFace(1));
    EXPECT_EQ(interaction_.placement(), stood);
    ASSERT_TRUE(e_.explorer().clip);
    EXPECT_EQ(clipText(*e_.explorer().clip), "min:2.25,min:max,min:max");
    e_.undo();
    EXPECT_TRUE(e_.explorer() == before) << "one step of undo";
    ask(HandCommand::ClipByHand);
    grab();
    EXPECT_TRUE(interaction_.holds(1)) << "as without";
    moved();
    EXPECT_FALSE(interaction_.placement() == stood);
    EXPECT_FALSE(e_.explorer().clip);
}

TEST_F(HandsOfAnExploration, WithClipByHandAGrabElsewhereStillCarries) {
    ask(HandCommand::ClipByHand);
    aim(right_, {3, 0, 3});
    right_.grab = true;
    frame();
    EXPECT_TRUE(interaction_.holds(1));
    aim(left_, onPanel({0.5, 0.5}));
    left_.grab = left_.select = true;
    frame();
    EXPECT_FALSE(interaction_.holdsFace(0));
    EXPECT_TRUE(interaction_.pointer()->pressed);
}

TEST_F(HandsOfAnExploration, WhileAFaceIsHeldNothingElseIsDragged) {
    ask(HandCommand::ClipByHand);
    right_.aim = right_.grip = looking(volume() + glm::dvec3(1, 0, 0), volume());
    right_.grab = true;
    frame();
    const Explorer before = e_.explorer();
    left_.stick.x = right_.stick.x = 1;
    for (int i = 0; i < 100; ++i) frame();
    EXPECT_TRUE(e_.explorer() == before);
}

TEST_F(HandsOfAnExploration, HandsWithoutPosesDoNoHarm) {
    left_.grab = right_.grab = true;
    const glm::dvec3 before = volume();
    for (int i = 0; i < 3; ++i) frame();
    input_.head.reset();
    left_.bring = right_.menu = true;
    frame();
    EXPECT_EQ(volume(), before);
}

}  // namespace
}  // namespace app::headset
