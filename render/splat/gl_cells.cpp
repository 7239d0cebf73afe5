#include "render/splat/gl_cells.h"

#include <algorithm>
#include <glm/vec2.hpp>

#include "render/splat/cell_view.h"

namespace render {
namespace {

// In double: floats have no difference of places that are near.
std::vector<glm::vec2> sidesOf(const Scene& scene) {
    std::vector<glm::vec2> sides;
    const glm::uvec3 size = scene.cells->size();
    for (int a = 0; a < 3; ++a)
        for (std::uint32_t i = 0; i < size[a]; ++i) {
            const auto [from, to] = endsAlong(scene.placed, static_cast<std::size_t>(a), i);
            sides.emplace_back(0.5 * from + 0.5 * to, to - from);
        }
    return sides;
}

GlCell glCell(const CellSplat<float>& s, const CellOfLayer& of, unsigned octant,
              const RangeStyle& style, double steep) {
    GlCell c{};
    c.cell = of.cell;
    c.kind = octant | static_cast<std::uint32_t>(s.crossesLeast) << 4 |
             static_cast<std::uint32_t>(s.crossesMost) << 5 | std::uint32_t{of.layer} << 8;
    c.least = s.least;
    c.most = s.most;
    c.perRange = s.perRange;
    c.map = glMapPlaceOf(style, s.reference, s.extent);
    c.steep = steepnessIn(s.extent, steep);
    std::ranges::copy(s.f, c.f);
    return c;
}

}  // namespace

GlCells::GlCells(const Scene& scene, std::uint64_t mostBytes)
    : GlPieces(scene, mostBytes),
      sides_(std::span<const glm::vec2>(sidesOf(scene))),
      sidesTexture_(GL_RG32F, sides_) {
    const double steep = steepnessOf(scene);
    take<GlCell>(
        scene,
        [&](std::span<const CellOfLayer> cells, std::vector<GlCell>& pieces) {
            forEachPiece(scene, cells,
                         [&](const ValuedCell& piece, const CellOfLayer& of, unsigned octant) {
                             CellSplat<float> s;
                             if (cell::seeField(s, piece, scene.placed.unitLength()))
                                 pieces.push_back(
                                     glCell(s, of, octant, scene.layers[of.layer].style, steep));
                         });
        },
        [&](const GlCell& piece) {
            cells_.push_back(timeseries::indicesOf(piece.cell, scene.cells->size()));
        });
}

std::shared_ptr<const gl::Buffer> GlCells::order(const CellRank& rank, GlTetOrder&) const {
    NearestFirst order(rank);
    for (const glm::uvec3& cell : cells_) order.count(rank(cell));
    order.allCounted();
    std::vector<std::uint32_t> places(cells_.size());
    for (std::size_t i = 0; i < cells_.size(); ++i)
        places[cells_.size() - 1 - order.place(rank(cells_[i]))] = static_cast<std::uint32_t>(i);
    return std::make_shared<const gl::Buffer>(std::span<const std::uint32_t>(places));
}

}  // namespace render
