// Scenes drawn by cells, and what the processor draws of them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "render/splat/cell_splatter.h"
#include "tests/support/scenes.h"

namespace tests {

constexpr std::uint64_t kAllCells = std::numeric_limits<std::uint64_t>::max();

// Layers of a step, drawn by cells.
struct CellWorld {
    CellWorld(timeseries::SortedStep s, const std::vector<std::string>& layers,
              double opacity = 0.5, render::Map map = render::Map::Flat)
        : step(std::move(s)),
          placed(step.grid(), {}, map),
          scene{.step = step,
                .placed = placed,
                .layers = {},
                .footprint = {},
                .order = render::Order::None,
                .clip = {}} {
        scene.cells = step.cells();
        if (placed.isMesh()) scene.gradients = step.gradients(placed.mesh());
        for (const std::string& text : layers) {
            const timeseries::RangeSet ranges = timeseries::RangeSet::parse(text);
            render::Layer layer{
                step.select(ranges),
                {render::Constant{glm::dvec3(scene.layers.empty() ? 1.0 : 0.0, 0.25, 1)}, opacity}};
            layer.cells.ranges = timeseries::betweenPoints(ranges, step.type());
            layer.cells.candidates = scene.cells->select(layer.cells.ranges);
            scene.layers.push_back(layer);
        }
    }
    timeseries::SortedStep step;
    render::PlacedPoints placed;
    render::Scene scene;
};

// Of the whole picture, row 0 at the bottom.
inline std::vector<float> drawn(const render::Scene& scene, const render::View& view,
                                render::Channels channels = render::Channels::Weight,
                                std::size_t layer = 0, unsigned threads = 2,
                                std::uint64_t slice = kAllCells, std::span<const float> opaque = {},
                                int raysAcross = 1) {
    render::CellSum sum(scene, view, channels, layer, opaque, raysAcross, threads);
    while (!sum.done()) sum.add(slice);
    const std::size_t floats = render::floatsPerPixel(channels);
    std::vector<float> whole(static_cast<std::size_t>(view.size.x) * view.size.y * floats);
    const render::PixelBox& box = sum.box();
    for (int y = 0; y < box.size.y; ++y)
        std::copy_n(sum.plane().begin() + std::ptrdiff_t(std::size_t(y) * box.size.x * floats),
                    std::size_t(box.size.x) * floats,
                    whole.begin() + std::ptrdiff_t((std::size_t(y + box.at.y) * view.size.x +
                                                    std::size_t(box.at.x)) *
                                                   floats));
    return whole;
}

}  // namespace tests
