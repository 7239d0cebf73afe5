// What is measured of small worlds whose figures are known, and how it is told.
#include "app/measure/measurement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "app/choices/camera.h"
#include "app/choices/choice_text.h"
#include "app/measure/report.h"
#include "app/picture/picture.h"
#include "render/reference/interval_truth.h"
#include "tests/support/scenes.h"

namespace app {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using timeseries::RangeSet;

// The field is x, 0 to 8, on 9^3 points.
class MeasuredRamp : public testing::Test {
 protected:
    std::vector<Measured> measured(const std::vector<const char*>& ranges, unsigned raysAcross = 3,
                                   const std::vector<std::string>& names = {},
                                   render::Light light = render::Light::Off) {
        Explorer e;
        e.size = {80, 60};
        e.light = light;
        e.lamp = LampChoice{-10, 50};
        for (const char* range : ranges) {
            const bool isFirst = e.layers.empty();
            e.layers.push_back({RangeSet::parse(range), glm::dvec3(isFirst, 0, !isFirst), 0.3});
        }
        return measure(e, step_, placed_,
                       {.views = 2, .frames = 3, .raysAcross = raysAcross, .modes = names});
    }

    std::shared_ptr<const timeseries::Grid> grid_ = tests::cube(9);
    timeseries::SortedStep step_ =
        tests::stepOf(grid_, [&](std::size_t i) { return double(grid_->indices(i).x); });
    render::PlacedPoints placed_{step_.grid()};
};

// All of it: every point and every cell is drawn, and the mass is the domain's. Where all is
// selected, cells are exact for the ray in a pixel's middle.
TEST_F(MeasuredRamp, WhatIsSelectedWholeHasItsWholeMass) {
    const auto modes = measured({"min:max"}, 1);
    ASSERT_EQ(modes.size(), 10u);
    EXPECT_NEAR(modes[0].drawn, 9 * 9 * 9 / 8.0, double(render::kSubsetUnevenness));
    EXPECT_GT(modes[0].depthError, modes[3].depthError);
    EXPECT_EQ(modes[3].mode.name(), "points");
    EXPECT_EQ(modes[3].drawn, 9 * 9 * 9);
    EXPECT_EQ(modes[4].mode.name(), "cells");
    EXPECT_EQ(modes[4].drawn, 10 * 10 * 10);
    for (const Measured& m : modes) {
        EXPECT_NEAR(m.mass, 1, 0.05) << m.mode.name();
        EXPECT_GT(m.frame, 0);
        EXPECT_GE(m.before, 0);
    }
    EXPECT_LT(modes[4].depthError, 1e-5);
    EXPECT_GT(modes[3].depthError, 1e-2);
    EXPECT_GT(modes[4].psnr, 80);
    EXPECT_LT(modes[4].rmse, modes[3].rmse);
    EXPECT_LT(modes[4].colorDifference, modes[3].colorDifference);
    EXPECT_LE(modes[4].rmse, modes[4].largest);
}

// A range between points holds none of them: points draw nothing, which is no picture of it.
TEST_F(MeasuredRamp, ARangeBetweenPointsIsLostByPointsAndKeptByCells) {
    const auto modes = measured({"4.2:4.6"});
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(modes[i].drawn, 0);
        EXPECT_EQ(modes[i].mass, 0);
        EXPECT_EQ(modes[i].depthError, 1);
        EXPECT_TRUE(modes[i].massIsOff());
    }
    EXPECT_NEAR(modes[4].mass, 1, 0.01);
    EXPECT_LT(modes[4].depthError, 0.05);
    EXPECT_FALSE(modes[4].massIsOff());
}

// Sums in coarse pixels keep their mass, and are told of the points and cells that they are of.
TEST_F(MeasuredRamp, CoarsePixelsBlurWhatTheyShow) {
    const auto modes = measured({"4:4.4"});
    for (std::size_t i = 0; i < 5; ++i) {
        const Measured &fine = modes[i], &coarse = modes[i + 5];
        EXPECT_EQ(coarse.mode.name(), "coarse " + fine.mode.name());
        EXPECT_EQ(coarse.drawn, fine.drawn);
        EXPECT_NEAR(coarse.mass, fine.mass, 0.02 * fine.mass) << coarse.mode.name();
        EXPECT_GT(coarse.parts.parts->pixels, fine.parts.parts->pixels);
        EXPECT_NEAR(coarse.parts.parts->model, fine.parts.parts->model, 1e-9);
    }
    EXPECT_GT(modes[9].depthError, 1.5 * modes[4].depthError);
    EXPECT_LT(modes[9].depthError, 0.2);
}

