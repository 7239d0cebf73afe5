// Hands on the exploration: what plays, what is clicked, what sticks move, what a tip asks.
#include "app/headset/hand_interaction.h"

#include "tests/app/headset/hands_of_an_exploration.h"

namespace app::headset {
namespace {

TEST_F(HandsOfAnExploration, TheTriggerPlaysAndPauses) {
    aim(right_, {3, 0, 3});
    right_.select = true;
    frame();
    EXPECT_TRUE(playing());
    frame();
    EXPECT_TRUE(playing()) << "once a press";
    right_.select = false;
    frame();
    right_.select = true;
    frame();
    EXPECT_FALSE(playing());
}

TEST_F(HandsOfAnExploration, TheTriggerOnThePanelClicksThere) {
    aim(right_, onPanel({0.25, 0.75}));
    frame();
    ASSERT_TRUE(interaction_.pointer());
    EXPECT_LT(glm::distance(interaction_.pointer()->at, glm::dvec2(0.25, 0.75)), 1e-9);
    EXPECT_FALSE(interaction_.pointer()->pressed);
    right_.select = true;
    frame();
    EXPECT_TRUE(interaction_.pointer()->pressed);
    EXPECT_FALSE(playing());
    right_.select = false;
    frame();
    EXPECT_FALSE(interaction_.pointer()->pressed);
}

TEST_F(HandsOfAnExploration, TheHandThatClicksIsTheMouse) {
    aim(right_, onPanel({0.2, 0.2}));
    aim(left_, onPanel({0.8, 0.8}));
    frame();
    EXPECT_NEAR(interaction_.pointer()->at.x, 0.2, 1e-9);
    left_.select = true;
    frame();
    EXPECT_NEAR(interaction_.pointer()->at.x, 0.8, 1e-9);
    EXPECT_TRUE(interaction_.pointer()->pressed);
}

TEST_F(HandsOfAnExploration, TheMenuHidesThePanelAndBringsItBefore) {
    right_.menu = true;
    frame();
    EXPECT_FALSE(interaction_.panel());
    aim(right_, {-1, 1.5, -1});
    right_.menu = false;
    frame();
    EXPECT_FALSE(interaction_.pointer());
    input_.head->position = {5, 1.6, 5};
    right_.menu = true;
    frame();
    EXPECT_LT(glm::distance(interaction_.panel()->stageFromPlate.position, input_.head->position),
              2);
}

TEST_F(HandsOfAnExploration, AControllerWithOneButtonMeansWhatItsRayMeets) {
    const auto press = [&](const glm::dvec3& at) {
        aim(right_, at);
        right_.grab = right_.select = true;
        frame();
    };
    const auto letGo = [&] {
        right_.grab = right_.select = false;
        frame();
    };
    press(volume());
    EXPECT_TRUE(interaction_.holds(1));
    EXPECT_FALSE(playing());
    letGo();
    press(onPanel({0.5, 0.5}));
    EXPECT_FALSE(interaction_.holds(1));
    EXPECT_TRUE(interaction_.pointer()->pressed);
    EXPECT_FALSE(playing());
    letGo();
    press({3, 0, 3});
    EXPECT_FALSE(interaction_.holds(1));
    EXPECT_TRUE(playing());
}

TEST_F(HandsOfAnExploration, SticksPlayTimeWithTheLeftHandAndValueWithTheRight) {
    world_.sweep("0:63");
    e_.seek(0);
    e_.seekTick(0);
    right_.stick.x = 1;
    for (int i = 0; i < 20; ++i) frame();
    EXPECT_GT(e_.explorer().play.tick, 0);
    EXPECT_EQ(e_.explorer().steps->first, 0u);
    right_.stick.x = 0;
    left_.stick.x = 1;
    for (int i = 0; i < 100; ++i) frame();
    EXPECT_GT(e_.explorer().steps->first, 0u);
}

TEST_F(HandsOfAnExploration, AnEndIsFeltOnceUntilTheStickComesBack) {
    world_.sweep("0:63");
    e_.seekTick(0);
    right_.stick.x = -1;
    std::size_t felt = 0;
    for (int i = 0; i < 100; ++i) felt += frame().size();
    EXPECT_EQ(felt, 1u);
    right_.stick.x = 0;
    frame();
    right_.stick.x = -1;
    for (int i = 0; i < 100; ++i) felt += frame().size();
    EXPECT_EQ(felt, 2u);
}

// A tip (the aim pose's place) at a point of the grid, and a little beside it.
class TipInTheVolume : public HandsOfAnExploration {
 protected:
    static constexpr std::size_t kPoint = 1 + 4 * (2 + 4 * 3);
    glm::dvec3 inStage(const glm::dvec3& world) const {
        return glm::dvec3(xr::stageFromWorld(interaction_.placement()) * glm::dvec4(world, 1));
    }
    void reach(xr::Hand& hand) {
        const glm::dvec3 at = inStage(placed_.position(kPoint) * 0.97);
        hand.aim = looking(at, at + glm::dvec3(1, 0, 1));  // beside the panel
        hand.grip = hand.aim;
    }
    double value() const { return world_.world.value(0, e_.shown()->step, kPoint); }
};

TEST_F(TipInTheVolume, TellsThePointThatItIsAt) {
    frame();
    EXPECT_FALSE(interaction_.tip());
    reach(left_);
    frame();
    ASSERT_TRUE(interaction_.tip());
    EXPECT_EQ(interaction_.tip()->hand, 0u);
    EXPECT_EQ(interaction_.tip()->reading.index, (std::array<std::size_t, 3>{1, 2, 3}));
    EXPECT_EQ(timeseries::toDouble(interaction_.tip()->reading.value), value());
    left_.grab = true;
    frame();
    EXPECT_FALSE(interaction_.tip()) << "it holds the volume";
}

TEST_F(TipInTheVolume, TheTriggerKeepsThePointInsteadOfPlaying) {
    reach(right_);
    right_.select = true;
    frame();
    ASSERT_TRUE(reading_);
    EXPECT_EQ(reading_->index, (std::array<std::size_t, 3>{1, 2, 3}));
    EXPECT_EQ(timeseries::toDouble(reading_->value), value());
    EXPECT_EQ(reading_->position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(reading_->world, placed_.position(kPoint));
    EXPECT_EQ(reading_->step, e_.shown()->step);
    EXPECT_FALSE(playing());
    frame();
    EXPECT_FALSE(reading_) << "once a press";
}

TEST_F(TipInTheVolume, ATapOfTheOnlyButtonKeepsThePointAndCarriesNothing) {
    reach(right_);
    const xr::Placement before = interaction_.placement();
    right_.grab = right_.select = true;
    frame();
    EXPECT_FALSE(reading_);
    right_.grip->position.x += 0.01;
    frame();
    right_.grab = right_.select = false;
    frame();
    ASSERT_TRUE(reading_);
    EXPECT_EQ(timeseries::toDouble(reading_->value), value());
    EXPECT_EQ(interaction_.placement(), before);
    EXPECT_FALSE(interaction_.canUndoMove());
}

TEST_F(TipInTheVolume, ALongPressOfTheOnlyButtonCarriesTheVolume) {
    reach(right_);
    const xr::Placement before = interaction_.placement();
    right_.grab = right_.select = true;
    frame();
    right_.grip->position.x += 0.3;
    for (int i = 0; i < 40; ++i) frame();
    right_.grab = right_.select = false;
    frame();
    EXPECT_FALSE(reading_);
    EXPECT_LT(glm::distance(volume(), before.stageFromVolume.position + glm::dvec3(0.3, 0, 0)),
              1e-12);
}

TEST_F(TipInTheVolume, ARayAtThePanelStillClicksThere) {
    right_.grip = right_.aim = looking(inStage({0, 0, 0}), onPanel({0.5, 0.5}));
    right_.select = true;
    frame();
    EXPECT_FALSE(reading_);
    EXPECT_FALSE(interaction_.tip());
    ASSERT_TRUE(interaction_.pointer());
    EXPECT_TRUE(interaction_.pointer()->pressed);
}

}  // namespace
}  // namespace app::headset
