// The tetrahedra of a scene's solid cells.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/common.hpp>

#include "render/splat/solid_tets.h"
#include "tests/support/cell_worlds.h"

namespace tests {

// use(cell, tet) for all that is seen.
template <typename Use>
void forEachTetOf(const CellWorld& world, const Use& use) {
    const render::SolidTets solids(world.placed, world.scene.cells->field(), world.scene.clip);
    const auto always = [](const auto&) { return true; };
    for (std::uint32_t cell = 0; cell < solids.count(); ++cell)
        solids.forEachTet(cell, nullptr, always, [&](const auto& tet) { use(cell, tet); });
}

// In the grid's units.
inline double volumeOf(const CellWorld& world) {
    double volume = 0;
    forEachTetOf(world, [&](std::uint32_t, const render::Tetrahedron& tet) {
        volume += std::abs(render::turnOf(tet.at)) / 6;
    });
    const glm::dvec3 scale = glm::abs(world.placed.scale());
    return volume / (scale.x * scale.y * scale.z);
}

}  // namespace tests
