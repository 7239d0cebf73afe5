#include "render/splat/gl_cells.h"

#include <glm/vec2.hpp>
#include <utility>
#include <vector>

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

}  // namespace

GlCells::GlCells(const Scene& scene, std::uint64_t mostBytes, GlCellLister& lister)
    : GlPieces(scene),
      size_(scene.cells->size()),
      sides_(std::span<const glm::vec2>(sidesOf(scene))),
      sidesTexture_(GL_RG32F, sides_) {
    GlCellLister::Listed listed = lister(scene, sidesTexture_, mostBytes);
    slopes_ = std::move(listed.slopes);
    take(std::move(listed.pieces), std::move(listed.firsts));
}

std::uint64_t GlCells::bytes() const {
    return GlPieces::bytes() + sides_.bytes() + (slopes_ ? slopes_->bytes() : 0);
}

glm::dvec3 GlCells::keyOf(const Scene& scene, const View& view) const {
    return cellOfEye(scene, view);
}

std::shared_ptr<const gl::Buffer> GlCells::order(const Scene& scene, const View& view,
                                                 GlPieceOrder& order) const {
    return order(CellsToOrder{count(), size_, pieces()}, cellOfEye(scene, view));
}

}  // namespace render
