// Small worlds for picture tests.
#pragma once

#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <random>

#include "render/model/scene.h"
#include "render/points/view.h"
#include "tests/support/sorted.h"

namespace tests {

inline timeseries::Axis axis(std::size_t n, double first = 0, double step = 1) {
    timeseries::Axis a{.name = "x", .units = "m", .coordinates = {}, .down = false};
    for (std::size_t i = 0; i < n; ++i)
        a.coordinates.push_back(first + step * static_cast<double>(i));
    return a;
}

inline std::shared_ptr<const timeseries::Grid> cube(std::size_t n) {
    return std::make_shared<timeseries::Grid>(std::array{axis(n), axis(n), axis(n)});
}

// Directions turned about no axis in particular.
inline glm::dmat3 rotation(double angle) {
    return glm::dmat3(glm::rotate(glm::dmat4(1.0), angle, glm::normalize(glm::dvec3(1, -2, 3))));
}

// Columns scaled to length 1: directions that lean over each other.
inline glm::dmat3 leaning(const glm::dvec3& x, const glm::dvec3& y, const glm::dvec3& z) {
    return {glm::normalize(x), glm::normalize(y), glm::normalize(z)};
}

// Values f(i) by grid index.
template <typename F>
timeseries::SortedStep stepOf(std::shared_ptr<const timeseries::Grid> grid, const F& f) {
    std::vector<float> values(grid->count());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(f(i));
    return tests::sorted({std::move(grid), std::move(values), {}});
}

// A field of a grid's places.
template <typename F>
timeseries::SortedStep stepOfPlaces(const std::shared_ptr<const timeseries::Grid>& grid,
                                    const F& f) {
    return stepOf(grid, [&](std::size_t i) { return f(grid->position(i)); });
}

// Uniform noise in [0, 1).
inline timeseries::SortedStep noise(std::shared_ptr<const timeseries::Grid> grid,
                                    unsigned seed = 7) {
    std::mt19937 random(seed);
    return stepOf(std::move(grid),
                  [&](std::size_t) { return static_cast<double>(random() >> 8) / (1 << 24); });
}

// An eye at `from` looking at the origin, z up, with half angles of tangent `tangent`.
inline render::View lookFrom(glm::dvec3 from, glm::ivec2 size, double tangent = 0.4) {
    const double aspect = static_cast<double>(size.x) / size.y;
    return {.clipFromView = render::clipFromView(
                {-tangent * aspect, tangent * aspect, -tangent, tangent, 0.01, 5000}),
            .viewFromWorld = glm::lookAt(from, glm::dvec3(0), glm::dvec3(0, 0, 1)),
            .size = size};
}

}  // namespace tests
