// Hands in a room, frame by frame: what moves, what plays, what is clicked.
#include "app/headset/room.h"

#include <gmock/gmock.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "app/choice_text.h"
#include "tests/support/scripted_exploration.h"

namespace app::headset {
namespace {

using namespace std::chrono_literals;

constexpr glm::dvec3 kUp(0, 1, 0);

class RoomOfAnExploration : public testing::Test {
 protected:
    tests::ScriptedExploration world_;
    Exploration& e_ = world_.exploration;
    Room room_;
    // 4 x 4 x 4 points.
    render::Lattice lattice_{e_.shown()->sorted->grid()};
    RoomInput input_{.hands = {},
                     .head = xr::Pose{{1, 0, 0, 0}, {0, 1.6, 0}},
                     .dt = 10ms,
                     .drawn = Drawn{&lattice_, e_.shown()->sorted, e_.shown()->step},
                     .asked = {}};
    xr::Hand& left_ = input_.hands[0];
    xr::Hand& right_ = input_.hands[1];
    std::optional<Reading> reading_;  // of the last frame

    RoomOfAnExploration() { frame(); }

    std::vector<Pulse> frame() {
        RoomOutcome outcome = room_.update(e_, input_);
        reading_ = outcome.reading;
        return outcome.pulses;
    }
    // Where the room is to place the volume.
    xr::Placement first() const { return volumeBefore(*input_.head, lattice_.boxHalfEdges()); }
    static xr::Pose looking(const glm::dvec3& from, const glm::dvec3& at) {
        return {glm::quatLookAt(glm::normalize(at - from), kUp), from};
    }
    // A point of the panel, [0, 1] from its upper left corner.
    glm::dvec3 onPanel(const glm::dvec2& at) const {
        const Plate& panel = *room_.panel();
        const glm::dvec2 in = panel.half * glm::dvec2(2 * at.x - 1, 1 - 2 * at.y);
        return panel.stageFromPlate.orientation * glm::dvec3(in, 0) + panel.stageFromPlate.position;
    }
    void aim(xr::Hand& hand, const glm::dvec3& at) {
        hand.aim = looking({0.2, 1.3, -0.2}, at);
        hand.grip = hand.aim;
    }
    void ask(RoomCommand command) {
        input_.asked = command;
        frame();
        input_.asked.reset();
    }
    // Takes hold, goes along, lets go.
    void carry(xr::Hand& hand, const glm::dvec3& by) {
        hand.grip = xr::Pose{};
        hand.grab = true;
        frame();
        hand.grip->position += by;
        frame();
        hand.grab = false;
        frame();
    }
    // Both hands, from 0.4 m apart.
    void stretch(double ratio) {
        for (xr::Hand* hand : {&left_, &right_}) hand->grab = true;
        for (const double apart : {0.4, 0.4 * ratio}) {
            left_.grip = xr::Pose{{1, 0, 0, 0}, {-0.5 * apart, 1.2, -0.5}};
            right_.grip = xr::Pose{{1, 0, 0, 0}, {0.5 * apart, 1.2, -0.5}};
            frame();
        }
        for (xr::Hand* hand : {&left_, &right_}) hand->grab = false;
        frame();
    }
    glm::dvec3 volume() const { return room_.placement().stageFromVolume.position; }
    bool playing() const { return e_.playback().playing; }
};

TEST_F(RoomOfAnExploration, VolumeAndPanelStandBeforeTheFirstHeadAndStay) {
    const xr::Placement expected = first();
    EXPECT_EQ(volume(), expected.stageFromVolume.position);
    input_.head->position += glm::dvec3(1, 0, 1);
    frame();
    EXPECT_EQ(volume(), expected.stageFromVolume.position);
}

TEST_F(RoomOfAnExploration, AVolumeThatComesLaterIsPlacedThen) {
    Room room;
    RoomInput empty = input_;
    empty.drawn.reset();
    room.update(e_, empty);
    EXPECT_TRUE(room.panel());
    input_.head->position.x = 3;
    room.update(e_, input_);
    EXPECT_NEAR(room.placement().stageFromVolume.position.x, 3, 1e-12);
}

TEST_F(RoomOfAnExploration, AHandThatGrabsCarriesTheVolumeWithIt) {
    aim(right_, volume());
    frame();
    const glm::dvec3 before = volume();
    right_.grab = true;
    const auto pulses = frame();
    ASSERT_EQ(pulses.size(), 1u);
    EXPECT_EQ(pulses[0].hand, 1);
    EXPECT_TRUE(room_.holds(1));
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

TEST_F(RoomOfAnExploration, TheOtherHandJoinsWithoutAJumpAndScales) {
    left_.grip = xr::Pose{{1, 0, 0, 0}, {-0.2, 1.2, -0.5}};
    right_.grip = xr::Pose{{1, 0, 0, 0}, {0.2, 1.2, -0.5}};
    left_.grab = true;
    frame();
    frame();
    const xr::Placement before = room_.placement();
    right_.grab = true;
    frame();
    EXPECT_EQ(room_.placement().metresPerUnit, before.metresPerUnit);
    left_.grip->position.x = -0.4;
    right_.grip->position.x = 0.4;
    frame();
    EXPECT_NEAR(room_.placement().metresPerUnit, 2 * before.metresPerUnit, 1e-12);
}

TEST_F(RoomOfAnExploration, TheStickOfAHandThatHoldsTurnsTheVolumeAndMovesNothingElse) {
    const std::size_t step = e_.explorer().steps->first;
    left_.grip = xr::Pose{};
    left_.grab = true;
    frame();
    const xr::Placement before = room_.placement();
    left_.stick.x = 1;
    const auto pulses = frame();
    ASSERT_EQ(pulses.size(), 1u);
    EXPECT_EQ(pulses[0].hand, 0);
    EXPECT_EQ(room_.placement(), turned(before, 1));
    for (int i = 0; i < 100; ++i) frame();
    EXPECT_EQ(room_.placement(), turned(before, 1)) << "one step a flick";
    left_.grab = false;
    for (int i = 0; i < 100; ++i) frame();
    EXPECT_EQ(e_.explorer().steps->first, step) << "before the stick has come back";
    left_.stick.x = 0;
    frame();
    left_.stick.x = 1;
    for (int i = 0; i < 100; ++i) frame();
    EXPECT_GT(e_.explorer().steps->first, step);
}

TEST_F(RoomOfAnExploration, ATurnAmidACarryIsUndoneByItself) {
    right_.grip = xr::Pose{};
    right_.grab = true;
    frame();
    right_.grip->position = {0.3, 0, 0};
    frame();
    const xr::Placement carried = room_.placement();
    right_.stick.x = -1;
    frame();
    const xr::Placement turnedThere = room_.placement();
    EXPECT_EQ(turnedThere, turned(carried, -1));
    right_.grip->position = {0.3, 0.4, 0};
    frame();
    right_.grab = false;
    frame();
    ask(RoomCommand::UndoMove);
    EXPECT_EQ(room_.placement(), turnedThere);
    ask(RoomCommand::UndoMove);
    EXPECT_EQ(room_.placement(), carried);
}

TEST_F(RoomOfAnExploration, TheTriggerPlaysAndPauses) {
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

TEST_F(RoomOfAnExploration, TheTriggerOnThePanelClicksThere) {
    aim(right_, onPanel({0.25, 0.75}));
    frame();
    ASSERT_TRUE(room_.pointer());
    EXPECT_LT(glm::distance(room_.pointer()->at, glm::dvec2(0.25, 0.75)), 1e-9);
    EXPECT_FALSE(room_.pointer()->pressed);
    right_.select = true;
    frame();
    EXPECT_TRUE(room_.pointer()->pressed);
    EXPECT_FALSE(playing());
    right_.select = false;
    frame();
    EXPECT_FALSE(room_.pointer()->pressed);
}

TEST_F(RoomOfAnExploration, TheHandThatClicksIsTheMouse) {
    aim(right_, onPanel({0.2, 0.2}));
    aim(left_, onPanel({0.8, 0.8}));
    frame();
    EXPECT_NEAR(room_.pointer()->at.x, 0.2, 1e-9);
    left_.select = true;
    frame();
    EXPECT_NEAR(room_.pointer()->at.x, 0.8, 1e-9);
    EXPECT_TRUE(room_.pointer()->pressed);
}

TEST_F(RoomOfAnExploration, TheMenuHidesThePanelAndBringsItBefore) {
    right_.menu = true;
    frame();
    EXPECT_FALSE(room_.panel());
    aim(right_, {-1, 1.5, -1});
    right_.menu = false;
    frame();
    EXPECT_FALSE(room_.pointer());
    input_.head->position = {5, 1.6, 5};
    right_.menu = true;
    frame();
    EXPECT_LT(glm::distance(room_.panel()->stageFromPlate.position, input_.head->position), 2);
}

TEST_F(RoomOfAnExploration, AControllerWithOneButtonMeansWhatItsRayMeets) {
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
    EXPECT_TRUE(room_.holds(1));
    EXPECT_FALSE(playing());
    letGo();
    press(onPanel({0.5, 0.5}));
    EXPECT_FALSE(room_.holds(1));
    EXPECT_TRUE(room_.pointer()->pressed);
    EXPECT_FALSE(playing());
    letGo();
    press({3, 0, 3});
    EXPECT_FALSE(room_.holds(1));
    EXPECT_TRUE(playing());
}

TEST_F(RoomOfAnExploration, ThePressedStickBringsVolumeAndPanelBeforeTheHead) {
    carry(left_, {0, 0, -4});
    input_.head->position.x += 1;
    left_.bring = true;
    frame();
    EXPECT_EQ(room_.placement(), first());
    EXPECT_EQ(room_.panel()->stageFromPlate, panelBefore(*input_.head).stageFromPlate);
    input_.head->position.x += 1;
    frame();
    EXPECT_NEAR(volume().x, 1, 1e-12) << "once a press";
}

TEST_F(RoomOfAnExploration, EachMoveIsUndoneByItself) {
    EXPECT_FALSE(room_.canUndoMove()) << "it has only been placed";
    std::vector rests{room_.placement()};
    const auto rest = [&] {
        EXPECT_FALSE(room_.placement() == rests.back());
        rests.push_back(room_.placement());
    };
    carry(right_, {0.1, 0.2, 0.3});
    rest();
    stretch(3);
    rest();
    ask(RoomCommand::ResetSize);
    rest();
    input_.head->position.x += 1;
    ask(RoomCommand::Bring);
    rest();
    while (rests.size() > 1) {
        ASSERT_TRUE(room_.canUndoMove());
        rests.pop_back();
        ask(RoomCommand::UndoMove);
        EXPECT_EQ(room_.placement(), rests.back());
    }
    EXPECT_FALSE(room_.canUndoMove());
    ask(RoomCommand::UndoMove);
    EXPECT_EQ(room_.placement(), rests.back()) << "nothing is left to undo";
}

TEST_F(RoomOfAnExploration, UndoWhileAHandHoldsTheVolumeTakesBackThatHandsWay) {
    const xr::Placement first = room_.placement();
    right_.grip = xr::Pose{};
    right_.grab = true;
    frame();
    right_.grip->position.x = 0.5;
    frame();
    ask(RoomCommand::UndoMove);
    EXPECT_EQ(room_.placement(), first);
    right_.grip->position.x = 0.6;
    frame();
    EXPECT_LT(glm::distance(volume(), first.stageFromVolume.position + glm::dvec3(0.1, 0, 0)),
              1e-12)
        << "it goes on from there";
}

TEST_F(RoomOfAnExploration, TheFirstSizeComesBackWhereTheVolumeIs) {
    const double first = room_.placement().metresPerUnit;
    stretch(0.5);
    const xr::Placement small = room_.placement();
    EXPECT_NEAR(small.metresPerUnit, 0.5 * first, 1e-12);
    ask(RoomCommand::ResetSize);
    EXPECT_EQ(room_.placement(), (xr::Placement{small.stageFromVolume, first}));
}

TEST_F(RoomOfAnExploration, SticksPlayTimeWithTheLeftHandAndValueWithTheRight) {
    Explorer next = e_.explorer();
    next.sweep.emplace();
    next.sweep->animation = timeseries::RangeSet::parse("0:63");
    e_.edit(next);
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

TEST_F(RoomOfAnExploration, AnEndIsFeltOnceUntilTheStickComesBack) {
    Explorer next = e_.explorer();
    next.sweep.emplace();
    next.sweep->animation = timeseries::RangeSet::parse("0:63");
    e_.edit(next);
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
class TipInTheVolume : public RoomOfAnExploration {
 protected:
    static constexpr std::size_t kPoint = 1 + 4 * (2 + 4 * 3);
    glm::dvec3 inStage(const glm::dvec3& world) const {
        return glm::dvec3(xr::stageFromWorld(room_.placement()) * glm::dvec4(world, 1));
    }
    void reach(xr::Hand& hand) {
        const glm::dvec3 at = inStage(lattice_.position(kPoint) * 0.97);
        hand.aim = looking(at, at + glm::dvec3(1, 0, 1));  // beside the panel
        hand.grip = hand.aim;
    }
    double value() const { return world_.world.value(0, e_.shown()->step, kPoint); }
};

TEST_F(TipInTheVolume, TellsThePointThatItIsAt) {
    frame();
    EXPECT_FALSE(room_.tip());
    reach(left_);
    frame();
    ASSERT_TRUE(room_.tip());
    EXPECT_EQ(room_.tip()->hand, 0u);
    EXPECT_EQ(room_.tip()->reading.index, (std::array<std::size_t, 3>{1, 2, 3}));
    EXPECT_EQ(timeseries::toDouble(room_.tip()->reading.value), value());
    left_.grab = true;
    frame();
    EXPECT_FALSE(room_.tip()) << "it holds the volume";
}

TEST_F(TipInTheVolume, TheTriggerKeepsThePointInsteadOfPlaying) {
    reach(right_);
    right_.select = true;
    frame();
    ASSERT_TRUE(reading_);
    EXPECT_EQ(reading_->index, (std::array<std::size_t, 3>{1, 2, 3}));
    EXPECT_EQ(timeseries::toDouble(reading_->value), value());
    EXPECT_EQ(reading_->position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(reading_->world, lattice_.position(kPoint));
    EXPECT_EQ(reading_->step, e_.shown()->step);
    EXPECT_FALSE(playing());
    frame();
    EXPECT_FALSE(reading_) << "once a press";
}

TEST_F(TipInTheVolume, ATapOfTheOnlyButtonKeepsThePointAndCarriesNothing) {
    reach(right_);
    const xr::Placement before = room_.placement();
    right_.grab = right_.select = true;
    frame();
    EXPECT_FALSE(reading_);
    right_.grip->position.x += 0.01;
    frame();
    right_.grab = right_.select = false;
    frame();
    ASSERT_TRUE(reading_);
    EXPECT_EQ(timeseries::toDouble(reading_->value), value());
    EXPECT_EQ(room_.placement(), before);
    EXPECT_FALSE(room_.canUndoMove());
}

TEST_F(TipInTheVolume, ALongPressOfTheOnlyButtonCarriesTheVolume) {
    reach(right_);
    const xr::Placement before = room_.placement();
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
    EXPECT_FALSE(room_.tip());
    ASSERT_TRUE(room_.pointer());
    EXPECT_TRUE(room_.pointer()->pressed);
}

TEST_F(RoomOfAnExploration, WithClipByHandAGrabMovesAFaceAndNotTheVolume) {
    const Explorer before = e_.explorer();
    const xr::Placement stood = room_.placement();
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
    EXPECT_TRUE(room_.clipEdges().empty());
    ask(RoomCommand::ClipByHand);
    EXPECT_TRUE(room_.clipsByHand());
    EXPECT_EQ(room_.clipEdges().size(), 12u);
    grab();
    EXPECT_TRUE(room_.holdsFace(1));
    EXPECT_FALSE(room_.holds(1));
    moved();
    EXPECT_FALSE(room_.holdsFace(1));
    EXPECT_EQ(room_.placement(), stood);
    ASSERT_TRUE(e_.explorer().clip);
    EXPECT_EQ(clipText(*e_.explorer().clip), "min:2.25,min:max,min:max");
    e_.undo();
    EXPECT_TRUE(e_.explorer() == before) << "one step of undo";
    ask(RoomCommand::ClipByHand);
    grab();
    EXPECT_TRUE(room_.holds(1)) << "as without";
    moved();
    EXPECT_FALSE(room_.placement() == stood);
    EXPECT_FALSE(e_.explorer().clip);
}

TEST_F(RoomOfAnExploration, WithClipByHandAGrabElsewhereStillCarries) {
    ask(RoomCommand::ClipByHand);
    aim(right_, {3, 0, 3});
    right_.grab = true;
    frame();
    EXPECT_TRUE(room_.holds(1));
    aim(left_, onPanel({0.5, 0.5}));
    left_.grab = left_.select = true;
    frame();
    EXPECT_FALSE(room_.holdsFace(0));
    EXPECT_TRUE(room_.pointer()->pressed);
}

TEST_F(RoomOfAnExploration, WhileAFaceIsHeldNothingElseIsDragged) {
    ask(RoomCommand::ClipByHand);
    right_.aim = right_.grip = looking(volume() + glm::dvec3(1, 0, 0), volume());
    right_.grab = true;
    frame();
    const Explorer before = e_.explorer();
    left_.stick.x = right_.stick.x = 1;
    for (int i = 0; i < 100; ++i) frame();
    EXPECT_TRUE(e_.explorer() == before);
}

TEST_F(RoomOfAnExploration, HandsWithoutPosesDoNoHarm) {
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