// A picture in float is near the same in double, however far the model is from the truth, and no
// part of it.
TEST_F(MeasuredRamp, ArithmeticIsToldApartFromTheModel) {
    for (const char* range : {"4.2:4.6", "2:5", "min:max"})
        for (const Measured& m : measured({range}, 1)) {
            EXPECT_LT(m.arithmetic, 1e-4) << m.mode.name() << ' ' << range;
            EXPECT_EQ(m.arithmetic > 0, m.drawn > 0) << m.mode.name() << ' ' << range;
        }
    EXPECT_EQ(measured({"20:30"})[0].arithmetic, 0);
}

// The truth is lit as cells are, so that their light is as near to it as what comes from within.
TEST_F(MeasuredRamp, LitCellsAreHeldAgainstALitTruth) {
    for (const auto& ranges : {std::vector{"2:5"}, {"0:3", "5:8"}})
        for (const render::Light light : {render::Light::Soft, render::Light::Full}) {
            const auto modes = measured(ranges, 3, {"cells", "lit cells"}, light);
            const Measured &dark = modes.front(), &lit = modes.back();
            EXPECT_EQ(lit.mode, (Mode{{Model::Cells}, render::Order::BackToFront, light}));
            EXPECT_EQ(lit.mode.name(), "lit cells");
            EXPECT_EQ(lit.depthError, dark.depthError);
            EXPECT_LT(lit.rmse, 3 * dark.rmse + 1e-3);
            EXPECT_GT(lit.rmse, 0);
        }
    // A lamp from elsewhere is another light.
    Explorer e;
    e.size = {80, 60};
    e.light = render::Light::Soft;
    e.layers.push_back({RangeSet::parse("2:5"), glm::dvec3(1, 0, 0), 0.9});
    const render::Scene scene = makeScene(e, step_, placed_);
    const render::View view = eyes(e.view, {}, placed_.outline(), e.size).front();
    render::Scene other = scene;
    other.lamp = glm::dvec3(1, 0, 0);
    const render::IntervalTruth fromEye(scene, scene.cells->field(), 1),
        fromSide(other, scene.cells->field(), 1);
    EXPECT_NE(fromEye.light(view), fromSide.light(view));
}

// Dots jump from pixel to pixel where the field glides.
TEST_F(MeasuredRamp, PointsPopMoreThanCells) {
    const auto modes = measured({"4:4.4"});
    EXPECT_GT(modes[0].popping, modes[4].popping);
    EXPECT_GT(modes[3].popping, modes[4].popping);
    EXPECT_GT(modes[4].popping, 0);
    EXPECT_LT(modes[4].popping, 0.03);
}

// Mixed or in order, the optical depth is the same; the light is not.
TEST_F(MeasuredRamp, SeveralColoursAreDrawnInBothOrders) {
    const auto modes = measured({"0:3", "5:8"});
    ASSERT_EQ(modes.size(), 15u);
    const Measured &ordered = modes[8], &mixed = modes[9];
    EXPECT_EQ(ordered.mode, (Mode{{Model::Cells}, render::Order::BackToFront}));
    EXPECT_EQ(mixed.mode, (Mode{{Model::Cells}, render::Order::None}));
    EXPECT_EQ(ordered.depthError, mixed.depthError);
    EXPECT_EQ(ordered.mass, mixed.mass);
    EXPECT_LT(3 * ordered.rmse, mixed.rmse);
    EXPECT_LT(ordered.colorDifference, mixed.colorDifference);
    // Of parts that lie in cells of their own, whose order is exact.
    EXPECT_LT(ordered.parts.order, 1e-6);
    EXPECT_GT(mixed.parts.order, 0.1);
    EXPECT_EQ(ordered.parts.parts, mixed.parts.parts);
}

