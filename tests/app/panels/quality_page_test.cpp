// What a picture that moves is to keep, as the Quality page lets it be chosen.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/support/panels_desk.h"

namespace app::panels {
namespace {

// All that a click on the page chooses, four to a control.
std::set<Moving> chosenByClicks(bool inHeadset) {
    std::set<Moving> chosen;
    for (std::size_t control = 0, count = 1; control < count; ++control) {
        // All of the page is in view.
        tests::PanelsDesk desk(tests::World{}, {1280, 1800});
        desk.inHeadset = inHeadset;
        Choices& choices = desk.interface.choices();
        choices.page = Page::Quality;
        desk.frames(2);
        count = focus().controls().size();
        const Rect at = focus().controls()[control].at;
        for (const float share : {1 / 8.f, 3 / 8.f, 5 / 8.f, 7 / 8.f}) {
            choices.moving = Moving::Pace;
            desk.click({at.min.x + share * at.size().x, at.centre().y});
            chosen.insert(choices.moving);
        }
    }
    return chosen;
}

TEST(QualityPage, LetsAMovingPictureKeepWhatIsChosen) {
    EXPECT_THAT(chosenByClicks(false),
                testing::ElementsAre(Moving::Pace, Moving::Error, Moving::Fixed, Moving::All));
}

// The display's pace holds anyhow: all is what it is without a choice.
TEST(QualityPage, LetsTheMostThatAHeadsetDrawsBeChosen) {
    EXPECT_THAT(chosenByClicks(true),
                testing::ElementsAre(Moving::Pace, Moving::Error, Moving::Fixed));
}

// All kinds of light that clicks on the page choose where it is off.
std::set<render::Light> lightsByClicks(render::Order order) {
    std::set<render::Light> chosen;
    for (std::size_t control = 0, count = 1; control < count; ++control) {
        tests::PanelsDesk desk(tests::World{}, {1280, 1800});
        desk.interface.choices().page = Page::Quality;
        for (const float share : {1 / 6.f, 3 / 6.f, 5 / 6.f}) {
            Explorer e = desk.exploration.explorer();
            e.light = render::Light::Off;
            e.order = order;
            desk.exploration.edit(e);
            desk.frames(2);
            count = focus().controls().size();
            if (control >= count) break;
            const Rect at = focus().controls()[control].at;
            desk.click({at.min.x + share * at.size().x, at.centre().y});
            if (!desk.exploration.shown()) break;
            chosen.insert(desk.exploration.explorer().light);
        }
    }
    return chosen;
}

TEST(QualityPage, LetsLightBeChosenWhereCellsAreLitAlone) {
    using enum render::Light;
    EXPECT_THAT(lightsByClicks(render::Order::BackToFront), testing::ElementsAre(Off, Soft, Full));
    EXPECT_THAT(lightsByClicks(render::Order::None), testing::ElementsAre(Off));
}

TEST(AskedOfMoving, IsTheRungThatIsChosenOrKeepsTheError) {
    DepthErrors errors;
    errors.rungs = {{.rung = {Model::Cells}, .depth = 0.002},
                    {.rung = {Model::Points}, .depth = 0.02},
                    {.rung = {Model::Points, 4}, .depth = 0.2}};
    Choices choices;
    EXPECT_FALSE(askedOfMoving(choices, &errors));
    choices.moving = Moving::Error;
    choices.movingError = 0.03;
    EXPECT_FALSE(askedOfMoving(choices, nullptr)) << "not known yet";
    EXPECT_EQ(askedOfMoving(choices, &errors), (Rung{Model::Points}));
    choices.moving = Moving::Fixed;
    choices.movingRung = {Model::Points, 8, kCoarse};
    EXPECT_EQ(askedOfMoving(choices, nullptr), choices.movingRung);
    choices.moving = Moving::All;
    EXPECT_EQ(askedOfMoving(choices, &errors), Rung());
}

}  // namespace
}  // namespace app::panels
