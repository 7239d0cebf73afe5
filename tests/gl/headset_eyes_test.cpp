// What a headset's images get is what a file would have, seen with the same poses.
#include "app/headset/eyes.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>

#include "app/headset/standing.h"
#include "app/picture/picture.h"
#include "app/picture/still.h"
#include "render/gl/debug_output.h"
#include "render/gl/headless_context.h"
#include "render/image/color.h"
#include "tests/support/eye_image.h"
#include "tests/support/shown_steps.h"

namespace app::headset {
namespace {

constexpr glm::ivec2 kImage{220, 200}, kDrawn{160, 150};

class HeadsetEyes : public testing::Test {
 protected:
    HeadsetEyes() {
        const double half = 0.0315;  // a distance of 63 mm
        for (int i = 0; i < 2; ++i) {
            const double side = 2 * i - 1;
            // Wider outwards, as headsets are; a head that looks down at the volume.
            eyes_.push_back(
                {.stageFromEye = {glm::angleAxis(-0.4, glm::dvec3(1, 0, 0)), {side * half, 1.6, 0}},
                 .fov = {i == 0 ? -0.8 : -0.6, i == 0 ? 0.6 : 0.8, 0.7, -0.75},
                 .size = kDrawn,
                 .framebuffer = images_[static_cast<std::size_t>(i)].framebuffer.id()});
        }
    }
    // The light of a renderer that has seen nothing else, pictures of `size`.
    std::vector<render::EyePicture> rendered(const Shown& shown, glm::ivec2 size) const {
        const render::PlacedPoints placed(shown.sorted->grid(), shown.explorer.scale);
        render::GlStep onGpu(*shown.sorted, placed);
        const Picture picture =
            makePicture(shown.explorer, shown.dataset.variable, shown.step, *shown.sorted, placed);
        render::FrameRenderer renderer;
        std::array views{viewOf(eyes_[0], placement_), viewOf(eyes_[1], placement_)};
        for (render::View& view : views) view.size = size;
        return renderer.render({.scene = picture.scene,
                                .grid = shown.sorted->grid(),
                                .legend = {},
                                .background = kBackground},
                               onGpu, views);
    }

    // GL's own encoding of sRGB may round to the neighbouring step.
    void expectPicture(std::size_t eye, const render::Image& truth) const {
        ASSERT_EQ(eyes_[eye].size, truth.size);
        const auto pixels = images_[eye].pixels(truth.size);
        int volume = 0;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            for (int c = 0; c < 3; ++c)
                ASSERT_LE(std::abs(pixels[i][c] - render::srgb8FromLinear(
                                                      static_cast<double>(truth.pixels[i][c]))),
                          1)
                    << "eye " << eye << ", pixel " << i;
            volume += truth.pixels[i].r > 0.1f ? 1 : 0;
        }
        EXPECT_GT(volume, 500) << "the volume is seen";
    }