TEST_F(MeasuredRamp, PartsTellWhatIsLeftOut) {
    const auto modes = measured({"2:5"});
    ASSERT_EQ(modes.size(), 10u);
    for (const Measured& m : modes) {
        ASSERT_TRUE(m.parts.parts) << m.mode.name();
        EXPECT_EQ(m.parts.rung, m.mode.rung);
        EXPECT_EQ(m.parts.parts->subset > 0, m.mode.rung.stride > 1) << m.mode.name();
        EXPECT_EQ(m.parts.order, 0) << "one colour";
    }
    EXPECT_GT(modes[0].parts.parts->subset, modes[2].parts.parts->subset);
    EXPECT_GT(modes[3].parts.parts->model, 3 * modes[4].parts.parts->model);
}

TEST_F(MeasuredRamp, WhereNothingIsThereIsNothingWrong) {
    for (const Measured& m : measured({"20:30"})) {
        EXPECT_EQ(m.depthError, 0);
        EXPECT_EQ(m.mass, 1);
        EXPECT_EQ(m.rmse, 0);
        EXPECT_EQ(m.psnr, std::numeric_limits<double>::infinity());
        EXPECT_EQ(m.colorDifference, 0);
    }
}

TEST_F(MeasuredRamp, ProgressRisesFromNothing) {
    Explorer e;
    e.size = {16, 12};
    e.layers.push_back({RangeSet::parse("1:2"), glm::dvec3(1), 0.3});
    std::vector<double> told;
    measure(e, step_, placed_, {.views = 1, .frames = 3, .raysAcross = 1},
            [&](double share) { told.push_back(share); });
    EXPECT_EQ(told.front(), 0);
    EXPECT_TRUE(std::ranges::is_sorted(told));
    EXPECT_LT(told.back(), 1);
}

// With the figures that they have beside the others.
TEST_F(MeasuredRamp, ChosenModesAloneAreMeasured) {
    const auto all = measured({"2:5"});
    for (const std::vector<std::string>& names :
         {std::vector<std::string>{"points"}, {"cells", "points 1/4"}}) {
        const auto chosen = measured({"2:5"}, 3, names);
        ASSERT_EQ(chosen.size(), names.size());
        for (const Measured& m : chosen) {
            const auto same = std::ranges::find(all, m.mode, &Measured::mode);
            ASSERT_NE(same, all.end());
            EXPECT_NE(std::ranges::find(names, m.mode.name()), names.end());
            EXPECT_EQ(m.depthError, same->depthError);
            EXPECT_EQ(m.drawn, same->drawn);
            EXPECT_EQ(m.parts.depth, same->parts.depth);
            EXPECT_EQ(m.parts.parts, same->parts.parts);
        }
    }
}

TEST(ModesNamed, AreInTheUsualOrderAndOfBothOrders) {
    const std::vector<std::string> names = {"cells", "points 1/8", "cells"};
    using render::Order;
    const Rung points{Model::Points, 8}, cells{Model::Cells};
    EXPECT_THAT(modesNamed(names, {}), ElementsAre(Mode{points}, Mode{cells}));
    const ModesOf several{.severalColors = true};
    EXPECT_THAT(modesNamed(names, several),
                ElementsAre(Mode{points, Order::BackToFront}, Mode{points},
                            Mode{cells, Order::BackToFront}, Mode{cells}));
    EXPECT_EQ(modesNamed({}, several), modesFor(several));
}

TEST(ModesNamed, LitCellsAreNamedWhereThereIsLight) {
    const std::vector<std::string> names = {"lit cells"};
    const Mode lit{{Model::Cells}, render::Order::BackToFront, render::Light::Soft};
    for (const bool several : {false, true})
        EXPECT_THAT(modesNamed(names, {.severalColors = several, .light = render::Light::Soft}),
                    ElementsAre(lit));
    EXPECT_EQ(modesFor({.light = render::Light::Soft}).back(), lit);
    EXPECT_THROW(modesNamed(names, {}), ChoiceError);
}

TEST(ModesNamed, RefusesAnUnknownOneAndNamesThoseThereAre) {
    for (const std::string name : {"", "point", "points 1/3", "Cells"}) {
        const std::vector<std::string> names = {"cells", name};
        try {
            modesNamed(names, {});
            FAIL() << name;
        } catch (const ChoiceError& error) {
            EXPECT_EQ(error.what(),
                      "--modes: '" + name +
                          "' is none of points 1/8, points 1/4, points 1/2, points, cells, "
                          "coarse points 1/8, coarse points 1/4, coarse points 1/2, coarse points, "
                          "coarse cells");
        }
    }
}

