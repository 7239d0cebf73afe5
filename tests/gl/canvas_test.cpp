// What a window draws: the same pictures as files, in time.
#include "app/drawing/canvas.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/choices/camera.h"
#include "app/choices/session.h"
#include "app/files/picture_files.h"
#include "app/picture/still.h"
#include "render/gl/debug_output.h"
#include "render/gl/headless_context.h"
#include "render/image/exr.h"
#include "render/image/png.h"
#include "render/model/splat_cost.h"
#include "render/reference/image_compare.h"
#include "render/splat/gl_cells.h"
#include "tests/support/files.h"
#include "tests/support/shown_steps.h"

namespace app {
namespace {

using render::Image;
using timeseries::RangeSet;

class CanvasOfNoise : public testing::Test {
 protected:
    std::vector<Image> draw(const Shown& shown, const CanvasLimits& limits = {},
                            bool moving = false) {
        std::vector<Image> eyes;
        const auto views = canvas_.eyesOf(shown);
        report_ = canvas_.draw(shown, views, limits, moving,
                               [&](std::size_t eye, const render::Targets& light) {
                                   EXPECT_EQ(eye, eyes.size());
                                   eyes.push_back(light.readLight());
                               });
        render::gl::throwOnError();
        return eyes;
    }
    // As `isochron render` makes it: a renderer and a step on the GPU that have seen nothing else.
    void drawApart(const Shown& shown, const std::filesystem::path& file) {
        render::FrameRenderer renderer(render::SplatterChoice::Gl);
        const render::PlacedPoints placed(shown.sorted->grid(), shown.explorer.scale);
        render::GpuStep onGpu(*shown.sorted, placed);
        writeStill({shown.explorer, shown.dataset.about, shown.step, *shown.sorted, placed, 0},
                   renderer, onGpu, {}, file);
    }

