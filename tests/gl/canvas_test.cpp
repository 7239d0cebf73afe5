// What a window draws: the same pictures as files, in time.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/choices/camera.h"
#include "app/choices/session.h"
#include "app/choices/sweep_edits.h"
#include "app/drawing/canvas.h"
#include "app/files/picture_files.h"
#include "app/picture/still.h"
#include "render/gl/headless_context.h"
#include "render/image/exr.h"
#include "render/image/png.h"
#include "render/reference/image_compare.h"
#include "tests/support/canvas_of_noise.h"
#include "tests/support/files.h"
#include "tests/support/shown_steps.h"
#include "tests/support/unstructured.h"

namespace app {
namespace {

using render::Image;
using timeseries::RangeSet;
using namespace app::canvas_of_noise;

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
    for (const render::Order order : {render::Order::None, render::Order::BackToFront}) {
        world_.explorer.order = order;
        for (const Stereo stereo : {Stereo::Off, Stereo::SideBySide}) {
            world_.explorer.stereo.mode = stereo;
            const CanvasLimits limits{.splats = static_cast<std::uint64_t>(cost(1) / 4)};
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

TEST_F(CanvasOfNoise, MovingBelowTheLimitDrawsAll) {
    const Image resting = draw(world_.shown())[0];
    EXPECT_EQ(draw(world_.shown(), {.splats = 100 * report_.selected}, true)[0], resting);
    EXPECT_EQ(report_.stride, 1u);
    EXPECT_TRUE(report_.whole);
}

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
    EXPECT_GE(report_.gpuBytes / (6 * kBlockBytes), 2u) << "of six blocks each, and for order";
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
    // A GPU's lines may take other pixels at their edges, and hide other splats there.
    const render::PictureError error = render::comparePictures(eyes[0], byGl, 0.004);
    EXPECT_LE(error.differingPixels, 200 * 150 / 500);
    EXPECT_LE(error.maxAbsolute, 0.06);
    EXPECT_GE(error.psnrLinear, 60);
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
    many.explorer.order = render::Order::None;  // which would take room of its own
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

TEST_F(CanvasOfNoise, ProbesTellTheCellOfAMesh) {
    const auto cells =
        tests::bricks({9, 9, 9}, tests::Cut::Hexahedra,
                      [](double i, double j, double k) { return glm::dvec3(i, j, k); });
    const auto grid = tests::gridOf(tests::atCells(cells));
    world_.steps[0] = std::make_shared<const timeseries::SortedStep>(tests::noise(grid, 1));
    world_.dataset.variable.grid = grid;
    draw(world_.shown());
    const auto probe = canvas_.probe(canvas_.eyesOf(world_.shown())[0], {100, 75});
    ASSERT_TRUE(probe);
    EXPECT_EQ(probe->cell, fmt::format("{}, hexahedron", probe->picked.gridIndex));
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
    const auto seen = [&] {
        return timeseries::toDouble(canvas_.probe(view, {100, 75})->picked.value);
    };
    EXPECT_TRUE((seen() >= 0.1 && seen() <= 0.4) || (seen() >= 0.8 && seen() <= 0.9)) << seen();
    // A hidden layer is not seen.
    world_.explorer.layers[0].visible = false;
    draw(world_.shown());
    EXPECT_GE(seen(), 0.8);
    EXPECT_LE(seen(), 0.9);
    // The swept window is.
    world_.explorer.layers[1].visible = false;
    setSweep(world_.explorer, {.animation = RangeSet::parse("0.5:0.6"), .delta = 0.05});
    world_.explorer.layers.front().color = glm::dvec3(1);
    world_.explorer.layers.front().opacity = 0.5;
    draw(world_.shown());
    EXPECT_GE(seen(), 0.45);
    EXPECT_LE(seen(), 0.65);
}

TEST_F(CanvasOfNoise, TimesComeSomeFramesLaterForTheSplatsTheyAreOf) {
    world_.explorer.footprint.size = 0.1;  // so that each counts as little more than one
    bool timed = false;
    for (int i = 0; i < 50 && !timed; ++i) {
        draw(world_.shown());
        timed = report_.gpuTime.has_value();
    }
    ASSERT_TRUE(timed);
    EXPECT_GT(report_.gpuTime->count(), 0);
    EXPECT_EQ(report_.gpuSplats, report_.cost);
    const std::uint64_t splats = report_.cost - report_.planesCost;
    EXPECT_NEAR(static_cast<double>(splats), cost(1), 1e-3 * cost(1));
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
