// The error that the window states.
#include "app/drawing/picture_error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <thread>

#include "app/choices/camera.h"
#include "app/picture/depth_error.h"
#include "app/picture/error_text.h"
#include "tests/support/scenes.h"
#include "tests/support/sorted.h"
#include "tests/support/step_bytes.h"

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

std::optional<DepthErrors> untilTold(PictureError& error, const PictureError::Picture& picture) {
    std::optional<DepthErrors> told;
    const auto end = std::chrono::steady_clock::now() + 60s;
    while (!(told = error.of(picture)) && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for(1ms);
    return told;
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

// A picture of nothing, where nothing is, has no error to tell.
TEST(PictureError, OfNothingIsNone) {
    EXPECT_TRUE(std::isnan(worked(waves(Model::Cells, "5:6"))));
    EXPECT_TRUE(std::isnan(worked(waves(Model::Points, "5:6"))));
    EXPECT_EQ(depthErrorText(worked(waves(Model::Cells, "5:6"))), "");
}

// Neither order nor light changes depths.
TEST(PictureError, IsOfDepthsAlone) {
    PictureError::Picture picture = waves(Model::Cells, "0.2:0.23");
    const double error = worked(picture);
    picture.explorer.light = render::Light::Full;
    picture.explorer.order = render::Order::None;
    EXPECT_EQ(worked(picture), error);
}

// As opacity is: where points stand for cells, they are held against what these show; where they
// were chosen, against lengths.
TEST(PictureError, IsOfCrossingsOrOfLengths) {
    using render::OpacityPer;
    const auto told = [](Model chosen, const Rung& rung, OpacityPer per, const char* range) {
        PictureError::Picture picture = waves(chosen, range);
        picture.explorer.opacityPer = per;
        const std::array rungs{Rung{Model::Cells}, rung};
        return *depthErrorsOf(picture.explorer, *picture.sorted, picture.view, rungs).of(rung);
    };
    const Rung cells{Model::Cells}, points{Model::Points};
    for (const char* range : {"0.2:0.23", "0.2:0.203"})
        for (const OpacityPer per : {OpacityPer::Crossing, OpacityPer::Length})
            EXPECT_LT(told(Model::Cells, cells, per, range), 0.1) << range;
    const char* thin = "0.2:0.203";
    EXPECT_EQ(told(Model::Points, points, OpacityPer::Crossing, thin),
              told(Model::Points, points, OpacityPer::Length, thin));
    // A tenth of what a crossing is worth, at most: they hardly show.
    const double asCells = told(Model::Cells, points, OpacityPer::Crossing, thin);
    EXPECT_GT(asCells, 0.8);
    EXPECT_LT(asCells, 1.1);
}

TEST(PictureError, ComesLaterAndIsOfThePictureAskedForLast) {
    PictureError error;
    for (const char* range : {"0.2:0.9", "0.2:0.5"}) {
        const PictureError::Picture picture = waves(Model::Points, range);
        const std::optional<DepthErrors> told = untilTold(error, picture);
        ASSERT_TRUE(told);
        // Those of cells are not made for it.
        EXPECT_EQ(told->of({Model::Cells}), std::nullopt);
        EXPECT_EQ(told->of({Model::Points}), worked(picture));
        EXPECT_GT(told->of({Model::Points, 8}), told->of({Model::Points, 1}));
        EXPECT_EQ(told->of({Model::Points, 64}), told->of({Model::Points, 16}));
    }
}

// A step on disk whose points can be read no longer.
TEST(PictureError, WhyThereIsNoneIsTold) {
    PictureError::Picture picture = waves(Model::Points, "0.2:0.5");
    auto bytes = tests::written(*picture.sorted);
    const auto whole = tests::opened(bytes);
    for (const timeseries::StepBlock& block : whole->blocks()) bytes[block.idsAt] ^= std::byte{1};
    picture.sorted = std::make_shared<const timeseries::SortedStep>(
        timeseries::SortedStep::ofFile(tests::opened(bytes), picture.sorted->sharedGrid(), false));
    PictureError error;
    const DepthErrors told = *untilTold(error, picture);
    EXPECT_TRUE(told.rungs.empty());
    EXPECT_THAT(told.whyNone, testing::HasSubstr("damaged"));
}

TEST(PictureError, OfEveryWayToDrawIsWhatEachWouldHave) {
    PictureError::Picture cells = waves(Model::Cells, "0.2:0.5");
    cells.sorted->cells();
    const DepthErrors all = depthErrorsOf(cells.explorer, *cells.sorted, cells.view,
                                          rungsOf(cells.explorer, *cells.sorted));
    ASSERT_EQ(all.rungs.size(), 12u) << "cells and points by 1, 2, .. 16, in both sizes of pixels";
    EXPECT_NEAR(*all.of({Model::Cells}), worked(cells), 1e-12);
    cells.explorer.model = Model::Points;
    // Another picture, another sample of its pixels.
    EXPECT_NEAR(*all.of({Model::Points}) / worked(cells), 1, 0.3);
}

DepthErrors partsOf(const PictureError::Picture& p, std::vector<Rung> rungs) {
    return depthErrorsOf(p.explorer, *p.sorted, p.view, rungs, {.parts = Parts::All});
}

// What parts must be whatever they are of: D - T = (M - T) + (P - M) + (D - P), whose sizes obey
// the triangle inequality, each against the sum of the others.
TEST(PictureError, PartsAddUpAsDifferencesDo) {
    for (const char* range : {"0.2:0.9", "0.2:0.23"}) {
        const PictureError::Picture picture = waves(Model::Cells, range);
        picture.sorted->cells();
        const auto rungs = rungsOf(picture.explorer, *picture.sorted);
        const DepthErrors told = partsOf(picture, rungs);
        ASSERT_EQ(told.rungs.size(), rungs.size());
        for (const RungError& error : told.rungs) {
            ASSERT_TRUE(error.parts);
            const auto& [model, subset, pixels] = *error.parts;
            const std::array sizes{error.depth, model, subset, pixels};
            double sum = 0;
            for (const double size : sizes) sum += size;
            for (const double size : sizes) EXPECT_LE(size, sum - size + 1e-12);
            EXPECT_EQ(subset == 0, error.rung.stride == 1);
            EXPECT_GT(model, 0);
        }
        // The same without them.
        const DepthErrors plain =
            depthErrorsOf(picture.explorer, *picture.sorted, picture.view, rungs);
        for (std::size_t i = 0; i < rungs.size(); ++i) {
            EXPECT_EQ(plain.rungs[i].depth, told.rungs[i].depth);
            EXPECT_FALSE(plain.rungs[i].parts);
        }
    }
}

// Few rays are enough for the first of these, but not for the second, which is far truer.
TEST(PictureError, OfATruePictureIsNotToldByTheRaysOfAPoorOneBeforeIt) {
    const PictureError::Picture picture = waves(Model::Points, "0.2:0.203");
    picture.sorted->cells();
    const DepthErrors told = partsOf(picture, {{Model::Points}, {Model::Cells}});
    ASSERT_EQ(told.rungs.size(), 2u);
    const RungError& cells = told.rungs[1];
    ASSERT_LT(10 * cells.depth, told.rungs[0].depth);
    EXPECT_LE(cells.depth, cells.parts->model + cells.parts->pixels + 1e-12);
    EXPECT_LE(cells.parts->pixels, cells.parts->model + cells.depth + 1e-12);
}

TEST(PictureError, APartComesFromWhatMakesIt) {
    PictureError::Picture picture = waves(Model::Cells, "0.2:0.23");
    const Rung cells{Model::Cells}, points{Model::Points};
    const DepthErrors few =
        partsOf(picture, {cells, points, {Model::Points, 4}, {Model::Points, 16}});
    const auto partsIn = [](const DepthErrors& errors, const Rung& rung) {
        return *errors.find(rung)->parts;
    };
    // Dots are no shell; fewer of them less so.
    EXPECT_GT(partsIn(few, points).model, 5 * partsIn(few, cells).model);
    EXPECT_EQ(partsIn(few, {Model::Points, 4}).model, partsIn(few, points).model);
    EXPECT_GT(partsIn(few, {Model::Points, 4}).subset, 0);
    EXPECT_GT(partsIn(few, {Model::Points, 16}).subset, partsIn(few, {Model::Points, 4}).subset);
}

TEST(PictureError, OfOrderIsToldOfColoursThatMeet) {
    PictureError::Picture picture = waves(Model::Cells, "0.2:0.5");
    const auto told = [&](render::Order order, Model model) {
        picture.explorer.order = order;
        const DepthErrors errors =
            depthErrorsOf(picture.explorer, *picture.sorted, picture.view, std::array{Rung{model}});
        return std::pair(errors.ordering, errors.rungs.front().order);
    };
    using render::Order;
    EXPECT_EQ(told(Order::None, Model::Cells), std::pair(Ordering::OneColor, 0.0));
    picture.explorer.layers.push_back(picture.explorer.layers.front());
    picture.explorer.layers.back().ranges = timeseries::RangeSet::parse("-0.8:-0.6");
    picture.explorer.layers.back().color = glm::dvec3(0, 0.2, 1);
    const auto [mixed, byMixing] = told(Order::None, Model::Cells);
    EXPECT_EQ(mixed, Ordering::Mixed);
    EXPECT_GT(byMixing, 0.02);
    const auto [ordered, byOrder] = told(Order::BackToFront, Model::Cells);
    EXPECT_EQ(ordered, Ordering::ByDepth);
    EXPECT_LT(10 * byOrder, byMixing);
    EXPECT_EQ(told(Order::BackToFront, Model::Points), std::pair(Ordering::ByDepth, 0.0));
    // Points are as opaque as they are long.
    const auto ofBoth = [&](render::OpacityPer per) {
        picture.explorer.order = Order::None;
        picture.explorer.opacityPer = per;
        const std::array rungs{Rung{Model::Cells}, Rung{Model::Points}};
        const DepthErrors errors =
            depthErrorsOf(picture.explorer, *picture.sorted, picture.view, rungs);
        return std::pair(errors.find(rungs[0])->order, errors.find(rungs[1])->order);
    };
    const auto [cells, points] = ofBoth(render::OpacityPer::Length);
    EXPECT_EQ(cells, points);
    const auto [opaqueCells, samePoints] = ofBoth(render::OpacityPer::Crossing);
    EXPECT_NEAR(samePoints, points, 0.1 * points);  // of other pixels
    EXPECT_NE(opaqueCells, cells);
}

TEST(PictureError, TheCheapestWayWithinAnErrorDrawsLeast) {
    constexpr Rung kCells{Model::Cells};
    const auto points = [](std::uint32_t stride) { return Rung{Model::Points, stride}; };
    const auto errorsOf = [](std::initializer_list<std::pair<Rung, double>> known) {
        DepthErrors errors;
        for (const auto& [rung, depth] : known)
            errors.rungs.push_back({.rung = rung, .depth = depth});
        return errors;
    };
    const DepthErrors errors =
        errorsOf({{kCells, 0.01}, {points(1), 0.1}, {points(2), 0.2}, {points(4), 0.5}});
    for (const auto& [error, rung] :
         {std::pair(0.9, points(4)), std::pair(0.5, points(4)), std::pair(0.3, points(2)),
          std::pair(0.15, points(1)), std::pair(0.05, kCells), std::pair(0.001, kCells)})
        EXPECT_EQ(errors.cheapest(error), rung) << error;
    // Points are truer of what is below a pixel.
    EXPECT_EQ(errorsOf({{kCells, 0.2}, {points(1), 0.1}}).cheapest(0.01), points(1));
    EXPECT_FALSE(DepthErrors().cheapest(1));
}

TEST(PictureError, OfCategoriesIsNotTold) {
    const auto grid = tests::cube(3);
    timeseries::Field field{grid, std::vector<float>(27, 1.0f), {}};
    EXPECT_TRUE(hasDepthError(tests::sorted(field)));
    field.categories = true;
    EXPECT_FALSE(hasDepthError(tests::sorted(field)));
}

}  // namespace
}  // namespace app
