// Splats are put in order as wholes, by the distance of their centres. What that costs beside the
// order of their fragments, pixel by pixel.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <vector>

#include "render/model/footprint.h"
#include "render/splat/depth_order.h"
#include "render/splat/tile_splatter.h"
#include "tests/support/scenes.h"

namespace tests {

// What a splat is on a pixel, and how far from the eye its density is greatest there: where the ray
// comes nearest to its centre. REQUIRES: cells are cubes, larger than pixels.
struct Fragment {
    double distance, alpha;
    glm::dvec3 rgb;
};

inline std::vector<std::vector<Fragment>> fragmentsOf(const render::Scene& scene,
                                                      const render::View& view) {
    const render::CellsView seen(scene.placed, view);
    const render::PixelRays rays = render::pixelRays(view);
    const render::Layer& layer = scene.layers.front();
    std::vector<std::vector<Fragment>> all(std::size_t(view.size.x) * view.size.y);
    const auto add = [&](std::uint64_t p) {
        const std::uint32_t index = scene.step.gridIndex(p);
        const auto s = render::splatAt<double>(seen, index, scene.footprint);
        if (!s.visible) return;
        const glm::dvec3 away = scene.placed.position(index) - rays.eye;
        for (int y = 0; y < view.size.y; ++y)
            for (int x = 0; x < view.size.x; ++x) {
                const glm::dvec2 offset = glm::dvec2(x, y) + 0.5 - rays.centre;
                if (std::abs(offset.x - s.centre.x) > s.hi.x ||
                    std::abs(offset.y - s.centre.y) > s.hi.y)
                    continue;
                const auto weight =
                    render::weightOn<double>(s, scene.footprint.kernel, offset - s.centre,
                                             offset / rays.focal, seen.rayLength);
                if (!weight) continue;
                const glm::dvec3 along = rays.along(offset);
                all[static_cast<std::size_t>(y * view.size.x + x)].push_back(
                    {glm::dot(away, glm::normalize(along)),
                     -std::expm1(-render::opticalDepthPerWeight(layer.style.opacity) * *weight),
                     render::colorOf(layer.style, timeseries::toDouble(scene.step.value(p)))});
            }
    };
    for (const timeseries::Run& run : layer.runs)
        for (std::uint64_t i = 0; i < run.count; ++i) add(run.first + i);
    return all;
}

// The root of the mean square of the light's difference, of all channels.
inline double offItsFragments(const render::Scene& scene, const render::View& view) {
    const std::vector<float> drawn =
        render::sumTiles(scene, render::order(scene, render::pixelRays(view).eye), view,
                         render::Channels::Over, 0, {});
    auto fragments = fragmentsOf(scene, view);
    double squares = 0;
    for (std::size_t pixel = 0; pixel < fragments.size(); ++pixel) {
        std::ranges::sort(fragments[pixel], std::greater(), &Fragment::distance);
        glm::dvec4 light(0);
        for (const Fragment& f : fragments[pixel])
            light = glm::dvec4(f.rgb, 1.0) * f.alpha + light * (1 - f.alpha);
        for (int c = 0; c < 4; ++c) {
            const double off = double(drawn[4 * pixel + std::size_t(c)]) - light[c];
            squares += off * off;
        }
    }
    return std::sqrt(squares / double(drawn.size()));
}

// A smooth field, coloured by value, and places to see it from.
struct SmoothScene {
    explicit SmoothScene(double opacity)
        : scene{.step = step,
                .placed = placed,
                .layers = {{step.select(timeseries::RangeSet::parse("0.4:0.8")),
                            {render::ByValue{{}, 0.4, 0.8}, opacity}}},
                .footprint = {},
                .order = render::Order::BackToFront,
                .clip = {}} {}
    SmoothScene(const SmoothScene&) = delete;  // refers to itself
    SmoothScene& operator=(const SmoothScene&) = delete;

    glm::dvec3 fromOutside() const { return {1.3, -2.4, 0.9}; }
    glm::dvec3 within() const { return {0.1, 0.05, -0.2}; }
    glm::dvec3 alongAFace() const { return {-1.5, 0.02, placed.boxHalf().z}; }
    // The root of the mean square of the light's difference, from there.
    double offFrom(const glm::dvec3& eye) const {
        return offItsFragments(scene, lookFrom(eye, {48, 36}));
    }

    std::shared_ptr<const timeseries::Grid> grid = cube(24);
    timeseries::SortedStep step = stepOf(grid, [this](std::size_t i) {
        const glm::dvec3 p = grid->position(i) * (1.0 / 23);
        return static_cast<float>(p.x + 0.5 * std::sin(5 * p.y) + 0.3 * std::cos(7 * p.z));
    });
    render::PlacedPoints placed{step.grid()};
    render::Scene scene;
};

}  // namespace tests
