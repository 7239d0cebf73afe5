// Light on a sphere that cells draw, against that of its normals.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "render/splat/cell_view.h"
#include "tests/support/cell_rays.h"
#include "tests/support/cell_worlds.h"

namespace tests {

// Of what soft light makes of a colour, where the sphere is seen.
struct LightError {
    double rms = 0, most = 0;
    int pixels = 0;
};
// REQUIRES: a world of one layer, a thin shell at `radius` of the distance from `centre`, both in
// the grid's units, drawn opaquely and in order.
inline LightError lightErrorOfSphere(CellWorld& world, const glm::dvec3& centre, double radius,
                                     const render::Lamp& lamp) {
    constexpr glm::ivec2 kSize(80, 60);
    const render::View view = lookFrom({1.1, -2.5, 0.8}, kSize);
    const double unit = std::abs(world.placed.scale().x);
    const glm::dvec3 middle = world.placed.axesFromGrid(centre);
    world.scene.light = render::Light::Off;
    const std::vector<float> dark = drawn(world.scene, view, render::Channels::Over);
    world.scene.light = render::Light::Soft;
    world.scene.lamp = lamp;
    const double steepness = render::steepnessOf(world.scene);
    const std::vector<float> lit = drawn(world.scene, view, render::Channels::Over);
    LightError error;
    double square = 0;
    for (int y = 0; y < kSize.y; ++y)
        for (int x = 0; x < kSize.x; ++x) {
            const std::size_t at = 4 * (std::size_t(y) * kSize.x + std::size_t(x));
            const cells::Ray ray = cells::rayOf(world, view, {x + 0.5, y + 0.5});
            const glm::dvec3 d = glm::normalize(ray.along), from = ray.from - middle;
            const double along = glm::dot(d, from), of = radius * unit;
            const double under = along * along - glm::dot(from, from) + of * of;
            if (under < 0.1 * of * of) continue;  // its rim
            const glm::dvec3 normal = glm::normalize(from + (-along - std::sqrt(under)) * d);
            const render::Shade shade =
                render::shadeOf(render::Light::Soft, lamp, normal / unit, ray.along, steepness);
            const double off = lit[at] / dark[at] - shade.diffuse;
            square += off * off;
            error.most = std::max(error.most, std::abs(off));
            ++error.pixels;
        }
    error.rms = std::sqrt(square / std::max(error.pixels, 1));
    return error;
}

}  // namespace tests
