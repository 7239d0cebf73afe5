// A picture at rest, drawn over several frames: the same bits, never more than a slice a call, and
// given up at once.
#include "app/drawing/refinement.h"

#include <gtest/gtest.h>

#include "app/drawing/canvas.h"
#include "render/gl/debug_output.h"
#include "render/gl/headless_context.h"
#include "render/splat/pieces.h"
#include "tests/support/files.h"
#include "tests/support/shown_steps.h"

namespace app {
namespace {

using render::Image;
using timeseries::RangeSet;

// About half of 262,144 points, in calls of 10,000.
class CanvasAtRest : public testing::Test {
 protected:
    static constexpr CanvasLimits kSlice{.splats = 10'000};

    // What a canvas draws at once.
    std::vector<Image> draw(Canvas& canvas, const Shown& shown, const CanvasLimits& limits = {},
                            bool moving = false) {
        std::vector<Image> eyes;
        report_ = canvas.draw(
            shown, canvas.eyesOf(shown), limits, moving,
            [&](std::size_t, const render::Targets& light) { eyes.push_back(light.readLight()); });
        render::gl::throwOnError();
        return eyes;
    }
    // What an eye that knows nothing else would see.
    std::vector<Image> drawApart(const CanvasLimits& limits = {}, bool moving = false) {
        Canvas apart;
        return draw(apart, world_.shown(), limits, moving);
    }
    void refineALittle() {
        for (int i = 0; i < 4; ++i) EXPECT_TRUE(refine(world_.shown()).empty());
        EXPECT_GT(report_.refined, 0);
    }
    // One call; what it showed.
    std::vector<Image> refine(const Shown& shown, std::span<const render::View> eyes) {
        std::vector<Image> images;
        report_ =
            canvas_.refine(shown, eyes, kSlice, [&](std::size_t eye, const render::Targets& light) {
                images.push_back(light.readLight());
                shownEyes_.push_back(eye);
            });
        render::gl::throwOnError();
        return images;
    }
    std::vector<Image> refine(const Shown& shown) { return refine(shown, canvas_.eyesOf(shown)); }
    // All calls that it takes. Each draws a slice, and nothing but the first eye is shown before
    // the last call.
    std::vector<Image> refineWhole(const Shown& shown) {
        std::vector<Image> eyes;
        const std::size_t count = canvas_.eyesOf(shown).size();
        shownEyes_.clear();
        for (double before = 0; eyes.size() < count; before = report_.refined) {
            for (Image& eye : refine(shown)) eyes.push_back(std::move(eye));
            const auto splats = static_cast<double>(report_.selected * count);
            EXPECT_GT(report_.refined, before);
            // An ordered list, a fifth of the work, is made in slices of time.
            const double ordering = world_.explorer.order == render::Order::None ? 0 : splats / 4;
            EXPECT_LE((report_.refined - before) * splats,
                      ordering + static_cast<double>(kSlice.splats + render::kPiecePoints));
            EXPECT_EQ(report_.whole, eyes.size() == count);
        }
        EXPECT_EQ(report_.refined, 1);
        EXPECT_EQ(report_.drawn, report_.selected);
        EXPECT_EQ(shownEyes_, count == 1 ? Eyes{0} : (Eyes{0, 1}));
        return eyes;
    }

    render::gl::HeadlessContext context_;
    tests::ShownSteps world_{64};
    Canvas canvas_;
    CanvasReport report_;
    using Eyes = std::vector<std::size_t>;
    Eyes shownEyes_;  // by refine()
};

TEST_F(CanvasAtRest, SlicesMakeThePictureOfAllPoints) {
    for (const render::Order order : {render::Order::None, render::Order::BackToFront})
        for (const Stereo stereo : {Stereo::Off, Stereo::SideBySide}) {
            world_.explorer.order = order;
            world_.explorer.stereo.mode = stereo;
            const auto whole = draw(canvas_, world_.shown());
            draw(canvas_, world_.shown(), kSlice, true);
            const std::uint64_t drawn = report_.drawn;
            EXPECT_TRUE(refine(world_.shown()).empty());
            EXPECT_EQ(report_.drawn, drawn) << "what is on the screen, while it is refined";
            draw(canvas_, world_.shown(), kSlice, true);
            EXPECT_EQ(refineWhole(world_.shown()), whole);
        }
}

TEST_F(CanvasAtRest, FewPointsAreDrawnInOneCall) {
    world_.explorer.layers[0].ranges = RangeSet::parse("0.1:0.11");
    world_.explorer.layers[1].visible = false;
    world_.explorer.stereo.mode = Stereo::SideBySide;
    const auto whole = draw(canvas_, world_.shown());
    EXPECT_EQ(refine(world_.shown()), whole);
    EXPECT_TRUE(report_.whole);
}

TEST_F(CanvasAtRest, AnotherSelectionShowsInTheNextFrameDrawn) {
    // So thin that no note tells of mixed colours: a moving picture carries the last one on.
    for (LayerChoice& layer : world_.explorer.layers) layer.opacity = 0.005;
    draw(canvas_, world_.shown());
    refineALittle();
    world_.explorer.layers[1].ranges = RangeSet::parse("0.82:0.88");
    EXPECT_EQ(draw(canvas_, world_.shown(), kSlice, true), drawApart(kSlice, true));
    // And nothing of what was given up is in what comes to rest.
    EXPECT_EQ(refineWhole(world_.shown()), drawApart());
    // Nor is it where nothing was drawn between.
    refineALittle();
    world_.explorer.layers[0].color = glm::dvec3(0, 1, 0);
    EXPECT_EQ(refineWhole(world_.shown()), drawApart());
}

TEST_F(CanvasAtRest, OtherEyesAndOtherDrawingBeginItAnew) {
    const auto whole = draw(canvas_, world_.shown());
    refineALittle();
    canvas_.save(world_.shown(), tests::freshFolder() / "saved.exr");
    EXPECT_EQ(refineWhole(world_.shown()), whole);
    refineALittle();
    canvas_.drawPlacards({}, canvas_.eyesOf(world_.shown()),
                         [](std::size_t, const render::Targets&) {});
    EXPECT_EQ(refineWhole(world_.shown()), whole);
    refineALittle();
    world_.explorer.view.azimuthDegrees += 30;
    const auto turned = drawApart();
    EXPECT_EQ(refineWhole(world_.shown()), turned);
    EXPECT_NE(turned, whole);
    // Also where nothing but the eyes is another.
    const auto eyes = canvas_.eyesOf(world_.shown());
    world_.explorer.view.azimuthDegrees -= 30;
    refineALittle();
    std::vector<Image> last;
    while (!report_.whole) last = refine(world_.shown(), eyes);
    EXPECT_EQ(last, turned);
}

TEST_F(CanvasAtRest, AnotherStepBeginsItAnewAlsoWhereTheFirstIsGone) {
    draw(canvas_, world_.shown());
    refineALittle();
    world_.steps[0].reset();
    Canvas apart;
    const auto other = draw(apart, world_.shown(1));
    EXPECT_EQ(refineWhole(world_.shown(1)), other);
}

TEST_F(CanvasAtRest, TimesAreOfItsOwnSlices) {
    world_.explorer.footprint.size = 0.01;  // so that each counts as little more than one
    draw(canvas_, world_.shown());
    for (int i = 0; i < 50; ++i) {
        refine(world_.shown());
        if (!report_.gpuTime) continue;
        EXPECT_LE(report_.gpuSplats, kSlice.splats + 2 * render::kPiecePoints);
        return;
    }
    FAIL() << "no time was told";
}

}  // namespace
}  // namespace app
