// The headset's front end against a real runtime: what both eyes are given, what hands do, and what
// is left when the runtime goes.
#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <utility>

#include "app/picture/still.h"
#include "render/image/color.h"
#include "tests/support/headset.h"
#include "tests/support/monado_service.h"
#include "tests/support/shown_steps.h"
#include "tests/xr/monado/api_layer.h"
#include "tests/xr/monado/front_end.h"

namespace app::headset {
namespace {

using namespace std::chrono_literals;

std::vector<glm::u8vec4> pixelsOf(const xr::Eye& eye) {
    std::vector<glm::u8vec4> upwards(std::size_t(eye.size.x) * eye.size.y), rows;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, eye.framebuffer);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, eye.size.x, eye.size.y, GL_RGBA, GL_UNSIGNED_BYTE, upwards.data());
    for (int y = eye.size.y - 1; y >= 0; --y)
        rows.insert(rows.end(), upwards.begin() + y * eye.size.x,
                    upwards.begin() + (y + 1) * eye.size.x);
    return rows;
}

// Where the eye's lenses hide the picture, from the top.
std::vector<bool> hiddenOf(const xr::Eye& eye, const render::View& view) {
    std::vector<bool> hidden(std::size_t(eye.size.x) * eye.size.y);
    for (const auto& [at, size] : hiddenPixels(*eye.hidden, view))
        for (int x = at.x; x < at.x + size.x; ++x)
            hidden[std::size_t(eye.size.y - 1 - at.y) * eye.size.x + x] = true;
    return hidden;
}

// 120 frames as the runtime asks for them, a swaying head's; GL's own encoding of sRGB may round to
// the neighbouring step. What the lenses hide is black.
TEST(HeadsetFrames, BothEyesGetWhatAFileWouldHave) {
    const tests::MonadoService service(tests::Monado::Null);
    const render::gl::HeadlessContext context;
    const auto session = tests::openHeadset(context);
    ASSERT_TRUE(session);
    const tests::ShownSteps world(10);
    const Shown shown = world.shown();
    const render::PlacedPoints placed(shown.sorted->grid(), shown.explorer.scale);
    render::GlStep onGpu(*shown.sorted, placed);
    const Picture picture =
        makePicture(shown.explorer, shown.dataset.variable, shown.step, *shown.sorted, placed);
    render::FrameRenderer renderer;
    const auto nothingHidden = std::make_shared<const render::HiddenArea>();
    Eyes eyes;
    std::optional<xr::Placement> placement;
    for (int drawn = 0; drawn < 120;) {
        const auto frame = session->beginFrame();
        if (!frame || !frame->shouldRender()) continue;
        const auto given = frame->eyes(1);
        if (given.empty() || !frame->head()) continue;
        if (!placement) placement = volumeBefore(*frame->head(), placed.boxHalfEdges());
        eyes.draw(&shown, given, *placement, {}, Eyes::Splats::All);
        std::array views{viewOf(given[0], *placement), viewOf(given[1], *placement)};
        // Of nothing, for which all the same GL draws the lines: their soft edges are a driver's.
        for (render::View& view : views) view.hidden = nothingHidden;
        const auto truth = renderer.render({.scene = picture.scene,
                                            .grid = shown.sorted->grid(),
                                            .legend = {},
                                            .background = kBackground},
                                           onGpu, views);
        for (std::size_t eye = 0; eye < 2; ++eye) {
            const auto pixels = pixelsOf(given[eye]);
            const render::Image& image = truth[eye].image;
            const std::vector<bool> hidden = hiddenOf(given[eye], views[eye]);
            int far = 0, volume = 0;
            for (std::size_t i = 0; i < pixels.size(); ++i) {
                if (hidden[i]) {
                    ASSERT_EQ(pixels[i], glm::u8vec4(0, 0, 0, 255));
                    continue;
                }
                for (int c = 0; c < 3; ++c)
                    far = std::max(
                        far, std::abs(pixels[i][c] - render::srgb8FromLinear(
                                                         static_cast<double>(image.pixels[i][c]))));
                volume += image.pixels[i].r > 0.1f ? 1 : 0;
            }
            ASSERT_LE(far, 1) << "frame " << drawn << ", eye " << eye;
            ASSERT_GT(volume, 1000) << "the volume is seen";
        }
        frame->submit(kNear, kFar);
        ++drawn;
    }
}

TEST_F(FrontEnd, GoesOnWithTheSameStateAfterTheRuntimeIsLost) {
    tests::MonadoService service(tests::Monado::Null);
    open();
    framesUntil([&] { return headset_->interaction().panel().has_value(); });
    world_.exploration.seek(3);
    // A program that takes its time to export.
    const auto exporter = tests::testFolder() / "exporter.sh";
    tests::writeBytes(exporter, "#!/bin/sh\nexec sleep 1000\n");
    std::filesystem::permissions(exporter, std::filesystem::perms::owner_all);
    exporting_.emplace(
        world_.exploration.explorer(),
        FrameFiles(tests::testFolder() / "picture.png", world_.exploration.explorer(), {3}),
        exporter);
    const Explorer before = world_.exploration.explorer();
    service.kill();
    try {
        headset_->run();
        FAIL() << "a session without a runtime";
    } catch (const xr::LostError& lost) {
        EXPECT_THAT(lost.what(), testing::HasSubstr("Monado"));
    }
    headset_.reset();
    EXPECT_TRUE(world_.exploration.explorer() == before);
    ASSERT_TRUE(exporting_);
    exporting_->poll();
    EXPECT_EQ(exporting_->state(), ExportJob::State::Running) << exporting_->outcome();
    world_.until([&] { return world_.exploration.shown()->step == 3; });
}

