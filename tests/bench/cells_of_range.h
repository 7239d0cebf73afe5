// Cells to draw: of turbulence, on upright grids and on meshes.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>

#include "render/splat/cell_splatter.h"
#include "tests/bench/turbulence.h"
#include "tests/support/built_paths.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"
#include "tests/support/unstructured.h"
#include "timeseries/index/cell_index.h"
#include "timeseries/readers/reader.h"

namespace bench {

// The field's values have a spread of about a third.
inline constexpr double kMiddle = 0.1, kSpread = 0.33;

// Layers by cells of a field, in a range of so many thousandths of its spread.
struct CellsOfRange {
    CellsOfRange(timeseries::Field field, std::int64_t thousandths, bool isOrdered)
        : step(timeseries::SortedStep::build(std::move(field))),
          placed(step.grid()),
          scene{.step = step,
                .placed = placed,
                .layers = {},
                .footprint = {},
                .order = isOrdered ? render::Order::BackToFront : render::Order::None,
                .clip = {}} {
        scene.cells = step.cells();
        const double half = kSpread * static_cast<double>(thousandths) / 2000;
        render::Layer layer{{}, {render::Constant{{1, 0.5, 0.1}}, 0.3}};
        layer.cells.ranges = {{kMiddle - half, kMiddle + half}};
        layer.cells.candidates = scene.cells->select(layer.cells.ranges);
        scene.layers.push_back(layer);
    }
    // Refers to itself.
    CellsOfRange(const CellsOfRange&) = delete;
    CellsOfRange& operator=(const CellsOfRange&) = delete;

    void draw(render::Channels channels) {
        render::CellSum sum(scene, view, channels, 0, {}, 1, render::sharingThreads(),
                            std::move(memory));
        while (!sum.done()) sum.add(std::numeric_limits<std::uint64_t>::max());
        memory = sum.takeMemory();
    }
    render::View view = tests::lookFrom({1.2, -2.6, 0.9}, {1024, 1024}, 0.36);
    timeseries::SortedStep step;
    render::PlacedPoints placed;
    render::Scene scene;
    render::CellMemory memory;
};

// The fire's 600 to 1000 K where there are 0 points along an edge, or turbulence in a tenth of its
// spread: of one colour, or by value and in order.
struct FireOrTurbulence : CellsOfRange {
    FireOrTurbulence(std::int64_t points, bool isOrdered)
        : CellsOfRange(points == 0 ? timeseries::openReader(std::array{tests::demo()})->read(0, 15)
                                   : turbulence<float>(static_cast<std::size_t>(points)),
                       100, isOrdered) {
        render::Layer& layer = scene.layers[0];
        if (points == 0) layer.cells.ranges = {{600, 1000}};
        layer.cells.candidates = scene.cells->select(layer.cells.ranges);
        if (!isOrdered) return;
        const auto [lo, hi] = layer.cells.ranges[0];
        layer.style.color = render::ByValue{{}, lo, hi};
    }
};

// The points of a lattice placed one by one, neighbours by their indices or corners of hexahedra.
inline std::shared_ptr<const timeseries::Grid> latticeOneByOne(std::size_t n, bool ofSolids) {
    const auto place = [](double i, double j, double k) { return glm::dvec3(i, j, k); };
    if (!ofSolids) return tests::curvilinear({n, n, n}, place);
    const auto m = static_cast<std::uint32_t>(n);
    return tests::gridOf(tests::atPoints(tests::bricks({m, m, m}, tests::Cut::Hexahedra, place)));
}

}  // namespace bench
