#include "render/splat/gl_tets.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "render/splat/cell_view.h"
#include "timeseries/grid/solid_cells.h"

namespace render {
namespace {

constexpr double kSixAboutADiagonal = 6;

// False where it takes nothing of the range.
bool takeTet(GlTet& t, const ValuedTet& tet, const CellOfLayer& of, const Scene& scene,
             double steep) {
    const auto [low, high] = std::minmax_element(tet.values.begin(), tet.values.end());
    if (!cell::reaches(*low, *high, tet.lo, tet.hi) || isFlat(tet.at, turnOf(tet.at))) return false;
    TetSplat<float> s;
    std::array<double, 4> f{};
    tet::seeField(s, tet, *low, *high, tet::slopesOf(tet.at), scene.placed.unitLength(), f);
    for (std::size_t i = 0; i < 4; ++i)
        t.corners[i] = glm::vec4(glm::dvec4(i == 0 ? tet.at[0] : tet.at[i] - tet.at[0], f[i]));
    t.least = s.least;
    t.most = s.most;
    t.perRange = s.perRange;
    t.steep = steepnessIn(s.extent, steep);
    t.map = glMapPlaceOf(scene.layers[of.layer].style, s.reference, s.extent);
    t.kind = static_cast<std::uint32_t>(s.crossesLeast) << 4 |
             static_cast<std::uint32_t>(s.crossesMost) << 5 | std::uint32_t{of.layer} << 8;
    t.cell = of.cell;
    return true;
}

}  // namespace

double GlTets::perCell(const Scene& scene) {
    const auto& solids = scene.placed.mesh()->solids();
    return solids ? static_cast<double>(solids->tets()) / static_cast<double>(solids->count())
                  : kSixAboutADiagonal;
}

GlTets::GlTets(const Scene& scene, std::uint64_t mostBytes) : GlPieces(scene, mostBytes) {
    const double steep = steepnessOf(scene);
    std::vector<std::uint32_t> cells;
    std::vector<glm::vec4> middles;
    std::uint32_t cell = 0, layer = 0;
    take<GlTet>(
        scene,
        [&](std::span<const CellOfLayer> some, std::vector<GlTet>& pieces) {
            forEachTet(scene, some, nullptr, [&](const ValuedTet& tet, const CellOfLayer& of) {
                GlTet piece{};
                if (takeTet(piece, tet, of, scene, steep)) pieces.push_back(piece);
            });
        },
        [&](const GlTet& piece) {
            const bool goesOn = !middles.empty() && cell == piece.cell && layer == piece.kind >> 8;
            cell = piece.cell;
            layer = piece.kind >> 8;
            if (!goesOn) {
                const glm::dvec3 middle = middleOfCell(scene, cell);
                radius_ = std::max(radius_, glm::length(middle));
                middles.emplace_back(glm::dvec4(middle, 0));
            }
            cells.push_back(static_cast<std::uint32_t>(middles.size() - 1));
        });
    count_ = static_cast<std::uint32_t>(cells.size());
    cells_.emplace(std::span<const std::uint32_t>(cells));
    middles_.emplace(std::span<const glm::vec4>(middles));
}

std::uint64_t GlTets::bytes() const {
    return GlPieces::bytes() + cells_->bytes() + middles_->bytes();
}

std::shared_ptr<const gl::Buffer> GlTets::order(const CellRank& rank, GlTetOrder& order) const {
    return order({count_, radius_, pieces(), *cells_, *middles_}, rank.from());
}

}  // namespace render
