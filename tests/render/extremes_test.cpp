// What scientists' data and a headset's scales ask of a splatter at the extremes, one test a row of
// tests/EXTREMES.md that no other test stands for. By tiles, against the truth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/reference/cpu_splatter.h"
#include "render/reference/exact_order.h"
#include "render/reference/image_compare.h"
#include "render/splat/depth_order.h"
#include "render/splat/tile_splatter.h"
#include "tests/support/scenes.h"

namespace render {
namespace {

class Extremes : public testing::Test {
 protected:
    static Scene allOf(const timeseries::SortedStep& step, const PlacedPoints& placed,
                       double opacity = 0.5) {
        return {.step = step,
                .placed = placed,
                .layers = {{step.select(timeseries::RangeSet::everything()),
                            {ByValue{{}, 0, 1}, opacity}}},
                .footprint = {},
                .order = Order::BackToFront,
                .clip = {}};
    }
    std::vector<float> drawn(const Scene& scene, const View& view, Channels channels) const {
        return sumTiles(scene, order(scene, pixelRays(view).eye), view, channels, 0, {}, 2);
    }
    static std::vector<double> truth(const Scene& scene, const View& view, Channels channels) {
        Accumulator<double> sums(view.size, {channels});
        splat(scene, orderExactly(scene, pixelRays(view).eye), view, {}, sums);
        return sums.planes[0];
    }
    double error(const Scene& scene, const View& view, Channels channels) const {
        const auto expected = truth(scene, view, channels);
        EXPECT_GT(*std::ranges::max_element(expected), 0) << "or nothing was compared";
        return compareScalars(drawn(scene, view, channels), expected).relativeL2;
    }
};

// A column of points seen from its end: all fall on the same pixels. Each sum of floats may be off
// by half a unit in its last place, 2^-25 of it, or less where they fall both ways.
TEST_F(Extremes, CoincidentSplatsByTheHundredThousand) {
    constexpr std::size_t kPoints = 1 << 18;
    const auto step = tests::noise(std::make_shared<timeseries::Grid>(
        std::array{tests::axis(1), tests::axis(kPoints), tests::axis(1)}));
    const PlacedPoints placed(step.grid());
    const View view = tests::lookFrom({0, -3, 0}, {9, 9}, 0.01);
    const double most = kPoints * std::ldexp(1, -25);
    EXPECT_LE(error(allOf(step, placed), view, Channels::Weight), most);
    for (const double opacity : {1e-7, 0.5, 1.0})
        EXPECT_LE(error(allOf(step, placed, opacity), view, Channels::Over), most) << opacity;
}

TEST_F(Extremes, OpacitiesOfATenMillionthAndOfOne) {
    const auto step = tests::noise(tests::cube(24));
    const PlacedPoints placed(step.grid());
    for (const glm::dvec3& eye : {glm::dvec3(1.3, -2.4, 0.9), glm::dvec3(0.2, 0.1, 0.3)})
        for (const double opacity : {1e-7, 1.0})
            EXPECT_LE(error(allOf(step, placed, opacity), tests::lookFrom(eye, {150, 110}),
                            Channels::Over),
                      1e-4)
                << opacity << " from " << eye.x;
}

TEST_F(Extremes, SplatsThatFillTheScreen) {
    const auto step = tests::noise(tests::cube(5));
    const PlacedPoints placed(step.grid());
    Scene scene = allOf(step, placed, 0.1);
    for (const double size : {10.0, 1e3}) {
        scene.footprint.size = size;
        for (const glm::dvec3& eye : {glm::dvec3(1.3, -2.4, 0.9), glm::dvec3(0.2, 0.1, 0.3)})
            for (const Channels channels : {Channels::WeightedColor, Channels::Over})
                EXPECT_LE(error(scene, tests::lookFrom(eye, {150, 110}), channels), 1e-4)
                    << size << " from " << eye.x;
    }
}

// A thousandth of a pixel from each other, wherever between the pixels they lie.
TEST_F(Extremes, SplatsFarBelowAPixelKeepTheirMass) {
    const auto step = tests::noise(tests::cube(12));
    const PlacedPoints placed(step.grid());
    const Scene scene = allOf(step, placed);
    double first = 0;
    for (const double shift : {0.0, 0.2, 0.37, 0.5}) {
        View view = tests::lookFrom({0, -3000, 0}, {65, 65}, 0.325);
        view.viewFromWorld[3].x += shift * 2 * 0.325 / 65 * 3000;
        const auto sums = drawn(scene, view, Channels::Weight);
        double mass = 0;
        for (const float w : sums) mass += static_cast<double>(w);
        if (shift == 0) first = mass;
        EXPECT_GT(mass, 0);
        EXPECT_NEAR(mass / first, 1, 6e-3) << shift;
        EXPECT_LE(error(scene, view, Channels::Weight), 1e-5) << shift;
    }
}

// The same cells at 10^7 of their units, and of 10^-6 and 10^6 of them: the same picture.
TEST_F(Extremes, CoordinatesAtTenMillionAndUnitsOfAMillionth) {
    const auto at = [](double first, double step) {
        const auto axis = [&] { return tests::axis(16, first, step); };
        return tests::noise(std::make_shared<timeseries::Grid>(std::array{axis(), axis(), axis()}));
    };
    const View view = tests::lookFrom({1.3, -2.4, 0.9}, {150, 110});
    const auto plain = at(0, 1);
    const PlacedPoints placed(plain.grid());
    const auto expected = truth(allOf(plain, placed), view, Channels::Over);
    for (const auto& [first, step] : {std::pair(1e7, 1.0), {-1e7, 1e-3}, {0.0, 1e-6}, {5.0, 1e6}}) {
        const auto moved = at(first, step);
        const PlacedPoints there(moved.grid());
        EXPECT_LE(
            compareScalars(drawn(allOf(moved, there), view, Channels::Over), expected).relativeL2,
            1e-5)
            << first << ' ' << step;
    }
}

}  // namespace
}  // namespace render
