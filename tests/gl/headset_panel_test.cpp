// The panel under a ray: what is pressed there is asked for.
#include "app/headset/panel.h"

#include <gtest/gtest.h>

#include "render/gl/headless_context.h"
#include "tests/support/scripted_exploration.h"

namespace app::headset {
namespace {

class PanelUnderARay : public testing::Test {
 protected:
    render::gl::HeadlessContext context_;
    tests::ScriptedExploration world_;
    Panel panel_{[] {}};
    Panel::Around around_{.offers = {},
                          .help = "help",
                          .exporting = {},
                          .performance = {},
                          .buttons = {.canUndo = true}};

    static Pointer on(HandCommand command, bool pressed) {
        const glm::vec2 size(kPanelPixels);
        const panels::Rect button = handButton(panels::layoutOf(size, kPanelScale), command);
        return {.at = glm::dvec2(button.centre() / size), .pressed = pressed};
    }
    std::optional<HandCommand> draw(const std::optional<Pointer>& pointer) {
        return panel_.draw(world_.exploration, pointer, around_, std::chrono::milliseconds(10))
            .interaction;
    }
    // All that is asked while the ray comes, presses, and lets go.
    std::vector<HandCommand> click(HandCommand button) {
        std::vector<HandCommand> asked;
        for (const bool pressed : {false, true, true, false, false})
            if (const auto command = draw(on(button, pressed))) asked.push_back(*command);
        return asked;
    }
};

TEST_F(PanelUnderARay, EachButtonAsksForItsOwnOnceAClick) {
    draw({});  // before there is a ray
    for (const HandCommand command : {HandCommand::Bring, HandCommand::UndoMove,
                                      HandCommand::ResetSize, HandCommand::ClipByHand})
        EXPECT_EQ(click(command), std::vector{command});
}

// As below a window's picture: somewhere on its lines it is pressed.
TEST_F(PanelUnderARay, ThePicturesErrorOpensWhatItComesFrom) {
    const auto opens = [&] {
        const glm::vec2 size(kPanelPixels);
        const panels::Rect status = panels::layoutOf(size, kPanelScale).status;
        for (float y = status.min.y + 10; y < status.max.y; y += 10)
            for (float x = status.min.x + 25; x < status.min.x + 400; x += 75)
                for (const bool pressed : {false, true, true, false, false})
                    if (panel_
                            .draw(world_.exploration,
                                  Pointer{.at = glm::dvec2(glm::vec2(x, y) / size),
                                          .pressed = pressed},
                                  around_, std::chrono::milliseconds(10))
                            .requests.errorParts)
                        return true;
        return false;
    };
    around_.performance.report = {
        .counts = PointCounts{.layers = {7}, .selected = 7, .kept = 64, .total = 64},
        .whole = true};
    around_.performance.errors.emplace();  // of nothing that is seen
    draw({});
    EXPECT_FALSE(opens());
    around_.performance.errors = DepthErrors{.rungs = {{.rung = {Model::Cells}, .depth = 0.03}}};
    around_.performance.report.cells = 7;
    draw({});
    EXPECT_TRUE(opens());
}

TEST_F(PanelUnderARay, WhereNoMoveIsLeftNoneIsTakenBack) {
    draw({});
    around_.buttons.canUndo = false;
    EXPECT_TRUE(click(HandCommand::UndoMove).empty());
    EXPECT_EQ(click(HandCommand::Bring).size(), 1u);
}

TEST_F(PanelUnderARay, BeforeThereAreDataItHasNoButtons) {
    Exploration empty({});
    for (const bool pressed : {false, true, false})
        EXPECT_FALSE(panel_
                         .draw(empty, on(HandCommand::Bring, pressed), around_,
                               std::chrono::milliseconds(10))
                         .interaction);
}

// At a step that the others do not have, of a variable that is not theirs.
TEST(PanelOfOtherData, KeepsNoReadingOfThoseBefore) {
    const render::gl::HeadlessContext context;
    tests::ExplorationDesk desk({{"long", {.steps = 10}}, {"short", {.steps = 1}}});
    Panel panel([] {});
    const auto draw = [&] { panel.draw(desk.exploration, {}, {}, std::chrono::milliseconds(10)); };
    panel.interface().choices().page = panels::Page::Probe;
    desk.open("long");
    draw();
    panel.interface().takeReading(Reading{.value = 3.0, .step = 9}, false);
    draw();
    EXPECT_TRUE(panel.interface().reading());
    desk.open("short");
    draw();
    EXPECT_FALSE(panel.interface().reading());
    desk.choose("P");
    desk.untilOpened();
    draw();
    panel.interface().takeReading(Reading{.value = 3.0, .step = 0}, false);
    desk.choose("T");
    desk.untilOpened();
    draw();
    EXPECT_FALSE(panel.interface().reading());
}

}  // namespace
}  // namespace app::headset
