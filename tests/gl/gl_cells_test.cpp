// Interval volumes by GL, cell by cell: what the processor draws, which tests/render holds to the
// truth.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "render/model/rays_across.h"
#include "tests/bench/turbulence.h"
#include "tests/support/gl_cell_planes.h"
#include "tests/support/meshes.h"
#include "tests/support/sampled_errors.h"
#include "tests/support/sorted.h"

namespace render {
namespace {

using GlCellsOf = tests::GlCellPlanes;

using tests::CellWorld;
using tests::drawn;
using tests::lookFrom;
using timeseries::Grid;

double wave(const glm::dvec3& p) {
    return std::sin(0.9 * p.x) + std::cos(0.7 * p.y + 0.3 * p.x) * std::sin(0.8 * p.z);
}
template <typename F>
timeseries::SortedStep sampled(const std::shared_ptr<const Grid>& grid, const F& f) {
    return tests::stepOf(grid, [&](std::size_t i) { return f(glm::dvec3(grid->indices(i))); });
}
timeseries::SortedStep waves(std::size_t n = 10) { return sampled(tests::cube(n), wave); }

TEST_F(GlCellsOf, LengthsAreTheProcessorsFromOutsideAndInside) {
    for (const char* range : {"-0.5:0.5", "min:max", "0.3:0.31", "0.2"}) {
        CellWorld world(waves(), {range});
        for (const OpacityPer per : {OpacityPer::Length, OpacityPer::Crossing}) {
            if (per == OpacityPer::Length && std::string_view(range) == "0.2") continue;
            world.scene.opacityPer = per;
            for (const View& view : {kOutside, kInside}) {
                SCOPED_TRACE(testing::Message()
                             << range << (per == OpacityPer::Crossing) << (&view == &kInside));
                expectTheProcessors(world.scene, view, 1.5e-4);
            }
        }
    }
}

// Values that points have, so that cells touch the range.
TEST_F(GlCellsOf, RangesAtTheValuesOfPointsAreTheProcessors) {
    for (const char* range : {"4", "4:4.05", "3.95:4"}) {
        CellWorld world(sampled(tests::cube(9), [](const glm::dvec3& p) { return p.x; }), {range});
        world.scene.opacityPer = OpacityPer::Crossing;
        SCOPED_TRACE(range);
        for (const View& view : {kOutside, kInside}) expectTheProcessors(world.scene, view, 1.5e-4);
    }
}

// Many of which a pixel's ray passes, so that what it sees beside itself is that along them.
TEST_F(GlCellsOf, FlatOnesAreTheProcessors) {
    const auto bent = [](const glm::dvec3& p) { return p.z + 0.4 * std::sin(0.6 * p.x); };
    for (const double height : {0.3, 0.02, 1e-3}) {
        const auto places = [&](double i, double j, double k) {
            return glm::dvec3(i, j, k * height);
        };
        const auto upright = std::make_shared<Grid>(
            std::array{tests::axis(9), tests::axis(9), tests::axis(9, 0, height)});
        for (const auto& grid :
             {std::shared_ptr<const Grid>(upright), tests::curvilinear({9, 9, 9}, places)})
            for (const char* range : {"3:6", "4.52:4.53"}) {
                CellWorld world(sampled(grid, bent), {range});
                world.scene.opacityPer = OpacityPer::Crossing;
                SCOPED_TRACE(testing::Message() << range << " of " << height);
                expectTheProcessors(world.scene, kOutside, 1e-3);
            }
    }
}

// Whose pixels' rays run along faces between cells.
TEST_F(GlCellsOf, PicturesAlongAnAxisAreTheProcessors) {
    const auto one = [](const glm::dvec3&) { return 3.0; };
    const auto places = [](double i, double j, double k) { return glm::dvec3(i, j, k); };
    for (const auto& grid : {tests::cube(9), tests::curvilinear({9, 9, 9}, places)}) {
        CellWorld world(sampled(grid, one), {"2:4"});
        for (const glm::ivec2& size : {glm::ivec2(49, 31), glm::ivec2(48, 48)})
            for (const glm::dvec3& from : {glm::dvec3(0, -1, 0), glm::dvec3(1, 1, 1)}) {
                expectTheProcessors(world.scene, lookFrom(3.0 * from, size, 0.2), 1e-3);
                expectTheProcessors(world.scene, lookFrom(1e3 * from, size, 6e-4), 1e-3);
            }
    }
}

TEST_F(GlCellsOf, ColoursLightAndOrderAreTheProcessors) {
    CellWorld world(waves(), {"-2:-0.5", "0.2:0.25", "0.8:2"}, 0.7);
    world.scene.layers[1].style.color = ByValue{{}, 0.2, 0.25};
    world.scene.layers[2].style.color = ByValue{{}, 0.5, 2.5};
    world.scene.opacityPer = OpacityPer::Crossing;
    expectTheProcessorsInEveryLight(world.scene, 2e-4, 2e-4);
}

// Missing corners leave octants, and so does a clip box.
TEST_F(GlCellsOf, OctantsAreTheProcessors) {
    std::mt19937 random(3);
    CellWorld world(sampled(tests::cube(9),
                            [&](const glm::dvec3& p) {
                                return random() % 8 == 0 ? std::numeric_limits<double>::quiet_NaN()
                                                         : wave(p);
                            }),
                    {"-0.4:0.6"});
    expectTheProcessors(world.scene, kOutside, 1e-4);
    world.scene.clip = {{2, 0, 1}, {6, 7, 5}};
    expectTheProcessors(world.scene, kOutside, 1e-4);
}

TEST_F(GlCellsOf, AnyUprightOrLeaningGridIsTheProcessors) {
    timeseries::Axis down = tests::axis(7, 100, -3), uneven = tests::axis(5);
    uneven.coordinates = {0, 1, 4, 4.5, 9};
    timeseries::CoordinateFrame leaning;
    leaning.directions = tests::leaning({1, 0.2, 0}, {-0.3, 1, 0.1}, {0.1, 0.4, 1});
    for (const timeseries::CoordinateFrame& frame : {timeseries::CoordinateFrame{}, leaning}) {
        CellWorld world(
            sampled(std::make_shared<Grid>(std::array{down, uneven, tests::axis(6, -2, 2)}, frame),
                    wave),
            {"-0.5:0.2"});
        world.scene.layers[0].style.color = ByValue{{}, -0.5, 0.2};
        for (const Order order : {Order::None, Order::BackToFront}) {
            world.scene.order = order;
            world.scene.light = order == Order::None ? Light::Off : Light::Soft;
            expectTheProcessors(world.scene, kOutside, 2e-4);
        }
    }
}

TEST_F(GlCellsOf, WhatIsOpaqueHidesTheRestOfARay) {
    const CellWorld world(waves(), {"-0.5:0.5"});
    const auto wall =
        static_cast<float>(windowDepth(kOutside, glm::length(glm::dvec3(1.2, -2.5, 1))));
    const std::vector<float> hides(std::size_t(kSize.x) * kSize.y, wall);
    const std::vector<float> expected =
        drawn(world.scene, kOutside, Channels::Weight, 0, 2, tests::kAllCells, hides);
    expectSame(plane(world.scene, kOutside, Channels::Weight, 0, tests::kAllCells, wall), expected,
               1e-4);
    EXPECT_NE(drawn(world.scene, kOutside), expected) << "or nothing was hidden";
}

TEST_F(GlCellsOf, SlicesAreTheSameBitForBit) {
    CellWorld world(waves(30), {"-0.5:0.5"});
    for (const Order order : {Order::None, Order::BackToFront}) {
        world.scene.order = order;
        const Channels channels = channelsFor(world.scene)[0];
        ASSERT_GT(world.scene.layers[0].cells.candidates[0].count, 0u);
        EXPECT_EQ(plane(world.scene, kOutside, channels, 0, 1),
                  plane(world.scene, kOutside, channels));
    }
}

// What is kept on the GPU is not taken for another scene's.
TEST_F(GlCellsOf, EachOfSeveralScenesIsItsOwn) {
    CellWorld world(waves(), {"-0.5:0.5", "0.7:0.8"});
    const auto each = [&](const char* what, const std::function<void(Scene&)>& change) {
        SCOPED_TRACE(what);
        expectTheProcessors(world.scene, kOutside, 2e-4);
        const std::vector<float> before = drawn(world.scene, kOutside, channelsFor(world.scene)[0]);
        change(world.scene);
        expectTheProcessors(world.scene, kOutside, 2e-4);
        EXPECT_NE(drawn(world.scene, kOutside, channelsFor(world.scene)[0]), before);
    };
    each("range", [&](Scene& scene) {
        Cells& cells = scene.layers[0].cells;
        cells.ranges = {{-0.4, 0.4}};
        cells.candidates = scene.cells->select(cells.ranges);
    });
    each("by value", [](Scene& scene) { scene.layers[0].style.color = ByValue{{}, -0.4, 0.4}; });
    each("map", [](Scene& scene) { scene.layers[0].style.color = ByValue{{}, -0.4, 0.9}; });
    each("clip", [](Scene& scene) { scene.clip = {{0, 0, 0}, {5, 9, 9}}; });
    each("per crossing", [](Scene& scene) {
        scene.layers[0].cells.ranges = {{0.1, 0.11}};
        scene.layers[0].cells.candidates = scene.cells->select(scene.layers[0].cells.ranges);
        scene.opacityPer = OpacityPer::Crossing;
    });
    each("order", [](Scene& scene) { scene.order = Order::BackToFront; });
    each("opacity", [](Scene& scene) { scene.layers[0].style.opacity = 0.9; });
    each("light", [](Scene& scene) { scene.light = Light::Full; });
    each("lamp", [](Scene& scene) { scene.lamp = glm::dvec3(0, 0, 1); });
    // Another step of the same shape.
    const CellWorld other(
        sampled(tests::cube(10), [](const glm::dvec3& p) { return wave(p + 1.0); }),
        {"0.1:0.11", "0.7:0.8"});
    expectTheProcessors(other.scene, kOutside, 2e-4);
    expectTheProcessors(world.scene, kOutside, 2e-4);
}

// 64 bytes each, and as many for each octant of those that are parted.
TEST_F(GlCellsOf, TakeNoMoreThanTheyMay) {
    CellWorld world(waves(), {"-0.5:0.5"});
    const std::uint64_t bytes = 64 * cellCount(world.scene.layers[0]);
    EXPECT_EQ(GlPieces::bytesOf(world.scene), bytes);
    EXPECT_NO_THROW(whole(world.scene, bytes, lister_));
    EXPECT_THROW(
        whole(world.scene,
              64 * cells_.prepare(world.scene, Runs{}, GlStep(world.scene.step, world.scene.placed))
                          ->splats(Channels::Weight, 0) -
                  1,
              lister_),
        std::runtime_error);
    world.scene.clip = {{0, 0, 0}, {5, 9, 9}};
    EXPECT_EQ(GlPieces::bytesOf(world.scene), bytes);
    EXPECT_LE(whole(world.scene, 8 * bytes, lister_)->bytes(), 8 * bytes + 1000);
}

// Of axes whose coordinates are the same as floats.
TEST_F(GlCellsOf, SlicesThinnerThanFloatsTellAreTheProcessors) {
    timeseries::Axis uneven = tests::axis(5);
    uneven.coordinates = {0, 1, 1 + 1e-9, 3, 6};
    const CellWorld world(
        sampled(std::make_shared<Grid>(std::array{uneven, tests::axis(5), tests::axis(6)}), wave),
        {"-0.5:0.5"});
    expectTheProcessors(world.scene, kOutside, 1.5e-4);
}

TEST_F(GlCellsOf, ValuesFarBeyondFloatsAreTheProcessors) {
    const auto grid = tests::cube(8);
    std::vector<double> huge(grid->count());
    std::vector<std::int64_t> whole(grid->count());
    for (std::size_t i = 0; i < huge.size(); ++i) {
        const double at = wave(glm::dvec3(grid->indices(i)));
        huge[i] = 1e300 * at;
        whole[i] = (std::int64_t{1} << 52) + static_cast<std::int64_t>(std::round(1000 * at));
    }
    const CellWorld ofHuge(tests::sorted({grid, std::move(huge), {}}), {"-5e299:5e299"});
    expectTheProcessors(ofHuge.scene, kOutside, 1e-4);
    const CellWorld ofWhole(tests::sorted({grid, std::move(whole), {}}),
                            {"4503599627370296:4503599627370696"});
    expectTheProcessors(ofWhole.scene, kOutside, 1e-4);
    const CellWorld plateau(sampled(grid, [](const glm::dvec3&) { return 3.0; }), {"2:4"});
    expectTheProcessors(plateau.scene, kOutside, 1e-4);
}

// Cells less than three pixels wide: of several rays a pixel has the mean.
TEST_F(GlCellsOf, SmallOnesAreTheProcessorsMeans) {
    CellWorld world(waves(30), {"-0.4:-0.3", "0.2:0.25"}, 0.7);
    world.scene.layers[1].style.color = ByValue{{}, 0.2, 0.25};
    for (const double far : {2.0, 5.0, 12.0})
        for (const bool inParts : {false, true})
            for (const Order order : {Order::None, Order::BackToFront}) {
                inParts_ = inParts;
                world.scene.order = order;
                world.scene.light = order == Order::None ? Light::Off : Light::Soft;
                const View view = lookFrom(far * glm::dvec3(0.4, -0.8, 0.4), kSize, 1.5 / far);
                SCOPED_TRACE(testing::Message() << raysAcross(world.scene, view) << inParts);
                EXPECT_GT(raysAcross(world.scene, view), 1);
                expectTheProcessors(world.scene, view, 3e-4);
                const Channels channels = channelsFor(world.scene)[0];
                EXPECT_EQ(plane(world.scene, view, channels, 0, 1),
                          plane(world.scene, view, channels));
            }
}

// Beside the continuous field itself, as the processor is in cell_extremes_test.cpp: ranges as wide
// as the step between neighbours is, a third of it, and a thirtieth.
TEST_F(GlCellsOf, TurbulenceIsTrueHoweverThinTheRange) {
    const timeseries::Field field = bench::turbulence<float>(48);
    const auto& values = std::get<std::vector<float>>(field.values);
    double sum = 0, steps = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        sum += static_cast<double>(values[i]);
        if ((i + 1) % 48 != 0) steps += std::pow(static_cast<double>(values[i + 1] - values[i]), 2);
    }
    const auto count = static_cast<double>(values.size());
    const double mean = sum / count, between = std::sqrt(steps / count);
    for (const auto& [width, bound] :
         {std::pair(1.0, 0.01), std::pair(0.3, 0.03), std::pair(0.03, 0.12)}) {
        const CellWorld world(tests::sorted(timeseries::Field(field)),
                              {std::to_string(mean) + "~" + std::to_string(width * between / 2)});
        const View view = lookFrom({1.2, -2.6, 0.9}, {600, 600}, 0.36);
        std::vector<float> depth = plane(world.scene, view, Channels::Weight);
        for (float& each : depth)
            each *= static_cast<float>(opticalDepthPerWeight(world.scene.layers[0].style.opacity));
        const DepthAt picture = depthFrom(std::move(depth), view.size);
        EXPECT_LT(tests::sampledError(world, view, picture, {.pixels = 96}).relativeL2, bound)
            << width;
    }
}

}  // namespace
}  // namespace render
