// Fields whose interval volumes are known in closed form, and the rays through them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "render/reference/interval_truth.h"
#include "tests/support/scenes.h"
#include "tests/support/sorted.h"

namespace render::true_world {

using tests::axis;
using timeseries::Field;
using timeseries::Grid;
using timeseries::Interval;

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
inline const glm::ivec2 kSize(20, 16);

using OfPoint = std::function<double(const glm::uvec3&)>;

template <typename T = double>
Field fieldOn(std::shared_ptr<const Grid> grid, const OfPoint& f) {
    std::vector<T> values(grid->count());
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = static_cast<T>(f(glm::uvec3(grid->indices(i))));
    return {std::move(grid), std::move(values), {}};
}

// A field and layers of ranges in it.
struct TrueWorld {
    TrueWorld(Field of, const std::vector<std::vector<Interval<double>>>& layers)
        : field(std::move(of)),
          step(tests::sorted(field)),
          placed(*field.grid),
          scene{.step = step,
                .placed = placed,
                .layers = {},
                .footprint = {},
                .order = Order::BackToFront,
                .clip = {}} {
        for (const auto& ranges : layers) {
            Layer layer{{}, {Constant{glm::dvec3(1)}, 0.5}};
            layer.cells.ranges = ranges;
            scene.layers.push_back(layer);
        }
    }
    std::vector<double> weight(const View& view, std::size_t layer = 0, int across = 1) const {
        return IntervalTruth(scene, field, across, 2).weight(view, layer);
    }

    Field field;
    timeseries::SortedStep step;
    PlacedPoints placed;
    Scene scene;
};

struct Ray {
    glm::dvec3 from, along;  // axis coordinates, a unit of view depth
    double weight, near;     // W of that unit
};
inline Ray rayOf(const TrueWorld& world, const View& view, double x, double y) {
    const PixelRays rays = besideFaces(pixelRays(world.placed.inAxes(view)));
    const glm::dvec3 along = rays.along(glm::dvec2(x, y) - rays.centre);
    return {rays.eye, along,
            glm::length(world.placed.worldFromAxes() * along) / world.placed.unitLength(),
            rays.near};
}

struct Way {
    double from, to;
};
inline Way within(const Ray& ray, const glm::dvec3& lo, const glm::dvec3& hi) {
    Way way{ray.near, kInfinity};
    for (int a = 0; a < 3; ++a) {
        const double one = (lo[a] - ray.from[a]) / ray.along[a];
        const double other = (hi[a] - ray.from[a]) / ray.along[a];
        way.from = std::max(way.from, std::min(one, other));
        way.to = std::min(way.to, std::max(one, other));
    }
    return way;
}
inline double pathThrough(const Ray& ray, const glm::dvec3& lo, const glm::dvec3& hi) {
    const Way way = within(ray, lo, hi);
    return std::max(way.to - way.from, 0.0) * ray.weight;
}

// wanted(ray) of every pixel's middle.
inline void expectOfRays(const TrueWorld& world, const View& view, const std::vector<double>& is,
                         const std::function<double(const Ray&)>& wanted, double tolerance = 1e-9) {
    for (int y = 0; y < view.size.y; ++y)
        for (int x = 0; x < view.size.x; ++x) {
            const double path = wanted(rayOf(world, view, x + 0.5, y + 0.5));
            ASSERT_NEAR(is[std::size_t(y) * std::size_t(view.size.x) + std::size_t(x)], path,
                        tolerance * (1 + path))
                << x << ' ' << y;
        }
}

inline std::shared_ptr<const Grid> unevenGrid() {
    auto uneven = axis(5);
    uneven.coordinates = {0, 1, 1.5, 3, 5};
    return std::make_shared<Grid>(std::array{uneven, axis(4, 7, -1.3), axis(3, 0, 2)});
}
inline std::shared_ptr<const Grid> shearedGrid() {
    const auto lean = tests::leaning({1, 0, 0.2}, {0.5, 1, 0}, {-0.3, 0.3, 1});
    return std::make_shared<Grid>(std::array{axis(4), axis(5, 0, 0.7), axis(1)},
                                  timeseries::CoordinateFrame{lean});
}

inline const std::array<glm::dvec3, 3> kFrom = {
    glm::dvec3(0.7, -3, 1.1), glm::dvec3(-1.3, 1.2, -0.8),
    glm::dvec3(0.06, -0.11, 0.05)};  // the last from inside

}  // namespace render::true_world
