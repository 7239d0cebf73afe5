// What a window draws by cells, and by the points that stand for them.
#include <gtest/gtest.h>

#include "render/image/exr.h"
#include "render/reference/image_compare.h"
#include "render/splat/gl_cells.h"
#include "tests/support/canvas_of_noise.h"
#include "tests/support/files.h"
#include "tests/support/meshes.h"

namespace app {
namespace {

using render::Image;
using namespace app::canvas_of_noise;

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

// Points of one layer among the cells of another, which the program draws itself also beside a GPU.
TEST_F(CanvasOfNoise, LayersOfEitherModelRestWholeTogether) {
    const auto by = [&](Model first, Model other) {
        world_.explorer.layers[0].model = first;
        world_.explorer.layers[1].model = other;
        const Image image = draw(world_.shown())[0];
        EXPECT_TRUE(report_.whole);
        EXPECT_EQ(report_.cells.has_value(), first == Model::Cells || other == Model::Cells);
        return image;
    };
    for (const render::Order order : {render::Order::None, render::Order::BackToFront}) {
        world_.explorer.order = order;
        const Image points = by(Model::Points, Model::Points),
                    cells = by(Model::Cells, Model::Cells);
        const Image one = by(Model::Points, Model::Cells), other = by(Model::Cells, Model::Points);
        for (const Image& mixed : {one, other}) {
            EXPECT_NE(mixed, points);
            EXPECT_NE(mixed, cells);
        }
        EXPECT_NE(one, other);
        Image refined;
        int calls = 0;
        do {
            const auto views = canvas_.eyesOf(world_.shown());
            report_ = canvas_.refine(
                world_.shown(), views, {.splats = 2'000},
                [&](std::size_t, const render::Targets& light) { refined = light.readLight(); });
        } while (!report_.whole && ++calls < 1000);
        EXPECT_GT(calls, 1);
        EXPECT_EQ(refined, other);
        draw(world_.shown(), {.splats = 2'000}, true);
        EXPECT_FALSE(report_.cells) << "points stand for all where they would take too long";
    }
}

TEST_F(CanvasOfNoise, AMovingPictureMayBeToldHowItIsDrawn) {
    world_.explorer.model = Model::Cells;
    const Image cells = draw(world_.shown())[0];
    // Whatever the limits are.
    for (const std::uint64_t splats : {1'000u, 100'000'000u}) {
        EXPECT_EQ(draw(world_.shown(), {.splats = splats, .rung = Rung{Model::Cells}}, true)[0],
                  cells);
        EXPECT_TRUE(report_.whole);
        for (const std::uint32_t stride : {1u, 4u}) {
            draw(world_.shown(), {.splats = splats, .rung = Rung{Model::Points, stride}}, true);
            EXPECT_FALSE(report_.cells);
            EXPECT_EQ(report_.stride, stride);
        }
    }
    world_.explorer.model = Model::Points;
    draw(world_.shown(), {.splats = 1'000, .rung = Rung{Model::Points, 1}}, true);
    EXPECT_TRUE(report_.whole);
}

// As in a headset: no more than that, and less where the limits ask for it.
TEST_F(CanvasOfNoise, AMovingPictureDrawsNoMoreThanItMay) {
    world_.explorer.model = Model::Cells;
    const auto drawn = [&](std::uint64_t splats, const Rung& most) {
        draw(world_.shown(), {.splats = splats, .most = most, .mayBeCoarse = true}, true);
        return Rung{report_.cells ? Model::Cells : Model::Points, report_.stride, report_.across};
    };
    constexpr std::uint64_t kEnough = 1'000'000'000;
    for (const Rung& most : {Rung{Model::Cells}, Rung{Model::Cells, 1, kCoarse},
                             Rung{Model::Points}, Rung{Model::Points, 4}})
        EXPECT_EQ(drawn(kEnough, most), most);
    const Rung least = drawn(1'000, {Model::Cells});
    ASSERT_EQ(least.model, Model::Points);
    ASSERT_GT(least.stride, 4u);
    EXPECT_EQ(drawn(1'000, {Model::Points, 4}), least);
}

// By cells, then by coarse ones, then by points, as the limit falls; none where nobody may.
TEST_F(CanvasOfNoise, AMovingPictureGoesDownTheLadder) {
    world_.explorer.model = Model::Cells;
    world_.explorer.size = {401, 301};
    Canvas inProgram(render::SplatterChoice::Cpu);
    const auto rungAt = [&](double splats, bool mayBeCoarse) {
        const auto views = inProgram.eyesOf(world_.shown());
        report_ = inProgram.draw(
            world_.shown(), views,
            {.splats = static_cast<std::uint64_t>(splats), .mayBeCoarse = mayBeCoarse}, true,
            [](auto, auto&) {});
        return Rung{report_.cells ? Model::Cells : Model::Points, report_.stride, report_.across};
    };
    for (const bool mayBeCoarse : {true, false}) {
        std::vector<Rung> met;
        for (double splats = 1e8; splats > 1000; splats *= 0.85) {
            const Rung rung = rungAt(splats, mayBeCoarse);
            EXPECT_EQ(report_.whole, rung == Rung());
            if (met.empty() || met.back() != rung) met.push_back(rung);
        }
        EXPECT_EQ(met.front(), Rung());
        for (std::size_t i = 1; i < met.size(); ++i) EXPECT_FALSE(drawsLess(met[i - 1], met[i]));
        const bool hasCoarse = std::ranges::count(met, Rung{Model::Cells, 1, kCoarse}) > 0;
        EXPECT_EQ(hasCoarse, mayBeCoarse);
        for (const Rung& rung : met) EXPECT_TRUE(mayBeCoarse || rung.across == 1);
        EXPECT_EQ(met.back().model, Model::Points);
    }
}

// Of a limit that swings by a tenth the picture does not change all the time.
TEST_F(CanvasOfNoise, ClimbingTheLadderWantsRoomToSpare) {
    world_.explorer.model = Model::Cells;
    const auto drawAt = [&](double splats) {
        draw(world_.shown(), {.splats = static_cast<std::uint64_t>(splats), .mayBeCoarse = true},
             true);
        return report_.whole;
    };
    draw(world_.shown());
    double fits = 2 * static_cast<double>(report_.cost);  // then the least that all of it keeps to
    ASSERT_TRUE(drawAt(fits));
    while (drawAt(0.98 * fits)) fits *= 0.98;
    EXPECT_FALSE(drawAt(0.95 * fits));
    EXPECT_FALSE(drawAt(1.05 * fits)) << "it has just fallen";
    EXPECT_TRUE(drawAt(1.3 * fits));
    EXPECT_TRUE(drawAt(1.05 * fits)) << "and is there";
}

// What is known of errors says which of those that fit is the truest.
TEST_F(CanvasOfNoise, OfWhatFitsTheTruestIsDrawn) {
    world_.explorer.model = Model::Cells;
    const Rung points{Model::Points, 1, kCoarse};
    DepthErrors errors;
    for (const Rung& rung : ladder({})) errors.rungs.push_back({.rung = rung, .depth = 0.5});
    for (RungError& error : errors.rungs)
        if (error.rung == points) error.depth = 0.1;
    draw(world_.shown());
    draw(world_.shown(), {.splats = 100'000'000, .mayBeCoarse = true, .errors = &errors}, true);
    EXPECT_EQ(report_.across, kCoarse);
    EXPECT_FALSE(report_.cells);
    EXPECT_FALSE(report_.whole);
}

// But where all that fits would show nothing of the field, what a slower pace has room for.
TEST_F(CanvasOfNoise, APaceGivesWayWhereItWouldShowNothing) {
    world_.explorer.model = Model::Cells;
    draw(world_.shown());
    for (const double error : {0.9, 0.3}) {
        DepthErrors errors;
        for (const Rung& rung : ladder({}))
            errors.rungs.push_back({.rung = rung, .depth = rung == Rung() ? 0.01 : error});
        CanvasLimits limits{.splats = 2'000, .mayBeCoarse = true, .errors = &errors};
        for (const std::uint64_t slower : {100'000'000u, 2'000u}) {
            limits.slower = {slower, slower};
            draw(world_.shown(), limits, true);
            EXPECT_EQ(report_.whole, error > 0.5 && slower > 2'000) << error << ' ' << slower;
        }
    }
    // And where errors are not known some points in place of cells, but not of points.
    for (const Model model : {Model::Cells, Model::Points}) {
        world_.explorer.model = model;
        CanvasLimits limits{.splats = 2'000, .mayBeCoarse = true};
        limits.slower = {100'000'000, 100'000'000};
        draw(world_.shown(), limits, true);
        EXPECT_EQ(report_.whole, model == Model::Cells);
    }
}

TEST_F(CanvasOfNoise, ComingBackToAPaceWantsRoomToSpare) {
    world_.explorer.model = Model::Cells;
    draw(world_.shown());
    DepthErrors errors;  // of all points a third, of fewer too much
    for (const Rung& rung : ladder({}))
        errors.rungs.push_back({.rung = rung,
                                .depth = rung == Rung()                ? 0.01
                                         : rung == Rung{Model::Points} ? 0.3
                                                                       : 0.9});
    const auto givesWay = [&](double splats) {
        CanvasLimits limits{
            .splats = static_cast<std::uint64_t>(splats), .cells = 1, .errors = &errors};
        limits.slower = {100'000'000, 100'000'000};
        draw(world_.shown(), limits, true);
        return report_.cells.has_value();
    };
    double fits = 1e8;  // then the least that all points keep to
    ASSERT_FALSE(givesWay(fits));
    while (!givesWay(0.98 * fits)) fits *= 0.98;
    EXPECT_TRUE(givesWay(1.05 * fits)) << "it has just given way";
    EXPECT_FALSE(givesWay(1.4 * fits));
    EXPECT_FALSE(givesWay(1.05 * fits)) << "and is there";
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

// Of a mesh the program lists tetrahedra once a selection, which takes too long for a picture that
// moves; the GPU puts them in order for each eye.
void showTetrahedra(tests::ShownSteps& world) {
    const auto grid = tests::curvilinear(
        {32, 32, 32}, [](double i, double j, double k) { return glm::dvec3(i, j, k); });
    world.steps[0] = std::make_shared<const timeseries::SortedStep>(tests::noise(grid, 1));
    world.dataset.variable.grid = grid;
    world.explorer.model = Model::Cells;
    world.explorer.size = {60, 45};
    world.explorer.layers = {tests::ShownSteps::layer("0:0.9", app::MapChoice{{}, 0, 1})};
    world.steps[0]->cells();
}

// At rest GL's tetrahedra are made in slices; a hand comes between, and another selection.
TEST_F(CanvasOfNoise, ManyTetrahedraAreMadeByAndBy) {
    showTetrahedra(world_);
    const auto views = canvas_.eyesOf(world_.shown());
    std::optional<Image> whole;
    const auto refine = [&] {
        report_ = canvas_.refine(
            world_.shown(), views, {},
            [&](std::size_t, const render::Targets& light) { whole = light.readLight(); });
        EXPECT_GT(report_.refined, 0) << "or a window would wait before it goes on";
    };
    const auto apart = [&] {
        Canvas other(render::SplatterChoice::Gl);
        Image image;
        other.draw(world_.shown(), views, {}, false,
                   [&](std::size_t, const render::Targets& light) { image = light.readLight(); });
        return image;
    };
    for (const char* range : {"0:0.8", "0:0.9"}) {  // the first is left half-way
        whole.reset();
        world_.explorer.layers[0].ranges = timeseries::RangeSet::parse(range);
        refine();
        draw(world_.shown(), {}, true);
    }
    while (!whole) refine();
    EXPECT_TRUE(report_.whole);
    EXPECT_EQ(*whole, apart());
}

TEST_F(CanvasOfNoise, ManyTetrahedraAreDrawnWhileMovingOnceTheyAreThere) {
    showTetrahedra(world_);
    const CanvasLimits most{.splats = std::uint64_t{1} << 50};
    draw(world_.shown(), most, true);
    EXPECT_FALSE(report_.cells) << "but points";
    const Image rest = draw(world_.shown(), most)[0];
    EXPECT_TRUE(report_.whole);
    EXPECT_EQ(draw(world_.shown(), most, true)[0], rest);
    world_.explorer.view.azimuthDegrees += 10;
    draw(world_.shown(), most, true);
    EXPECT_TRUE(report_.cells);
    EXPECT_TRUE(report_.whole);
    world_.explorer.layers[0].ranges = timeseries::RangeSet::parse("0:0.8");
    draw(world_.shown(), most, true);
    EXPECT_FALSE(report_.cells) << "of another selection";
}

// What was shown last is asked: cells, or the points that stood for them.
TEST_F(CanvasOfNoise, ProbesTellWhatIsSeenBetweenPointsWhereCellsAre) {
    world_.explorer.model = Model::Cells;
    draw(world_.shown());
    const auto view = canvas_.eyesOf(world_.shown())[0];
    const auto cell = canvas_.probe(view, {100, 75});
    ASSERT_TRUE(cell);
    ASSERT_TRUE(cell->picked.between);
    const double seen = *cell->picked.between;
    EXPECT_TRUE((0.1 <= seen && seen <= 0.4) || (0.8 <= seen && seen <= 0.9)) << seen;
    draw(world_.shown(), {.cells = 1}, true);
    const auto point = canvas_.probe(view, {100, 75});
    ASSERT_TRUE(point);
    EXPECT_FALSE(point->picked.between);
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

}  // namespace
}  // namespace app
