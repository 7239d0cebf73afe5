// A mesh's cells in the order that they are drawn in, held against what rays pass.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include "render/reference/parts_on_rays.h"
#include "render/splat/cell_pieces.h"
#include "render/splat/face_order.h"
#include "tests/support/cell_worlds.h"
#include "tests/support/meshes.h"

namespace tests {

inline std::vector<render::CellOfLayer> listed(const render::Scene& scene, const render::View& view,
                                               unsigned threads = 2,
                                               std::uint64_t slice = kAllCells) {
    const render::CellRank rank(scene, view);
    render::CellList list(scene, render::Channels::Over, 0, &rank, threads);
    while (!list.done()) list.goOn(slice);
    return {list.cells().begin(), list.cells().end()};
}

constexpr double kTouched = 1e-4;  // of a ray along an edge; more than GapOrder takes for one place

struct Passed {
    std::size_t inOrder = 0, wrong = 0;

    Passed& operator+=(const Passed& more) {
        inOrder += more.inOrder;
        wrong += more.wrong;
        return *this;
    }
};
// Of neighbours along the rays through a picture's pixels.
inline Passed passed(const CellWorld& world, const render::View& view) {
    const auto list = listed(world.scene, view);
    std::vector<std::size_t> places(world.scene.placed.isMesh() ? 100'000 : 0);
    for (std::size_t at = 0; at < list.size(); ++at) places.at(list[at].cell) = at;
    std::vector<glm::ivec2> pixels;
    for (int y = 0; y < view.size.y; ++y)
        for (int x = 0; x < view.size.x; ++x) pixels.emplace_back(x, y);
    std::vector<std::vector<render::PartInLayer>> rays(pixels.size());
    render::addPartsOnRays(world.scene, world.scene.cells->field(), view, pixels, 2, rays);
    Passed sum;
    for (auto& parts : rays) {
        std::erase_if(parts, [](const auto& p) { return p.part.to - p.part.from < kTouched; });
        render::orderAlongRay(parts);
        for (std::size_t i = 1; i < parts.size(); ++i)
            ++(places[parts[i - 1].cell] <= places[parts[i].cell] ? sum.inOrder : sum.wrong);
    }
    return sum;
}

inline CellWorld wholeOf(const std::shared_ptr<const timeseries::Grid>& grid) {
    return {stepOfPlaces(grid, [](const auto& p) { return p.x + 0.3 * p.y; }), {"min:max"}};
}

// From far away, beside and inside.
inline std::vector<render::View> views() {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> side(-1, 1);
    std::vector<render::View> all;
    for (int i = 0; i < 9; ++i) {
        const double away = std::array{0.3, 1.2, 4.0}[static_cast<std::size_t>(i) % 3];
        all.push_back(
            lookFrom(away * glm::dvec3(side(random), side(random), side(random)), {16, 12}));
    }
    return all;
}

}  // namespace tests