    render::gl::HeadlessContext context_;
    tests::ShownSteps world_{20};
    Canvas canvas_{render::SplatterChoice::Gl};
    CanvasReport report_;
    const std::uint64_t stepBytes_ = world_.steps[0]->size() * 10;  // points and values
};

TEST_F(CanvasOfNoise, AtRestAllPointsAreDrawnForEveryEye) {
    for (const render::Order order : {render::Order::None, render::Order::BackToFront}) {
        world_.explorer.order = order;
        for (const Stereo stereo : {Stereo::Off, Stereo::SideBySide}) {
            world_.explorer.stereo.mode = stereo;
            const auto eyes = draw(world_.shown(), {.splats = 100});
            ASSERT_EQ(eyes.size(), stereo == Stereo::Off ? 1u : 2u);
            if (eyes.size() == 2) {
                EXPECT_NE(eyes[0], eyes[1]);
            }
            const auto& step = *world_.steps[0];
            EXPECT_EQ(report_.selected, step.count(RangeSet::parse("0.1:0.4")) +
                                            step.count(RangeSet::parse("0.8:0.9")));
            EXPECT_EQ(report_.drawn, report_.selected);
            EXPECT_EQ(report_.stride, 1u);
            EXPECT_TRUE(report_.whole);
            EXPECT_EQ(report_.counts->selected, report_.selected) << "the layers are apart";
        }
    }
}

TEST_F(CanvasOfNoise, WhatIsDrawnIsWhatIsSaved) {
    const Image drawn = draw(world_.shown())[0];
    const auto file = tests::freshFolder() / "saved.exr";
    canvas_.save(world_.shown(), file);
    EXPECT_EQ(render::readExr(file).views[0].image, drawn);
}

TEST_F(CanvasOfNoise, MovingKeepsToTheLimitOfAllEyesAndRestsWhole) {
    // Of all eyes, in ordinary splats; those of a subset are larger.
    const auto cost = [&](std::uint32_t stride) {
        const Shown shown = world_.shown();
        const render::PlacedPoints placed(shown.sorted->grid());
        Picture picture =
            makePicture(shown.explorer, shown.dataset.about, 0, *shown.sorted, placed);
        picture.scene.stride = stride;
        picture.scene.footprint.size *= std::cbrt(stride);
        double sum = 0;
        for (const render::View& view : canvas_.eyesOf(shown))
            sum += render::sceneCost(picture.scene, view);
        return sum;
    };
    for (const render::Order order : {render::Order::None, render::Order::BackToFront}) {
        world_.explorer.order = order;
        for (const Stereo stereo : {Stereo::Off, Stereo::SideBySide}) {
            world_.explorer.stereo.mode = stereo;
            const CanvasLimits limits{.splats = 2'000};
            const Image moving = draw(world_.shown(), limits, true)[0];
            EXPECT_LE(cost(report_.stride), limits.splats);
            ASSERT_GT(report_.stride, 1u);
            EXPECT_GT(cost(report_.stride / 2), limits.splats) << "the least stride that does";
            EXPECT_FALSE(report_.whole);
            const Image resting = draw(world_.shown(), limits, false)[0];
            EXPECT_TRUE(report_.whole);
            EXPECT_NE(moving, resting);
            double light = 0, whole = 0;
            for (std::size_t i = 0; i < moving.pixels.size(); ++i) {
                light += static_cast<double>(moving.pixels[i].g);
                whole += static_cast<double>(resting.pixels[i].g);
            }
            EXPECT_NEAR(light, whole, 0.1 * whole) << "a subset is as bright";
        }
    }
}

TEST_F(CanvasOfNoise, CellsRestWholeAndPointsStandForThemWhileTheyWouldTakeTooLong) {
    const Image points = draw(world_.shown())[0];
    world_.explorer.model = Model::Cells;
    for (const render::Order order : {render::Order::None, render::Order::BackToFront}) {
        world_.explorer.order = order;
        const Image cells = draw(world_.shown())[0];
        EXPECT_TRUE(report_.whole);
        EXPECT_NE(cells, points);
        EXPECT_EQ(draw(world_.shown(), {.splats = 100'000'000}, true)[0], cells);
        EXPECT_TRUE(report_.whole);
        EXPECT_GT(report_.cells, 0u);
        EXPECT_NE(draw(world_.shown(), {.splats = 2'000}, true)[0], cells);
        EXPECT_FALSE(report_.whole);
        EXPECT_FALSE(report_.cells) << "but points";
        EXPECT_GT(report_.stride, 1u) << "of points";
        // In slices.
        Image refined;
        int calls = 0;
        do {
            const auto views = canvas_.eyesOf(world_.shown());
            report_ = canvas_.refine(
                world_.shown(), views, {.splats = 2'000},
                [&](std::size_t, const render::Targets& light) { refined = light.readLight(); });
            EXPECT_EQ(report_.cells.has_value(), report_.whole) << "until then points are shown";
        } while (!report_.whole && ++calls < 1000);
        EXPECT_GT(calls, 1);
        EXPECT_EQ(refined, cells);
    }
}

// Of a step of which no points were drawn before.
TEST_F(CanvasOfNoise, PointsThatStandForCellsComeToTheGpu) {
    world_.explorer.model = Model::Cells;
    world_.explorer.order = render::Order::None;
    const Image image = draw(world_.shown(), {.splats = 2'000}, true)[0];
    EXPECT_TRUE(report_.lacksCells);
    EXPECT_GT(report_.stride, 1u);
    world_.explorer.model = Model::Points;
    EXPECT_EQ(render::comparePictures(draw(world_.shown(), {.splats = 2'000}, true)[0], image)
                  .maxAbsolute,
              0)
        << "but for what the legend says";
}

// Points stand for them until then; afterwards the picture is the one that files have.
TEST_F(CanvasOfNoise, CellsOfALargeStepComeLater) {
    world_ = tests::ShownSteps(102, 1);
    world_.explorer.model = Model::Cells;
    world_.explorer.layers = {
        tests::ShownSteps::layer("0.5:0.501", app::MapChoice{{}, 0.5, 0.501})};
    Canvas canvas(render::SplatterChoice::Cpu);
    const auto views = canvas.eyesOf(world_.shown());
    Image image;
    CanvasReport report;
    const auto draw = [&] {
        report = canvas.draw(
            world_.shown(), views, {}, false,
            [&](std::size_t, const render::Targets& light) { image = light.readLight(); });
    };
    draw();
    EXPECT_TRUE(report.lacksCells);
    EXPECT_FALSE(report.whole);
    const Image points = image;
    world_.steps[0]->cells();  // waits for whoever makes them
    draw();
    EXPECT_TRUE(report.whole);
    EXPECT_NE(image, points);
    const auto file = tests::freshFolder() / "saved.exr";
    canvas.save(world_.shown(), file);
    EXPECT_EQ(render::readExr(file).views[0].image, image) << "the legend's words, too";
}

TEST_F(CanvasOfNoise, MovingBelowTheLimitDrawsAll) {
    const Image resting = draw(world_.shown())[0];
    EXPECT_EQ(draw(world_.shown(), {.splats = 100 * report_.selected}, true)[0], resting);
    EXPECT_EQ(report_.stride, 1u);
    EXPECT_TRUE(report_.whole);
}

// Noise on 64^3 points: eight blocks on the GPU, block b of the values [b / 8, (b + 1) / 8), near
// enough.
class CanvasOfBlocks : public CanvasOfNoise {
 protected:
    CanvasOfBlocks() {
        world_ = tests::ShownSteps(64);
        world_.explorer.order = render::Order::None;  // in order lists bring their own points
    }
    static constexpr std::uint64_t kBlockBytes = render::GpuStep::kBlock * 10;
};

TEST_F(CanvasOfBlocks, AStepComesInSlicesAndTheOneBeforeStays) {
    // 0.1 to 0.4 and 0.8 to 0.9 touch blocks 0 to 3, 6 and 7.
    const CanvasLimits limits{.uploadBytes = 2 * kBlockBytes};
    // Counted of the step on the screen: the one before while another comes.
    const auto countsAreOf = [&](std::size_t step) {
        EXPECT_EQ(report_.counts, pointCounts(world_.explorer, *world_.steps[step]));
        EXPECT_EQ(report_.selected, report_.counts->selected);
    };
    const auto comes = [&](std::size_t step) {
        std::vector<std::vector<Image>> frames;
        for (int i = 0; i < 3; ++i) {
            frames.push_back(draw(world_.shown(step), limits));
            if (!frames.back().empty()) countsAreOf(i < 2 ? 0 : step);
            EXPECT_DOUBLE_EQ(report_.uploaded, 1 - (2 - i) / 3.0) << step << ' ' << i;
            EXPECT_EQ(report_.whole, i == 2);
        }
        return frames;
    };
    const auto first = comes(0);
    for (int i = 0; i < 2; ++i) EXPECT_TRUE(first[i].empty()) << "nothing is there yet";
    ASSERT_EQ(first[2].size(), 1u);
    EXPECT_EQ(report_.step, 0u);
    const auto second = comes(1);
    for (int i = 0; i < 2; ++i) EXPECT_EQ(second[i], first[2]) << "the step before";
    EXPECT_NE(second[2], first[2]);
    EXPECT_EQ(report_.step, 1u);
    // Back again: it is still there.
    EXPECT_EQ(draw(world_.shown(0), limits), first[2]);
    EXPECT_TRUE(report_.whole);
    EXPECT_EQ(report_.gpuBytes / (8 * kBlockBytes), 2u);
}

// The step before stays until then, or its cells would be drawn over the limit.
TEST_F(CanvasOfBlocks, AMovingStepWhoseCellsAreTooManyWaitsForItsPoints) {
    world_ = tests::ShownSteps(64, 3);
    world_.explorer.order = render::Order::None;
    world_.explorer.model = Model::Cells;
    for (const auto& step : world_.steps) step->cells();
    draw(world_.shown(0));
    const CanvasLimits limits{.splats = 2'000, .uploadBytes = 64};
    draw(world_.shown(1), limits, true);
    EXPECT_EQ(report_.step, 0u);
    EXPECT_LT(report_.uploaded, 1);
    for (int calls = 0; report_.step == 0 && calls < 10'000; ++calls)
        draw(world_.shown(1), limits, true);
    EXPECT_EQ(report_.step, 1u);
    EXPECT_FALSE(report_.cells);
    EXPECT_GT(report_.stride, 1u);
    // With room for them nothing waits.
    draw(world_.shown(2), {.splats = 100'000'000, .uploadBytes = 64}, true);
    EXPECT_EQ(report_.step, 2u);
    EXPECT_TRUE(report_.cells);
}

TEST_F(CanvasOfBlocks, AnotherSelectionOfTheStepOnTheScreenComesInSlicesOfEightfoldSize) {
    const auto select = [&](const char* ranges) {
        world_.explorer.layers = {tests::ShownSteps::layer(ranges, MapChoice{{}, 0.1, 0.4})};
    };
    select("0.01:0.1");
    draw(world_.shown());
    EXPECT_DOUBLE_EQ(report_.uploaded, 1);
    select("0.01:0.6");  // four blocks more
    const auto wider = draw(world_.shown(), {.uploadBytes = kBlockBytes / 2});
    EXPECT_TRUE(report_.whole);
    select("0.01:0.99");  // three more, of eight
    for (int i = 0; i < 2; ++i) {
        EXPECT_EQ(draw(world_.shown(), {.uploadBytes = kBlockBytes / 8}), wider)
            << "the choices before";
        EXPECT_DOUBLE_EQ(report_.uploaded, (6 + i) / 8.0);
        EXPECT_EQ(report_.counts->selected, report_.selected) << "as they are on the screen";
        EXPECT_FALSE(report_.whole);
    }
    EXPECT_NE(draw(world_.shown(), {.uploadBytes = kBlockBytes / 8}), wider);
    EXPECT_TRUE(report_.whole);
}

TEST_F(CanvasOfBlocks, WhatTheProgramSumsItselfIsThereAtOnce) {
    const CanvasLimits limits{.uploadBytes = 64};
    while (!report_.whole) draw(world_.shown(), limits);
    const Image byGl = draw(world_.shown(), limits)[0];
    Canvas own(render::SplatterChoice::Cpu);
    std::vector<Image> eyes;
    const Shown shown = world_.shown();
    const CanvasReport report = own.draw(
        shown, own.eyesOf(shown), limits, false,
        [&](std::size_t, const render::Targets& light) { eyes.push_back(light.readLight()); });
    EXPECT_TRUE(report.whole);
    EXPECT_EQ(report.uploaded, 1);
    EXPECT_LT(report.gpuBytes, kBlockBytes) << "no points";
    ASSERT_EQ(eyes.size(), 1u);
    EXPECT_LE(render::comparePictures(eyes[0], byGl).maxAbsolute, 1e-4);
}

TEST_F(CanvasOfBlocks, ChoicesShowAtOnceWhileAStepComes) {
    draw(world_.shown(0));
    world_.explorer.layers[1].color = glm::dvec3(0, 0, 1);
    const CanvasLimits slice{.uploadBytes = 64};
    const Image coming = draw(world_.shown(1), slice)[0];
    EXPECT_EQ(report_.step, 0u);
    EXPECT_EQ(coming, draw(world_.shown(0))[0]) << "the step before, in its new colour";
    // What they select is not there of the step on the screen.
    world_.explorer.layers[1].ranges = RangeSet::parse("0.55:0.6");
    EXPECT_EQ(draw(world_.shown(1), slice)[0], coming);
    EXPECT_EQ(report_.step, 0u);
}

TEST_F(CanvasOfNoise, AnotherDatasetIsNotDrawnWithChoicesThatAreNotItsOwn) {
    const Image before = draw(world_.shown(0))[0];
    tests::ShownSteps other(47);
    other.explorer.files = {"other.nc"};
    other.explorer.layers = {tests::ShownSteps::layer("0:1", glm::dvec3(1))};
    EXPECT_EQ(draw(other.shown(0), {.uploadBytes = 64})[0], before);
    EXPECT_FALSE(report_.whole);
    EXPECT_TRUE(canvas_.shows(world_.explorer) && !canvas_.shows(other.explorer));
    EXPECT_NE(draw(other.shown(0))[0], before);
    EXPECT_TRUE(report_.whole);
    EXPECT_TRUE(canvas_.shows(other.explorer) && !canvas_.shows(world_.explorer));
}

TEST_F(CanvasOfNoise, StepsThatAreNotDrawnAreFreedBeyondTheBudget) {
    tests::ShownSteps many(20, 6);
    many.explorer.order = render::Order::None;  // in order lists bring their own points
    const CanvasLimits two{.cacheBytes = 2 * stepBytes_ + stepBytes_ / 2};
    for (std::size_t i = 0; i < 6; ++i) draw(many.shown(i), two);
    EXPECT_EQ(report_.gpuBytes / stepBytes_, 3u) << "the one drawn and two more";
    // The reader's copies go: nobody can ask for these again.
    const auto last = many.shown(5);
    for (std::size_t i = 0; i < 5; ++i) many.steps[i].reset();
    draw(last, two);
    EXPECT_EQ(report_.gpuBytes / stepBytes_, 1u);
}

TEST_F(CanvasOfNoise, OtherProportionsMoveThePointsWithoutUploadingThem) {
    draw(world_.shown());
    world_.explorer.scale = glm::dvec3(1, 1, 3);
    const Image stretched = draw(world_.shown(), {.uploadBytes = 0})[0];
    EXPECT_TRUE(report_.whole);
    Canvas apart{render::SplatterChoice::Gl};
    std::optional<Image> expected;
    apart.draw(world_.shown(), apart.eyesOf(world_.shown()), {}, false,
               [&](std::size_t, const render::Targets& light) { expected = light.readLight(); });
    EXPECT_EQ(stretched, *expected);
}

TEST_F(CanvasOfNoise, AMapThatMovesALittleUploadsNothing) {
    draw(world_.shown());
    auto& map = std::get<MapChoice>(*world_.explorer.layers[0].color);
    map.lo = 0.2;
    map.hi = 0.3;
    const Image drawn = draw(world_.shown(), {.uploadBytes = 0})[0];
    EXPECT_TRUE(report_.whole);
    const auto file = tests::freshFolder() / "saved.exr";
    canvas_.save(world_.shown(), file);
    EXPECT_LE(render::comparePictures(drawn, render::readExr(file).views[0].image).maxAbsolute,
              1e-4);
}

TEST_F(CanvasOfNoise, ProbesTellWhatStandsThere) {
    EXPECT_FALSE(canvas_.probe(canvas_.eyesOf(world_.shown())[0], {100, 75}));
    draw(world_.shown());
    const auto view = canvas_.eyesOf(world_.shown())[0];
    const auto probe = canvas_.probe(view, {100, 75});
    ASSERT_TRUE(probe);
    const auto& step = *world_.steps[0];
    const std::uint64_t i = probe->index[0] + 20 * (probe->index[1] + 20 * probe->index[2]);
    EXPECT_EQ(probe->picked.gridIndex, i);
    const auto point = std::ranges::find(step.gridIndex(), i) - step.gridIndex().begin();
    EXPECT_EQ(probe->picked.value, step.value(static_cast<std::uint64_t>(point)));
    EXPECT_EQ(probe->coordinates, step.grid().position(i));
    EXPECT_EQ(probe->picked.world, canvas_.drawn()->placed->position(i));
    const double value = timeseries::toDouble(probe->picked.value);
    ASSERT_TRUE(probe->layer);
    EXPECT_TRUE(*probe->layer == 0 ? 0.1 <= value && value <= 0.4 : 0.8 <= value && value <= 0.9)
        << *probe->layer << ' ' << value;
    // A hidden layer is not seen, and the others keep their places.
    world_.explorer.layers[0].visible = false;
    draw(world_.shown());
    const auto behind = canvas_.probe(view, {100, 75});
    ASSERT_TRUE(behind);
    EXPECT_EQ(behind->layer, 1u);
    // The swept window is none of the layers.
    world_.explorer.layers[1].visible = false;
    world_.explorer.sweep.emplace();
    world_.explorer.sweep->animation = RangeSet::parse("0.4:0.6");
    world_.explorer.sweep->delta = 0.1;
    world_.explorer.sweepLayer = tests::ShownSteps::layer("0:1", glm::dvec3(1));
    draw(world_.shown());
    const auto swept = canvas_.probe(view, {100, 75});
    ASSERT_TRUE(swept);
    EXPECT_FALSE(swept->layer);
}

// What was shown last is asked: cells, or the points that stood for them.
TEST_F(CanvasOfNoise, ProbesTellWhatIsSeenBetweenPointsWhereCellsAre) {
    world_.explorer.model = Model::Cells;
    draw(world_.shown());
    const auto view = canvas_.eyesOf(world_.shown())[0];
    const auto cell = canvas_.probe(view, {100, 75});
    ASSERT_TRUE(cell);
    ASSERT_TRUE(cell->layer && cell->picked.between);
    const double seen = *cell->picked.between;
    EXPECT_TRUE(*cell->layer == 0 ? 0.1 <= seen && seen <= 0.4 : 0.8 <= seen && seen <= 0.9);
    draw(world_.shown(), {.cells = 1}, true);
    const auto point = canvas_.probe(view, {100, 75});
    ASSERT_TRUE(point);
    EXPECT_FALSE(point->picked.between);
}

TEST_F(CanvasOfNoise, TimesComeSomeFramesLaterForTheSplatsTheyAreOf) {
    world_.explorer.footprint.size = 0.1;  // so that each counts as one
    bool timed = false;
    for (int i = 0; i < 50 && !timed; ++i) {
        draw(world_.shown());
        timed = report_.gpuTime.has_value();
    }
    ASSERT_TRUE(timed);
    EXPECT_GT(report_.gpuTime->count(), 0);
    EXPECT_EQ(report_.gpuSplats, report_.drawn);
    EXPECT_EQ(report_.cost, report_.drawn);
    EXPECT_FALSE(report_.gpuCells);
    world_.explorer.model = Model::Cells;
    timed = false;
    for (int i = 0; i < 50 && !timed; ++i) {
        draw(world_.shown());
        timed = report_.gpuTime && report_.gpuCells;
    }
    EXPECT_TRUE(timed);
    EXPECT_EQ(report_.gpuSplats, report_.cost);
    EXPECT_NE(report_.cost, report_.drawn);
}

TEST_F(CanvasOfNoise, CellsOnTheGpuCount) {
    world_.explorer.order = render::Order::None;
    for (int i = 0; i < 2; ++i) draw(world_.shown());
    const std::uint64_t points = report_.gpuBytes;
    world_.explorer.model = Model::Cells;
    for (int i = 0; i < 2; ++i) draw(world_.shown());
    ASSERT_TRUE(report_.cells);
    // Not every cell that is looked at reaches into its range.
    EXPECT_GT(report_.gpuBytes, points + *report_.cells * sizeof(render::GlCell) / 2);
    EXPECT_LT(report_.gpuBytes, points + *report_.cells * sizeof(render::GlCell) * 2);
}

TEST_F(CanvasOfNoise, CellsHaveALimitOfTheirOwn) {
    world_.explorer.model = Model::Cells;
    draw(world_.shown());
    draw(world_.shown(), {.splats = 100'000'000, .cells = 2'000}, true);
    EXPECT_TRUE(report_.lacksCells);
    EXPECT_EQ(report_.stride, 1u);
    draw(world_.shown(), {.splats = 2'000, .cells = 100'000'000}, true);
    EXPECT_FALSE(report_.lacksCells);
}

// Saving from a window that has drawn other things before, against a render that has not.
class CanvasSaves : public CanvasOfNoise,
                    public testing::WithParamInterface<std::pair<Stereo, const char*>> {};

TEST_P(CanvasSaves, TheBytesThatItsSessionIsRenderedTo) {
    const auto& [stereo, ending] = GetParam();
    draw(world_.shown(1), {.splats = 500}, true);
    world_.explorer.stereo.mode = stereo;
    std::get<MapChoice>(*world_.explorer.layers[0].color).hi = 0.35;
    draw(world_.shown(0), {.splats = 500}, true);
    const auto folder = tests::freshFolder();
    const auto saved = folder / ("saved" + std::string(ending));
    canvas_.save(world_.shown(0), saved);
    const auto files = filesOf(saved, stereo);
    // What it carries draws it again, byte for byte.
    const std::string session = files[0].extension() == ".png"
                                    ? render::readPng(files[0]).metadata.at(kSessionKey)
                                    : render::readExr(files[0]).metadata.at(kSessionKey);
    world_.explorer = fromJson(nlohmann::json::parse(session), folder);
    EXPECT_EQ(world_.explorer.steps, (StepChoice{0, 0}));
    const auto apart = folder / ("apart" + std::string(ending));
    drawApart(world_.shown(0), apart);
    for (std::size_t i = 0; i < files.size(); ++i)
        EXPECT_EQ(tests::readBytes(files[i]), tests::readBytes(filesOf(apart, stereo)[i])) << i;
}

INSTANTIATE_TEST_SUITE_P(
    AllFiles, CanvasSaves,
    testing::Values(std::pair(Stereo::Off, ".png"), std::pair(Stereo::Off, ".exr"),
                    std::pair(Stereo::SideBySide, ".png"), std::pair(Stereo::SideBySide, ".exr"),
                    std::pair(Stereo::TopBottom, ".png"), std::pair(Stereo::TopBottom, ".exr"),
                    std::pair(Stereo::LeftRight, ".png"), std::pair(Stereo::LeftRight, ".exr"),
                    std::pair(Stereo::MultiView, ".exr")));

}  // namespace
}  // namespace app
