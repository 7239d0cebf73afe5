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

glm::vec3 middleOf(const GlTet& t) {
    return glm::vec3(t.corners[0]) + 0.25f * glm::vec3(t.corners[1] + t.corners[2] + t.corners[3]);
}

}  // namespace

double GlTets::perCell(const Scene& scene) {
    const auto& solids = scene.placed.mesh()->solids();
    return solids ? static_cast<double>(solids->tets()) / static_cast<double>(solids->count())
                  : kSixAboutADiagonal;
}

GlTets::GlTets(const Scene& scene, std::uint64_t mostBytes) : GlPieces(scene, mostBytes) {
    const double steep = steepnessOf(scene);
    std::uint32_t layer = 0;
    take<GlTet>(
        scene,
        [&](std::span<const CellOfLayer> cells, std::vector<GlTet>& pieces) {
            forEachTet(scene, cells, nullptr, [&](const ValuedTet& tet, const CellOfLayer& of) {
                GlTet piece{};
                if (takeTet(piece, tet, of, scene, steep)) pieces.push_back(piece);
            });
        },
        [&](const GlTet& piece) {
            const bool goesOn =
                !groups_.empty() && groups_.back().cell == piece.cell && layer == piece.kind >> 8;
            layer = piece.kind >> 8;
            if (!goesOn)
                groups_.push_back({piece.cell, static_cast<std::uint32_t>(middles_.size())});
            middles_.push_back(middleOf(piece));
        });
}

std::vector<std::uint32_t> GlTets::order(const CellRank& rank) const {
    constexpr std::size_t kWorthAThread = 1 << 12;
    std::vector<std::uint32_t> ranks(groups_.size());
    const unsigned shared = threadsFor(ranks.size(), kWorthAThread, sharingThreads());
    sharing(shared, [&](unsigned k) {
        const std::size_t last = ranks.size() * (k + 1) / shared;
        for (std::size_t i = ranks.size() * k / shared; i < last; ++i)
            ranks[i] = rank(groups_[i].cell);
    });
    NearestFirst nearest(rank);
    for (const std::uint32_t r : ranks) nearest.count(r);
    nearest.allCounted();
    std::vector<std::uint32_t> ordered(groups_.size());
    for (std::uint32_t i = 0; i < ranks.size(); ++i) ordered[nearest.place(ranks[i])] = i;

    const glm::vec3 eye(rank.from());
    std::vector<std::uint32_t> places(middles_.size());
    auto to = places.end();
    std::vector<std::pair<float, std::uint32_t>> away;
    for (const std::uint32_t group : ordered) {
        const std::size_t last =
            group + 1 < groups_.size() ? groups_[group + 1].first : middles_.size();
        away.clear();
        for (std::uint32_t i = groups_[group].first; i < last; ++i)
            away.emplace_back(glm::distance(eye, middles_[i]), i);
        std::ranges::sort(away);
        for (const auto& [distance, place] : away) *--to = place;
    }
    return places;
}

}  // namespace render
