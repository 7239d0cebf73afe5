// Cells, and the gradients by which light falls on them, that a window waits for, or gives up.
#include <gtest/gtest.h>

#include "app/files/memory_budget.h"
#include "render/image/exr.h"
#include "tests/support/canvas_of_noise.h"
#include "tests/support/files.h"
#include "tests/support/meshes.h"

namespace app {
namespace {

using render::Image;
using namespace app::canvas_of_noise;

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

// A budget of 5 bytes a point fits its value, of 4, and not the cells beside it, of 8 each.
TEST_F(CanvasOfNoise, CellsBeyondTheMemoryForStepsAreDrawnByPointsAndThePictureSaysSo) {
    const Image points = draw(world_.shown())[0];
    world_.explorer.model = Model::Cells;
    chosenMemory = 5 * world_.steps[0]->grid().count();
    const Image image = draw(world_.shown())[0];
    chosenMemory = 0;
    EXPECT_TRUE(report_.whole);
    EXPECT_FALSE(report_.lacksCells);
    EXPECT_FALSE(report_.cells) << "but points";
    EXPECT_EQ(report_.drawn, report_.selected);
    EXPECT_NE(image, points) << "for its words";
    EXPECT_TRUE(world_.steps[0]->cellsAreGivenUp());
}

// By the thread that makes them, after a picture without a word of it.
TEST_F(CanvasOfNoise, CellsThatAreGivenUpLaterAreTold) {
    world_ = tests::ShownSteps(102, 1);
    world_.explorer.model = Model::Cells;
    const Image before = draw(world_.shown())[0];
    EXPECT_TRUE(report_.lacksCells);
    world_.steps[0]->giveUpCells();
    const Image after = draw(world_.shown())[0];
    EXPECT_FALSE(report_.lacksCells);
    EXPECT_NE(after, before) << "for its words";
}

// Each tetrahedron is lit by its own gradient until then.
TEST_F(CanvasOfNoise, GradientsOfAMeshComeLater) {
    const auto grid = tests::curvilinear({60, 60, 60}, [](double i, double j, double k) {
        return glm::dvec3(i + 0.1 * j, j, k + 0.01 * i * j);
    });
    world_ = tests::ShownSteps(4, 1);
    world_.steps[0] = std::make_shared<const timeseries::SortedStep>(tests::noise(grid));
    world_.dataset.variable.grid = grid;
    world_.explorer.model = Model::Cells;
    world_.explorer.layers = {tests::ShownSteps::layer("0.5:0.51", glm::dvec3(0, 0.5, 1))};
    world_.explorer.layers[0].opacity = 0.9;
    Canvas canvas(render::SplatterChoice::Cpu);
    const auto views = canvas.eyesOf(world_.shown());
    Image image;
    CanvasReport report;
    int shown = 0;
    const auto show = [&](std::size_t, const render::Targets& light) {
        image = light.readLight();
        ++shown;
    };
    const auto refine = [&] {
        shown = 0;
        do report = canvas.refine(world_.shown(), views, {}, show);
        while (shown == 0);
    };
    report = canvas.draw(world_.shown(), views, {}, false, show);
    EXPECT_FALSE(report.lacksCells);
    EXPECT_TRUE(report.lacksGradients);
    EXPECT_FALSE(report.whole);
    const Image faceted = image;
    world_.steps[0]->gradients(grid->mesh());  // waits for whoever makes them
    EXPECT_FALSE(canvas.waitsForGradients());
    refine();
    EXPECT_TRUE(report.whole);
    EXPECT_FALSE(report.lacksGradients);
    EXPECT_NE(image, faceted);
    const auto file = tests::freshFolder() / "saved.exr";
    canvas.save(world_.shown(), file);
    EXPECT_EQ(render::readExr(file).views[0].image, image);
    // Without light nobody asks for them.
    world_.explorer.light = render::Light::Off;
    world_.explorer.scale = glm::dvec3(1, 1, 2);
    report = canvas.draw(world_.shown(), views, {}, false, show);
    EXPECT_TRUE(report.whole);
}

}  // namespace
}  // namespace app
