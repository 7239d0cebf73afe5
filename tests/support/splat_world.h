// Everything of a step in one layer, drawn by the truth.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "render/model/footprint.h"
#include "render/reference/cpu_splatter.h"
#include "render/splat/depth_order.h"
#include "tests/support/scenes.h"

namespace render::splat_world {

using tests::axis;
using timeseries::Grid;
using timeseries::RangeSet;

// Everything of a step in one layer.
struct World {
    explicit World(timeseries::SortedStep s, const RangeSet& range = RangeSet::everything(),
                   Footprint footprint = {})
        : step(std::move(s)),
          placed(step.grid()),
          scene{.step = step,
                .placed = placed,
                .layers = {{step.select(range), {Constant{glm::dvec3(1)}, 0.5}}},
                .footprint = footprint,
                .order = Order::None,
                .clip = {}} {}
    timeseries::SortedStep step;
    PlacedPoints placed;
    Scene scene;
};

inline std::vector<double> weights(const World& world, const View& view) {
    Accumulator<double> sums(view.size, {Channels::Weight});
    splat(world.scene, Runs{}, view, {}, sums);
    return sums.planes[0];
}

// From so far that all rays are upright.
inline View fromAbove(int pixels) {
    View view = tests::lookFrom({0, 0, 0}, {pixels, pixels}, 0.001);
    view.viewFromWorld = glm::lookAt(glm::dvec3(0, 0, 1000), glm::dvec3(0), glm::dvec3(0, 1, 0));
    return view;
}

// Sum over pixels of W times the area that a pixel sees at the depth of the points: the mass that
// was drawn, in units of l. Exact for parallel rays; the views below are nearly that.
inline double massDrawn(const std::vector<double>& w, const View& view, double depth) {
    const PixelRays rays = pixelRays(view);
    double sum = 0;
    for (int y = 0; y < view.size.y; ++y)
        for (int x = 0; x < view.size.x; ++x) {
            const glm::dvec2 slope = (glm::dvec2(x + 0.5, y + 0.5) - rays.centre) / rays.focal;
            const double cosine = 1 / std::sqrt(1 + glm::dot(slope, slope));
            sum += w[std::size_t(y) * view.size.x + x] * cosine;
        }
    return sum * depth * depth / (rays.focal.x * rays.focal.y);
}

// Of long cells whose points all stand at corners of the domain: what their cut splats lack there
// (tests/render/footprint_test.cpp).
inline constexpr double kAtCorners = 0.011;

inline timeseries::SortedStep onePoint() {
    return tests::stepOf(std::make_shared<Grid>(std::array{axis(1), axis(1), axis(1)}),
                         [](std::size_t) { return 1.0; });
}

}  // namespace render::splat_world
