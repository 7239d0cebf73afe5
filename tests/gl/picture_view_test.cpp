// When the window's picture is to be drawn again.
#include "app/desktop/picture_view.h"

#include <gtest/gtest.h>

#include <set>

#include "render/gl/debug_output.h"
#include "render/gl/headless_context.h"
#include "tests/support/shown_steps.h"

namespace app::desktop {
namespace {

using namespace std::chrono_literals;

TEST(PictureView, WaitsWhilePlayStandsInTheWayOfRefining) {
    const render::gl::HeadlessContext context;
    tests::ShownSteps world(100);
    PictureView view;
    panels::Choices choices;
    choices.frameBudget = 1ms;
    const auto draw = [&](bool playing) {
        const Shown shown = world.shown();
        return view.draw(&shown, playing, false, choices);
    };
    EXPECT_TRUE(draw(false)) << "there is something to show";
    while (view.performance().report.refined == 0) draw(false);
    ASSERT_FALSE(view.performance().report.whole);
    EXPECT_EQ(view.untilNextDraw(), 0ns);
    // Between two steps that play: nothing is drawn.
    draw(true);
    EXPECT_GT(view.untilNextDraw().value(), 0ns);
    while (!view.performance().report.whole) draw(false);
    // Its error comes from a thread, and is waited for unless something plays.
    EXPECT_GT(view.untilNextDraw().value(), 0ns);
    EXPECT_FALSE(draw(true)) << "the same";
    EXPECT_FALSE(view.untilNextDraw());
    const auto drawUntil = [&](const auto& isSo) {
        const auto end = std::chrono::steady_clock::now() + 120s;
        while (!isSo() && std::chrono::steady_clock::now() < end) draw(false);
    };
    drawUntil([&] { return view.performance().error().has_value(); });
    ASSERT_TRUE(view.performance().error());
    EXPECT_GT(*view.performance().error(), 0);
    EXPECT_FALSE(view.untilNextDraw());
    const double measured = *view.performance().error();
    EXPECT_EQ(view.errorOf(world.shown()), measured);
    // Its parts, once somebody looks: the picture rests, and what is known stays.
    ASSERT_FALSE(view.performance().told()->parts);
    view.wantParts(true);
    EXPECT_GT(view.untilNextDraw().value(), 0ns);
    drawUntil([&] {
        EXPECT_EQ(view.performance().error(), measured);
        return view.performance().told()->parts.has_value();
    });
    ASSERT_TRUE(view.performance().told()->parts);
    // Panels have not seen them yet, and what opens for them has its size a frame later.
    int frames = 0;
    for (; view.untilNextDraw() == 0ns && frames < 10; ++frames) draw(false);
    EXPECT_GE(frames, 2);
    EXPECT_LE(frames, 3);
    EXPECT_FALSE(view.untilNextDraw());
    view.wantParts(false);
    draw(false);
    EXPECT_TRUE(view.performance().told()->parts) << "they are still true";
    EXPECT_FALSE(view.untilNextDraw());
    // While it moves: what was told of such a subset.
    const DepthErrors told = *view.performance().errors;
    world.explorer.view.azimuthDegrees += 5;
    draw(true);
    ASSERT_GT(view.performance().report.stride, 1u);
    EXPECT_EQ(view.performance().error(), told.of(view.performance().drawn()));
    EXPECT_NE(view.performance().error(), measured);
    EXPECT_FALSE(view.errorOf(world.shown())) << "it was not measured";
    // As little as an error allows, or all.
    const auto turned = [&](Moving moving, double error) {
        choices.moving = moving;
        choices.movingError = error;
        world.explorer.view.azimuthDegrees += 5;
        draw(true);
        return view.performance().drawn();
    };
    std::set<double> errors;
    for (const RungError& known : told.rungs) errors.insert(known.depth);
    for (const double error : errors) {
        const Rung drawn = turned(Moving::Error, 1.001 * error);
        EXPECT_LE(told.of(drawn), 1.001 * error);
        for (const RungError& known : told.rungs)
            EXPECT_FALSE(known.depth <= 1.001 * error && drawsLess(known.rung, drawn));
    }
    EXPECT_EQ(turned(Moving::All, 1), Rung{Model::Points});
    EXPECT_NE(turned(Moving::Pace, 0), Rung{Model::Points});
    for (const Rung& rung : {Rung{Model::Points, 4, 1}, Rung{Model::Points, 1, kCoarse}}) {
        choices.movingRung = rung;
        EXPECT_EQ(turned(Moving::Fixed, 0), rung);
    }
    // Of another selection nothing is known.
    choices.moving = Moving::Error;
    world.explorer.layers[0].ranges = timeseries::RangeSet::parse("0.2:0.3");
    draw(true);
    EXPECT_FALSE(view.performance().error());
}

// The rest of a frame is the interface's.
TEST(PictureView, WhatMovesFillsFourFifthsOfAFrameAlsoTheFirst) {
    const render::gl::HeadlessContext context;
    tests::ShownSteps world(60);
    panels::Choices choices;
    choices.frameBudget = 20ms;
    PictureView view;
    Canvas canvas, full;
    // What a canvas draws of so many splats, and the view's first frame where each takes so long.
    const auto rungOf = [&](Canvas& by, double splats) {
        const Shown shown = world.shown();
        const CanvasLimits limits{.splats = static_cast<std::uint64_t>(splats),
                                  .mayBeCoarse = true};
        const CanvasReport report =
            by.draw(shown, by.eyesOf(shown), limits, true, [](auto, auto&) {});
        return Rung{Model::Points, report.stride, report.across};
    };
    const auto rungAt = [&](double perSplatNs) {
        view.beginFrom({.points = {{0, perSplatNs, 1e6}}, .cells = {}});
        world.explorer.view.azimuthDegrees += 1e-3;
        const Shown shown = world.shown();
        view.draw(&shown, true, false, choices);
        return view.performance().drawn();
    };
    rungAt(1);
    for (Canvas* each : {&canvas, &full}) rungOf(*each, 20e6);
    unsigned differ = 0;
    for (double perSplatNs = 40; perSplatNs < 400; perSplatNs *= 1.1) {
        const Rung drawn = rungOf(canvas, 0.8 * 20e6 / perSplatNs);
        EXPECT_EQ(rungAt(perSplatNs), drawn) << perSplatNs;
        differ += rungOf(full, 20e6 / perSplatNs) != drawn;
    }
    EXPECT_GT(differ, 0u);
}

}  // namespace
}  // namespace app::desktop
