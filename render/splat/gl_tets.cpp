#include "render/splat/gl_tets.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "render/shader_sources.h"
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

std::shared_ptr<const gl::Buffer> GlTets::order(const CellRank& rank, GlRadixSort& sort) const {
    auto places = std::make_shared<const gl::Buffer>(count_ * sizeof(std::uint32_t));
    if (count_ == 0) return places;
    if (!programs_)
        programs_.emplace(Programs{gl::Program::ofCompute("tet_keys", shaders::tet_keys_comp),
                                   GlRadixSort::scatter("#define PLACES\n")});
    const double away = glm::length(rank.from()), s = std::max(away, radius_);
    const glm::vec4 eye = s > 0 ? glm::vec4(glm::dvec4(rank.from() / s, away / s)) : glm::vec4(0);
    const auto findKeys = [&](bool ofCells) {
        constexpr GLuint kGroup = 256, kAcross = 1 << 15;
        glUseProgram(programs_->keys.id());
        glUniform1ui(0, count_);
        glUniform1i(1, ofCells ? 1 : 0);
        glUniform4fv(2, 1, &eye.x);
        glUniform1f(3, s > 0 ? static_cast<float>(1 / s) : 0);
        pieces().bindStorage(0);
        cells_->bindStorage(1);
        middles_->bindStorage(2);
        sort.entries().bindStorage(3);
        const GLuint groups = (count_ + kGroup - 1) / kGroup, across = std::min(groups, kAcross);
        glDispatchCompute(across, (groups + across - 1) / across, 1);
        betweenShaders();
    };
    constexpr unsigned kDigits = 4;
    sort.begin(count_);
    findKeys(false);
    sort.sort(0, kDigits);
    findKeys(true);
    sort.sort(0, kDigits - 1);
    places->bindStorage(2);
    sort.last(8 * (kDigits - 1), programs_->places);
    sort.shrink();
    return places;
}

}  // namespace render
