// Rays through interval volumes: how far they run in a box, and what they meet of a field.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "tests/support/cell_worlds.h"
#include "tests/support/scenes.h"

namespace tests::cells {

using namespace render;
using timeseries::Grid;

constexpr std::uint64_t kAll = tests::kAllCells;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// A ray in axis coordinates, a unit of which is `length` long in the world.
struct Ray {
    glm::dvec3 from, along;
    double length, near;
};
inline Ray rayOf(const CellWorld& world, const View& view, const glm::dvec2& pixel) {
    const PixelRays rays = besideFaces(pixelRays(world.placed.inAxes(view)));
    const glm::dvec3 along = rays.along(pixel - rays.centre);
    return {rays.eye, along, glm::length(world.placed.worldFromAxes() * along), rays.near};
}

// Where a ray is inside a box: [first, second] of it, empty where first > second.
inline std::pair<double, double> inside(const Ray& ray, const PlacedPoints::Box& box) {
    double from = ray.near, to = std::numeric_limits<double>::infinity();
    for (int a = 0; a < 3; ++a) {
        const double one = (box.lo[a] - ray.from[a]) / ray.along[a];
        const double other = (box.hi[a] - ray.from[a]) / ray.along[a];
        from = std::max(from, std::min(one, other));
        to = std::min(to, std::max(one, other));
    }
    return {from, to};
}

inline double pathThrough(const CellWorld& world, const View& view, int x, int y,
                          const PlacedPoints::Box& box) {
    const Ray ray = rayOf(world, view, {x + 0.5, y + 0.5});
    const auto [from, to] = inside(ray, box);
    return std::max(to - from, 0.0) * ray.length / world.placed.unitLength();
}

// The cell that a point stands for.
inline PlacedPoints::Box boxOf(const PlacedPoints& placed, const glm::uvec3& point) {
    PlacedPoints::Box box{};
    for (int a = 0; a < 3; ++a) {
        const auto& at = placed.positions()[std::size_t(a)];
        const auto& width = placed.widths()[std::size_t(a)];
        const std::size_t i = point[a], last = at.size() - 1;
        const double up = at.front() > at.back() ? -1 : 1;
        const double one = i > 0 ? (at[i] + at[i - 1]) / 2 : at[0] - up * width[0] / 2;
        const double other = i < last ? (at[i] + at[i + 1]) / 2 : at[i] + up * width[i] / 2;
        box.lo[a] = std::min(one, other);
        box.hi[a] = std::max(one, other);
    }
    return box;
}

// The field at a place, linear along each axis between points and constant beyond the last.
inline double fieldAt(const CellWorld& world, const std::vector<float>& values,
                      const glm::dvec3& place) {
    glm::uvec3 at{0};
    glm::dvec3 share{0};
    const glm::uvec3 n = world.placed.size();
    for (int a = 0; a < 3; ++a) {
        const auto& p = world.placed.positions()[std::size_t(a)];
        if (p.size() == 1) continue;
        const bool down = p.front() > p.back();
        unsigned i = 0;
        while (i + 2 < p.size() && (down ? p[i + 1] > place[a] : p[i + 1] < place[a])) ++i;
        at[a] = i;
        share[a] = std::clamp((place[a] - p[i]) / (p[i + 1] - p[i]), 0.0, 1.0);
    }
    double sum = 0;
    for (unsigned c = 0; c < 8; ++c) {
        double weight = 1;
        glm::uvec3 i = at;
        for (int a = 0; a < 3; ++a) {
            weight *= c >> a & 1 ? share[a] : 1 - share[a];
            if (c >> a & 1) i[a] = std::min(i[a] + 1, n[a] - 1);
        }
        if (weight > 0)
            sum += weight * double(values[i.x + std::size_t(n.x) * (i.y + std::size_t(n.y) * i.z)]);
    }
    return sum;
}

// What a pixel sees of lo <= field <= hi, by samples, in units of l.
inline double sampled(const CellWorld& world, const std::vector<float>& values, const View& view,
                      int x, int y, double lo, double hi) {
    constexpr int kRays = 3, kSamples = 500;
    double sum = 0;
    for (int s = 0; s < kRays * kRays; ++s) {
        const Ray ray =
            rayOf(world, view, {x + (s % kRays + 0.5) / kRays, y + (s / kRays + 0.5) / kRays});
        const auto [from, to] = inside(ray, world.placed.domain());
        if (!(to > from)) continue;
        int in = 0;
        for (int i = 0; i < kSamples; ++i) {
            const double t = from + (to - from) * (i + 0.5) / kSamples;
            const double f = fieldAt(world, values, ray.from + t * ray.along);
            in += f >= lo && f <= hi ? 1 : 0;
        }
        sum += (to - from) * ray.length * in / kSamples;
    }
    return sum / (kRays * kRays) / world.placed.unitLength();
}

inline double relativeL2(const std::vector<float>& is, const std::vector<double>& wanted) {
    double difference = 0, size = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        difference += std::pow(double(is[i]) - wanted[i], 2);
        size += wanted[i] * wanted[i];
    }
    return std::sqrt(difference / size);
}

inline std::shared_ptr<const Grid> unevenGrid() {
    auto uneven = axis(5);
    uneven.coordinates = {0, 1, 1.5, 3, 5};
    auto down = axis(4, 7, -1.3);
    return std::make_shared<Grid>(std::array{uneven, down, axis(3, 0, 2)});
}

const std::array<glm::dvec3, 3> kFrom = {glm::dvec3(0.7, -3, 1.1), glm::dvec3(-1.3, 1.2, -0.8),
                                         glm::dvec3(0.06, -0.11, 0.05)};  // the last from inside

}  // namespace tests::cells
