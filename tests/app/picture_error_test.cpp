// The error that the window states.
#include "app/drawing/picture_error.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "app/choices/camera.h"
#include "app/picture/depth_error.h"
#include "tests/support/scenes.h"

namespace app {
namespace {

using namespace std::chrono_literals;

PictureError::Picture waves(Model model, const char* range) {
    const auto grid = tests::cube(24);
    const auto step =
        std::make_shared<const timeseries::SortedStep>(tests::stepOf(grid, [&](std::size_t i) {
            const glm::dvec3 p(grid->indices(i));
            return std::sin(0.45 * p.x) + std::cos(0.35 * p.y + 0.15 * p.x) * std::sin(0.4 * p.z);
        }));
    Explorer e;
    e.model = model;
    e.size = {160, 120};
    e.layers = {{.ranges = timeseries::RangeSet::parse(range),
                 .color = glm::dvec3(1, 0.5, 0),
                 .opacity = 0.4}};
    const render::PlacedPoints placed(*grid);
    return {step, e, eyes(e.view, {}, placed.boxHalfEdges(), e.size).front()};
}

double worked(const PictureError::Picture& p) {
    const Rung drawn{p.explorer.model};
    return *depthErrorsOf(p.explorer, *p.sorted, p.view, std::span(&drawn, 1)).of(drawn);
}

// Figures of the design's table: rho here is 3 and .1.
TEST(PictureError, OfCellsIsSmallAndOfAThinRangesPointsLarge) {
    EXPECT_LT(worked(waves(Model::Cells, "0.2:0.9")), 0.01);
    EXPECT_LT(worked(waves(Model::Cells, "0.2:0.23")), 0.1);
    const double wide = worked(waves(Model::Points, "0.2:0.9"));
    EXPECT_GT(wide, 0.02);
    EXPECT_LT(wide, 0.3);
    EXPECT_GT(worked(waves(Model::Points, "0.2:0.23")), 0.4);
}

// Neither order, light nor what opacity is of changes lengths.
TEST(PictureError, IsOfLengths) {
    PictureError::Picture picture = waves(Model::Cells, "0.2:0.23");
    const double error = worked(picture);
    picture.explorer.opacityPer = render::OpacityPer::Length;
    picture.explorer.light = render::Light::Full;
    picture.explorer.order = render::Order::None;
    EXPECT_EQ(worked(picture), error);
}

TEST(PictureError, ComesLaterAndIsOfThePictureAskedForLast) {
    PictureError error;
    for (const char* range : {"0.2:0.9", "0.2:0.5"}) {
        const PictureError::Picture picture = waves(Model::Points, range);
        std::optional<DepthErrors> told;
        const auto end = std::chrono::steady_clock::now() + 60s;
        while (!(told = error.of(picture)) && std::chrono::steady_clock::now() < end)
            std::this_thread::sleep_for(1ms);
        ASSERT_TRUE(told);
        // Those of cells are not made for it.
        EXPECT_EQ(told->of({Model::Cells}), std::nullopt);
        EXPECT_EQ(told->of({Model::Points}), worked(picture));
        EXPECT_GT(told->of({Model::Points, 8}), told->of({Model::Points, 1}));
        EXPECT_EQ(told->of({Model::Points, 64}), told->of({Model::Points, 16}));
    }
}

TEST(PictureError, OfEveryWayToDrawIsWhatEachWouldHave) {
    PictureError::Picture cells = waves(Model::Cells, "0.2:0.5");
    cells.sorted->cells();
    const DepthErrors all = depthErrorsOf(cells.explorer, *cells.sorted, cells.view,
                                          rungsOf(cells.explorer, *cells.sorted));
    ASSERT_EQ(all.rungs.size(), 6u);
    EXPECT_NEAR(*all.of({Model::Cells}), worked(cells), 1e-12);
    cells.explorer.model = Model::Points;
    // Another picture, another sample of its pixels.
    EXPECT_NEAR(*all.of({Model::Points}) / worked(cells), 1, 0.3);
}

TEST(PictureError, TheCheapestWayWithinAnErrorDrawsLeast) {
    constexpr Rung kCells{Model::Cells};
    const auto points = [](std::uint32_t stride) { return Rung{Model::Points, stride}; };
    const DepthErrors errors{
        {{kCells, 0.01}, {points(1), 0.1}, {points(2), 0.2}, {points(4), 0.5}}};
    for (const auto& [error, rung] :
         {std::pair(0.9, points(4)), std::pair(0.5, points(4)), std::pair(0.3, points(2)),
          std::pair(0.15, points(1)), std::pair(0.05, kCells), std::pair(0.001, kCells)})
        EXPECT_EQ(errors.cheapest(error), rung) << error;
    // Points are truer of what is below a pixel.
    EXPECT_EQ((DepthErrors{{{kCells, 0.2}, {points(1), 0.1}}}.cheapest(0.01)), points(1));
    EXPECT_FALSE(DepthErrors().cheapest(1));
}

TEST(PictureError, OfCategoriesIsNotTold) {
    const auto grid = tests::cube(3);
    timeseries::Field field{grid, std::vector<float>(27, 1.0f), {}};
    EXPECT_TRUE(hasDepthError(timeseries::SortedStep::build(field)));
    field.categories = true;
    EXPECT_FALSE(hasDepthError(timeseries::SortedStep::build(field)));
}

}  // namespace
}  // namespace app