    render::gl::HeadlessContext context_;
    std::array<tests::EyeImage, 2> images_{tests::EyeImage(kImage), tests::EyeImage(kImage)};
    std::vector<xr::Eye> eyes_;
    tests::ShownSteps world_{12};
    Eyes view_;
    const xr::Placement placement_ = volumeBefore(
        {{1, 0, 0, 0}, {0, 1.6, 0}}, render::PlacedPoints(world_.steps[0]->grid()).boxHalfEdges());
};

TEST_F(HeadsetEyes, SeeWhatAFileWouldHave) {
    const Shown shown = world_.shown();
    view_.draw(&shown, eyes_, placement_, {}, Eyes::Splats::All);
    render::gl::throwOnError();
    const auto pictures = rendered(shown, kDrawn);
    for (std::size_t eye = 0; eye < 2; ++eye) expectPicture(eye, pictures[eye].image);
    EXPECT_NE(images_[0].pixels(kDrawn), images_[1].pixels(kDrawn));
}

// As headsets may recommend, and as the share that is drawn of them changes.
TEST_F(HeadsetEyes, MayBeOfDifferentSizes) {
    const Shown shown = world_.shown();
    for (const auto& [left, right] : {std::pair{glm::ivec2(160, 150), glm::ivec2(220, 200)},
                                      {glm::ivec2(140, 120), glm::ivec2(200, 180)},
                                      {glm::ivec2(180, 160), glm::ivec2(180, 160)}}) {
        eyes_[0].size = left;
        eyes_[1].size = right;
        view_.draw(&shown, eyes_, placement_, {}, Eyes::Splats::All);
        render::gl::throwOnError();
        expectPicture(0, rendered(shown, left)[0].image);
        expectPicture(1, rendered(shown, right)[1].image);
    }
}

// Of one eye alone, beneath a slope from corner to corner of its field of view, and a notch above.
TEST_F(HeadsetEyes, WhatALensHidesIsBlackAndFarAndNothingElseChanges) {
    const Shown shown = world_.shown();
    const xr::Fov& fov = eyes_[1].fov;
    const glm::dvec2 lo(std::tan(fov.left), std::tan(fov.down)),
        hi(std::tan(fov.right), std::tan(fov.up));
    const auto area = std::make_shared<render::HiddenArea>(
        render::HiddenArea{{lo, {hi.x, lo.y}, hi, {-0.2, hi.y}, {0, 0.1}, {0.3, hi.y}}});
    eyes_[1].hidden = area;
    // A wall behind the volume, as large as the sight: also its depth is left out.
    const Plate wall{{{1, 0, 0, 0}, {0, 1.6, -3}}, {9, 9}};
    const std::array placards{
        render::Placard{worldFromPlacard(wall, placement_), glm::vec3(0, 0, 1)}};
    for (const bool withData : {true, false}) {
        const auto draw = [&] {
            view_.draw(withData ? &shown : nullptr, eyes_, placement_, placards, Eyes::Splats::All);
            render::gl::throwOnError();
            return std::array{images_[0].pixels(kDrawn), images_[1].pixels(kDrawn)};
        };
        eyes_[1].hidden = nullptr;
        const auto whole = draw();
        eyes_[1].hidden = area;
        const auto masked = draw();
        EXPECT_EQ(masked[0], whole[0]);
        std::vector<bool> hidden(whole[1].size());
        for (const auto& [at, size] : hiddenPixels(*area, viewOf(eyes_[1], placement_)))
            for (int x = at.x; x < at.x + size.x; ++x)
                hidden[std::size_t(kDrawn.y - 1 - at.y) * kDrawn.x + x] = true;
        int lost = 0;
        for (int y = 0; y < kDrawn.y; ++y)
            for (int x = 0; x < kDrawn.x; ++x) {
                const std::size_t i = std::size_t(kDrawn.y - 1 - y) * kDrawn.x + x;
                lost += hidden[i] && whole[1][i].r > 100 ? 1 : 0;
                ASSERT_EQ(masked[1][i], hidden[i] ? glm::u8vec4(0, 0, 0, 255) : whole[1][i])
                    << x << ' ' << y;
                ASSERT_EQ(images_[1].depthAt({x, y}) == 1.0f, hidden[i]) << x << ' ' << y;
            }
        EXPECT_EQ(lost > 100, withData) << "something of the volume is hidden";
    }
}

TEST_F(HeadsetEyes, TheDepthIsThatOfTheOpaqueThings) {
    const Shown shown = world_.shown();
    // A wall 2 m ahead, as large as the sight.
    const Plate wall{{{1, 0, 0, 0}, {0, 1.6, -2}}, {9, 9}};
    const std::array placards{
        render::Placard{worldFromPlacard(wall, placement_), glm::vec3(0, 0, 1)}};
    view_.draw(&shown, eyes_, placement_, placards, Eyes::Splats::All);
    render::gl::throwOnError();
    // A level eye sees the wall at the depth of 2 m everywhere.
    eyes_[0].stageFromEye.orientation = {1, 0, 0, 0};
    view_.draw(&shown, eyes_, placement_, placards, Eyes::Splats::All);
    const double expected = kFar * (2 - kNear) / (2 * (kFar - kNear));
    for (const glm::ivec2 at : {glm::ivec2(3, 3), {80, 140}, {150, 20}})
        EXPECT_NEAR(static_cast<double>(images_[0].depthAt(at)), expected, 1e-5);
}

TEST_F(HeadsetEyes, WithoutDataThereIsStillARoom) {
    const Plate wall{{{1, 0, 0, 0}, {0, 1.2, -1}}, {0.2, 0.2}};
    const std::array placards{
        render::Placard{worldFromPlacard(wall, placement_), glm::vec3(0, 1, 0)}};
    view_.draw(nullptr, eyes_, placement_, placards, Eyes::Splats::All);
    render::gl::throwOnError();
    eyes_[1].size = kImage;
    view_.draw(nullptr, eyes_, placement_, placards, Eyes::Splats::All);
    render::gl::throwOnError();
    for (const tests::EyeImage& image : images_) {
        int green = 0;
        for (const glm::u8vec4& pixel : image.pixels(kDrawn)) green += pixel.g == 255 ? 1 : 0;
        EXPECT_GT(green, 100);
        EXPECT_EQ(image.pixels(kDrawn)[0].r,
                  render::srgb8FromLinear(static_cast<double>(kBackground.r)));
    }
}

// Between all of its cells and points that stand for them: of what fits the pace the truest is
// drawn.
TEST_F(HeadsetEyes, DrawCellsInCoarsePixelsWhereFinerOnesDoNotFit) {
    tests::ShownSteps cells(8, 1);
    cells.explorer.model = Model::Cells;
    cells.explorer.footprint.size = 0.2;  // so that points fit, also where pixels cost most
    (void)cells.steps[0]->cells(cellsNeeded(cells.explorer, cells.steps[0]->type()));
    const Shown shown = cells.shown();
    for (xr::Eye& eye : eyes_) eye.size = glm::ivec2(400);
    const auto drawn = [&](const DepthErrors* errors) {
        view_.draw(&shown, eyes_, placement_, {}, Eyes::Splats::Governed, {}, errors);
        const CanvasReport& report = view_.report();
        return Rung{report.cells ? Model::Cells : Model::Points, report.stride, report.across};
    };
    EXPECT_EQ(drawn(nullptr), (Rung{Model::Cells, 1, kCoarse}));
    DepthErrors errors;
    for (const Rung& rung : ladder({})) errors.rungs.push_back({.rung = rung, .depth = 0.5});
    errors.rungs[2].depth = 0.1;
    EXPECT_EQ(drawn(&errors), errors.rungs[2].rung) << "whose error is less";
    const Rung most{Model::Points, 4};
    view_.draw(&shown, eyes_, placement_, {}, Eyes::Splats::Governed, {}, &errors, most);
    EXPECT_EQ(view_.report().stride, 4u) << "and no more than may be";
}

TEST_F(HeadsetEyes, KeepTheDisplaysPaceWithFewerSplatsThenFewerPixels) {
    using namespace std::chrono_literals;
    using Clock = std::chrono::steady_clock;
    const Shown shown = world_.shown();
    EXPECT_EQ(view_.scale(), 1);
    for (int i = 0; i < 100; ++i) {
        view_.draw(&shown, eyes_, placement_, {}, Eyes::Splats::Governed);
        view_.took(Clock::now() - 1ms, 1us);
    }
    EXPECT_EQ(view_.scale(), 0.5);
    for (int i = 0; i < 100; ++i) view_.took(Clock::now(), 1s);
    EXPECT_EQ(view_.scale(), 1);
}

}  // namespace
}  // namespace app::headset