TEST_F(FrontEnd, ErrorsThatTheRuntimeLeavesInGlAreNoWarning) {
    if (!tests::ApiLayer::isBuilt()) GTEST_SKIP() << tests::ApiLayer::kNotBuilt;
    const tests::MonadoService service(tests::Monado::Null);
    const tests::ApiLayer layer(tests::kGlErrors);
    open();
    framesUntil([&] { return layer.submitted().size() >= 20; });
    EXPECT_THAT(world_.exploration.messages(), testing::IsEmpty());
    headset_.reset();  // before its runtime goes
}

// A panel at which nobody points and on which nothing changes costs nothing.
TEST_F(FrontEnd, ThePanelIsDrawnWhenItChanges) {
    const tests::MonadoService service(tests::Monado::Null);
    open();
    framesUntil([&] { return headset_->interaction().panel().has_value(); });
    const auto until = [&](std::chrono::nanoseconds after) {
        const auto begin = headset_->timing().displayTime;
        int frames = 0;
        framesUntil([&] { return ++frames, headset_->timing().displayTime - begin > after; });
        return frames;
    };
    until(2s);  // all is loaded and bound
    const std::uint64_t before = headset_->panel().timesDrawn();
    const int frames = until(3s);
    EXPECT_LE(headset_->panel().timesDrawn() - before, 7u) << "its numbers, twice a second";
    EXPECT_GT(frames, 10);
    headset_.reset();  // before its runtime goes
}

TEST_F(FrontEnd, WhatPlaysWaitsWhileAnotherProgramHasTheFocus) {
    using Clock = std::chrono::steady_clock;
    const tests::MonadoService service(tests::Monado::Null);
    open();
    Exploration& e = world_.exploration;
    world_.sweep("0:63", 3);
    e.togglePlay();
    Clock::time_point moved = Clock::now();
    std::int64_t last = 0;
    const auto moves = [&] {
        const bool has = std::exchange(last, e.explorer().play.tick) != last;
        if (has) moved = Clock::now();
        return has;
    };
    framesUntil(moves);
    FILE* second = popen(SECOND_CLIENT, "w");
    ASSERT_TRUE(second);
    // It moves some ten times a second otherwise.
    framesUntil([&] { return !moves() && Clock::now() - moved > 1s; });
    EXPECT_TRUE(e.playback().playing);
    EXPECT_EQ(pclose(second), 0);
    framesUntil(moves);
    headset_.reset();  // before its runtime goes
}

TEST_F(FrontEndWithHands, AGrabMovesTheVolumeByExactlyTheHandsMotion) {
    auto& right = devices_.hand(1);
    right.squeeze = right.squeezeForce = 1;
    devices_.send();
    framesUntil([&] { return headset_->interaction().holds(1); });
    const glm::dvec3 before = volume(), by(0.12, 0.2, -0.3);
    right.place = tests::place(glm::dvec3(0.3, 1.1, -0.4) + by);
    devices_.send();
    framesUntil([&] { return glm::distance(volume(), before + by) < 1e-5; });
}

TEST_F(FrontEndWithHands, TwoHandsScaleByTheRatioOfTheirDistances) {
    for (int h = 0; h < 2; ++h) devices_.hand(h).squeeze = devices_.hand(h).squeezeForce = 1;
    devices_.send();
    framesUntil(
        [&] { return headset_->interaction().holds(0) && headset_->interaction().holds(1); });
    const double before = headset_->interaction().placement().metresPerUnit;
    for (int h = 0; h < 2; ++h)
        devices_.hand(h).place = tests::place({h == 0 ? -0.45 : 0.45, 1.1, -0.4});
    devices_.send();
    framesUntil([&] {
        return std::abs(headset_->interaction().placement().metresPerUnit / before - 1.5) < 1e-4;
    });
}

TEST_F(FrontEndWithHands, TheTriggerPlaysAndTheStickMovesTime) {
    Exploration& e = world_.exploration;
    devices_.hand(1).trigger = 1;
    devices_.hand(1).triggerClick = 1;
    devices_.send();
    framesUntil([&] { return e.playback().playing; });
    devices_.hand(1).trigger = 0;
    devices_.hand(1).triggerClick = 0;
    devices_.send();
    e.togglePlay();
    const std::size_t before = e.explorer().steps->first;
    devices_.hand(0).stick = {1, 0};
    devices_.send();
    framesUntil([&] { return e.explorer().steps->first != before; });
}

TEST_F(FrontEndWithHands, TheStickMovesTheWindowAndTheCountFollows) {
    Exploration& e = world_.exploration;
    world_.sweep("0:63", 3);
    const double before = e.playback().sweep->contour();
    devices_.hand(1).stick = {1, 0};
    devices_.send();
    framesUntil([&] { return e.playback().sweep->contour() > before + 10; });
    const timeseries::Range window = e.playback().sweep->window();
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < 64; ++i) {
        const double value = world_.world.value(0, e.shown()->step, i);
        count += value >= timeseries::toDouble(window.lo.value) &&
                         value <= timeseries::toDouble(window.hi.value)
                     ? 1
                     : 0;
    }
    EXPECT_GT(count, 0u);
    EXPECT_EQ(e.counts()->layers.front(), count);
}

}  // namespace
}  // namespace app::headset