// Squares of so many pixels are not drawn in coarse ones.
TEST(ModesFor, AreSubsetsPointsAndCells) {
    std::vector<std::string> names;
    for (const Mode& mode : modesFor({.coarsePoints = false})) names.push_back(mode.name());
    EXPECT_THAT(names, ElementsAre("points 1/8", "points 1/4", "points 1/2", "points", "cells",
                                   "coarse cells"));
    EXPECT_EQ(modesFor({.severalColors = true}).size(), 15u);
}

TEST(ViewsAbout, BeginWithTheOneChosenAndNoTwoAreAlike) {
    ViewChoice view;
    view.azimuthDegrees = 100;
    view.elevationDegrees = -10;
    const auto views = viewsAbout(view, 8);
    EXPECT_EQ(views.front(), view);
    for (std::size_t i = 0; i < views.size(); ++i) {
        EXPECT_EQ(views[i].elevationDegrees, -10);
        EXPECT_LE(std::abs(views[i].azimuthDegrees), 180);
        for (std::size_t k = 0; k < i; ++k) {
            const double apart =
                std::abs(std::remainder(views[i].azimuthDegrees - views[k].azimuthDegrees, 360));
            EXPECT_GT(apart, 20);
        }
    }
}

std::vector<Measured> someModes() {
    Measured points{
        .mode = {{Model::Points, 4}, render::Order::None}, .frame = 0.002, .before = 1e-5};
    points.drawn = 12345;
    points.depthError = 0.25;
    points.parts.parts = ErrorParts{.model = 0.1875, .subset = 0.125, .pixels = 0.0625};
    points.parts.depth = 0.3125;
    points.parts.order = 0.5;
    points.arithmetic = 0.03125;
    points.mass = 1.0625;
    points.psnr = 20;
    Measured cells{.mode = {{Model::Cells}, render::Order::BackToFront}, .frame = 1.5};
    cells.psnr = std::numeric_limits<double>::infinity();
    return {points, cells};
}

TEST(MeasuredReport, MarksAMassThatIsOff) {
    const auto modes = someModes();
    EXPECT_THAT(table(modes),
                HasSubstr("points 1/4        mixed          2 ms   0.01 ms       12,345"));
    EXPECT_THAT(table(modes), HasSubstr("+6.25 % !"));
    EXPECT_THAT(table(modes), HasSubstr("\n! its mass is more than 5 % off"));
    EXPECT_THAT(table(std::span(modes).subspan(1)), Not(HasSubstr("!")));
}

TEST(MeasuredReport, IsOffFromMoreThanFivePercentOnAndWhereItIsNoNumber) {
    Measured m;
    for (const double mass : {0.96, 1.0, 1.04}) {
        m.mass = mass;
        EXPECT_FALSE(m.massIsOff()) << mass;
    }
    for (const double mass : {0.94, 1.06, std::nan(""), std::numeric_limits<double>::infinity()}) {
        m.mass = mass;
        EXPECT_TRUE(m.massIsOff()) << mass;
    }
}

TEST(MeasuredReport, CsvHasARowAMode) {
    EXPECT_EQ(
        csv(someModes()),
        "mode,order,light,frame,before,drawn,depthError,sampledError,modelError,subsetError,"
        "pixelsError,orderError,arithmeticError,mass,massIsOff,popping,rmse,psnr,largest,"
        "colorDifference\n"
        "points "
        "1/4,mixed,off,0.002,1e-05,12345,0.25,0.3125,0.1875,0.125,0.0625,0.5,0.03125,1.0625,true,"
        "0.0,0.0,20.0,0.0,0.0\n"
        "cells,by depth,off,1.5,0.0,0,0.0,0.0,0.0,0.0,0.0,0.0,0.0,1.0,false,0.0,0.0,,0.0,0.0\n");
}

TEST(MeasuredReport, JsonHasNullForTheInfinite) {
    EXPECT_TRUE(json(someModes()[1])["psnr"].is_null());
    EXPECT_EQ(json(someModes()[0])["drawn"], 12345);
}

}  // namespace
}  // namespace app
