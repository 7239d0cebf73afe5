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
                groups_.push_back({piece.cell, static_cast<std::uint32_t>(middles_.size()),
                                   glm::vec3(middleOfCell(scene, piece.cell))});
            middles_.push_back(middleOf(piece));
        });
    groups_.push_back({0, static_cast<std::uint32_t>(middles_.size()), {}});
}

std::vector<std::uint32_t> GlTets::order(const CellRank& rank) const {
    constexpr std::size_t kWorthAThread = 1 << 12;
    const std::size_t groups = groups_.size() - 1;
    const unsigned shared = threadsFor(groups, kWorthAThread, sharingThreads());
    const auto share = [&](const auto& use) {  // of the groups with each thread
        sharing(shared, [&](unsigned k) { use(groups * k / shared, groups * (k + 1) / shared); });
    };
    std::vector<std::uint32_t> ranks(groups), ordered(groups), ends(groups),
        places(middles_.size());
    share([&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            ranks[i] = rank.ofMiddle(glm::dvec3(groups_[i].middle));
    });
    NearestFirst nearest(rank);
    for (const std::uint32_t r : ranks) nearest.count(r);
    nearest.allCounted();
    for (std::uint32_t i = 0; i < groups; ++i) ordered[groups - 1 - nearest.place(ranks[i])] = i;
    std::uint32_t end = 0;
    for (std::size_t i = 0; i < groups; ++i)
        ends[i] = end += groups_[ordered[i] + 1].first - groups_[ordered[i]].first;

    const glm::vec3 eye(rank.from());
    share([&](std::size_t first, std::size_t last) {
        std::vector<std::pair<float, std::uint32_t>> own;  // minus the square of how far away
        for (std::size_t i = first; i < last; ++i) {
            own.clear();
            const Group* const group = &groups_[ordered[i]];
            for (std::uint32_t p = group->first; p < group[1].first; ++p) {
                const glm::vec3 way = middles_[p] - eye;
                own.emplace_back(-glm::dot(way, way), p);
            }
            std::ranges::sort(own);
            std::uint32_t to = ends[i] - static_cast<std::uint32_t>(own.size());
            for (const auto& [nearer, place] : own) places[to++] = place;
        }
    });
    return places;
}

}  // namespace render
